"""Structured Text of Logix -> that of the standard, piece by piece: comments and lines stay as they are.

From *Logix 5000 Controllers Structured Text* (1756-PM007): bits are `tag.3`, a block is called by the name of its instruction with the
instance as its first argument, a routine by JSR.
"""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from scanbench.syntax.l5x import notes, texts
from scanbench.syntax.l5x.instructions import WRITTEN
from scanbench.syntax.l5x.known import Known, Parameter, Passed
from scanbench.syntax.l5x.names import CONTROLLER, INSTRUCTIONS, LIBRARY, NOTHING, STUBS, name_of
from scanbench.syntax.l5x.values import integer

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
MAX_DEPTH = 100
BLANK = ("comment", "space")


_COMMENT = re.compile(r"\(\*.*?\*\)|/\*.*?\*/|//[^\n]*", re.DOTALL)
_SBR = re.compile(r"(?i)\bSBR\s*\(([^()]*)\)")
_RET = re.compile(r"(?i)\bRET\s*\(([^()]*)\)")


@dataclass(frozen=True, slots=True)
class _Piece:
    kind: str
    text: str


def passed_of(text: str) -> Passed | None:
    """What a routine is given by SBR, its first statement, and gives back by RET; None where a call cannot say the same."""
    code = _COMMENT.sub(" ", text)
    given, back = _SBR.findall(code), _RET.findall(code)
    results = {tuple(_parts(each)) for each in back}
    if len(given) != len(re.findall(r"(?i)\bSBR\b", code)) or len(back) != len(re.findall(r"(?i)\bRET\b", code)):
        return None
    if len(given) > 1 or (given and not _SBR.match(code.lstrip())) or len(results) > 1:
        return None
    if results and any(results) and not re.search(r"(?i)\bRET\s*\([^()]*\)\s*;?\s*$", code):
        return None  # the end of the routine gives nothing back
    return Passed(tuple(_parts(given[0])) if given else (), results.pop() if results else ())


def _parts(written: str) -> list[str]:
    return [each.strip() for each in written.split(",")] if written.strip() else []


def _depends(assigned: list[tuple[str, str]]) -> bool:
    """Whether a value would be read after something that it names was assigned."""
    seen: set[str] = set()
    for target, value in assigned:
        if seen & set(re.findall(r"\w+", value.upper())):
            return True
        seen |= set(re.findall(r"\w+", target.upper()))
    return False


class TooDeep(ValueError):
    """More calls within calls than anybody writes."""


def statements(text: str, known: Known, told: list[str], depth: int = 0) -> str:
    """The text of a routine, or of a part `depth` levels deep; what is not as it was is added to `told`. `TooDeep`."""
    return _Writer(text, known, told, depth).write()


