"""Calls of standard functions -> intrinsics and operations."""

import re
from dataclasses import replace
from functools import partial

from scanbench.check.body import conversions, fold, standard_fold, wide
from scanbench.check.body.allowed import allowed, may, used
from scanbench.check.body.bitwise import inverted, literal_inverted, literal_of
from scanbench.check.body.coercion import as_type, coerce
from scanbench.check.body.context import Body
from scanbench.check.body.growing import is_ax
from scanbench.check.body.lenient import bits_of, literal_shifted, shifted, shifted_with_sign
from scanbench.check.body.named_texts import name_of
from scanbench.check.body.operators import operate
from scanbench.check.body.short_times import clock
from scanbench.check.body.standard_arguments import checked, integer, ordered
from scanbench.check.body.standard_choice import alike, chain, limit, mux, same, sel
from scanbench.check.dialect import Allowance
from scanbench.check.standard.functions import (
    FUNCTIONS,
    INTERNAL,
    Chain,
    Operator,
    Row,
    Same,
    Shift,
    Special,
    StringFunction,
)
from scanbench.program.origin import in_library
from scanbench.program.program import Compare, Const, Expr, Place
from scanbench.program.shown import shown
from scanbench.program.types import (
    BOOL,
    CHAR,
    DINT,
    ELEMENTARY,
    INT,
    LINT,
    LTIME,
    MAX_STRING,
    TIME,
    ULINT,
    Elementary,
    Enumeration,
    Kind,
    Reference,
    StringType,
    Type,
)
from scanbench.program.untyped import settle
from scanbench.syntax import tree

TYPED = re.compile(r"([A-Z]+)_([A-Z]+)")
STANDARD_STRING = 255
"""Characters of a text in the functions of the vendors' Standard library."""
LARGEST = {4: 3.4028234663852886e38, 8: 1.7976931348623157e308}
"""The largest finite number of a REAL and an LREAL."""


def standard_call(body: Body, node: tree.Call, name: str, wanted: Type | None, eno: Place | None = None) -> Expr | None:
    """The call of a standard function by its upper-case name; None where there is no such function.

    EN and ENO are not among the arguments any more. `eno` is TRUE before, and set to FALSE where the function
    itself finds that its result is not right.
    """
    row = FUNCTIONS.get(name)
    if row is None and in_library(node.span):
        row = INTERNAL.get(name)
    if row is not None:
        return _row(body, node, name, name, row, wanted, None, eno)
    conversion = _conversion(body, node, name, wanted)
    if conversion is not None:
        return conversion
    match = TYPED.fullmatch(name)
    typed = ELEMENTARY.get(match.group(2)) if match else None
    row = FUNCTIONS.get(match.group(1)) if match else None
    if match is None or row is None or typed is None:
        return None
    return _row(body, node, name, match.group(1), row, wanted, typed, eno)


def _row(body: Body, node: tree.Call, name: str, base: str, row: Row, wanted: Type | None, typed: Elementary | None,
    eno: Place | None,
) -> Expr:  # fmt: skip
    """`name` as written; `base` without the type in it, `typed`."""
    match row:
        case Same():
            return same(body, node, name, row, wanted, typed)
        case Chain():
            return chain(body, node, name, row, typed)
        case Shift():
            return _shift(body, node, name, row, wanted, typed)
        case StringFunction():
            return _string_function(body, node, name, row)
        case Operator():
            return _operator(body, node, name, row, wanted, typed)
        case Special():
            match base:
                case "SEL":
                    return sel(body, node, name, row, wanted, typed)
                case "MUX":
                    return mux(body, node, name, row, wanted, typed)
                case "LIMIT":
                    return limit(body, node, name, row, wanted, typed, eno)
            return _special(body, node, name, base, row, wanted, typed)


def _operator(
    body: Body, node: tree.Call, name: str, row: Operator, wanted: Type | None, typed: Elementary | None
) -> Expr:
    values = checked(body, node, name, row, typed or (None if row.types else wanted))
    if row.types is not None:
        values = [
            coerce(body, value, type, node.span, f"`{formal}` of `{name}`")
            for value, type, formal in zip(values, row.types, row.formals, strict=True)
        ]
    elif typed is not None:
        values = alike(body, values, node.span, name, None, typed)
    result = values[0]
    for value in values[1:]:
        result = operate(body, row.op, result, value, node.span, wanted)
    return result


