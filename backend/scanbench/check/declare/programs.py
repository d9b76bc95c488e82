"""Programs that other POUs call or look into, where the dialect has that: one instance each, whose place is known before bodies are checked."""

from collections.abc import Callable
from contextlib import suppress

from scanbench.check.context import Rejected
from scanbench.check.declare.declarations import Declarations
from scanbench.check.dialect import Allowance
from scanbench.problems import Span
from scanbench.program.layout import align
from scanbench.program.origin import in_library
from scanbench.program.types import Kind, Member, Record, Section

PROGRAMS = "PROGRAMS"
"""The name of the record that has them."""


def placed_programs(declarations: Declarations, variables: Record, is_plant: Callable[[Span], bool]) -> Record:
    """A member for each program, with the absolute offset of its instance, after the global variables; empty in other dialects."""
    record = Record(PROGRAMS, Kind.STRUCT)
    record.size = align(variables.size)
    if Allowance.PROGRAM_CALLS not in declarations.dialect.allows:
        return record
    for key, declaration in declarations.block_trees.items():
        if declaration.kind != "program" or declaration.namespace or in_library(declaration.span):
            continue
        if is_plant(declaration.span):
            continue
        with suppress(Rejected):
            instance = declarations.named(declaration.name, declaration.span)
            if isinstance(instance, Record):
                record.members[key] = Member(
                    declaration.name, instance, Section.GLOBAL, declaration.span, offset=record.size
                )
                record.size = align(record.size + instance.size)
    return record