class _Writer:
    """Reads the pieces from the first to the last."""

    def __init__(self, text: str, known: Known, told: list[str], depth: int) -> None:
        self._pieces = [_Piece(each.lastgroup or "", each[0]) for each in PIECE.finditer(text)]
        self._known, self._told = known, told
        self._at, self._depth = 0, depth
        if depth > MAX_DEPTH:
            raise TooDeep

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
        if piece.text == "-" and self._is_sign():
            return self._sign()
        if piece.kind == "number":
            return self._number(piece.text)
        if piece.kind == "text":
            return f"{LIBRARY}.TEXT({piece.text})"
        if piece.kind != "name":
            return piece.text
        if before is not None and before.text == ".":
            return name_of(piece.text)
        if piece.text.upper() in FLAGS:
            return self._flag(piece.text.upper())
        instead = self._chosen_bit() or self._assigned_text()
        if instead is not None:
            return instead
        if self._next() == "(":
            return self._call(piece.text)
        return self._name(piece.text)

    def _number(self, written: str) -> str:
        before = "".join(each.text for each in self._pieces[max(0, self._at - 3) : self._at - 1])
        if re.search(r"(?<!\.)\.$", before) and _DIGITS.fullmatch(written):  # a bit, and no range `1..5`
            return f"%X{written}"
        if "#" in written and 1 << 31 <= (integer(written) or 0) < 1 << 32:
            return f"DWORD_TO_DINT({written})"  # in a DINT it is its bits
        return written

    def _is_sign(self) -> bool:
        """Whether the minus that was taken has no operand before it."""
        before = next((each for each in reversed(self._pieces[: self._at - 1]) if each.kind not in BLANK), None)
        if before is None or (before.kind == "name" and before.text.upper() in KEYWORDS - {"TRUE", "FALSE"}):
            return True
        return before.kind not in ("name", "number") and before.text not in (")", "]")

    def _sign(self) -> str:
        """A minus: of `-x ** y` the power comes first there, and the minus in the standard."""
        end = self._operand(self._at)
        power = self._after_blanks(end)
        if power is None or self._pieces[power].text != "**":
            return "-"
        end = self._operand(power + 1)
        inner = "".join(each.text for each in self._pieces[self._at : end])
        self._at = end
        return f"-({statements(inner, self._known, self._told, self._depth + 1)})"

    def _after_blanks(self, at: int) -> int | None:
        return next((i for i in range(at, len(self._pieces)) if self._pieces[i].kind not in BLANK), None)

    def _operand(self, at: int) -> int:
        """Where the operand that begins here ends: a name with its members and indices, a number, what is in parentheses."""
        start = self._after_blanks(at)
        if start is None:
            return len(self._pieces)
        while start < len(self._pieces) and (self._pieces[start].text == "-" or self._pieces[start].kind in BLANK):
            start += 1
        i, depth = start, 0
        while i < len(self._pieces):
            piece = self._pieces[i]
            if depth == 0 and piece.kind not in ("name", "number") and piece.text not in (".", "[", "("):
                break
            depth += (piece.text in ("(", "[")) - (piece.text in (")", "]"))
            i += 1
        return i

    def _name(self, written: str) -> str:
        target = self._known.aliases.get(written.upper())
        if target is not None:  # of one that is an alias itself, too, but never round in a circle
            rest = {name: text for name, text in self._known.aliases.items() if name != written.upper()}
            return statements(target, Known(rest, types=self._known.types), self._told, self._depth + 1)
        if written.upper() in KEYWORDS:
            return written
        return name_of(written.removeprefix("\\"))

    def _flag(self, name: str) -> str:
        """`S:FS` and the other flags of the controller."""
        if name == "S:FS":
            return "_FirstCycle"
        flag = name.replace(":", "_")
        self._known.stubs[flag] = "BOOL"
        self._tell(notes.unset_flag(name))
        return f"{CONTROLLER}.{flag}"

    def _chosen_bit(self) -> str | None:
        """`value.[number]`, which begins with the name that was taken: read, or assigned; None of other names."""
        start, i, depth = self._at - 1, self._at, 0
        while i < len(self._pieces):
            text = self._pieces[i].text
            if depth == 0 and text == "[" and self._pieces[i - 1].text == ".":
                break
            if depth == 0 and self._pieces[i].kind not in ("name", "number") and text not in (".", "["):
                return None
            depth += (text == "[") - (text == "]")
            i += 1
        else:
            return None
        last = self._closing(i)
        if last is None:
            return None
        value = self._again("".join(each.text for each in self._pieces[start : i - 1]))
        number = self._again("".join(each.text for each in self._pieces[i + 1 : last]))
        self._at = last + 1
        after = self._after_blanks(self._at)
        if after is None or self._pieces[after].text != ":=":
            return f"{LIBRARY}.BIT({value}, {number})"
        self._at = after + 1
        end = next((k for k in range(self._at, len(self._pieces)) if self._pieces[k].text == ";"), len(self._pieces))
        given = self._again("".join(each.text for each in self._pieces[self._at : end])).strip()
        self._at = end
        return f"{value} := {LIBRARY}.WITH_BIT({value}, {number}, {given})"

    def _assigned_text(self) -> str | None:
        """`name := 'text'` of a text of an own type, which begins with the name that was taken; None of all else."""
        end = self._operand(self._at - 1)
        sign = self._after_blanks(end)
        value = None if sign is None or self._pieces[sign].text != ":=" else self._after_blanks(sign + 1)
        after = None if value is None or self._pieces[value].kind != "text" else self._after_blanks(value + 1)
        if value is None or after is None or self._pieces[after].text != ";":
            return None
        target = "".join(each.text for each in self._pieces[self._at - 1 : end] if each.kind not in BLANK)
        made = texts.assigned(self._again(target), self._pieces[value].text, self._known)
        if made is not None:
            self._at = value + 1
        return made

    def _closing(self, at: int) -> int | None:
        """Where the bracket that is here is closed."""
        depth = 0
        for i in range(at, len(self._pieces)):
            depth += (self._pieces[i].text == "[") - (self._pieces[i].text == "]")
            if depth == 0:
                return i
        return None

    def _call(self, name: str) -> str:
        """An instruction or function."""
        upper = name.upper()
        if upper in KEYWORDS:  # `IF(a)`
            return name
        if upper in STUBS and upper not in self._known.instructions:
            self._skip_arguments()
            self._known.stubs[upper] = ""
            return f"{CONTROLLER}.{upper}()"
        if upper in NOTHING and upper not in self._known.instructions:
            self._skip_arguments()
            self._tell(notes.does_nothing(upper))
            return ""
        instead = CALLS.get(upper)
        if upper in self._known.instructions:
            return self._instruction(self._known.instructions[upper], self._arguments())
        if instead is not None:
            return instead(self, self._arguments())
        if upper in WRITTEN:
            return WRITTEN[upper](self._known, self._tell, self._arguments())
        if upper in texts.READ:
            return texts.instruction(upper, self._arguments(), self._known)
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
        call = f"{self._known.routines.get(routine.upper(), routine)}()"
        if len(given) <= 1 or (len(given) == 2 and given[1] in ("", "0")):
            return call
        passed = self._known.passed.get(routine.upper())
        count = int(given[1]) if given[1].isdigit() else 0
        inputs, results = given[2 : 2 + count], given[2 + count :]
        if passed is None or len(passed.inputs) != len(inputs) or len(passed.results) != len(results):
            return self._as_it_is("JSR", given)
        before = [*zip(map(self._again, passed.inputs), inputs, strict=True)]
        after = [*zip(results, map(self._again, passed.results), strict=True)]
        if _depends(before) or _depends(after):
            return self._as_it_is("JSR", given)
        return "; ".join([*(f"{a} := {b}" for a, b in before), call, *(f"{a} := {b}" for a, b in after)])

    def _again(self, written: str) -> str:
        """A part of a different routine of the program."""
        return statements(written, self._known, self._told, self._depth + 1)

    def back(self, given: list[str]) -> str:
        """RET: the end of a routine."""
        return self._as_it_is("RET", given) if given and not self._is_passed() else "RETURN"

    def begin(self, given: list[str]) -> str:
        """SBR: the beginning of one."""
        return self._as_it_is("SBR", given) if given and not self._is_passed() else ""

    def _is_passed(self) -> bool:
        """Whether those who call this routine assign what it is given and gives back."""
        return self._known.routine in self._known.passed

    def _as_it_is(self, name: str, given: list[str]) -> str:
        self._tell(notes.with_parameters(name))
        return f"{name}({', '.join(given)})"

    def _skip_arguments(self) -> None:
        depth = 0
        while self._at < len(self._pieces):
            text = self._pieces[self._at].text
            depth += (text == "(") - (text == ")")
            self._at += 1
            if depth == 0 and text == ")":
                return

    def _arguments(self) -> list[str]:
        """Those in the parentheses that come now, in the words of the standard; comments between them are dropped."""
        while self._pieces[self._at].text != "(":
            self._at += 1
        self._at += 1
        self._depth += 1
        if self._depth > MAX_DEPTH:
            raise TooDeep
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
        self._depth -= 1
        return [each.strip() for each in found] if found != [""] else []

    def _next(self) -> str:
        """The piece that comes after blanks; empty at the end."""
        return next((each.text for each in self._pieces[self._at :] if each.kind not in BLANK), "")

    def _tell(self, note: str) -> None:
        if note not in self._told:
            self._told.append(note)


_DIGITS = re.compile(r"[0-9]{1,2}")
CALLS: dict[str, Callable[[_Writer, list[str]], str]] = {
    "JSR": _Writer.jump,
    "RET": _Writer.back,
    "TND": _Writer.back,
    "SBR": _Writer.begin,
}
FLAGS = frozenset(("S:FS", "S:V", "S:Z", "S:N", "S:C", "S:MINOR"))
"""What the controller tells of itself in bits."""
KEYWORDS = frozenset(
    "IF THEN ELSIF ELSE END_IF CASE OF END_CASE FOR TO BY DO END_FOR WHILE END_WHILE REPEAT UNTIL END_REPEAT EXIT RETURN "
    "AND OR XOR NOT MOD TRUE FALSE".split()
)
"""Words of its own, which are no names."""
