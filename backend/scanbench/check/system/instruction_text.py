"""The ST text of the vendor's instructions that raise and clear errors, made from a model.

Programs call them in every scan. So they request an error only if it is not there yet with this number. Whether an error of the
device is new can only be decided in the seam, because the code word may show a different error, and details may be anywhere.
A number outside of the range that an instruction accepts gives FALSE, and does nothing.
"""

from scanbench.check.system.system_text import (
    CODE,
    STOP,
    Form,
    ask,
    flag,
    number_name,
    query_code,
    query_flags,
    reset_flags,
    stand_in,
    texts,
)
from scanbench.plcmodel.model import (
    ErrorAddress,
    ErrorEntry,
    Instruction,
    MessageInstruction,
    Model,
    QueryInstruction,
    ResetInstruction,
    Severity,
    TextPlace,
)
from scanbench.program.layout import Layout

_LAST = Layout.ASKED_LIMIT - 1


def instructions(model: Model) -> list[str]:
    """A function for each."""
    made = [_instruction(model, number) for number, each in enumerate(model.instructions) if not each.part]
    made += [_reset(number, reset) for number, reset in enumerate(model.resets)]
    return [*made, *map(_query, model.queries), *map(_message, model.messages)]


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
    made = model.instructions[index]
    entry = model.error(made.error)
    fatal = entry is not None and entry.severity == "fatal"
    number = made.parameter
    parts = [each for each in model.instructions if each.name == made.name]
    branches = [_raise(model, each) for each in parts]
    if made.system_errors is not None and entry is not None:
        branches.insert(0, _system_error(model, made, entry))
    if made.clears is not None and entry is not None:
        branches.append(_clear(model, made))
    inputs = "".join(f" {name} : LINT := -1;" for name in (made.selector, made.information) if name)
    keeps = own = ""
    if made.texts is not None:
        own = " k, place : LINT;"
        inputs += f" {made.text} : STRING[{2 * made.texts.words}];"
        keeps = f"IF asks AND form = 0 AND {number} >= {made.minimum} THEN\n{_keep_text(made, made.texts)}\nEND_IF;\n"
    between = "\nELS"
    # What stops the PLC must get in, so it takes the place of the last one.
    room = f"__ASKED_COUNT := MIN(__ASKED_COUNT, {_LAST});" if fatal else f"asks := asks AND __ASKED_COUNT <= {_LAST};"
    return f"""\
FUNCTION {made.name} : BOOL
VAR_INPUT {number} : LINT;{inputs} END_VAR
VAR_OUTPUT {STOP} : BOOL; END_VAR
VAR asks : BOOL; form : ULINT; asked : LINT;{own} END_VAR
asked := {number};
{between.join(branches)}
END_IF;
{keeps}IF asks THEN {room} END_IF;
IF asks THEN
{ask(Form.RAISE, index, "LINT_TO_ULINT(asked)", "form")}
END_IF;
END_FUNCTION
"""


def _raise(model: Model, made: Instruction) -> str:
    """The branch for the numbers that raise an error."""
    entry = model.error(made.error)
    fatal = entry is not None and entry.severity == "fatal"
    number = made.parameter
    raises = f"{flag(made)} := TRUE; " if entry is not None else ""
    news = "TRUE" if fatal or entry is None else f"NOT {flag(made)} OR NOT ({_shown(model, made, number)})"
    stops = f"{STOP} := TRUE; " if fatal else ""
    part = f"form := {made.part}; " if made.part else ""
    return f"""\
IF {number} >= {made.minimum} AND {number} <= {made.maximum} THEN
  asks := {news}; {part}{raises}{stops}{made.name} := TRUE;"""


def _keep_text(made: Instruction | MessageInstruction, place: TextPlace) -> str:
    """Writes the text of its parameter: the first of two characters is in the high byte of a word."""
    size = 2 * place.words
    return f"""\
  FOR k := 0 TO {size - 1} DO
    place := {made.parameter} * {size} + k + 1 - k MOD 2 * 2;
    IF k < LEN({made.text}) THEN {texts(made)}[place] := CHAR_TO_BYTE({made.text}[k + 1]); ELSE {texts(made)}[place] := 0; END_IF;
  END_FOR;"""


def _message(made: MessageInstruction) -> str:
    return f"""\
FUNCTION {made.name} : BOOL
VAR_INPUT {made.parameter} : LINT; {made.text} : STRING[{2 * made.texts.words}]; END_VAR
VAR k, place : LINT; END_VAR
IF {made.parameter} >= {made.minimum} AND {made.parameter} <= {made.maximum} THEN
{_keep_text(made, made.texts)}
  {made.name} := TRUE;
END_IF;
END_FUNCTION
"""