def _shift(body: Body, node: tree.Call, name: str, row: Shift, wanted: Type | None, typed: Elementary | None) -> Expr:
    bits_tree, count_tree = ordered(body, node, name, row)
    bits = body.expression(bits_tree, typed or wanted)
    if typed is not None:
        bits = coerce(body, bits, typed, bits_tree.span, "`IN`")
    elif isinstance(bits, Const) and isinstance(wanted, Elementary) and wanted.kind is Kind.BITS:
        bits = coerce(body, bits, wanted, bits_tree.span, "`IN`")
    if may(body, Allowance.INTEGER_SHIFTS):
        bits = literal_of(body, bits, wanted) or bits
        moved = integer(body, body.expression(count_tree), count_tree.span, name)
        signed = shifted_with_sign(body, row.intrinsic, bits, moved, bits_tree.span)
        if signed is not None:
            return signed
    whole = shifted(body, row.intrinsic, bits, bits_tree.span)
    if whole is not None:
        count = integer(body, body.expression(count_tree), count_tree.span, name)
        value, type, result = whole
        return fold.convert(result, standard_fold.intrinsic(row.intrinsic, type, (value, count)))
    count = integer(body, body.expression(count_tree), count_tree.span, name)
    literal = literal_shifted(body, row.intrinsic, bits, count, bits_tree.span)
    if literal is not None:
        return literal
    given = settle(bits).type
    if not isinstance(bits.type, Elementary) or bits.type.kind is not Kind.BITS or not bits.type.size:
        hint = ""
        if isinstance(given, Elementary) and given.kind in (Kind.INT, Kind.UINT):
            same = bits_of(given)
            hint = f" Convert it with {given}_TO_{same}, or write {same}#..."
        raise body.report.reject("T002", f"`{name}` needs a bit string, not {given}.{hint}", bits_tree.span)
    return standard_fold.intrinsic(row.intrinsic, bits.type, (bits, count))


def _string_function(body: Body, node: tree.Call, name: str, row: StringFunction) -> Expr:
    values = checked(body, node, name, row)
    args: list[Expr] = []
    for value, kind in zip(values, row.kinds.ljust(len(values), "s"), strict=True):
        if kind == "n":
            args.append(integer(body, value, node.span, name))
            continue
        if isinstance(value.type, Elementary) and value.type.kind is Kind.CHAR:
            value = standard_fold.intrinsic("CHAR_STR", StringType(1, value.type.size), (value,))
        if not isinstance(value.type, StringType):
            raise body.report.reject("T002", f"`{name}` needs a STRING, not {settle(value).type}.", node.span)
        args.append(_in_standard(body, node, value))
    strings = [arg.type for arg in args if isinstance(arg.type, StringType)]
    if any(each.width != strings[0].width for each in strings):
        raise body.report.reject(
            "T002", f"`{name}` cannot join STRING and WSTRING; convert one with STRING_TO_WSTRING.", node.span
        )
    if row.result == "INT":
        return standard_fold.intrinsic(row.intrinsic, INT, tuple(args))
    if row.variadic:
        result = args[0]
        for arg in args[1:]:
            joined = standard_fold.intrinsic(row.intrinsic, _capacity(result, arg), (result, arg))
            result = _in_standard(body, node, joined)
        return result
    kept = args[:1] if row.result == "first" else args
    return _in_standard(body, node, standard_fold.intrinsic(row.intrinsic, _capacity(*kept), tuple(args)))


def _in_standard(body: Body, node: tree.Call, text: Expr) -> Expr:
    """A text as the functions of the vendors' Standard library take and give it: STRING(255).

    https://content.helpme-codesys.com/en/libs/Standard/Current/String-Functions/INSERT.html
    """
    if not isinstance(text.type, StringType) or in_library(node.span) or not may(body, Allowance.ARGUMENT_NAMES):
        return text
    if text.type.capacity <= STANDARD_STRING:
        return text
    return standard_fold.intrinsic(
        "LEFT", StringType(STANDARD_STRING, text.type.width), (text, Const(LINT, STANDARD_STRING))
    )


def _special(
    body: Body, node: tree.Call, name: str, base: str, row: Special, wanted: Type | None, typed: Elementary | None
) -> Expr:
    values = checked(body, node, name, row, typed or wanted)
    if typed is not None and base not in ("IS_VALID", "TIME", "LTIME"):
        values = alike(body, values, node.span, name, None, typed)
    match base:
        case "TIME" | "LTIME":
            return clock(body, LTIME if base == "LTIME" else TIME)
        case "MOVE":
            return values[0]
        case "NOT":
            return _not(body, node, values[0], wanted)
        case "IS_VALID":
            return _is_valid(body, node, name, settle(values[0]))
        case "__CODE_AT":
            position = integer(body, values[1], node.span, name)
            return fold.convert(INT, standard_fold.intrinsic("CHAR_AT", CHAR, (values[0], position)))
        case "MUL_TIME" | "DIV_TIME" | "MUL_LTIME" | "DIV_LTIME" | "MULTIME" | "DIVTIME":
            time = coerce(body, values[0], LTIME if "_L" in base else TIME, node.span, "`IN1`")
            return operate(body, base[:3].lower(), time, values[1], node.span)
    return _byte_order(body, node, name, values[0], wanted)


