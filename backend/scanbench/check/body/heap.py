"""`__NEW(type)`, `__NEW(type, count)` and `__DELETE(pointer)` of vendors: memory of the library `__HEAP`, which is part of the image."""

from dataclasses import replace

from scanbench.check.body import fold
from scanbench.check.body.allowed import may, used
from scanbench.check.body.arguments import invoke
from scanbench.check.body.context import Body
from scanbench.check.body.references import reference_type
from scanbench.check.context import Rejected
from scanbench.check.declare.classes import Class
from scanbench.check.declare.creations import FB_EXIT
from scanbench.check.declare.start_references import own_references
from scanbench.check.dialect import Allowance
from scanbench.check.life.start import Writer, referring
from scanbench.problems import Span
from scanbench.program.program import (
    Assign,
    Base,
    CallFunction,
    Const,
    Evaluate,
    Expr,
    If,
    Load,
    Place,
    Sequence,
    SetBytes,
    Stmt,
)
from scanbench.program.shown import shown
from scanbench.program.sites import TrapKind
from scanbench.program.types import BOOL, NULL, ULINT, Kind, OpenArray, Record, Reference, Type, initial_of
from scanbench.syntax import tree
from scanbench.syntax.parse_expression import POINTER_TO

FORMS = ("__NEW", "__DELETE")
HEAP = "__HEAP"


def heap_form(body: Body, node: tree.Call, name: str) -> Expr | None:
    """One of `FORMS`; None where the user declared something of that name."""
    if name in body.pous.functions or body.scope.find(name) is not None:
        return None
    if not may(body, Allowance.HEAP) or body.pou is None:
        raise body.report.reject(
            "X001", f"`{name}` is not supported: memory that is allocated while the program runs.", node.callee.span
        )
    if f"{HEAP}.TAKE" not in body.pous.functions:
        raise body.report.reject(
            "X001", f"`{name}` needs the library `{HEAP}`; add it to the project.", node.callee.span
        )
    used(body, Allowance.HEAP, node.callee.span, f"`{name}` uses the memory of the library `{HEAP}`")
    values = [each.value for each in node.arguments if each.name is None and each.value is not None]
    if name == "__NEW" and len(values) == len(node.arguments) in (1, 2):
        return _new(body, node, values[0], values[1] if len(values) == 2 else None)
    if name == "__DELETE" and len(values) == len(node.arguments) == 1:
        return _delete(body, node, values[0])
    takes = "a type, and perhaps how many" if name == "__NEW" else "one pointer"
    raise body.report.reject("T004", f"`{name}` takes {takes}.", node.span)


def _new(body: Body, node: tree.Call, named: tree.Expression, count: tree.Expression | None) -> Expr:
    arguments: tuple[tree.Argument, ...] = ()
    if isinstance(named, tree.Call):  # `__NEW(Unit(number := 3))`: what FB_init gets
        arguments, named = named.arguments, named.callee
    if not isinstance(named, tree.Name | tree.MemberOf):
        raise body.report.reject("T004", "`__NEW` takes the name of a type.", named.span)
    target, pointers = shown(named), 0
    while target.startswith(f"{POINTER_TO} "):
        target, pointers = target.removeprefix(f"{POINTER_TO} "), pointers + 1
    type = body.declarations.named(target, named.span)
    if isinstance(type, OpenArray) or (isinstance(type, Record) and type.kind is Kind.INTERFACE):
        raise body.report.reject("T004", f"`__NEW` makes no {type}.", named.span)
    for _ in range(pointers):
        type = reference_type(type, pointer=True)
    size = tree.Literal("int", max(type.size, 1), None, node.span)
    taken = _call(body, "Take", (size, count or tree.Literal("int", 1, None, node.span)), node.span)
    pointer = reference_type(type, pointer=True)
    kept = body.temporary(pointer, node.span)
    first = Assign(kept, fold.convert(pointer, fold.convert(ULINT, taken)), node.span)
    made = _initialised(body, type, kept, node.span, arguments, one=count is None)
    there = fold.compare("ne", BOOL, Load(kept), Const(NULL, 0))
    stores: tuple[Stmt, ...] = (first, If(((there, tuple(made)),), (), node.span)) if made else (first,)
    return Sequence(stores, Load(kept))