def _query(query: QueryInstruction) -> str:
    levels = "\nELS".join(
        f"IF ({query_flags(query)} / {1 << bit}) MOD 2 = 1 THEN Level := {level};"
        for bit, level in zip(query.bits, query.levels, strict=True)
    )
    return f"""\
FUNCTION {query.name} : BOOL
VAR_OUTPUT Level : {query.level_type}; Code : {query.code_type}; END_VAR
{levels}
END_IF;
{query.name} := Level <> 0;
IF {query.name} THEN Code := UDINT_TO_{query.code_type}({query_code(query)}); END_IF;
END_FUNCTION
"""


def _system_error(model: Model, made: Instruction, entry: ErrorEntry) -> str:
    """In place of its own error, one of the device, if that has such a code and stops the program, or does not, likewise."""
    severity = entry.severity
    known = ", ".join(f"{code.start}..{code.stop - 1}" for code in _codes(model, severity))
    stops = f"{STOP} := TRUE; " if severity == "fatal" else ""
    return f"""\
IF {stand_in(made)} <> 0 AND {made.parameter} = {stand_in(made)} THEN
  CASE {made.selector} OF
    {known}:
      asks := TRUE; {stops}{made.name} := TRUE; form := {Form.SYSTEM * 256};
      asked := {made.selector} * 16#1_0000 + MAX({made.information}, 0) MOD 16#1_0000;
  END_CASE;"""


def _codes(model: Model, severity: Severity) -> list[range]:
    """Every code that such an error of the device can have, as stretches that do not touch."""
    errors = [error for error in model.errors() if error.severity == severity and not error.user and error.coded]
    codes = [code for error in errors for code in (range(error.code, error.code + 1), *error.codes)]
    found: list[range] = []
    for code in sorted(codes, key=lambda each: each.start):
        if found and code.start <= found[-1].stop:
            found[-1] = range(found[-1].start, max(code.stop, found[-1].stop))
        else:
            found.append(code)
    return found


def _clear(model: Model, made: Instruction) -> str:
    whole = f"asks := {flag(made)}; {flag(made)} := FALSE; {made.name} := TRUE;"
    if not made.selector:
        return f"IF {made.parameter} = {made.clears} THEN {whole}"
    present = "TRUE" if model.code_word is None else f"{CODE} <> 0"
    return f"""\
IF {made.parameter} = {made.clears} THEN
  IF {made.selector} < 0 THEN
    {whole}
  ELSIF {made.selector} <= 16#FFFF THEN
    asks := {present}; {made.name} := TRUE; form := {Form.CLEAR * 256}; asked := {made.selector};
    IF {made.selector} >= {made.minimum} AND {made.selector} <= {made.maximum} THEN
      asks := {_shown(model, made, made.selector)};
    END_IF;
  END_IF;"""


def _reset(index: int, reset: ResetInstruction) -> str:
    inputs, one = "", ""
    if reset.code:
        inputs = f"VAR_INPUT {reset.code} : LINT := -1; END_VAR\n"
        one = f"IF {reset.code} > 0 THEN\n{ask(Form.CLEAR_CODE, index, f'LINT_TO_ULINT({reset.code})')}\nRETURN;\nEND_IF;\n"
    return f"""\
FUNCTION {reset.name} : BOOL
{inputs}{reset.name} := TRUE;
IF {reset_flags(reset)} <> 0 AND __ASKED_COUNT <= {_LAST} THEN
{one}{ask(Form.CLEAR_FLAGS, index, "0")}
END_IF;
END_FUNCTION
"""


def _shown(model: Model, made: Instruction, number: str) -> str:
    """Whether the error memory shows this number."""
    place = number_place(model, made)
    entry = model.error(made.error)
    if place is None:
        if model.code_word is None or entry is None:
            return "FALSE"
        return f"{'UDINT' if model.code_word.bits == 32 else 'UINT'}_TO_LINT({CODE}) = {number} + {entry.code}"
    if place.kind == "Word":
        return f"UINT_TO_LINT({number_name(made)}) = {number}"
    bit = f"SHL(WORD#1, LINT_TO_UINT({number} MOD 16))"
    return f"(UINT_TO_WORD({number_name(made)}[{number} / 16]) AND {bit}) <> 0"
