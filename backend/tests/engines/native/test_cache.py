"""Object code that is kept: in memory, on disk, from one program to the next."""

from pathlib import Path

import pytest

from scanbench.check.incremental import Checks
from scanbench.engines.cache import BlobCache
from scanbench.engines.engine import Reason
from scanbench.engines.native import jit
from scanbench.engines.native.compiler import AT_ONCE, FAST, QUICK, Build, Compiler
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.native.parts import Part
from scanbench.engines.native.worker import optimised
from scanbench.program.program import Program
from tests.conftest import Compile
from tests.engines.native.plc import MODEL, check

SOURCE = """\
FUNCTION_BLOCK Counter
VAR_INPUT step : DINT; END_VAR
VAR_OUTPUT n : DINT; END_VAR
VAR list : ARRAY[1..4] OF DINT; END_VAR
  n := n + step;
  list[n MOD 4 + 1] := n;
{more}
END_FUNCTION_BLOCK
FUNCTION Twice : DINT
VAR_INPUT v : DINT; END_VAR
  Twice := v * 2;
END_FUNCTION
PROGRAM Main
VAR c : Counter; sum : DINT; i : DINT; d : ARRAY[0..9] OF DINT; END_VAR
  c(step := 3);
  FOR i := 0 TO 9 DO d[i] := Twice(c.n + i); END_FOR;
  sum := sum + d[c.n MOD 10];
{extra}
END_PROGRAM
"""
# enough for a program to be compiled in parts
FILLER = "\n".join("  IF sum > 5 THEN d[1] := d[2]; ELSE d[3] := d[4] / 2; END_IF;" for _ in range(40))


@pytest.fixture(autouse=True)
def _always_compiled(compiled_once: Compile, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(jit, "compile_object", compiled_once)


def program(more: str = "", extra: str = FILLER) -> Program:
    return check(SOURCE.format(more=more, extra=extra))


def large() -> Program:
    return program(extra=FILLER * (AT_ONCE // 16_000))


def result(made: Program, build: Build, scans: int = 20) -> bytes:
    memory = bytearray(made.initial_image)
    assert NativeEngine(made, memory, objects=build.objects).run(scans).reason is Reason.DONE
    return bytes(memory[: made.layout.state_size])


def compiled(build: Build) -> bool:
    return build.timings.codegen > 0


def test_the_second_build_is_read_from_the_disk(tmp_path: Path) -> None:
    made = program()
    first = Compiler(BlobCache(tmp_path)).build(made)
    second = Compiler(BlobCache(tmp_path)).build(made)
    assert compiled(first)
    assert not compiled(second)
    assert result(made, first) == result(made, second)


def test_a_different_level_or_machine_is_different_code(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made = program()
    Compiler(BlobCache(tmp_path)).build(made)
    assert compiled(Compiler(BlobCache(tmp_path)).build(made, QUICK))
    monkeypatch.setattr(jit, "host", lambda: "another machine")
    assert compiled(Compiler(BlobCache(tmp_path)).build(made))


def test_only_what_changed_is_compiled() -> None:
    checks, compiler = Checks(), Compiler()
    text = SOURCE.format(more="", extra=FILLER)
    first = checks.check({"test.st": text}, MODEL, 1_000_000).program
    assert first is not None
    before = compiler.build(first)
    other = text.replace("Twice := v * 2;", "Twice := v * 3;")
    second = checks.check({"test.st": other}, MODEL, 1_000_000).program
    assert second is not None
    after = compiler.build(second)
    same = [part for part in after.parts if part in before.parts]
    assert (
        len(same) == 2
    )  # the system's words, Counter; Main has a copy of the function, the scan and the numbers are made again
    assert sum(part.text not in {each.text for each in before.parts} for part in after.parts) == 2
    assert result(second, after) == result(second, Compiler().build(check(other)))


def test_more_trap_sites_in_one_pou_leave_the_others_alone() -> None:
    large = "  n := n + 1;\n" * 30  # no part of its callers
    before = {part.text for part in Compiler().build(program(large), QUICK).parts}
    more = large + "  list[n MOD 3 + 1] := n / (step - 2);\n" * 3
    after = [part for part in Compiler().build(program(more), QUICK).parts if part.text not in before]
    assert len(after) == 2  # Counter and the numbers


def test_traps_count_over_all_pous() -> None:
    """The number that a module says is relative; what comes out names the site in the whole program."""
    made = check(
        "FUNCTION_BLOCK A\nVAR x, n : DINT; END_VAR\n x := 1 / n; x := 2 / n;\nEND_FUNCTION_BLOCK\n"
        "PROGRAM Main\nVAR a : A; x, zero : DINT; go : BOOL; END_VAR\nIF go THEN a(); END_IF;\nx := 1 / zero;\nEND_PROGRAM"
    )
    for level in (QUICK, FAST):
        stop = NativeEngine(made, bytearray(made.initial_image), level).run(1)
        assert stop.reason is Reason.TRAP
        assert made.traps[stop.trap - 1].span.line == 8


def test_a_broken_file_is_built_again(tmp_path: Path) -> None:
    made = program()
    whole = Compiler(BlobCache(tmp_path)).build(made)
    for number, path in enumerate(sorted(tmp_path.iterdir())):
        data = path.read_bytes()
        path.write_bytes((data[:-1], data[:20], b"", data[:100] + b"\x00" + data[101:])[number % 4])
    again = Compiler(BlobCache(tmp_path)).build(made)
    assert compiled(again)
    assert result(made, again) == result(made, whole)
    assert not compiled(Compiler(BlobCache(tmp_path)).build(made))


def test_quick_code_first_and_optimised_code_later(tmp_path: Path) -> None:
    made = large()
    compiler = Compiler(BlobCache(tmp_path))
    compiler.prepare(program())
    soon = compiler.build_soon(made)
    assert len(soon.objects) > 1
    assert soon.pending
    quick = result(made, soon)
    for part, code in optimised(soon.pending, lambda: True):
        compiler.learn(soon, part, code)
    assert soon.finished
    assert result(made, soon) == quick
    again = Compiler(BlobCache(tmp_path))
    again.prepare(program())
    assert again.build_soon(made).finished


def test_a_large_program_is_one_piece_first(tmp_path: Path) -> None:
    made = large()
    compiler = Compiler(BlobCache(tmp_path))
    soon = compiler.build_soon(made)
    assert len(soon.objects) == 1
    quick = result(made, soon)
    compiler.divide(soon, made)
    for part, code in optimised(soon.pending, lambda: True):
        compiler.learn(soon, part, code)
    assert soon.finished
    assert len(soon.objects) > 1
    assert result(made, soon) == quick
    again = Compiler(BlobCache(tmp_path)).build_soon(made)
    Compiler(BlobCache(tmp_path)).divide(again, made)
    assert again.finished  # all of it is on the disk


def test_a_little_is_optimised_at_once() -> None:
    assert Compiler().build_soon(program(extra="")).finished


def test_what_is_not_wanted_is_not_optimised() -> None:
    compiler, made = Compiler(), large()
    soon = compiler.build_soon(made)
    compiler.divide(soon, made)
    done: list[Part] = []
    for part, _ in optimised(soon.pending, lambda: not done):
        done.append(part)
    assert len(done) == 1 < len(soon.pending)
