"""Instructions of TIA Portal that assign something: each is spelled out as statements of the standard.

From https://docs.tia.siemens.cloud, the help on each instruction; STRG_VAL, VAL_STRG and S_CONV from the S7-1200 System Manual.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

from scanbench.check.body.allowed import may, used
from scanbench.check.body.context import Body
from scanbench.check.body.generic import tried
from scanbench.check.dialect import Allowance
from scanbench.problems import Span
from scanbench.program.program import Const
from scanbench.program.types import DINT, ArrayType, Elementary, Kind, Record, StringType, Type
from scanbench.program.untyped import bounds, settle
from scanbench.syntax import tree

Given = Mapping[str, tree.Expression]
Spelled = tuple[tree.Statement, ...]

SET_BACK = frozenset("TP TP_TIME TP_LTIME TOF TOF_TIME TOF_LTIME TONR_TIME".split())
"""Timers that are not set back by a call with IN := FALSE."""
MOST = 256
"""Elements of a block that are assigned one by one; more are a loop."""


def spelled_out(body: Body, node: tree.Call) -> Spelled | None:
    """The statements that the instruction is; None of other calls."""
    if not isinstance(node.callee, tree.Name) or not may(body, Allowance.BLOCK_MOVES):
        return None
    name = node.callee.name.upper()
    found = INSTRUCTIONS.get(name)
    if found is None or name in body.pous.functions or body.scope.find(name) is not None:
        return None
    formals, spell = found
    given: dict[str, tree.Expression] = {}
    for at, argument in enumerate(node.arguments):
        formal = formals[min(at, len(formals) - 1)] if argument.name is None else argument.name.upper()
        if argument.value is not None:
            given[formal] = argument.value
    missing = next((formal for formal in formals if formal not in given), None)
    if missing is not None or (len(given) > len(formals) and name != "DEMUX"):
        raise body.report.reject("T004", f"`{name}` takes {', '.join(formals)}.", node.span)
    made = spell(body, name, given, node.span)
    if not made:
        return None
    used(body, Allowance.BLOCK_MOVES, node.callee.span, f"`{name}` is spelled out as assignments")
    return made


def _move(body: Body, name: str, given: Given, span: Span) -> Spelled:
    """MOVE_BLK and FILL_BLK: elements of an array, from one on."""
    count = given["COUNT"]
    known = body.expression(count)
    fixed = known.value if isinstance(known, Const) else None
    source, target = given["IN"], given["OUT"]
    if isinstance(fixed, int) and fixed <= 0:
        raise body.report.reject("T004", f"COUNT of `{name}` is 1 at least.", count.span)

    def one(ahead: tree.Expression | None) -> tree.Statement:
        value = source if "FILL" in name else _element(body, source, ahead, name)
        return tree.Assignment(_element(body, target, ahead, name), value, span)

    if isinstance(fixed, int) and fixed <= MOST:
        return tuple(one(_number(at, span) if at else None) for at in range(fixed))
    index = _temporary(body, DINT, span)
    next_one = tree.Assignment(index, tree.BinaryOp("add", index, _number(1, span), span), span)
    loop = tree.WhileStatement(tree.BinaryOp("lt", index, count, span), (one(index), next_one), span)
    return (tree.Assignment(index, _number(0, span), span), loop)


def _whole(body: Body, name: str, given: Given, span: Span) -> Spelled:
    """BLKMOV and S_MOVE: all of a variable."""
    source, target = given.get("SRCBLK", given.get("IN")), given.get("DSTBLK", given.get("OUT"))
    assert source is not None
    assert target is not None
    return (tree.Assignment(target, source, span),)


def _preset(body: Body, name: str, given: Given, span: Span) -> Spelled:
    """PRESET_TIMER: how long a timer takes."""
    return (tree.Assignment(tree.MemberOf(given["TIMER"], "PT", span), given["PT"], span),)


def _reset(body: Body, name: str, given: Given, span: Span) -> Spelled:
    """RESET_TIMER of a timer that IN := FALSE does not set back: all that it has becomes 0. None of others, which a call sets back."""
    type = body.place(given["TIMER"])[0].type
    if not isinstance(type, Record) or type.name.upper() not in SET_BACK:
        return ()
    return tuple(_zeros(given["TIMER"], type, span))


def _zeros(node: tree.Expression, type: Record, span: Span) -> Iterator[tree.Statement]:
    for member in type.members.values():
        part = tree.MemberOf(node, member.name, span)
        if isinstance(member.type, Record):
            yield from _zeros(part, member.type, span)
        elif not member.hidden and isinstance(member.type, Elementary):
            kind = "bool" if member.type.kind is Kind.BOOL else "time"
            wanted = None if kind == "bool" else member.type.name
            yield tree.Assignment(part, tree.Literal(kind, 0, wanted, span), span)


def _scatter(body: Body, name: str, given: Given, span: Span) -> Spelled:
    """SCATTER and GATHER: the bits of a bit string, and the elements of an ARRAY of BOOL."""
    apart = name == "SCATTER"
    whole, single = (given["IN"], given["OUT"]) if apart else (given["OUT"], given["IN"])
    bits, array = tried(body, whole).type, body.place(single)[0].type
    if not isinstance(bits, Elementary) or bits.kind is not Kind.BITS:
        raise body.report.reject("T002", f"`{name}` needs a bit string here, not {bits}.", whole.span)
    if not isinstance(array, ArrayType) or len(array.bounds) != 1 or array.count != bits.size * 8:
        raise body.report.reject(
            "T002", f"`{name}` needs an ARRAY of {bits.size * 8} BOOL beside {bits}, not {array}.", single.span
        )
    low = array.bounds[0][0]
    made = []
    for bit in range(bits.size * 8):
        one = tree.IndexOf(single, (_number(low + bit, span),), span)
        part = tree.PartialAccess(whole, "X", bit, span)
        made.append(tree.Assignment(one, part, span) if apart else tree.Assignment(part, one, span))
    return tuple(made)


def _demux(body: Body, name: str, given: Given, span: Span) -> Spelled:
    """DEMUX: the value into the output of the number K, or into OUTELSE."""
    value = given["IN"]
    branches = []
    for formal, target in given.items():
        if formal.startswith("OUT") and formal[3:].isdigit():
            label = (_number(int(formal[3:]), span), None)
            branches.append(((label,), (tree.Assignment(target, value, span),)))
    other = given.get("OUTELSE")
    orelse = () if other is None else (tree.Assignment(other, value, span),)
    return (tree.CaseStatement(given["K"], tuple(branches), orelse, span),)


def _read(body: Body, name: str, given: Given, span: Span) -> Spelled:
    """STRG_VAL: the number that is in a text."""
    type = body.place(given["OUT"])[0].type
    formals = {key: given.get(key, _number(at, span)) for at, key in enumerate(("FORMAT", "P"))}
    if not isinstance(type, Elementary) or type.kind not in (Kind.INT, Kind.UINT, Kind.REAL):
        raise body.report.reject("T002", f"`{name}` needs a number at OUT, not {type}.", span)
    arguments = {"IN": given["IN"], **formals}
    if type.kind is Kind.REAL:
        read = _call("STRG_VAL_LREAL", arguments, span)
    else:
        limits = {
            key: tree.Literal("real", float(value), None, span)
            for key, value in zip(("LOW", "HIGH"), bounds(type), strict=True)
        }
        read = _call("STRG_VAL_LINT", {**arguments, **limits}, span)
    source = "LREAL" if type.kind is Kind.REAL else "LINT"
    same = type.name == source
    return (tree.Assignment(given["OUT"], read if same else _call(f"{source}_TO_{type}", {"": read}, span), span),)


def _write(body: Body, name: str, given: Given, span: Span) -> Spelled:
    """VAL_STRG: a number into a text, over characters of it."""
    kind = _kind(body, name, given["IN"])
    function = f"VAL_STRG_{'LREAL' if kind is Kind.REAL else 'LINT'}"
    arguments = {key: given[key] for key in ("IN", "SIZE", "PREC", "FORMAT", "P")}
    return (tree.Assignment(given["OUT"], _call(function, {**arguments, "OLD": given["OUT"]}, span), span),)


def _convert(body: Body, name: str, given: Given, span: Span) -> Spelled:
    """S_CONV: an integer as a text, a text as a number, a text as it is."""
    source = settle(tried(body, given["IN"])).type
    if isinstance(source, StringType):
        if isinstance(body.place(given["OUT"])[0].type, StringType):
            return _whole(body, name, given, span)
        return _read(body, name, {**given, "FORMAT": _number(0, span), "P": _number(1, span)}, span)
    if _kind(body, name, given["IN"]) is Kind.REAL:
        raise body.report.reject(
            "X001", "S_CONV of a REAL is not read: its number of digits is not documented. Write VAL_STRG.", span
        )
    return (tree.Assignment(given["OUT"], _call("S_CONV_LINT", {"IN": given["IN"]}, span), span),)


def _kind(body: Body, name: str, node: tree.Expression) -> Kind:
    type: Type | None = settle(tried(body, node)).type
    if not isinstance(type, Elementary) or type.kind not in (Kind.INT, Kind.UINT, Kind.REAL):
        raise body.report.reject("T002", f"`{name}` needs a number at IN, not {type}.", node.span)
    return type.kind


def _call(name: str, arguments: Mapping[str, tree.Expression], span: Span) -> tree.Call:
    made = tuple(tree.Argument(key or None, False, value, span) for key, value in arguments.items())
    return tree.Call(tree.Name(name, span), made, span)


def _temporary(body: Body, type: Type, span: Span) -> tree.Name:
    return tree.Name(body.temporary(type, span).variable.rpartition(".")[2], span)


def _element(body: Body, node: tree.Expression, ahead: tree.Expression | None, name: str) -> tree.Expression:
    """The element so many places after this one."""
    if not isinstance(node, tree.IndexOf):
        raise body.report.reject("T002", f"`{name}` begins with an element of an array, `a[0]`.", node.span)
    index = tree.BinaryOp("add", node.indices[-1], ahead, node.span) if ahead is not None else node.indices[-1]
    return replace(node, indices=(*node.indices[:-1], index))


def _number(value: int, span: Span) -> tree.Expression:
    return tree.Literal("int", value, None, span)


Spell = Callable[[Body, str, Given, Span], Spelled]
_BLOCK = ("IN", "COUNT", "OUT")
INSTRUCTIONS: dict[str, tuple[tuple[str, ...], Spell]] = {
    **dict.fromkeys(("MOVE_BLK", "UMOVE_BLK", "FILL_BLK", "UFILL_BLK"), (_BLOCK, _move)),
    "S_MOVE": (("IN", "OUT"), _whole),
    "PRESET_TIMER": (("PT", "TIMER"), _preset),
    "RESET_TIMER": (("TIMER",), _reset),
    "SCATTER": (("IN", "OUT"), _scatter),
    "GATHER": (("IN", "OUT"), _scatter),
    "DEMUX": (("K", "IN", "OUT0"), _demux),
    "STRG_VAL": (("IN", "FORMAT", "P", "OUT"), _read),
    "VAL_STRG": (("IN", "SIZE", "PREC", "FORMAT", "P", "OUT"), _write),
    "S_CONV": (("IN", "OUT"), _convert),
}