def _not(body: Body, node: tree.Call, value: Expr, wanted: Type | None) -> Expr:
    value = settle(value) if wanted is None else value
    if isinstance(wanted, Elementary) and wanted.kind is Kind.BITS and isinstance(value, Const):
        value = coerce(body, value, wanted, node.span, "`IN`")
    made = inverted(body, value, node.span) or literal_inverted(body, value, wanted, node.span)
    if made is not None:
        return made
    if not isinstance(value.type, Elementary) or value.type.kind not in (Kind.BOOL, Kind.BITS):
        raise body.report.reject("T002", f"`NOT` needs BOOL or a bit string, not {settle(value).type}.", node.span)
    return fold.unary("not", value.type, value)


def _is_valid(body: Body, node: tree.Call, name: str, value: Expr) -> Expr:
    if not isinstance(value.type, Elementary) or value.type.kind is not Kind.REAL:
        raise body.report.reject("T002", f"`{name}` needs a REAL or LREAL, not {value.type}.", node.span)
    size = standard_fold.intrinsic("ABS", value.type, (value,))
    return Compare("le", BOOL, size, Const(value.type, LARGEST[value.type.size]))


def _byte_order(body: Body, node: tree.Call, name: str, value: Expr, wanted: Type | None) -> Expr:
    """The image is little endian; big endian is the other way round."""
    if isinstance(value, Const) and isinstance(wanted, Elementary) and wanted.kind in conversions.WHOLE:
        value = coerce(body, value, wanted, node.span, "`IN`")
    value = settle(value)
    type = value.type
    if not isinstance(type, Elementary) or type.kind in (Kind.REAL, Kind.REF):
        hint = ""
        if isinstance(type, Elementary) and type.kind is Kind.REAL:
            hint = f" Take its bits with {type}_TO_{'DWORD' if type.size == 4 else 'LWORD'} first."
        raise body.report.reject("T002", f"`{name}` cannot work on {type}.{hint}", node.span)
    return standard_fold.intrinsic("SWAP", type, (value,)) if name.endswith("BIG_ENDIAN") and type.size > 1 else value


def _user_type(body: Body, name: str, node: tree.Call) -> Type | None:
    if not body.declarations.find_type(name, node.span):
        return None
    type = body.declarations.named(name, node.span)
    return type if isinstance(type, Elementary | StringType) else None


def _misspelt(body: Body, node: tree.Call, name: str) -> None:
    """Refuses `INT_TO_FOO` by the part of it that is no type."""
    source, _, target = name.partition("_TO_")
    known = [*ELEMENTARY, *conversions.SHORT, *conversions.STRINGS]
    for part, other in ((target, source), (source, target)):
        if other in known and part and part not in known:
            hint = body.report.near(part, lambda: known, "conversion")
            raise body.report.reject(
                "T001", f"There is no function `{name}`: `{part}` is no type to convert.{hint}", node.span
            )


def _without_any(body: Body, name: str, node: tree.Call) -> str:
    """`TO_INT` for `ANY_TO_INT` and `ANY_NUM_TO_INT`, where the dialect has these."""
    source, to, target = name.partition("_TO_")
    return f"TO_{target}" if to and source in ("ANY", "ANY_NUM") and may(body, Allowance.VENDOR_OPERATORS) else name


def _of_dialect(body: Body, type: Type | None) -> Type | None:
    """The type that a conversion names: a text is as long as the dialect has it without a length."""
    return replace(type, capacity=body.dialect.text_length) if isinstance(type, StringType) else type


def _is_character(body: Body, node: tree.Expression, target: Type | None) -> bool:
    """Whether `TO_USINT('0')` is the code of a character: in SIMATIC AX, where the tests of simatic-ax/conversion say so."""
    one = (
        isinstance(node, tree.Literal)
        and node.kind == "string"
        and isinstance(node.value, bytes)
        and len(node.value) == 1
    )
    number = isinstance(target, Elementary) and target.kind in (Kind.INT, Kind.UINT, Kind.BITS)
    return one and number and is_ax(body, node.span)


