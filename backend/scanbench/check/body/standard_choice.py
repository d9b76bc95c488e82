"""Selection and comparison: SEL, MUX, MIN, MAX, LIMIT, GT and its like, on every type that they can have."""

from collections.abc import Callable
from itertools import pairwise

from scanbench.check.body import fold, standard_fold
from scanbench.check.body.allowed import allowed
from scanbench.check.body.coercion import as_type, coerce
from scanbench.check.body.context import Body
from scanbench.check.body.lenient import INTEGRAL, unsigned
from scanbench.check.body.operators import operate
from scanbench.check.body.standard_arguments import checked, hold, integer, ordered, unify
from scanbench.check.dialect import Allowance
from scanbench.check.standard.functions import REALS, Chain, Row, Same
from scanbench.problems import Span
from scanbench.program.program import Assign, Const, Expr, If, Load, Place, Sequence, Stmt
from scanbench.program.types import BOOL, LINT, LREAL, Elementary, Kind, StringType, Type
from scanbench.syntax import tree


def same(body: Body, node: tree.Call, name: str, row: Same, wanted: Type | None, typed: Type | None) -> Expr:
    """ABS, SQRT, MAX ...: all arguments and the result have one type."""
    values = checked(body, node, name, row, typed or wanted)
    values = alike(body, values, node.span, name, wanted, typed)
    type = widest(values)
    if isinstance(type, Elementary | StringType) and type.kind in row.kinds:
        result = values[0]
        if len(row.formals) == 1:
            return standard_fold.intrinsic(row.intrinsic, type, (result,))
        for value in values[1:]:
            result = standard_fold.intrinsic(row.intrinsic, type, (result, value))
        return result
    if row.kinds == REALS and (numbers := _as_reals(body, values, node.span, name)) is not None:
        return standard_fold.intrinsic(row.intrinsic, LREAL, numbers)
    raise body.report.reject("T002", f"`{name}` cannot work on {type}.{_hint(type, row.kinds)}", node.span)


def _as_reals(body: Body, values: list[Expr], span: Span, name: str) -> tuple[Expr, ...] | None:
    """Integers and bit strings as LREAL, where the dialect has that; EXP(2) is 7.389056099 in its documentation, more than a REAL has."""
    types = [value.type for value in values]
    if not all(isinstance(each, Elementary) and each.kind in INTEGRAL for each in types):
        return None
    if not allowed(
        body,
        Allowance.REAL_FUNCTIONS,
        span,
        f"`{name}` takes {types[0]} as LREAL",
        f"`{name}({types[0]}_TO_LREAL(...))`",
    ):
        return None
    whole = [
        fold.convert(unsigned(type), value) if isinstance(type, Elementary) and type.kind is Kind.BITS else value
        for value, type in zip(values, types, strict=True)
    ]
    return tuple(fold.convert(LREAL, value) for value in whole)


def alike(body: Body, values: list[Expr], span: Span, name: str, wanted: Type | None, typed: Type | None) -> list[Expr]:
    """All of the type that the function's name says, or of their common one."""
    if typed is None:
        return unify(body, values, span, name, wanted)
    return [coerce(body, value, typed, span, f"Each argument of `{name}`") for value in values]


def chain(body: Body, node: tree.Call, name: str, row: Chain, typed: Type | None) -> Expr:
    """`GT(a, b, c)`; all arguments are evaluated once, in order."""
    values = checked(body, node, name, row, typed)
    if typed is not None:
        values = alike(body, values, node.span, name, None, typed)
    if len(values) == 2:
        return operate(body, row.op, values[0], values[1], node.span)
    run: list[Stmt] = []
    for index, value in enumerate(values):
        if not isinstance(value, Const):
            first, values[index] = hold(body, value, node.span)
            run += first
    result: Expr | None = None
    for left, right in pairwise(values):
        test = operate(body, row.op, left, right, node.span)
        result = test if result is None else fold.binary("and", BOOL, result, test)
    assert result is not None
    return Sequence(tuple(run), result) if run else result


