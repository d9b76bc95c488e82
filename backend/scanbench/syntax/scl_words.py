"""Words of SCL that are several tokens of the standard, or other ones: literals of S5 and DTL, addresses without `%`, bits of the system.

From the Programming Guide for S7-1200/S7-1500 and the TIA Portal's help: *Data types*, *System and clock memory*.
"""

import re
from datetime import date

from scanbench.syntax.lexer import Lex, Tokens
from scanbench.syntax.scl_rewriter import Rewriter
from scanbench.syntax.source import Source

ADDRESS = re.compile(r"(?:([IEQA])|M)(?:(X?)([BWD])?)(\d{1,5})", re.IGNORECASE)
"""`I0`, `MW10`: what may be an address that is written without `%`."""
_GERMAN = {"E": "I", "A": "Q"}
DTL = re.compile(r"DTL#(\d{4})-(\d{1,2})-(\d{1,2})(?:-(\d{1,2}):(\d{1,2}):(\d{1,2})(?:\.(\d{1,9}))?)?", re.IGNORECASE)
S5 = re.compile(r"(?:S5T|S5TIME)#((?:[\d.]+_?(?:D|H|MS|M|S)_?)+)", re.IGNORECASE)
_PART = re.compile(r"([\d.]+)_?(D|H|MS|M|S)", re.IGNORECASE)
_UNITS = {"D": 86_400_000, "H": 3_600_000, "M": 60_000, "S": 1000, "MS": 1}
BASES = (10, 100, 1000, 10_000)
"""Milliseconds of each time base of S5TIME."""
_BY_NUMBER = frozenset(("T_NO", "C_NO"))
"""Inputs that take a timer or counter by its number, `T5`."""
_S5_NUMBER = re.compile(r"([TCZ])(\d{1,3})", re.IGNORECASE)
_OLD_BLOCK = re.compile(r"S?FB\d+", re.IGNORECASE)
_PREFIXES = {"B": "BYTE", "W": "WORD", "DW": "DWORD", "LW": "LWORD", "L": "DINT"}
_NO_NAME = re.compile(r"\W")
_BLOCK = re.compile(r"%(DB\d{1,5})", re.IGNORECASE)
_BIT_OF_DATA = re.compile(r"DB?X(\d{1,5})", re.IGNORECASE)
_CLOCKS = ("10Hz", "5Hz", "2_5Hz", "2Hz", "1_25Hz", "1Hz", "0_625Hz", "0_5Hz")
SYSTEM_TAGS: dict[str, tuple[tuple[Lex, str], ...]] = {
    "ALWAYSTRUE": ((Lex.KEYWORD, "TRUE"),),
    "ALWAYSFALSE": ((Lex.KEYWORD, "FALSE"),),
    "FIRSTSCAN": ((Lex.NAME, "_FirstCycle"),),
    **{
        f"CLOCK_{each.upper()}": ((Lex.NAME, f"Clock_{each}"), (Lex.OPERATOR, "("), (Lex.OPERATOR, ")"))
        for each in _CLOCKS
    },
}
"""The names that the TIA Portal gives to bits of system and clock memory, and what has their value here."""


def name_of(quoted: str) -> str:
    """The name between quotes, with `_` for what no name of the standard can have."""
    plain = _NO_NAME.sub("_", quoted)
    return f"_{plain}" if plain[:1].isdigit() else plain


def typed(literal: str) -> str:
    """A literal with the type of the standard before its `#`: `WORD#16#1` of `W#16#1`."""
    prefix, hash, value = literal.partition("#")
    return _PREFIXES.get(prefix.upper(), prefix) + hash + value


def address(name: str, bit: str | None) -> str | None:
    """The address in the words of the standard, `%MW10` of `MW10`, `%I0.3` of `I0` and the `bit` 3; None of other names."""
    found = ADDRESS.fullmatch(name)
    if found is None or found[2]:
        return None
    area = found[1].upper() if found[1] else "M"
    area = _GERMAN.get(area, area)
    if found[3]:
        return f"%{area}{found[3].upper()}{found[4]}" if bit is None else None
    return f"%{area}X{found[4]}.{bit}" if bit is not None and len(bit) == 1 and bit in "01234567" else None


