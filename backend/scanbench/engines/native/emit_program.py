"""A whole program as the text of one LLVM module."""

from scanbench.check.program import Program
from scanbench.engines.native import emit_pou, emit_scan
from scanbench.engines.native.emit_body import Unit


def emit_program(program: Program) -> str:
    """The IR text: every POU, the scan, and `@run`."""
    unit = Unit()
    for pou in program.pous:
        emit_pou.emit(unit, pou, program.layout.size)
    emit_scan.emit(unit, program)
    return unit.module.text()
