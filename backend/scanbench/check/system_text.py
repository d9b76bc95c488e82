"""The ST text of common processing and of the vendor's instructions, made from a model.

Common processing runs in every scan of every PLC, so it is to cost nanoseconds: pulses are a remainder by a constant, and
the clock is taken apart only when its second changes.
"""

from collections.abc import Iterator

from scanbench.check.layout import Layout
from scanbench.check.standard.library import FOLDER
from scanbench.plcmodel.model import ClockField, ErrorAddress, Instruction, Model, Special
from scanbench.problems import Span

FILE = f"{FOLDER}system.st"
COMMON = "__System"
STOP = "__STOP"
"""Output of an instruction: the PLC stops where it was called."""

LOG_RESET = "log-reset"
"""The special address that empties the error log."""
LOG_COUNT = "__LOG_COUNT"

_CLOCK = """\
now := (__EPOCH + __TIME) / 1000000000;
IF now <> second OR __SCAN = __STARTED THEN
  second := now;
  day := now / 86400; rest := now MOD 86400;
  IF rest < 0 THEN rest := rest + 86400; day := day - 1; END_IF;
  (* years begin in March here, and eras of 400 of them are alike *)
  era := (day + 719468) / 146097;
  of_era := (day + 719468) MOD 146097;
  year := (of_era - of_era / 1460 + of_era / 36524 - of_era / 146096) / 365;
  of_year := of_era - (365 * year + year / 4 - year / 100);
  month := (5 * of_year + 2) / 153;
  of_month := of_year - (153 * month + 2) / 5 + 1;
  year := year + 400 * era;
  IF month < 10 THEN month := month + 3; ELSE month := month - 9; year := year + 1; END_IF;
"""
_FIELDS: dict[ClockField, str] = {
    "second": "rest MOD 60",
    "minute": "rest / 60 MOD 60",
    "hour": "rest / 3600",
    "day": "of_month",
    "month": "month",
    "year": "year MOD 100",
    "century": "year / 100",
    "weekday": "(day + 4 + 7 * 200000) MOD 7",
    "zero": "0",
}


def is_system(span: Span) -> bool:
    """Whether this stands in text that is made from a model."""
    return span.file == FILE


def word(number: int) -> str:
    """The name of a special address, by its number in the model."""
    return f"__S{number}"


def flag(instruction: Instruction) -> str:
    """The name of the flag of the error that an instruction raises."""
    return f"__F_{instruction.name}"


def number_name(instruction: Instruction) -> str:
    """The name of what shows its number."""
    return f"__N_{instruction.name}"


def of(model: Model) -> str:
    """All of it."""
    parts = [_common(model)]
    parts += [_instruction(model, number) for number in range(len(model.instructions))]
    return "\n".join(part for part in parts if part)


# ---- common processing ----------------------------------------------------------------------------------------


def _common(model: Model) -> str:
    words = [(word(number), special) for number, special in enumerate(model.specials) if special.role]
    lines = [line for name, special in words if special.role != "clock" for line in _kept_alive(name, special)]
    lines += _log_reset(model)
    clocks = [(name, special) for name, special in words if special.role == "clock"]
    declared = ""
    if clocks:
        declared = (
            "VAR second : LINT := -1; END_VAR\n"
            "VAR_TEMP now, day, rest, era, of_era, of_year, of_month, month, year : LINT; END_VAR\n"
        )
        lines += [_CLOCK.rstrip(), *(line for name, special in clocks for line in _fields(name, special)), "END_IF;"]
    if not lines:
        return ""
    return f"PROGRAM {COMMON}\n{declared}" + "\n".join(lines) + "\nEND_PROGRAM\n"


def _kept_alive(name: str, special: Special) -> Iterator[str]:
    bits = special.location.bits
    match special.role:
        case "on":
            yield f"{name} := TRUE;"
        case "off":
            yield f"{name} := FALSE;"
        case "first-cycle":
            yield f"{name} := __SCAN = __STARTED;"
        case "pulse":
            yield f"{name} := __CLOCK MOD {special.period_ns} >= {(special.period_ns + 1) // 2};"
        case "scan-count":
            yield f"{name} := {_number('__SCAN', bits)};"
        case "cycle-time":
            yield f"{name} := {_length(special)};"
        case "longest-cycle-time" | "shortest-cycle-time" as role:
            sign = ">" if role == "longest-cycle-time" else "<"
            length = _length(special)
            yield f"IF __SCAN = __STARTED OR {length} {sign} {name} THEN {name} := {length}; END_IF;"


