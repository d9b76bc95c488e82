"""Instructions of TIA Portal that are called in other ways than functions and blocks of the standard, where the dialect has that.

`timer.TON(IN := start)` calls the instance itself; `NORM_X(...)` is the function of the library for the
types of its arguments, as the help on the instruction says how its type is found.
"""

from dataclasses import replace

from scanbench.check.body.allowed import may, used
from scanbench.check.body.coercion import SHORT
from scanbench.check.body.context import Body
from scanbench.check.body.generic import tried
from scanbench.check.body.places import VARIABLES
from scanbench.check.context import Rejected
from scanbench.check.declare.names import qualified
from scanbench.check.dialect import Allowance
from scanbench.problems import Span
from scanbench.program.shown import shown
from scanbench.program.types import DINT, INT, LREAL, REAL, UINT, Elementary, Kind, Record, StringType, Type, base_of
from scanbench.program.untyped import ANY_INT, ANY_REAL, common, settle
from scanbench.syntax import tree

OF_INSTANCES = frozenset(("TON", "TOF", "TP", "TONR", "CTU", "CTD", "CTUD"))
BY_ARGUMENTS = {"NORM_X": ("MIN", "VALUE", "MAX"), "SCALE_X": ("MIN", "MAX"), "SWAP": ("IN",)}
TIMES = {"T_ADD": "add", "T_SUB": "sub", "T_DIFF": "sub"}
"""Instructions that are `+` or `-` but for DTL, of which the library has functions."""
BY_OUTPUT = frozenset(("RD_SYS_T", "RD_LOC_T"))
"""Instructions that the library has for LDT and DT as well, by the type of OUT."""
AS_INPUTS = frozenset("MOVE_BLK_VARIANT BLKMOV UBLKMOV FILL DPRD_DAT ATH HTA SERIALIZE DESERIALIZE".split())
"""Functions of the library whose outputs are a Variant, which is passed as an input."""
OF_STRINGS = frozenset(("CONCAT", "LEN", "LEFT", "RIGHT", "MID", "INSERT", "DELETE", "REPLACE", "FIND"))
"""Functions of texts, whose names may end with `_STRING` or `_WSTRING`."""
"""Instructions whose type is that of these arguments; the library has them for each type."""

RESET = frozenset(("TON", "TON_TIME", "TON_LTIME", "IEC_TIMER"))
REFUSED = {"DB_ANY_TO_VARIANT": "data blocks have no numbers here. Pass the data block itself"}
"""Beginnings of names of instructions that are known, and what to do instead."""


def instructed(body: Body, node: tree.Call, wanted: Type | None = None) -> tree.Call:
    """The call as the standard would have it, if it is one of an instruction; else as it is."""
    match node.callee:
        case tree.Name(name=name) if may(body, Allowance.INSTRUCTION_TYPES):
            return _typed(body, node, name.upper(), wanted)
        case tree.MemberOf(owner=owner, name=name) if may(body, Allowance.INSTRUCTION_CALLS):
            return _of_instance(body, node, owner, name.upper())
    return node


def _of_instance(body: Body, node: tree.Call, owner: tree.Expression, name: str) -> tree.Call:
    """`timer.TON(...)` as `timer(...)`, where `timer` is of such a block: TON, TON_TIME, and so on."""
    if name not in OF_INSTANCES:
        return _of_data_block(body, node, owner, name)
    type = body.place(owner)[0].type
    if not isinstance(type, Record) or type.name.upper().split("_")[0] != name:
        return node
    instance = shown(owner)
    used(body, Allowance.INSTRUCTION_CALLS, node.span, f"`{instance}` is called by `{name}`", f"`{instance}(...)`")
    return replace(node, callee=owner)


def _of_data_block(body: Body, node: tree.Call, owner: tree.Expression, name: str) -> tree.Call:
    """`"Block"."Data"(...)` as `"Data"(...)`, where the data block is an instance of that block."""
    found = body.scope.find(name)
    if found is None or not isinstance(owner, tree.Name) or body.scope.find(owner.name) is not None:
        return node
    type = found[0].type
    if not isinstance(type, Record) or type.name.upper() != owner.name.upper():
        return node
    instance = found[0].name
    told = f"`{instance}` is called by `{owner.name}`"
    used(body, Allowance.INSTRUCTION_CALLS, node.span, told, f"`{instance}(...)`")
    return replace(node, callee=tree.Name(instance, node.callee.span))


