"""Cross references: who reads and who writes a variable, and which variables nobody reads."""

import re
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from scanbench.check.uses import Symbol, variable_symbol
from scanbench.language.declared import Declared, member_of
from scanbench.language.index import Occurrence
from scanbench.language.navigate import family, references
from scanbench.language.passed import passed
from scanbench.language.reading import Reading
from scanbench.problems import Span
from scanbench.program.types import ArrayType, Elementary, Member, Record, Reference, Section, StringType, Type
from scanbench.syntax import tree

Access = Literal["declared", "read", "written", "named"]
"""`written`: assigned there, also in part, or passed to something that may write it. `named`: of what is no variable."""
_PART = re.compile(r"\.?([^\W\d]\w*)|\[[^\]]*\]|\^")


@dataclass(frozen=True, slots=True)
class CrossReference:
    """One place in the text that names a symbol."""

    place: Occurrence
    access: Access
    pou: str
    """The POU around it, with the method; empty outside of any."""
    text: str
    """Its line."""


@dataclass(frozen=True, slots=True)
class Unused:
    """A variable that no text reads."""

    declared: Declared
    written: bool
    """It is written, and never read; else it is not named at all."""
    pou: str


def cross_references(reading: Reading, symbol: Symbol) -> list[CrossReference]:
    """Every place that names a symbol, in order of files and lines; of an input also where it gets a value by its position."""
    own = {_place(each.span) for each in reading.declared(symbol)}
    places = [*references(reading, symbol, declaration=True), *passed(reading, family(reading, symbol))]
    return [
        CrossReference(
            each,
            "declared" if _place(each.span) in own or _is_external(reading, each)
            else "named" if each.symbol.kind != "variable"
            else "written" if each.written else "read",
            *_around(reading, each),
        )
        for each in sorted(places, key=lambda each: _place(each.span))
    ]  # fmt: skip


def symbol_of_path(reading: Reading, path: str) -> Symbol | None:
    """What an instance path ends in: `Main.belt.position` in the variable `position` of the block; None where nothing has this path,
    or the program cannot be told because it has errors."""
    program = reading.checked.program
    names = [each.upper() for each in _PART.findall(path.replace(" ", "")) if each]
    if program is None or not names:
        return None
    instances = {each.name.upper(): each for each in program.shown}
    start = next((count for count in (1, 2) if ".".join(names[:count]) in instances), 0)
    record: Record | None = reading.project.checker.globals
    if start:
        record = instances[".".join(names[:start])].pou.instance
    symbol = None
    for name in names[start:]:
        member = record.members.get(name) if record is not None else None
        if record is None or member is None or member.hidden:
            return None
        symbol, record = variable_symbol(member, record), _record(member.type)
    return symbol


def _record(type: Type) -> Record | None:
    while isinstance(type, ArrayType | Reference):
        inner = type.element if isinstance(type, ArrayType) else type.target
        if inner is None:
            return None
        type = inner
    return type if isinstance(type, Record) else None


def complete(reading: Reading) -> bool:
    """Whether all statements were understood: of one with an error the names are not known."""
    return reading.checked.program is not None


def unused(reading: Reading) -> list[Unused]:
    """The variables of the project that are not named anywhere but in their declaration; and, where nobody outside could see what they
    have, those that are only written. Members of structures are none: they may be there for the layout. In order of files and lines; only
    true where the reading is `complete`."""
    candidates = list(_candidates(reading))
    read: defaultdict[Symbol, set[bool]] = defaultdict(set)
    for each in reading.index.of(declared.symbol for declared, _ in candidates):
        if not _is_external(reading, each):
            read[each.symbol].add(not each.written or each.lent)
    program = reading.checked.program
    for access in program.accesses if program is not None else ():  # tools read it by that name
        symbol = symbol_of_path(reading, access.path)
        if symbol is not None:
            read[symbol].add(True)
    found = []
    for declared, member in candidates:
        uses = read[declared.symbol]
        if not uses or (uses == {False} and _is_private(member)):
            pou, _ = _around(reading, Occurrence(declared.span, declared.symbol))
            found.append(Unused(declared, bool(uses), pou))
    return found


def _candidates(reading: Reading) -> Iterator[tuple[Declared, Member]]:
    for file in sorted(reading.files):
        for each in reading.declared_in(file):
            if each.symbol.kind != "variable" or not isinstance(each.node, tree.Variable):
                continue
            member = member_of(reading.project.checker, each.symbol)
            if member is not None and not member.hidden and member.section is not Section.MEMBER:
                yield each, member


def _is_external(reading: Reading, place: Occurrence) -> bool:
    """Whether it is a VAR_EXTERNAL, which only names a global."""
    span = place.span
    return "VAR_EXTERNAL" in reading.holding(span.file, reading.position(span.file, span.line, span.column))


def _is_private(member: Member) -> bool:
    """Whether only the text of its POU, or of the program, says who reads it: no address, no parameter, nothing with parts of its own."""
    own = member.section in (Section.VAR, Section.TEMP, Section.GLOBAL)
    return own and not member.located and isinstance(member.type, Elementary | StringType)


def _around(reading: Reading, place: Occurrence) -> tuple[str, str]:
    """The POU around a place, and its line."""
    span = place.span
    start = reading.position(span.file, span.line, 1)
    at = reading.position(span.file, span.line, span.column)
    around = reading.around(span.file, at)
    names = [] if around is None else [around.pou.name, *([around.method.name] if around.method else [])]
    text = reading.text(span.file)
    end = text.find("\n", start)
    return ".".join(names), text[start : len(text) if end < 0 else end].strip()


def _place(span: Span) -> tuple[str, int, int]:
    return span.file, span.line, span.column
