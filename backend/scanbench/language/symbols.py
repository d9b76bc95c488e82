"""What a file declares, as a tree, and what a project declares, by name."""

from collections.abc import Iterator

from scanbench.check.declare.names import qualified
from scanbench.language.describe import written
from scanbench.language.entry import Entry, EntryKind
from scanbench.language.parts import parted
from scanbench.language.reading import Reading
from scanbench.problems import Span
from scanbench.syntax import tree
from scanbench.syntax.source import Stretch

POUS: dict[str, EntryKind] = {
    "program": "program", "function": "function", "function_block": "block", "class": "class", "interface": "interface",
    "method": "method", "get": "property", "set": "property",
}  # fmt: skip


Extent = tuple[int, int]
"""From one position to the next."""


def extents(reading: Reading, file: str) -> dict[int, Extent]:
    """The blocks of a file that have a name, by the position of the name."""
    return {
        start + each.name_at: (start + each.start, start + each.end)
        for start, block in reading.blocks(file)
        for each in block.walk()
    }


def entries(reading: Reading, file: str, statements: bool = False) -> list[Entry]:
    """What a file declares, in its order; perhaps with the statements that have others inside of them."""
    by_name = extents(reading, file)
    made: list[Entry] = []
    for chunk in reading.files[file].chunks:
        for pou in chunk.file.pous:
            made.append(_pou(reading, file, pou, by_name))
        made += [_type(reading, file, each) for each in chunk.file.types]
        for section in chunk.file.globals:
            made += [_variable(reading, file, each, section) for each in section.variables]
        for each in chunk.file.configurations:
            made.append(_configuration(reading, file, each, by_name))
    return parted(reading, file, made, list(reading.blocks(file)), statements)


def _entry(
    reading: Reading, file: str, name: str, kind: EntryKind, detail: str, span: Span, block: Extent | None,
    inner: tuple[Entry, ...] = (),
) -> Entry:  # fmt: skip
    start = reading.position(file, span.line, span.column)
    end = start + max(len(name.rpartition(".")[2]), 1)
    if block is not None:
        start, end = min(start, block[0]), max(end, block[1])
    for each in inner:
        start, end = min(start, each.start), max(end, each.end)
    return Entry(name, kind, detail, span, start, end, inner)


def _pou(reading: Reading, file: str, pou: tree.PouDeclaration, by_name: dict[int, Extent]) -> Entry:
    block = by_name.get(reading.position(file, pou.span.line, pou.span.column))
    inner = [
        _variable(reading, file, each, section)
        for section in pou.sections
        for each in section.variables
        if each.name[0] not in "$#"
    ]
    inner += [_pou(reading, file, each, by_name) for each in pou.methods]
    detail = written(pou.result) if pou.result is not None else ""
    name = qualified(pou.namespace, pou.name)
    return _entry(reading, file, name, POUS[pou.kind], detail, pou.span, block, tuple(inner))


def _variable(reading: Reading, file: str, variable: tree.Variable, section: tree.VariableSection) -> Entry:
    kind: EntryKind = "constant" if "CONSTANT" in section.qualifiers else "variable"
    detail = f"{section.keyword} {written(variable.type)}"
    return _entry(reading, file, variable.name, kind, detail, variable.span, None)


def _type(reading: Reading, file: str, type: tree.TypeDeclaration) -> Entry:
    spec = type.type
    inner: list[Entry] = []
    kind: EntryKind = "type"
    detail = written(spec)
    if isinstance(spec, tree.EnumSpec):
        kind, detail = "enumeration", ""
        inner = [_entry(reading, file, name, "value", "", span, None) for name, _, span in spec.values]
    elif isinstance(spec, tree.StructSpec):
        detail = "UNION" if spec.union else "STRUCT"
        inner = [
            _entry(reading, file, each.name, "member", written(each.type), each.span, None) for each in spec.members
        ]
    made = _entry(reading, file, qualified(type.namespace, type.name), kind, detail, type.span, None, tuple(inner))
    if isinstance(spec.span, Stretch):
        end = reading.position(file, spec.span.end_line, spec.span.end_column)
        return Entry(made.name, made.kind, made.detail, made.span, made.start, max(end, made.end), made.inner)
    return made


def _configuration(reading: Reading, file: str, each: tree.Configuration, by_name: dict[int, Extent]) -> Entry:
    block = by_name.get(reading.position(file, each.span.line, each.span.column))
    inner: list[Entry] = []
    parts: tuple[tree.Configuration | tree.ResourceDeclaration, ...] = (each, *each.resources)
    for part in parts:
        inner += [_entry(reading, file, task.name, "task", "TASK", task.span, None) for task in part.tasks]
        inner += [
            _entry(reading, file, run.name, "instance", f"PROGRAM {run.type.name}", run.span, None)
            for run in part.programs
        ]
        for section in part.globals:
            inner += [_variable(reading, file, variable, section) for variable in section.variables]
    return _entry(reading, file, each.name, "configuration", "", each.span, block, tuple(inner))


def find(reading: Reading, query: str, limit: int = 200) -> list[tuple[Entry, str]]:
    """POUs, types, global variables, methods whose names contain the letters of the query in order; with what they are in."""
    wanted = query.upper()
    found = []
    for file in reading.files:
        for entry in entries(reading, file):
            for each, around in _named(entry, ""):
                if _contains(each.name.upper(), wanted):
                    found.append((each, around))
    found.sort(key=lambda each: (not each[0].name.upper().startswith(wanted), len(each[0].name), each[0].name))
    return found[:limit]


def _named(entry: Entry, around: str) -> Iterator[tuple[Entry, str]]:
    if entry.kind != "section":
        yield entry, around
    for each in entry.inner:
        if entry.kind == "section":  # of global variables, which are found by their names
            yield each, around
        if each.kind in ("method", "property", "value", "instance", "task"):
            yield each, entry.name


def _contains(name: str, wanted: str) -> bool:
    """Whether the letters come in this order."""
    at = 0
    for letter in wanted:
        at = name.find(letter, at) + 1
        if at == 0:
            return False
    return True