def sel(body: Body, node: tree.Call, name: str, row: Row, wanted: Type | None, typed: Type | None) -> Expr:
    """`SEL(G, IN0, IN1)`."""
    gate_tree, *rest = ordered(body, node, name, row)
    gate = as_type(body, gate_tree, BOOL, "`G`")
    values = alike(body, [body.expression(each, typed or wanted) for each in rest], node.span, name, wanted, typed)
    type = widest(values)
    if isinstance(type, Elementary | StringType):
        return standard_fold.intrinsic("SEL", type, (gate, *values))
    held, chosen = hold(body, gate, node.span)
    return _copied(body, values, held, lambda index: chosen, node.span)


def _copied(body: Body, values: list[Expr], first: tuple[Stmt, ...], test: Callable[[int], Expr], span: Span) -> Expr:
    """Whole arrays or structures: all are evaluated, then the last one whose test holds is copied over the first."""
    type = values[0].type
    assert type is not None
    places = [body.temporary(type, span) for _ in values]
    run: list[Stmt] = [*first, *(Assign(*each, span) for each in zip(places, values, strict=True))]
    for index, place in enumerate(places[1:], 1):
        run.append(If(((test(index), (Assign(places[0], Load(place), span),)),), (), span))
    return Sequence(tuple(run), Load(places[0]))


def mux(body: Body, node: tree.Call, name: str, row: Row, wanted: Type | None, typed: Type | None) -> Expr:
    """`MUX(K, IN0, IN1, ...)`."""
    selector_tree, *rest = ordered(body, node, name, row)
    selector = integer(body, body.expression(selector_tree), selector_tree.span, name)
    values = alike(body, [body.expression(each, typed or wanted) for each in rest], node.span, name, wanted, typed)
    type = widest(values)
    if isinstance(type, Elementary | StringType):
        return standard_fold.intrinsic("MUX", type, (selector, *values))
    held, chosen = hold(body, selector, node.span)
    return _copied(body, values, held, lambda index: fold.compare("ge", BOOL, chosen, Const(LINT, index)), node.span)


def limit(
    body: Body, node: tree.Call, name: str, row: Row, wanted: Type | None, typed: Type | None, eno: Place | None
) -> Expr:
    """MIN(MAX(MN, IN), MX). `eno` becomes FALSE where IN is not between MN and MX."""
    values = checked(body, node, name, row, typed or wanted)
    low, value, high = values = alike(body, values, node.span, name, wanted, typed)
    type = widest(values)
    if not isinstance(type, Elementary | StringType):
        raise body.report.reject("T002", f"`{name}` cannot work on {type}.", node.span)
    run: tuple[Stmt, ...] = ()
    if eno is not None:
        (first, low), (second, value), (third, high) = (hold(body, each, node.span) for each in (low, value, high))
        above, below = fold.compare("ge", BOOL, value, low), fold.compare("le", BOOL, value, high)
        run = (*first, *second, *third, Assign(eno, fold.binary("and", BOOL, above, below), node.span))
    limited = standard_fold.intrinsic("MIN", type, (standard_fold.intrinsic("MAX", type, (low, value)), high))
    return Sequence(run, limited) if run else limited


def widest(values: list[Expr]) -> Type | None:
    """The type of values that are alike: of strings, the longest."""
    types = [value.type for value in values]
    strings = [type for type in types if isinstance(type, StringType)]
    return max(strings, key=lambda type: type.capacity) if strings else types[0]


def _hint(type: Type | None, kinds: tuple[Kind, ...]) -> str:
    whole = isinstance(type, Elementary) and type.kind in (Kind.INT, Kind.UINT)
    if whole and kinds == (Kind.REAL,):
        return f" Convert it with {type}_TO_{'LREAL' if type is not None and type.size > 2 else 'REAL'}."
    names = {Kind.INT: "numbers", Kind.REAL: "REAL and LREAL", Kind.TIME: "durations", Kind.BITS: "bit strings"}
    return f" It takes {', '.join(names[kind] for kind in kinds if kind in names)}."
