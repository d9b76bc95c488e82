"""Instructions of TIA Portal that are called in other ways than functions and blocks of the standard, where the dialect has that.

`timer.TON(IN := start)` calls the instance itself; `NORM_X(...)` is the function of the library for the
types of its arguments, as the help on the instruction says how its type is found.
"""

from dataclasses import replace

from scanbench.check.body.allowed import may, used
from scanbench.check.body.context import Body
from scanbench.check.body.generic import tried
from scanbench.check.context import Rejected
from scanbench.check.dialect import Allowance
from scanbench.program.shown import shown
from scanbench.program.types import LREAL, REAL, Elementary, Record, Type, base_of
from scanbench.program.untyped import ANY_INT, ANY_REAL, common
from scanbench.syntax import tree

OF_INSTANCES = frozenset(("TON", "TOF", "TP", "TONR", "CTU", "CTD", "CTUD"))
BY_ARGUMENTS = {"NORM_X": ("MIN", "VALUE", "MAX"), "SCALE_X": ("MIN", "MAX"), "SWAP": ("IN",)}
"""Instructions whose type is that of these arguments; the library has them for each type."""

RESET = frozenset(("TON", "TON_TIME", "TON_LTIME", "IEC_TIMER"))
_MEMORY = "memory has no numbers here. Declare a variable, and use its name and its parts, `x.%B0`"
_VARIANT = "there is no Variant. Declare the parameter with the type that is passed, an array as ARRAY[*]"
REFUSED = {
    **dict.fromkeys(("PEEK", "POKE"), _MEMORY),
    **dict.fromkeys(
        ("VARIANTGET", "VARIANTPUT", "TYPEOF", "IS_ARRAY", "COUNTOFELEMENTS", "MOVE_BLK_VARIANT", "DB_ANY_TO_VARIANT"),
        _VARIANT,
    ),
    **dict.fromkeys(("SERIALIZE", "DESERIALIZE"), _VARIANT),
}
"""Beginnings of names of instructions that are known, and what to do instead."""


def instructed(body: Body, node: tree.Call) -> tree.Call:
    """The call as the standard would have it, if it is one of an instruction; else as it is."""
    match node.callee:
        case tree.Name(name=name) if may(body, Allowance.INSTRUCTION_TYPES):
            return _typed(body, node, name.upper())
        case tree.MemberOf(owner=owner, name=name) if may(body, Allowance.INSTRUCTION_CALLS):
            return _of_instance(body, node, owner, name.upper())
    return node


def _of_instance(body: Body, node: tree.Call, owner: tree.Expression, name: str) -> tree.Call:
    """`timer.TON(...)` as `timer(...)`, where `timer` is of such a block: TON, TON_TIME, and so on."""
    if name not in OF_INSTANCES:
        return node
    type = body.place(owner)[0].type
    if not isinstance(type, Record) or type.name.upper().split("_")[0] != name:
        return node
    instance = shown(owner)
    used(body, Allowance.INSTRUCTION_CALLS, node.span, f"`{instance}` is called by `{name}`", f"`{instance}(...)`")
    return replace(node, callee=owner)


def _typed(body: Body, node: tree.Call, name: str) -> tree.Call:
    declared = body.declarations.names.find(name, node.callee.span, body.pous.functions, body.pous.generic)
    if declared is not None:
        return node
    if name == "RESET_TIMER":
        return _reset(body, node)
    if (mend := next((REFUSED[each] for each in REFUSED if name.startswith(each)), None)) is not None:
        values = [argument.value for argument in node.arguments]
        names = {value.name.upper() for value in values if isinstance(value, tree.Name)}
        if {(body.scope.pou.upper(), each) for each in names} & body.declarations.broken:
            raise Rejected  # its type is told where it is declared
        raise body.report.reject("X001", f"`{shown(node.callee)}` is not supported: {mend}.", node.callee.span)
    if name not in BY_ARGUMENTS:
        return node
    found = f"{name}_{_type_of(body, node, name)}"
    used(body, Allowance.INSTRUCTION_TYPES, node.callee.span, f"`{name}` is `{found}` here", f"`{found}(...)`")
    return replace(node, callee=tree.Name(found, node.callee.span))


def _reset(body: Body, node: tree.Call) -> tree.Call:
    """RESET_TIMER of an on-delay timer as a call with IN FALSE, which sets all of it to 0 as well."""
    timer = next((each.value for each in node.arguments if each.value is not None), None)
    type = None if timer is None else body.place(timer)[0].type
    if timer is None or not isinstance(type, Record) or type.name.upper() not in RESET:
        raise body.report.reject(
            "X001", "RESET_TIMER is read for TON, TON_TIME and IEC_TIMER. Call another timer with IN := FALSE until its time is over.",
            node.span,
        )  # fmt: skip
    name = shown(timer)
    used(body, Allowance.INSTRUCTION_CALLS, node.span, f"RESET_TIMER sets `{name}` back", f"`{name}(IN := FALSE)`")
    if type.name.upper() == "IEC_TIMER":
        return replace(node, callee=tree.MemberOf(timer, "RESET", node.callee.span), arguments=())
    false = tree.Literal("bool", 0, None, node.span)
    return replace(node, callee=timer, arguments=(tree.Argument("IN", False, false, node.span),))


def _type_of(body: Body, node: tree.Call, name: str) -> Type:
    formals = BY_ARGUMENTS[name]
    given = {
        (argument.name or "").upper() or formals[min(at, len(formals) - 1)]: argument.value
        for at, argument in enumerate(node.arguments)
        if argument.value is not None
    }
    types = [tried(body, given[formal]).type for formal in formals if formal in given]
    known = [base_of(each) for each in types if isinstance(each, Elementary) and each not in (ANY_INT, ANY_REAL)]
    if name == "NORM_X":
        return LREAL if LREAL in known else REAL
    joined: Elementary | None = known[0] if known else None
    for each in known[1:]:
        made = common(joined, each) if joined is not None else None
        joined = made if isinstance(made, Elementary) else None
    if not known and ANY_REAL in types:
        joined = REAL
    if joined is None:
        raise body.report.reject(
            "T004", f"Which type `{name}` has with these arguments is not documented. Write it after the name, e.g. `{name}_REAL` or `{name}_INT`.",
            node.span,
        )  # fmt: skip
    return joined
