"""Structured Text of Logix -> that of the standard, piece by piece: comments and lines stay as they are.

From *Logix 5000 Controllers Structured Text* (1756-PM007): bits are `tag.3`, a block is called by the name of its instruction with the
instance as its first argument, a routine by JSR.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from scanbench.syntax.l5x import notes
from scanbench.syntax.l5x.names import INSTRUCTIONS, LIBRARY, name_of

PIECE = re.compile(
    r"""
    (?P<comment>//[^\n]*|\(\*.*?\*\)|/\*.*?\*/)
  | (?P<region>\#(?:end)?region[^\n]*)
  | (?P<space>\s+)
  | (?P<text>'(?:\$.|[^'$\n])*')
  | (?P<number>\d+\#[0-9A-Fa-f_]+|\d+\.\d+(?:[eE][-+]?\d+)?|\d+(?:[eE][-+]?\d+)?)
  | (?P<name>\\?[A-Za-z_]\w*(?::[A-Za-z0-9_]+)*)
  | (?P<other>\[:=\]|:=|<>|<=|>=|\*\*|.)
    """,
    re.VERBOSE | re.DOTALL | re.IGNORECASE,
)
BLANK = ("comment", "space")


@dataclass(frozen=True, slots=True)
class Parameter:
    """A required one of an Add-On Instruction."""

    name: str
    usage: str
    """`Input`, `Output` or `InOut`."""


@dataclass(slots=True)
class Known:
    """What the names in a routine mean; all names in upper case."""

    aliases: Mapping[str, str] = field(default_factory=dict)
    """What an alias is written for."""
    routines: Mapping[str, str] = field(default_factory=dict)
    """The action that each routine of the program is."""
    instructions: Mapping[str, Sequence[Parameter]] = field(default_factory=dict)
    """Add-On Instructions."""


@dataclass(frozen=True, slots=True)
class _Piece:
    kind: str
    text: str


def statements(text: str, known: Known, told: list[str]) -> str:
    """The text of a routine; what is not as it was is added to `told`."""
    return _Writer(text, known, told).write()


class _Writer:
    """Reads the pieces from the first to the last."""

    def __init__(self, text: str, known: Known, told: list[str]) -> None:
        self._pieces = [_Piece(each.lastgroup or "", each[0]) for each in PIECE.finditer(text)]
        self._known, self._told = known, told
        self._at = 0

    def write(self) -> str:
        made = ""
        while self._at < len(self._pieces):
            made += self._one()
        return made

    def _one(self) -> str:
        piece = self._pieces[self._at]
        before = self._pieces[self._at - 1] if self._at else None
        self._at += 1
        if piece.kind == "region":
            return f"//{piece.text}"
        if piece.text == "[:=]":
            self._tell(notes.NOT_RETAINED)
            return ":="
        if piece.kind == "number" and before is not None and before.text == "." and piece.text.isdigit():
            return f"%X{piece.text}"
        if piece.kind == "text":
            return f"{LIBRARY}.TEXT({piece.text})"
        if piece.kind != "name":
            return piece.text
        if before is not None and before.text == ".":
            return name_of(piece.text)
        if self._next() == "(":
            return self._call(piece.text)
        return self._name(piece.text)

    def _name(self, written: str) -> str:
        target = self._known.aliases.get(written.upper())
        if target is not None:  # of one that is an alias itself, too, but never round in a circle
            rest = {name: text for name, text in self._known.aliases.items() if name != written.upper()}
            return statements(target, Known(rest), self._told)
        if written.upper() in KEYWORDS:
            return written
        return name_of(written.removeprefix("\\"))

    def _call(self, name: str) -> str:
        """An instruction or function."""
        upper = name.upper()
        if upper in KEYWORDS:  # `IF(a)`
            return name
        instead = CALLS.get(upper)
        if upper in self._known.instructions:
            return self._instruction(self._known.instructions[upper], self._arguments())
        if instead is not None:
            return instead(self, self._arguments())
        return f"{LIBRARY}.{upper}" if upper in INSTRUCTIONS else name_of(name)

    def _instruction(self, parameters: Sequence[Parameter], given: list[str]) -> str:
        """An Add-On Instruction: a call of its instance, by the names of its parameters."""
        instance, *values = given or [""]
        said = ", ".join(
            f"{name_of(each.name)} {'=>' if each.usage == 'Output' else ':='} {value}"
            for each, value in zip(parameters, values, strict=False)
        )
        return f"{instance}({said})"

    def jump(self, given: list[str]) -> str:
        """JSR: a routine of the same program is an action of it."""
        routine = given[0] if given else ""
        if len(given) > 1 and given[1].strip() not in ("", "0"):
            self._tell(notes.with_parameters(routine))
        return f"{self._known.routines.get(routine.upper(), routine)}()"

    def _arguments(self) -> list[str]:
        """Those in the parentheses that come now, in the words of the standard; comments between them are dropped."""
        while self._pieces[self._at].text != "(":
            self._at += 1
        self._at += 1
        found, depth = [""], 0
        while self._at < len(self._pieces):
            piece = self._pieces[self._at]
            if piece.text == ")" and depth == 0:
                self._at += 1
                break
            if piece.text == "," and depth == 0:
                self._at += 1
                found.append("")
                continue
            depth += (piece.text in ("(", "[")) - (piece.text in (")", "]"))
            if piece.kind in BLANK:
                self._at += 1
            found[-1] += " " if piece.kind in BLANK else self._one()
        return [each.strip() for each in found] if found != [""] else []

    def _next(self) -> str:
        """The piece that comes after blanks; empty at the end."""
        return next((each.text for each in self._pieces[self._at :] if each.kind not in BLANK), "")

    def _tell(self, note: str) -> None:
        if note not in self._told:
            self._told.append(note)


def _copied(writer: _Writer, given: list[str]) -> str:
    """COP, CPS: so many elements of the destination, byte for byte."""
    source, destination, length = (*given, "", "", "")[:3]
    return f"{LIBRARY}.COP(ADR({source}), ADR({destination}), {length} * SIZEOF({destination}))"


CALLS: dict[str, Callable[[_Writer, list[str]], str]] = {
    "JSR": _Writer.jump,
    "RET": lambda writer, given: "RETURN",
    "TND": lambda writer, given: "RETURN",
    "SBR": lambda writer, given: "",
    "COP": _copied,
    "CPS": _copied,
}
KEYWORDS = frozenset(
    "IF THEN ELSIF ELSE END_IF CASE OF END_CASE FOR TO BY DO END_FOR WHILE END_WHILE REPEAT UNTIL END_REPEAT EXIT RETURN "
    "AND OR XOR NOT MOD TRUE FALSE".split()
)
"""Words of its own, which are no names."""