def _conversion(body: Body, node: tree.Call, name: str, wanted: Type | None) -> Expr | None:
    given, name = name, _without_any(body, name, node)
    parsed = conversions.parse_name(name, lambda part: _user_type(body, part, node))
    if parsed is not None and given != name:
        used(body, Allowance.VENDOR_OPERATORS, node.span, f"`{given}` converts a value of any type", f"`{name}(...)`")
    if parsed is None:
        _misspelt(body, node, name)
        return None
    value_tree = ordered(body, node, name, Special(("IN",), ""))[0]
    source, target = (_of_dialect(body, each) for each in (parsed.source, parsed.target))
    if source is None and _is_character(body, value_tree, target):
        source = CHAR
    if source is None:
        value = _number_of_pointer(body, settle(body.expression(value_tree)), name, value_tree)
    else:
        value = as_type(body, value_tree, source, f"What {name} takes")
    if target is None:
        whole = isinstance(wanted, Elementary) and wanted.kind in (Kind.INT, Kind.UINT)
        target = wanted if whole and wanted is not None else DINT
    raw = in_library(node.span)
    vendor = conversions.Vendor(
        may(body, Allowance.NUMBER_OF_BITS),
        may(body, Allowance.TRUE_TEXTS),
        may(body, Allowance.TEXT_NUMBERS),
        may(body, Allowance.HALVES_AWAY),
        may(body, Allowance.SHORT_TIMES),
    )
    value = wide.settled(body, value)
    if isinstance(value.type, Enumeration) and value.type.named and isinstance(target, StringType):
        return name_of(body, value, value.type, target, partial(_library, body), node.span)
    result = conversions.convert(value, target, parsed.way, partial(_library, body), raw, vendor)
    if isinstance(result, str):
        raise body.report.reject("T002", f"There is no conversion {name}{result}", node.span)
    if not raw and isinstance(target, StringType) and may(body, Allowance.SIGNED_TEXTS):
        return _signed_text(body, node, name, value, result)
    if not raw and isinstance(value.type, Elementary) and (value.type.name, target.name) in conversions.BITCASTS:
        number = "UDINT" if value.type.size == 4 else "ULINT"
        if vendor.by_number:
            instead = f"`{number}_TO_{target}({value.type}_TO_{number}(...))`"
            used(body, Allowance.NUMBER_OF_BITS, node.span, f"`{name}` converts the number", instead)
            return result
        body.report.warn(
            "W003",
            f"`{name}` copies the bits, as the standard says; other tools convert the number. For the number write "
            f"{number}_TO_{target}({value.type}_TO_{number}(...)).",
            node.span,
        )
    return result


def _number_of_pointer(body: Body, value: Expr, name: str, node: tree.Expression) -> Expr:
    """The number that a pointer is, where the dialect has that; other values as they are."""
    if not isinstance(value.type, Reference) or not value.type.pointer:
        return value
    what = f"`{name}` converts the address that `{shown(node)}` holds"
    return fold.convert(ULINT, value) if allowed(body, Allowance.POINTER_NUMBERS, node.span, what) else value


def _signed_text(body: Body, node: tree.Call, name: str, value: Expr, text: Expr) -> Expr:
    """The text of a number as SCL has it: an integer with its sign, of which the standard has no `+`."""
    kind = value.type.kind if isinstance(value.type, Elementary) else None
    if kind is Kind.REAL:
        raise body.report.reject(
            "T002", f"How `{name}` writes a number in {body.dialect.title} is not documented exactly. Convert its integer part and the "
            "digits after the point by themselves, with DINT_TO_STRING.", node.span,
        )  # fmt: skip
    if kind not in (Kind.INT, Kind.UINT):
        return text
    used(body, Allowance.SIGNED_TEXTS, node.span, f"`{name}` begins with `+` or `-`", f"`CONCAT('+', {name}(...))`")
    plain = conversions.convert(value, StringType(21), "plain", partial(_library, body))
    assert not isinstance(plain, str)
    signed = _library(body, "__WITH_SIGN", plain)
    assert signed is not None
    made = conversions.convert(signed, text.type, "plain", partial(_library, body)) if text.type else signed
    assert not isinstance(made, str)
    return made


def _library(body: Body, name: str, *args: Expr) -> Expr | None:
    return body.effects.library(body, name, args)


def _capacity(*args: Expr) -> StringType:
    types = [arg.type for arg in args if isinstance(arg.type, StringType)]
    return StringType(min(sum(type.capacity for type in types), MAX_STRING), types[0].width)
