"""Observed code in a host: of the statements that run, whatever was checked since."""

from scanbench.host.build import Builder
from scanbench.program.program import Program
from scanbench.runtime.programs import Loaded
from scanbench.symbols.sites import sites_of
from scanbench.wire.host import Sources

SOURCE = "PROGRAM Main\nVAR n : DINT; END_VAR\n  n := n + 1;\n  IF n = 5 THEN\n    n := 7;\n  END_IF;\nEND_PROGRAM\n"
EDITED = SOURCE.replace("  n := n + 1;", "\n\n  n := n + 2;\n  n := n - 1;")


def sources(text: str, version: int) -> Sources:
    return Sources("CJ1M-CPU63", {"main.st": text}, 10_000_000, version)


def lines(program: Program) -> list[int]:
    return [site.span.line for site in sites_of(program).statements]


def test_the_program_checked_again_has_the_statements_that_run() -> None:
    builder = Builder(None)
    built = builder.build(sources(SOURCE, 1))
    memory = bytearray(built.program.layout.size)
    loaded = Loaded(1, built.program, memory, built.engine(built.program, memory))
    builder.build(sources(EDITED, 2))  # never swapped in
    assert lines(loaded.program) == [5, 6, 7, 8], "programs of one host share their bodies"
    loaded.fresh = builder.checked_alone(sources(SOURCE, 1))
    builder.preview(sources(SOURCE.replace("n := 7", "n := 8"), 3))
    assert lines(loaded.statements) == [3, 4, 5]

    memory[: len(loaded.program.initial_image)] = loaded.program.initial_image
    memory[40] = 1
    start = bytes(memory)
    loaded.engine.run(20)
    plain, memory[:] = bytes(memory), start
    builder.flavours.prepare_observed(loaded.statements)
    engine, observer = builder.flavours.observed(loaded.statements, memory)
    engine.run(4)
    assert observer.take().reached == {0, 1}
    engine.run(16)
    assert observer.take().reached == {0, 1, 2}
    size = loaded.program.layout.state_size
    assert memory[:size] == plain[:size]