def _initialised(
    body: Body, type: Type, kept: Place, span: Span, arguments: tuple[tree.Argument, ...], one: bool
) -> list[Stmt]:
    """What is new starts as a variable of the type does; its memory is all zero."""
    data, life = initial_of(type), body.pous.life
    lives = life is not None and life.needs.of(type)
    if arguments and not lives:
        raise body.report.reject("T004", f"{type} has no FB_init that could take these; write `__NEW({type})`.", span)
    references = own_references(body.declarations, type)
    if not any(data) and not references and not lives:
        return []
    if not one:
        raise body.report.reject(
            "X001", f"`__NEW` makes several of {type} only where all of it starts as zero; make them one by one.", span
        )
    trap = body.trap(TrapKind.NULL, span, "there is no room in the memory for __NEW")
    place = Place(type, Base.IMAGE, 0, null_trap=trap, reference=Load(kept))
    made: list[Stmt] = [SetBytes(place, data, span)] if any(data) else []
    for at, (value, base) in references.items():
        target = replace(place, type=value.type, offset=at)
        made.append(Assign(target, referring(place, value, base), span))
    if life is not None and lives:
        made += Writer(body, life, lambda member: place, passed_on=False).whole(place, type, span, arguments)
    return made


def _delete(body: Body, node: tree.Call, value: tree.Expression) -> Expr:
    place, _ = body.place(value)
    if not isinstance(place.type, Reference) or not place.type.pointer:
        raise body.report.reject("T002", f"`__DELETE` takes a pointer, not {place.type}.", value.span)
    ended: list[Stmt] = []
    ended += _ended(body, node, value, body.pous.classes.of(place.type.target))
    ended.append(_done(body, _call(body, "Give", (value,), node.span), node.span))
    ended.append(Assign(place, Const(place.type, 0), node.span))
    there = fold.compare("ne", BOOL, Load(place), Const(NULL, 0))
    return Sequence((If(((there, tuple(ended)),), (), node.span),), Const(BOOL, 1))


def _ended(body: Body, node: tree.Call, value: tree.Expression, owner: Class | None) -> list[Stmt]:
    """FB_exit of the instance, then those of the bases, the nearest first
    (https://infosys.beckhoff.com/content/1033/tc3_plc_intro/5482088715.html)."""
    first = None if owner is None else owner.find(FB_EXIT)
    if first is None:
        return []
    off = tree.Argument(None, False, tree.Literal("bool", 0, None, node.span), node.span)
    callee = tree.MemberOf(tree.Dereference(value, value.span), "FB_exit", node.span)
    made = [_done(body, body.call(tree.Call(callee, (off,), node.span)), node.span)]
    above = first.owner.base
    while above is not None:
        own = above.methods.get(FB_EXIT)
        if own is not None and own.pou is not None and not own.abstract:
            instance, _ = body.place(tree.Dereference(value, value.span))
            given = replace(instance, type=own.pou.frame.members["THIS"].type)
            call = tree.Call(tree.Name(own.name, node.span), (off,), node.span)
            made += invoke(body, call, own.pou, own.name, given, None).statements(node.span)
        above = above.base
    return made


def _done(body: Body, value: Expr, span: Span) -> Stmt:
    """A call whose result nobody wants."""
    if isinstance(value, CallFunction):
        return Evaluate(value, span)
    return Assign(body.temporary(value.type or BOOL, span), value, span)


def _call(body: Body, name: str, values: tuple[tree.Expression, ...], span: Span) -> Expr:
    """A call of a function of the library, which nobody is told of."""
    arguments = tuple(tree.Argument(None, False, each, span) for each in values)
    callee = tree.MemberOf(tree.Name(HEAP, span), name, span)
    made = body.call(tree.Call(callee, arguments, span))
    if made.type is None:
        raise Rejected
    return made