def _typed(body: Body, node: tree.Call, name: str, wanted: Type | None) -> tree.Call:
    if name in AS_INPUTS:
        return replace(node, arguments=tuple(replace(each, output=False) for each in node.arguments))
    plain, _, ending = name.rpartition("_")
    if plain in OF_STRINGS and ending in ("STRING", "WSTRING"):
        return replace(node, callee=tree.Name(plain, node.callee.span))
    if name in BY_OUTPUT:
        return _by_output(body, node, name)
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
    found = f"{name}_{_type_of(body, node, name, wanted)}"
    used(body, Allowance.INSTRUCTION_TYPES, node.callee.span, f"`{name}` is `{found}` here", f"`{found}(...)`")
    return replace(node, callee=tree.Name(found, node.callee.span))


def _by_output(body: Body, node: tree.Call, name: str) -> tree.Call:
    """RD_SYS_T and RD_LOC_T of LDT or DT."""
    value = node.arguments[0].value if node.arguments else None
    type = None if value is None else tried(body, value).type
    if not isinstance(type, Elementary) or type.kind is not Kind.DATE:
        return node
    return replace(node, callee=tree.Name(f"{name}_{type}", node.callee.span))


def calculated(body: Body, node: tree.Call, wanted: Type | None) -> tree.Expression:
    """T_ADD, T_SUB and T_DIFF of other types than DTL as the operator that they are, MUX with INELSE; other calls as they are."""
    if not isinstance(node.callee, tree.Name) or not may(body, Allowance.INSTRUCTION_TYPES):
        return node
    name = node.callee.name.upper()
    values = [each.value for each in node.arguments if each.value is not None]
    if name == "NAME_OF" and len(values) == 1:
        return _name_of(body, node, values[0])
    if name == "MUX" and any((each.name or "").upper() == "INELSE" for each in node.arguments):
        return _mux(body, node)
    if name == "T_CONV" and len(values) == 1:
        return _converted(body, node, values[0], wanted)
    if name == "MAX_LEN" and len(values) == 1 and isinstance(text := tried(body, values[0]).type, StringType):
        return tree.Literal("int", text.capacity, None, node.span)
    if name not in TIMES or len(values) != 2 or not isinstance(tried(body, values[0]).type, Elementary):
        return node
    used(body, Allowance.INSTRUCTION_TYPES, node.callee.span, f"`{name}` calculates with times", "`+` or `-`")
    return tree.BinaryOp(TIMES[name], values[0], values[1], node.span)


def _name_of(body: Body, node: tree.Call, value: tree.Expression) -> tree.Expression:
    """`NAME_OF(OnDelay)` of SIMATIC AX: the whole name of what is declared, as a text."""
    path, declared = shown(value), body.declarations
    key = declared.names.find(path, value.span, declared.block_trees, declared.type_trees, body.pous.functions)
    if key is None:
        raise body.report.reject("T001", f"There is no `{path}` of which this could be the name.", value.span)
    tree_of = declared.block_trees.get(key) or declared.type_trees.get(key)
    pou = body.pous.functions.get(key)
    name = qualified(tree_of.namespace, tree_of.name) if tree_of is not None else pou.name if pou is not None else path
    return tree.Literal("string", name.encode("latin-1", "replace"), None, node.span)


def _converted(body: Body, node: tree.Call, value: tree.Expression, wanted: Type | None) -> tree.Expression:
    """T_CONV: the conversion from the type of the value to the one that is wanted."""
    source = settle(tried(body, value)).type
    if wanted is None or source is None:
        raise body.report.reject("T004", "`T_CONV` is assigned to a variable, whose type it converts to.", node.span)
    names = [SHORT.get(each.name, each.name) for each in (source, wanted)]
    used(body, Allowance.INSTRUCTION_TYPES, node.callee.span, f"`T_CONV` is {names[0]}_TO_{names[1]} here")
    return value if source == wanted else _called(f"{names[0]}_TO_{names[1]}", (value,), node.span)


