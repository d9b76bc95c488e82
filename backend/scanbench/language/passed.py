"""Where an input gets a value without being named: in calls whose arguments are given by position, and in functions that are operators of IL."""

from collections.abc import Iterator, Sequence

from scanbench.check.body.arguments import by_position
from scanbench.check.uses import Symbol, variable_symbol
from scanbench.language.called import block_of, calls_of, parameters, symbol_of
from scanbench.language.declared import member_of
from scanbench.language.index import Occurrence
from scanbench.language.reading import Reading
from scanbench.program.program import Pou
from scanbench.program.types import Record, Section
from scanbench.syntax import tree
from scanbench.syntax.chunks import Chunk
from scanbench.syntax.source import Stretch

PARAMETERS = (Section.INPUT, Section.IN_OUT, Section.OUTPUT)


def passed(reading: Reading, symbols: Sequence[Symbol]) -> list[Occurrence]:
    """The arguments by position that these variables get, or outputs give; nothing for what is no parameter."""
    members = ((symbol, member_of(reading.project.checker, symbol)) for symbol in symbols)
    sections = {symbol: member.section for symbol, member in members if member is not None}
    wanted = {symbol for symbol, section in sections.items() if section in PARAMETERS}
    if not wanted:
        return []
    found = []
    for file in sorted(reading.files):
        for chunk in reading.files[file].chunks:
            for pou in (each for outer in chunk.file.pous for each in (outer, *outer.methods)):
                for span, symbol in (*_in_calls(reading, chunk, pou), *_in_il(reading, pou)):
                    if symbol in wanted and isinstance(span, Stretch):
                        # an in-out is bound, as where it is named
                        found.append(Occurrence(span, symbol, written=sections[symbol] is Section.INPUT))
    return found


def _in_calls(reading: Reading, chunk: Chunk, pou: tree.PouDeclaration) -> Iterator[tuple[object, Symbol]]:
    for call in calls_of(pou, 0, len(chunk.source.text) + 1):
        given = [each for each in call.arguments if each.name is None and each.value is not None]
        callee = symbol_of(reading, call) if given else None
        if callee is not None:
            for argument, symbol in zip(given, _inputs(reading, callee, len(given)), strict=False):
                yield argument.span, symbol


def _in_il(reading: Reading, pou: tree.PouDeclaration) -> Iterator[tuple[object, Symbol]]:
    """The current result is the first argument of a function that is an operator: its place is that of the operator."""
    for each in pou.body.instructions if isinstance(pou.body, tree.IlBody) else ():
        called = reading.project.checker.pous.functions.get(each.operator)
        if called is None or any(argument.name is not None for argument in each.arguments):
            continue
        operands = [] if each.operand is None else [each.operand]
        spans = [each.span, *(one.span for one in operands), *(one.span for one in each.arguments)]
        yield from zip(spans, _of_function(called, len(spans)), strict=False)


def _inputs(reading: Reading, callee: Symbol, count: int) -> list[Symbol]:
    """The variables that take so many arguments by position, in order."""
    if callee.kind == "variable":
        record = block_of(reading, callee)
        return [] if record is None else _of_record(record, count)
    function = reading.project.checker.pous.functions.get(callee.name) if callee.kind == "pou" else None
    if function is not None:
        return _of_function(function, count)
    owner = f"{callee.owner}.{callee.name}" if callee.kind == "method" else callee.name
    return [Symbol("variable", owner, name.upper()) for name in parameters(reading, callee, count)]


def _of_record(record: Record, count: int) -> list[Symbol]:
    members = [each for each in record.members.values() if each.section is not Section.VAR]
    return [variable_symbol(each, record) for each in by_position(members, count)]


def _of_function(pou: Pou, count: int) -> list[Symbol]:
    members = [pou.frame.members[key] for key in pou.parameters]
    return [variable_symbol(each, pou.frame) for each in by_position(members, count)]
