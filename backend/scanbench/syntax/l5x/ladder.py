"""Ladders of Logix, as the text of their rungs -> Structured Text of Logix, one line for each rung.

From *Logix 5000 Controllers General Instructions* (1756-RM003). An instruction gets the power that comes to it, from the left to the
right; before the first scan the controller runs each rung without power (prescan), which is done here at the first call.
"""

import re
from collections.abc import Callable, Sequence

from scanbench.syntax.l5x.elements import element
from scanbench.syntax.l5x.instructions import WRITTEN
from scanbench.syntax.l5x.known import Known
from scanbench.syntax.l5x.names import NOTHING, STUBS

POWER = "LadderPower_"
"""Begins the variables that hold the power at a place of a rung."""
BEGAN = "LadderBegan_"
"""Begins the variables that say that a routine had its prescan."""
_NAME = re.compile(r"\s*([A-Za-z_]\w*)\s*\(")
_NUMBER = re.compile(r"-?[0-9]+")
MAX_DEPTH = 50


class NotRead(ValueError):
    """What a ladder has that is not read, as it is written there."""


def structured(rungs: Sequence[tuple[str, str]], routine: str, known: Known) -> str:
    """The rungs, each with its comment, as statements. `NotRead`."""
    prescan: list[str] = []
    lines = []
    for text, comment in rungs:
        made = _Rung(text, known, prescan).write()
        lines.append(f"{made} // {' '.join(comment.split())}" if comment.strip() else made)
    if prescan:
        began = f"{BEGAN}{routine}"
        lines[0] = f"IF NOT {began} THEN {began} := TRUE; {' '.join(dict.fromkeys(prescan))} END_IF; {lines[0]}"
    return "\n".join(lines)


def variables(text: str) -> str:
    """The section of the variables that these statements need; empty without one."""
    names = sorted(set(re.findall(rf"\b(?:{POWER}|{BEGAN})\w+", text)))
    lines = "".join(f"    {each} : BOOL;\n" for each in names)
    return f"VAR\n{lines}END_VAR\n" if lines else ""