def s5time(written: str) -> int | None:
    """The word of a literal after its `#`: three digits of BCD, with the smallest time base that has room; None beyond 9990 s."""
    milliseconds = sum(int(float(number) * _UNITS[unit.upper()]) for number, unit in _PART.findall(written))
    for code, base in enumerate(BASES):
        count = milliseconds // base
        if count <= 999:
            return code << 12 | (count // 100) << 8 | (count // 10 % 10) << 4 | count % 10
    return None


def members_of_dtl(found: re.Match[str]) -> dict[str, int] | None:
    """The members of a literal of DTL; None where there is no such day or time."""
    year, month, day, hour, minute, second = (int(each or 0) for each in found.groups()[:6])
    try:
        weekday = date(year, month, day).isoweekday() % 7 + 1
    except ValueError:
        return None
    if hour > 23 or minute > 59 or second > 59:
        return None
    return {
        "YEAR": year, "MONTH": month, "DAY": day, "WEEKDAY": weekday, "HOUR": hour, "MINUTE": minute, "SECOND": second,
        "NANOSECOND": int((found[7] or "0").ljust(9, "0")),
    }  # fmt: skip


class Words(Rewriter):
    """Writes what is not one token of the standard."""

    def __init__(self, source: Source, tokens: Tokens) -> None:
        super().__init__(source, tokens)
        self._constants: dict[str, list[tuple[Lex, str]]] = {}
        """Constants of CONST, which have no type, and what they are written for; in upper case."""

    def _worded(self) -> bool:
        """Writes what is not one token of the standard: a literal of DTL or S5, an address without `%`, an output that is not wanted."""
        kind, text, at = self._in.kinds[self._at], self._in.texts[self._at], self._in.starts[self._at]
        if kind is Lex.TYPED:
            return self._literal(text, at)
        if kind is Lex.ADDRESS and (block := _BLOCK.fullmatch(text)) and self._word(1) == ".":
            self._at += 1
            self._put(Lex.NAME, block[1], at + 1)
            return True
        if kind is not Lex.NAME:
            return False
        if text == "_" and self._word(-1) == "=>" and self._word(1) in (",", ")"):
            self._drop_output()
            return True
        if text.upper() in self._constants and self._word(-1) != ".":
            self._at += 1
            self._several(tuple(self._constants[text.upper()]), at)
            return True
        if self._word(-1) == ":=" and self._word(-2) in _BY_NUMBER and (found := _S5_NUMBER.fullmatch(text)):
            table = "S5_Timers" if found[1].upper() == "T" else "S5_Counters"
            self._at += 1
            self._several(((Lex.NAME, table), (Lex.OPERATOR, "["), (Lex.INTEGER, found[2]), (Lex.OPERATOR, "]")), at)
            return True
        if _OLD_BLOCK.fullmatch(text) and self._word(1) == "." and self._word(3) == "(" and not self._declares:
            self._at += 2  # `FB10.DB10(...)` calls the instance
            return True
        return not self._declares and (self._bit_of_data(text, at) or self._address(text, at))

    def _bit_of_data(self, text: str, at: int) -> bool:
        """`"Data".DBX4.1` as `"Data".%DBX4.1`."""
        found = _BIT_OF_DATA.fullmatch(text) if self._word(-1) == "." and self._word(1) == "." else None
        if found is None or self._in.kinds[self._at + 2] is not Lex.INTEGER:
            return False
        bit = self._in.texts[self._at + 2]
        self._at += 3
        self._put(Lex.ADDRESS, f"%DBX{found[1]}.{bit}", at)
        return True

    def _literal(self, text: str, at: int) -> bool:
        moment, duration = DTL.match(self._source.text, at), S5.match(self._source.text, at)
        if moment is not None and (members := members_of_dtl(moment)) is not None:
            self._skip_to(moment.end())
            if self._declares or self._starts:
                listed = [
                    ((Lex.NAME, name), (Lex.OPERATOR, ":="), (Lex.INTEGER, str(value)))
                    for name, value in members.items()
                ]
                tokens = [each for one in listed for each in ((Lex.OPERATOR, ","), *one)]
                self._several(((Lex.OPERATOR, "("), *tokens[1:], (Lex.OPERATOR, ")")), at)
            else:
                literal = (Lex.TIME, f"LDT#{moment[0][4:]}{'' if moment[4] else '-00:00:00'}")
                self._several(((Lex.NAME, "LDT_TO_DTL"), (Lex.OPERATOR, "("), literal, (Lex.OPERATOR, ")")), at)
            return True
        if duration is not None and (word := s5time(duration[1])) is not None:
            self._skip_to(duration.end())
            self._put(Lex.TYPED, f"WORD#16#{word:04X}", at)
            return True
        return False

    def _address(self, text: str, at: int) -> bool:
        if self._word(-1) in (".", "#") or text.upper() in self._locals or self._word(1) in ("(", "["):
            return False
        if self._depth and self._word(1) in (":=", "=>"):
            return False  # the name of an argument
        dotted = self._word(1) == "." and self._in.kinds[self._at + 2] is Lex.INTEGER
        found = address(text, self._in.texts[self._at + 2] if dotted else None)
        if found is None and self._in.kinds[self._at + 1] is Lex.REAL:
            return False
        if found is None:
            return False
        self._at += 3 if dotted else 1
        self._put(Lex.ADDRESS, found, at)
        return True

    def _drop_output(self) -> None:
        """Leaves `NAME => _` out of a call, with a comma."""
        for column in (self._out.kinds, self._out.texts, self._out.starts):
            del column[-2:]
        self._at += 1
        if self._word() == ",":
            self._at += 1
        elif self._out.texts[-1] == ",":
            for column in (self._out.kinds, self._out.texts, self._out.starts):
                del column[-1]

    def _untyped_constants(self) -> None:
        """CONST ... END_CONST of STEP 7: each is read wherever it is named."""
        self._at += 1
        while not self._ended() and self._word() != "END_CONST":
            self._untyped_constant()
        self._at += 0 if self._ended() else 1

    def _untyped_constant(self) -> None:
        """`NAME := value;`"""
        name = self._in.texts[self._at].upper()
        self._at += 2
        value: list[tuple[Lex, str]] = []
        while not self._ended() and self._word() not in (";", "END_CONST", "END_VAR"):
            kind, text = self._in.kinds[self._at], self._in.texts[self._at]
            plain = [] if text == "#" else [(kind, typed(text) if kind is Lex.TYPED else text)]
            value += self._constants.get(text.upper(), plain)
            self._at += 1
        wrapped = len(value) > 1
        self._constants[name] = [(Lex.OPERATOR, "("), *value, (Lex.OPERATOR, ")")] if wrapped else value
        self._at += self._word() == ";"

    def _is_comment(self) -> bool:
        """Whether the parentheses are those of a comment in several languages, `(/* ... */)`."""
        text, at, end = self._source.text, self._in.starts[self._at], self._in.starts[self._at + 1]
        return text.startswith("(/*", at) and text.endswith("*/)", at, end + 1)