def with_moments(body: Body, node: tree.BinaryOp) -> tree.BinaryOp:
    """A comparison of two DTL as one of the moments that they are."""
    if not may(body, Allowance.INSTRUCTION_TYPES):
        return node
    sides = [each for each in (node.left, node.right) if isinstance(each, VARIABLES) or _is_literal(each)]
    types = [tried(body, each).type for each in sides]
    if len(types) != 2 or any(not isinstance(each, Record) or each.name.upper() != "DTL" for each in types):
        return node
    used(body, Allowance.INSTRUCTION_TYPES, node.span, "Moments are compared", "`DTL_TO_LDT(...)`")
    left, right = (_called("DTL_TO_LDT", (each,), node.span) for each in (node.left, node.right))
    return replace(node, left=left, right=right)


def _is_literal(node: tree.Expression) -> bool:
    """Whether it is what a literal of DTL is read as."""
    return isinstance(node, tree.Call) and isinstance(node.callee, tree.Name) and node.callee.name == "LDT_TO_DTL"


def _mux(body: Body, node: tree.Call) -> tree.Expression:
    """MUX whose last value is taken where K is the number of none."""
    given = {(each.name or "").upper(): each.value for each in node.arguments}
    selector, last = given.get("K"), given.pop("INELSE")
    values = [value for key, value in given.items() if key.startswith("IN")]
    if selector is None or last is None or None in values or len(values) != len(given) - 1:
        raise body.report.reject("T004", "`MUX` takes K, IN0, IN1 and so on, INELSE.", node.span)
    count = tree.Literal("int", len(values), None, node.span)
    zero = tree.Literal("int", 0, None, node.span)
    outside = tree.BinaryOp("lt", selector, zero, node.span)
    number = _called("SEL", (outside, selector, count), node.span)
    used(body, Allowance.INSTRUCTION_TYPES, node.callee.span, "`MUX` has INELSE")
    return _called("MUX", (number, *(each for each in values if each is not None), last), node.span)


def _called(name: str, values: tuple[tree.Expression, ...], span: Span) -> tree.Call:
    return tree.Call(tree.Name(name, span), tuple(tree.Argument(None, False, each, span) for each in values), span)


def _reset(body: Body, node: tree.Call) -> tree.Call:
    """RESET_TIMER of an on-delay timer as a call with IN FALSE, which sets all of it to 0 as well."""
    timer = next((each.value for each in node.arguments if each.value is not None), None)
    type = None if timer is None else body.place(timer)[0].type
    if timer is None or not isinstance(type, Record) or type.name.upper() not in RESET:
        raise body.report.reject(
            "X001", "RESET_TIMER is read for TON, TOF, TP, TONR and IEC_TIMER. Call another timer with IN := FALSE until its time is over.",
            node.span,
        )  # fmt: skip
    name = shown(timer)
    used(body, Allowance.INSTRUCTION_CALLS, node.span, f"RESET_TIMER sets `{name}` back", f"`{name}(IN := FALSE)`")
    if type.name.upper() == "IEC_TIMER":
        return replace(node, callee=tree.MemberOf(timer, "RESET", node.callee.span), arguments=())
    false = tree.Literal("bool", 0, None, node.span)
    return replace(node, callee=timer, arguments=(tree.Argument("IN", False, false, node.span),))


def _type_of(body: Body, node: tree.Call, name: str, wanted: Type | None) -> Type:
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
    if not known and isinstance(wanted, Elementary) and wanted in (INT, DINT, UINT, REAL, LREAL):
        joined = wanted  # whatever TIA chooses, the nearest integer is stored
    if joined is None:
        raise body.report.reject(
            "T004", f"Which type `{name}` has with these arguments is not documented. Write it after the name, e.g. `{name}_REAL` or `{name}_INT`.",
            node.span,
        )  # fmt: skip
    return joined