def _log_reset(model: Model) -> Iterator[str]:
    """The bit with which a program or tool empties the error log; the PLC turns it off again."""
    for number, special in enumerate(model.specials):
        if special.name == LOG_RESET and special.location.bit is not None and model.log is not None:
            yield f"IF {word(number)} THEN {word(number)} := FALSE; {LOG_COUNT} := 0; END_IF;"


def _length(special: Special) -> str:
    """The length of a scan in units of the address, or the largest number that it holds."""
    bits = special.location.bits
    return _number(f"MIN(__INTERVAL / {special.unit_ns}, {(1 << bits) - 1})", bits)


def _number(value: str, bits: int) -> str:
    type = {8: "USINT", 16: "UINT", 32: "UDINT", 64: "ULINT"}[bits]
    return value if bits == 64 else f"ULINT_TO_{type}({value})"


def _fields(name: str, special: Special) -> Iterator[str]:
    for index, field in enumerate(special.fields):
        value = _FIELDS[field]
        if special.bcd and field != "zero":
            value = f"({value}) / 10 * 16 + ({value}) MOD 10"
        yield f"  {name}[{index}] := LINT_TO_BYTE({value});"


# ---- instructions -----------------------------------------------------------------------------------------------


def number_place(model: Model, instruction: Instruction) -> ErrorAddress | None:
    """Where the error memory shows the number of an instruction, in a whole word or as a bit of its own."""
    entry = model.error(instruction.error)
    detail = entry.detail(instruction.detail) if entry is not None else None
    if entry is None or detail is None or detail.control == "List":
        return None
    for place in (*detail.addresses, *(each for each in entry.also if each.id == detail.name)):
        fits = place.kind == "BitArray" or (place.kind == "Word" and (place.shift, place.width) == (0, 16))
        if fits and place.location is not None and place.location.area.unit == "word":
            return place
    return None


def _instruction(model: Model, index: int) -> str:
    """A number outside of what it takes gives FALSE, and does nothing.

    Programs call it in every scan. So it asks only for what is news: an error that is not there with this number yet.
    """
    made = model.instructions[index]
    entry = model.error(made.error)
    fatal = entry is not None and entry.severity == "fatal"
    number = made.parameter
    raises = f"{flag(made)} := TRUE; " if entry is not None else ""
    news = "TRUE" if fatal or entry is None else f"NOT {flag(made)} OR NOT ({_shown(model, made)})"
    stops = f"{STOP} := TRUE; " if fatal else ""
    clears = ""
    if made.clears is not None and entry is not None:
        clears = (
            f"ELSIF {number} = {made.clears} THEN asks := {flag(made)}; {flag(made)} := FALSE; {made.name} := TRUE;\n"
        )
    last = Layout.ASKED_LIMIT - 1
    # What stops the PLC must get in, so it takes the place of the last one.
    room = f"__ASKED_COUNT := MIN(__ASKED_COUNT, {last});" if fatal else f"asks := asks AND __ASKED_COUNT <= {last};"
    return f"""\
FUNCTION {made.name} : BOOL
VAR_INPUT {number} : LINT; END_VAR
VAR_OUTPUT {STOP} : BOOL; END_VAR
VAR asks : BOOL; END_VAR
IF {number} >= {made.minimum} AND {number} <= {made.maximum} THEN
  asks := {news}; {raises}{stops}{made.name} := TRUE;
{clears}END_IF;
IF asks THEN {room} END_IF;
IF asks THEN
  __ASKED[__ASKED_COUNT] := ULINT_TO_LWORD(LINT_TO_ULINT({number}) * 16#1_0000_0000 + {index});
  __ASKED_COUNT := __ASKED_COUNT + 1;
END_IF;
END_FUNCTION
"""


def _shown(model: Model, made: Instruction) -> str:
    """Whether the error memory shows this number."""
    place = number_place(model, made)
    if place is None:
        return "FALSE"
    if place.kind == "Word":
        return f"UINT_TO_LINT({number_name(made)}) = {made.parameter}"
    bit = f"SHL(WORD#1, LINT_TO_UINT({made.parameter} MOD 16))"
    return f"(UINT_TO_WORD({number_name(made)}[{made.parameter} / 16]) AND {bit}) <> 0"
