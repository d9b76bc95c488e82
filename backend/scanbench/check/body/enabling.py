"""Calls with EN and ENO."""

from collections.abc import Container
from dataclasses import dataclass, replace

from scanbench.check.body import fold, targets
from scanbench.check.body.callees import callee_of, invoked, standard_function
from scanbench.check.body.coercion import as_type, coerce
from scanbench.check.body.context import Body
from scanbench.check.body.subrange_checks import explicitly
from scanbench.check.declare.scopes import decode
from scanbench.problems import Span
from scanbench.program.program import Assign, Const, Expr, If, Load, Place, Pou, SetBytes, Stmt
from scanbench.program.types import BOOL, Elementary, Type, initial_of
from scanbench.program.untyped import is_untyped, settle
from scanbench.syntax import tree
from scanbench.syntax.networks import wire_at


@dataclass(frozen=True, slots=True)
class Enabling:
    """The EN and ENO of a call, apart from the call itself."""

    call: tree.Call
    en: tree.Argument | None
    eno: tree.Argument | None


def enabled(body: Body, apart: Enabling, wanted: Type | None) -> tuple[list[Stmt], Expr | None]:
    """A call with EN or ENO: what runs, and where its result is."""
    with explicitly(body, apart.call):
        return _enabled_call(body, apart, wanted)


def _enabled_call(body: Body, apart: Enabling, wanted: Type | None) -> tuple[list[Stmt], Expr | None]:
    node, span = apart.call, apart.call.span
    condition = condition_of(body, apart.en)
    ok = body.temporary(BOOL, span) if apart.eno is not None else None
    callee = callee_of(body, node.callee, node)
    if callee is None:
        run, result, is_told = _enabled_standard(body, node, wanted, ok)
    else:
        called = callee if isinstance(callee, Pou) else callee[1].pou
        inputs = called.frame.members if called is not None else ()
        made = invoked(body, callee, given_enable(apart, inputs), ok)
        pou = made.call.pou
        result = body.temporary(pou.result, span) if pou.result is not None else None
        run, is_told = made.statements(span, result), "ENO" in pou.parameters
    if ok is not None and not is_told:
        run.append(Assign(ok, Const(BOOL, 1), span))
    if condition is not None:
        skipped = without_call(body, node)
        if result is not None:
            skipped.append(_zero(result, span))
        if ok is not None:
            skipped.append(Assign(ok, Const(BOOL, 0), span))
        run = [If(((condition, tuple(run)),), tuple(skipped), span)]
    if ok is not None and apart.eno is not None:
        run.append(store_eno(body, Load(ok), apart.eno))
    return run, Load(result) if result is not None else None


def _enabled_standard(
    body: Body, node: tree.Call, wanted: Type | None, ok: Place | None
) -> tuple[list[Stmt], Place | None, bool]:
    """The same for a standard function: what runs, its result, and whether it tells ENO itself."""
    value = standard_function(body, node, wanted, ok)
    if is_untyped(value):
        literal = isinstance(wanted, Elementary)
        value = coerce(body, value, wanted, node.span, "The result") if literal and wanted else settle(value)
    assert value.type is not None
    result = body.temporary(value.type, node.span)
    run: list[Stmt] = [] if ok is None else [Assign(ok, Const(BOOL, 1), node.span)]
    return [*run, Assign(result, value, node.span)], result, ok is not None


def condition_of(body: Body, en: tree.Argument | None) -> Expr | None:
    """What EN is given."""
    if en is None or en.value is None:
        return None
    return as_type(body, en.value, BOOL, "`EN`")


def store_eno(body: Body, value: Expr, eno: tree.Argument) -> Stmt:
    """Stores the value in what ENO is bound to."""
    if eno.value is None:
        raise body.report.reject("T004", "`ENO` needs a variable: write `ENO => ...`.", eno.span)
    target = targets.target(body, eno.value)
    value = fold.unary("not", BOOL, value) if eno.negated else value
    return Assign(target, coerce(body, value, target.type, eno.span, "The target of `ENO`"), eno.span)


def told(eno: tree.Argument, ok: tree.Expression) -> tree.Expression:
    """What `ENO => x` or `NOT ENO => x` gives to x."""
    return tree.UnaryOp("not", ok, eno.span) if eno.negated else ok


def _zero(place: Place, span: Span) -> Stmt:
    data = initial_of(place.type)
    constant = decode(place.type, data)
    if constant is not None and isinstance(place.type, Elementary):
        return Assign(place, constant, span)
    return SetBytes(place, data, span)


def without_call(body: Body, node: tree.Call) -> list[Stmt]:
    """What EN does where it keeps a box from being called: wires at its outputs have their defaults."""
    wires = [wire for each in node.arguments if (wire := wire_at(each)) is not None]
    return [_zero(body.place(each)[0], each.span) for each in wires]


def enabling(node: tree.Call) -> Enabling:
    """Takes EN and ENO off the arguments."""
    en = next((each for each in node.arguments if each.name and each.name.upper() == "EN" and not each.output), None)
    eno = next((each for each in node.arguments if each.name and each.name.upper() == "ENO" and each.output), None)
    if en is None and eno is None:
        return Enabling(node, None, None)
    rest = tuple(each for each in node.arguments if each is not en and each is not eno)
    return Enabling(replace(node, arguments=rest), en, eno)


def given_enable(apart: Enabling, inputs: Container[str]) -> tree.Call:
    """The call itself; it runs when EN is TRUE, and so that is what a declared input EN gets."""
    node, en = apart.call, apart.en
    if en is None or en.value is None or "EN" not in inputs:
        return node
    argument = replace(en, value=tree.Literal("bool", 1, None, en.span))
    return replace(node, arguments=(*node.arguments, argument))