class _Rung:
    """Reads the instructions of one rung, and writes a statement for each that does something."""

    def __init__(self, text: str, known: Known, prescan: list[str]) -> None:
        self._text, self._known, self.prescan = " ".join(text.splitlines()).strip().rstrip(";"), known, prescan
        self._at, self._powers, self._depth = 0, 0, 0
        self.made: list[str] = []

    def write(self) -> str:
        self._series("TRUE")
        if self._at < len(self._text):
            raise NotRead(self._text[self._at : self._at + 20])
        return " ".join(self.made)

    def _series(self, power: str) -> str:
        """What comes one after the other, up to the end of a branch: the power after it."""
        while self._skip_blanks() and self._text[self._at] not in ",]":
            if self._text[self._at] == "[":
                power = self._branches(power)
                continue
            found = _NAME.match(self._text, self._at)
            if found is None:
                raise NotRead(self._text[self._at : self._at + 20])
            self._at = found.end()
            power = self._instruction(found[1].upper(), self._arguments(), power)
        return power

    def _branches(self, power: str) -> str:
        """Those between brackets: each gets the same power, and what comes out of any of them goes on."""
        self._depth += 1
        if self._depth > MAX_DEPTH:
            raise NotRead("[")
        pure = set(_NAME.findall(self._text[self._at : self._closing()].upper())) <= CONDITIONS.keys()
        power = power if pure else self.held(power)  # what they set may change what it is made of
        found = self._each_branch("TRUE" if pure else power, hold=not pure)
        self._depth -= 1
        if not pure:
            return f"({' OR '.join(dict.fromkeys(found))})"
        return joined(power, "TRUE" if "TRUE" in found else f"({' OR '.join(found)})")

    def _closing(self) -> int:
        """Where the bracket that is here is closed."""
        depth = 0
        for at in range(self._at, len(self._text)):
            depth += (self._text[at] == "[") - (self._text[at] == "]")
            if depth == 0:
                return at
        raise NotRead("[")

    def _each_branch(self, power: str, hold: bool) -> list[str]:
        found: list[str] = []
        while not found or self._text[self._at] == ",":
            self._at += 1
            out = self._series(power)
            found.append(self.held(out) if hold else out)
            if self._at >= len(self._text):
                raise NotRead("[")
        self._at += 1
        return found

    def _instruction(self, name: str, given: list[str], power: str) -> str:
        condition = CONDITIONS.get(name)
        if condition is not None and len(given) == condition[0]:
            return joined(power, condition[1].format(*given))
        output = OUTPUTS.get(name)
        if output is not None and given:
            return output(self, given, power)
        if name in NOTHING or name == "NOP":
            return power
        done = DONE.get(name)
        if done is not None and len(given) == done[0]:
            if name == "DIV" and self._is_undocumented(given):
                raise NotRead(f"DIV({', '.join(given)})")
            return self.when(power, done[1].format(*given))
        if name in WRITTEN or name in STUBS or name in ("JSR", "SBR", "RET", "TND") or name in self._known.instructions:
            return self.when(power, f"{name}({', '.join(given)})")
        raise NotRead(f"{name}({', '.join(given)})")

    def _is_undocumented(self, given: list[str]) -> bool:
        """A quotient of integers that is stored in a REAL."""
        types = [found.type if (found := element(each, self._known)) is not None else "" for each in given]
        real = any("." in each and _NUMBER.match(each) for each in given[:2])
        return types[2] in ("REAL", "LREAL") and not real and not {"REAL", "LREAL"} & set(types[:2])

    def held(self, power: str) -> str:
        """The power in a variable, as what comes now may change what it is made of."""
        if power == "TRUE" or power.startswith(POWER):
            return power
        self._powers += 1
        self.made.append(f"{POWER}{self._powers} := {power};")
        return f"{POWER}{self._powers}"

    def kept(self, power: str) -> str:
        """The same, where anything comes after what uses it now."""
        return self.held(power) if self._depth or self._at < len(self._text.rstrip()) else power

    def when(self, power: str, statement: str) -> str:
        """A statement that is done with power alone."""
        power = self.kept(power)
        self.made.append(f"{statement};" if power == "TRUE" else f"IF {power} THEN {statement}; END_IF;")
        return power

    def type_of(self, tag: str) -> str:
        found = element(tag, self._known)
        return "" if found is None else found.type

    def _skip_blanks(self) -> bool:
        while self._at < len(self._text) and self._text[self._at].isspace():
            self._at += 1
        return self._at < len(self._text)

    def _arguments(self) -> list[str]:
        found, depth = [""], 0
        while self._at < len(self._text):
            letter = self._text[self._at]
            self._at += 1
            if letter == ")" and depth == 0:
                return [each.strip() for each in found] if found != [""] else []
            depth += (letter in "([") - (letter in ")]")
            if letter == "," and depth == 0:
                found.append("")
            else:
                found[-1] += letter
        raise NotRead("(")


def joined(power: str, condition: str) -> str:
    """Both together."""
    if power == "TRUE":
        return condition
    return power if condition == "TRUE" else f"{power} AND {condition}"


def _coil(rung: _Rung, given: list[str], power: str) -> str:
    power = rung.kept(power)
    rung.made.append(f"{given[0]} := {power};")
    rung.prescan.append(f"{given[0]} := FALSE;")
    return power


def _latch(value: str) -> Callable[[_Rung, list[str], str], str]:
    return lambda rung, given, power: rung.when(power, f"{given[0]} := {value}")


def _one_shot(rung: _Rung, given: list[str], power: str) -> str:
    """ONS: power for one scan; its prescan sets the bit that remembers."""
    power = rung.held(power)
    pulse = rung.held(f"({joined(power, f'NOT {given[0]}')})")
    rung.made.append(f"{given[0]} := {power};")
    rung.prescan.append(f"{given[0]} := TRUE;")
    return pulse


def _edge(rising: bool) -> Callable[[_Rung, list[str], str], str]:
    """OSR and OSF: a bit that remembers, and one that is set for one scan."""

    def write(rung: _Rung, given: list[str], power: str) -> str:
        bit, out = _two(given)
        power = rung.held(power)
        rung.made.append(
            f"{out} := {f'{power} AND NOT {bit}' if rising else f'NOT {power} AND {bit}'}; {bit} := {power};"
        )
        rung.prescan += [f"{bit} := {'TRUE' if rising else 'FALSE'};", f"{out} := FALSE;"]
        return power

    return write


