"""The ST text of common processing, made from a model; that of the vendor's instructions is in `instruction_text`.

Common processing runs in every scan of every PLC, so it is to cost nanoseconds: pulses are a remainder by a constant, and
the clock is taken apart only when its second changes.
"""

from collections.abc import Iterator
from enum import IntEnum

from scanbench.plcmodel.model import (
    ClockField,
    Instruction,
    MessageInstruction,
    Model,
    QueryInstruction,
    ResetInstruction,
    Special,
)

COMMON = "__System"
STOP = "__STOP"
"""Output of an instruction: the PLC stops where it was called."""
CODE = "__CODE"
"""The error code word."""
RESET_BIT, RESET_CODE = "__RESET_BIT", "__RESET_CODE"
"""The model's own way to clear an error."""

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


class Form(IntEnum):
    """What an entry of `Layout.ASKED` asks for, and what its number is."""

    RAISE = 0
    """An instruction's error with this number, or to clear it, if the number is that."""
    CLEAR = 1
    """To clear what the selector of an instruction says."""
    SYSTEM = 2
    """An error of the device: its code, then 16 bits of information."""
    CLEAR_CODE = 3
    """To clear the error with this code."""
    CLEAR_FLAGS = 4
    """To clear what a `ResetInstruction` is for."""
    NETWORK = 5
    """A communications instruction, by its number in `network_text.NAMES`; the entries after it say where its operands lie."""


def word(number: int) -> str:
    """The name of a special address, by its number in the model."""
    return f"__S{number}"


def flag(instruction: Instruction) -> str:
    """The name of the flag of the error that an instruction raises."""
    return f"__F_{_named(instruction)}"


def number_name(instruction: Instruction) -> str:
    """The name of what shows its number."""
    return f"__N_{_named(instruction)}"


def texts(instruction: Instruction | MessageInstruction) -> str:
    """The name of the bytes that hold its texts."""
    return f"__T_{instruction.name}"


def stand_in(instruction: Instruction) -> str:
    """The name of the word whose number represents an error of the device."""
    return f"__E_{instruction.name}"


def reset_flags(reset: ResetInstruction) -> str:
    """The name of the word of flags that an instruction clears."""
    return f"__R_{reset.name}"


def query_flags(query: QueryInstruction) -> str:
    """The name of the word of flags that an instruction tells of."""
    return f"__Q_{query.name}"


def query_code(query: QueryInstruction) -> str:
    """The name of the code that it tells."""
    return f"__C_{query.name}"


def _named(instruction: Instruction) -> str:
    return f"{instruction.name}_{instruction.part}" if instruction.part else instruction.name


def ask(form: Form, index: int, number: str, more: str = "0") -> str:
    """Puts one thing into what the seam reads after the scan; there must be room. `more` is added to form and index."""
    what = f"{form * 256 + index} + {more}"
    return (
        f"__ASKED[__ASKED_COUNT] := ULINT_TO_LWORD(({number}) * 16#1_0000_0000 + {what});\n"
        "__ASKED_COUNT := __ASKED_COUNT + 1;"
    )


def common(model: Model) -> str:
    """The program that runs before all others; '' where nothing is to be done."""
    words = [(word(number), special) for number, special in enumerate(model.specials) if special.role]
    lines = [line for name, special in words if special.role != "clock" for line in _kept_alive(name, special)]
    lines += _log_reset(model)
    declared = "VAR reset_was : BOOL; END_VAR\n" if model.error_reset is not None else ""
    lines += _error_reset(model)
    clocks = [(name, special) for name, special in words if special.role == "clock"]
    if clocks:
        declared += (
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


def _error_reset(model: Model) -> Iterator[str]:
    """The bit that clears the error whose code is in a word, when it goes on."""
    if model.error_reset is not None:
        yield f"IF {RESET_BIT} AND NOT reset_was THEN\n{ask(Form.CLEAR_CODE, 0, f'UINT_TO_ULINT({RESET_CODE})')}\nEND_IF;"
        yield f"reset_was := {RESET_BIT};"


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
