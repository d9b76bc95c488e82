"""Object code on disk."""

from pathlib import Path

from scanbench.engines.engine import Reason
from scanbench.engines.native.engine import NativeEngine
from tests.engines.native.plc import check

COUNT = "PROGRAM Main VAR n : DINT; END_VAR n := n + {step}; END_PROGRAM"


def build(step: int, cache: Path, opt_level: int = 2) -> tuple[NativeEngine, bytearray]:
    program = check(COUNT.format(step=step))
    memory = bytearray(program.initial_image)
    return NativeEngine(program, memory, opt_level, cache), memory


def test_the_second_build_is_read(tmp_path: Path) -> None:
    cache = tmp_path / "objects"
    first, _ = build(1, cache)
    assert first.timings.codegen > 0
    second, memory = build(1, cache)
    assert second.timings.codegen == second.timings.optimise == 0
    assert len(list(cache.iterdir())) == 1
    assert second.run(5).reason is Reason.DONE
    assert 5 in memory


def test_other_programs_and_levels_are_other_files(tmp_path: Path) -> None:
    for step, level in ((1, 2), (2, 2), (1, 0)):
        build(step, tmp_path, level)
    assert len(list(tmp_path.iterdir())) == 3