def _two(given: list[str]) -> tuple[str, str]:
    if len(given) != 2:
        raise NotRead(", ".join(given))
    return given[0], given[1]


def _counted(name: str) -> Callable[[_Rung, list[str], str], str]:
    """Timers and counters; a preset that the rung shows is that of the tag, and its value where the file has none."""

    def write(rung: _Rung, given: list[str], power: str) -> str:
        shown = given[1:2]
        if len(given) != 3 or rung.type_of(given[0]) not in ("TIMER", "COUNTER"):
            raise NotRead(f"{name}({', '.join(given)})")
        if shown != ["?"] and not _NUMBER.fullmatch(shown[0]):
            raise NotRead(f"{name}({', '.join(given)})")  # a tag: Studio takes a number alone
        if shown != ["?"]:
            rung.prescan.append(f"IF {given[0]}.PRE = 0 THEN {given[0]}.PRE := {shown[0]}; END_IF;")
        power = rung.kept(power)
        rung.made.append(f"LADDER_{name}({given[0]}, {power});")
        return power

    return write


def _reset(rung: _Rung, given: list[str], power: str) -> str:
    bits = {"TIMER": "EN TT DN", "COUNTER": "CU CD DN OV UN"}.get(rung.type_of(given[0]))
    if bits is None:
        raise NotRead(f"RES({', '.join(given)})")
    cleared = "; ".join(f"{given[0]}.{each} := FALSE" for each in bits.split())
    return rung.when(power, f"{given[0]}.ACC := 0; {cleared}")


CONDITIONS: dict[str, tuple[int, str]] = {
    "XIC": (1, "{0}"),
    "XIO": (1, "NOT {0}"),
    "AFI": (0, "FALSE"),
    **{name: (2, f"({{0}} {sign} {{1}})") for names, sign in (
        ("EQU EQ", "="), ("NEQ NE", "<>"), ("GRT GT", ">"), ("GEQ GE", ">="), ("LES LT", "<"), ("LEQ LE", "<="),
    ) for name in names.split()},
    "LIM": (3, "(({0} <= {2}) AND ({1} >= {0}) AND ({1} <= {2}) OR ({0} > {2}) AND (({1} >= {0}) OR ({1} <= {2})))"),
    "MEQ": (3, "(({0} AND {1}) = ({2} AND {1}))"),
    "CMP": (1, "({0})"),
}  # fmt: skip
"""How many operands each has, and what it asks."""
DONE: dict[str, tuple[int, str]] = {
    **dict.fromkeys(("MOV", "MOVE"), (2, "{1} := {0}")),
    **{name: (3, f"{{2}} := ({{0}}) {sign} ({{1}})") for name, sign in (
        ("ADD", "+"), ("SUB", "-"), ("MUL", "*"), ("DIV", "/"), ("MOD", "MOD"), ("AND", "AND"), ("OR", "OR"), ("XOR", "XOR"),
    )},
    "NOT": (2, "{1} := NOT ({0})"),
    "NEG": (2, "{1} := -({0})"),
    "CLR": (1, "{0} := 0"),
    "CPT": (2, "{0} := {1}"),
    **{name: (2, f"{{1}} := {function}({{0}})") for name, function in (
        ("ABS", "ABS"), ("SQR", "SQRT"), ("SQRT", "SQRT"), ("SIN", "SIN"), ("COS", "COS"), ("TAN", "TAN"), ("LN", "LN"), ("LOG", "LOG"),
    )},
}  # fmt: skip
"""How many operands each has, and what it does with power."""
OUTPUTS: dict[str, Callable[[_Rung, list[str], str], str]] = {
    "OTE": _coil,
    "OTL": _latch("TRUE"),
    "OTU": _latch("FALSE"),
    "ONS": _one_shot,
    "OSR": _edge(rising=True),
    "OSF": _edge(rising=False),
    **{name: _counted(name) for name in ("TON", "TOF", "RTO", "CTU", "CTD")},
    "RES": _reset,
}
