"""Mends of problems. What a problem tells people to do, its message says in one of a few sentences; the same is done here."""

import re
from collections.abc import Iterator

from scanbench.check.context import Rejected
from scanbench.check.declare.names import Space
from scanbench.language.complete import parsed
from scanbench.language.fix import Fix
from scanbench.language.fix_conversion import conversions
from scanbench.language.fix_syntax import of_syntax
from scanbench.language.fix_unreached import of_unreached
from scanbench.language.reading import Around, Reading
from scanbench.problems import Problem
from scanbench.program.types import INT
from scanbench.program.untyped import ANY_INT, settle

NEAR = re.compile(r"(.*)Did you mean (`.*`)\?")
NAMED = re.compile(r"`([^`]+)`")
UNKNOWN = re.compile(r"`([^\W\d]\w*)` is not declared\.")
STEP = "  "


def fixes(reading: Reading, file: str, start: int, end: int) -> list[Fix]:
    """What can be done about the problems that a stretch of a file touches, the likely ones first."""
    found: list[Fix] = []
    for problem in reading.checked.problems:
        if problem.span.file == file:
            first = reading.position(file, problem.span.line, problem.span.column)
            last = reading.position(file, problem.span.end_line, problem.span.end_column)
            if first <= end and start <= last:
                found += _of(reading, file, problem, first, last)
    return found


def _of(reading: Reading, file: str, problem: Problem, start: int, end: int) -> Iterator[Fix]:
    text, message = reading.text(file), problem.message
    written = text[start:end]
    yield from _near(problem, written, start)
    yield from of_syntax(reading, file, problem, start, end)
    yield from of_unreached(reading, file, problem, start)
    yield from conversions(reading, file, problem, start, end)
    unknown = UNKNOWN.match(message)
    around = reading.around(file, start)
    if problem.code == "T001" and unknown is not None and around is not None and written == unknown.group(1):
        yield _declared(reading, file, around, written, start)


def _near(problem: Problem, written: str, start: int) -> Iterator[Fix]:
    """What was perhaps meant."""
    near = NEAR.match(problem.message)
    if near is None:
        return
    for wrong in [each for each in reversed(NAMED.findall(near.group(1))) if each in written][:1]:
        at = start + (len(written) - len(wrong) if written.endswith(wrong) else written.index(wrong))
        for name in NAMED.findall(near.group(2)):
            yield Fix(f"Change to {name}", at, at + len(wrong), name)


def _declared(reading: Reading, file: str, around: Around, name: str, at: int) -> Fix:
    """A declaration in the first VAR of the POU, or in a new one after its head."""
    type = _wanted(reading, file, around, name, at)
    head = reading.position(file, around.inner.span.line, around.inner.span.column)
    text = reading.text(file)
    for start, block in reading.blocks(file):
        for each in block.walk():
            if each.name_at >= 0 and start + each.name_at == head:
                own = next((inner for inner in each.inner if inner.keyword == "VAR" and inner.closed), None)
                if own is not None:
                    last = start + own.end - len("END_VAR")
                    line = text.rfind("\n", 0, last) + 1
                    alone = not text[line:last].strip()
                    place = line if alone else last
                    indent = text[line:last] if alone else ""
                    made = f"{indent}{STEP}{name} : {type};\n" if alone else f"{name} : {type}; "
                    return Fix(f"Declare {name} : {type}", place, place, made)
    line = text.find("\n", head) + 1 or len(text)
    return Fix(f"Declare {name} : {type}", line, line, f"VAR\n{STEP}{name} : {type};\nEND_VAR\n")


def _wanted(reading: Reading, file: str, around: Around, name: str, at: int) -> str:
    """The type that fits where the name is used: that of what is assigned to it, or of what it is assigned to."""
    text = reading.text(file)
    line = text[text.rfind("\n", 0, at) + 1 : text.find("\n", at) if "\n" in text[at:] else len(text)]
    assigned = re.search(rf"(?:^|;|THEN|ELSE|DO|:)\s*{name}\s*:=\s*([^;]+);", line, re.IGNORECASE)
    target = re.search(rf"([^\W\d][\w.]*(?:\[[^\]]*\])?)\s*:=\s*{name}\s*;", line, re.IGNORECASE)
    found = assigned or target
    written: str | None = found.group(1) if found is not None else _argument(text, name, at)
    if written is None:
        condition = re.search(rf"\b(IF|ELSIF|WHILE|UNTIL|AND|OR|NOT)\s+{name}\b", line, re.IGNORECASE)
        # an index of an array follows a name
        drawn = re.search(rf"(?:^|[^\w\s])\s*{_element(name)}", line, re.IGNORECASE)
        return "BOOL" if condition or drawn or _in_rung(text, name, at) else "INT"
    body, node = reading.body(around), parsed(written)
    if body is None or node is None:
        return "INT"
    with reading.project.checker.declarations.names.within(Space(around.pou.namespace, around.pou.using)):
        try:
            value = body.expression(node)
            type = INT if value.type == ANY_INT else settle(value).type
        except Rejected:
            return "INT"
    return "INT" if type is None else str(type)


def _element(name: str) -> str:
    """A contact or coil of a rung."""
    return rf"(?:\[\s*(?:/|[PN]\s)?\s*{name}\s*\]|\(\s*(?:/|[SRPN]\s)?\s*{name}\s*\))"


def _in_rung(text: str, name: str, at: int) -> bool:
    """Whether the name at this place is that of a contact or coil. There one may follow the output of a box, after a blank."""
    line = text.rfind("\n", 0, at) + 1
    if not re.search(r"(?:^|\n)\s*RUNG\b(?:(?!END_RUNG).)*$", text[:line], re.IGNORECASE | re.DOTALL):
        return False
    elements = re.finditer(rf"(?<![\w.]){_element(name)}", text[line:], re.IGNORECASE)
    return any(each.start() <= at - line < each.end() for each in elements)


def _argument(text: str, name: str, at: int) -> str | None:
    """The input of an instance that the name alone is given to: `timer.PT`."""
    before = re.search(r"([^\W\d][\w.]*)\s*\(([^()]*?)([^\W\d]\w*)\s*:=\s*$", text[:at])
    alone = re.match(r"\s*[,)]", text[at + len(name) :])
    return f"{before.group(1)}.{before.group(3)}" if before and alone else None
