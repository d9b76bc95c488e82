"""Quick code first, optimised code later, and what is known already at once: all compute the same."""

import gc
import re
import threading
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import pytest

import scanbench
from scanbench.engines.cache import BlobCache
from scanbench.engines.native import worker
from scanbench.engines.native.parts import Part
from scanbench.engines.native.worker import WorkerDied
from scanbench.host import program_cache as known
from scanbench.host import tiers as tiers_module
from scanbench.host.build import Builder, Built, find_model
from scanbench.host.swaps import Recode
from scanbench.runtime.command import Entry
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.programs import Loaded, LoadedPrograms
from scanbench.runtime.resource import Resource
from scanbench.runtime.write import Write
from scanbench.wire.host import Sources
from tests.amounts import slow

BLOCK = (
    """\
FUNCTION_BLOCK Unit{0}
VAR_INPUT step : DINT; END_VAR
VAR_OUTPUT n : DINT; END_VAR
VAR r : REAL; list : ARRAY[0..7] OF DINT; t : TON; END_VAR
  t(IN := n MOD 3 = 0, PT := T#20ms);
"""
    + "".join(
        f"  IF list[n MOD 8] > {k} THEN r := r * 0.5 + {k}.25; list[{k % 8}] := REAL_TO_DINT(r); ELSE n := n + step; END_IF;\n"
        for k in range(40)
    )
    + "END_FUNCTION_BLOCK\n"
)
UNITS = 6
MAIN = """\
PROGRAM Main
VAR u : ARRAY[1..2] OF Unit0; {more} extra : DINT; END_VAR
  u[1](step := 3); u[2](step := 1 + extra);
{calls}
END_PROGRAM
"""


def sources(step: int = 1, units: int = UNITS, version: int = 1) -> Sources:
    more = "".join(f"v{k} : Unit{k}; " for k in range(units))
    calls = "".join(f"  v{k}(step := {step});\n" for k in range(units))
    text = "".join(BLOCK.format(k) for k in range(units)) + MAIN.format(more=more, calls=calls)
    return Sources("GENERIC-IEC", {"main.st": text}, 1_000_000, version)


def optimised(builder: Builder) -> Recode:
    """Waits for the optimised code."""
    found, done = [], threading.Event()

    def take(recode: Recode) -> None:
        found.append(recode)
        done.set()

    assert builder.tiers is not None
    builder.tiers.optimise(take)
    assert done.wait(60)
    return found[0]


def is_optimising(builder: Builder) -> bool:
    return builder.tiers is not None and builder.tiers.optimising


def state_after(built: Built, scans: int) -> bytes:
    plc = Resource(Loaded.make(built.program, built.engine))
    plc.run(scans)
    return plc.state


def test_the_seam_does_not_show(tmp_path: Path) -> None:
    builder = Builder(tmp_path)
    built = builder.build(sources())
    plc = Resource(Loaded.make(built.program, built.engine))
    assert is_optimising(builder)
    plc.run(50)
    plc.submit(Write("Ada", "Main.extra", "4"))
    recode = optimised(builder)
    assert recode.engine is not None
    assert recode.program is plc.program
    assert not is_optimising(builder)
    entries = list(plc.journal)
    plc.loaded.engine = recode.engine
    plc.run(50)
    assert list(plc.journal) == entries

    straight = Resource(Loaded.make(built.program, Builder(None).build(sources()).engine))
    straight.run(50)
    straight.submit(Write("Ada", "Main.extra", "4"))
    straight.run(50)
    assert plc.state == straight.state


def test_a_new_program_supersedes(tmp_path: Path) -> None:
    builder = Builder(tmp_path)
    first = builder.build(sources())
    Resource(Loaded.make(first.program, first.engine))
    assert builder.tiers is not None
    delivered: list[Recode] = []
    builder.tiers.optimise(delivered.append)
    second = builder.build(sources(units=UNITS - 1))
    plc = Resource(Loaded.make(second.program, second.engine))
    recode = optimised(builder)
    assert recode.program is plc.program
    for thread in threading.enumerate():
        if thread.name == "optimise":
            thread.join(60)
    assert not delivered


def test_a_known_program_starts_optimised(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    builder = Builder(tmp_path)
    built = builder.build(sources())
    expected = state_after(built, 30)
    optimised(builder)
    known.keep(BlobCache(tmp_path), known.key_of(sources(), find_model("GENERIC-IEC")), built.program)

    def refuse(*_: object) -> object:
        raise AssertionError("nothing is to be checked or compiled")

    monkeypatch.setattr("scanbench.engines.native.jit.compile_object", refuse)
    monkeypatch.setattr("scanbench.check.incremental.Checks.check", refuse)
    again = Builder(tmp_path)
    recalled = again.build(sources())
    assert state_after(recalled, 30) == expected
    assert not is_optimising(again)


def test_an_edit_of_a_recalled_program(tmp_path: Path) -> None:
    """Nothing of what was recalled gets in the way of the next program."""
    first = Builder(tmp_path)
    built = first.build(sources())
    state_after(built, 1)
    optimised(first)
    known.keep(BlobCache(tmp_path), known.key_of(sources(), find_model("GENERIC-IEC")), built.program)
    again = Builder(tmp_path)
    state_after(again.build(sources()), 1)
    again.prepare(sources())
    edited = again.build(sources(step=2))
    assert state_after(edited, 30) == state_after(Builder(None).build(sources(step=2)), 30)


def broken(directory: Path, change: Callable[[bytes], bytes]) -> None:
    for path in directory.iterdir():
        path.write_bytes(change(path.read_bytes()))


@pytest.mark.parametrize(
    "change",
    [
        lambda data: data[:-7],
        pytest.param(lambda data: b"", marks=slow),
        pytest.param(lambda data: data[:99] + b"\0\0" + data[101:], marks=slow),
    ],
)
def test_a_broken_cache_is_no_cache(tmp_path: Path, change: Callable[[bytes], bytes]) -> None:
    builder = Builder(tmp_path)
    built = builder.build(sources())
    expected = state_after(built, 20)
    optimised(builder)
    known.keep(BlobCache(tmp_path), known.key_of(sources(), find_model("GENERIC-IEC")), built.program)
    broken(tmp_path, change)
    assert state_after(Builder(tmp_path).build(sources()), 20) == expected


def test_what_a_program_depends_on_is_in_its_key(monkeypatch: pytest.MonkeyPatch) -> None:
    model, one = find_model("GENERIC-IEC"), sources()
    keys = {
        known.key_of(one, model),
        known.key_of(sources(step=2), model),
        known.key_of(Sources(one.model, {"other.st": one.files["main.st"]}, one.interval_ns, 1), model),
        known.key_of(Sources(one.model, one.files, 2 * one.interval_ns, 1), model),
        known.key_of(one, find_model("CJ1M-CPU63")),
    }
    assert len(keys) == 5
    assert known.key_of(sources(version=9), model) in keys
    monkeypatch.setattr(known, "_own_code", lambda: "another version of ours")
    assert known.key_of(one, model) not in keys


def test_all_rooms_that_have_a_part_in_a_program_are_in_its_key() -> None:
    """Else a newer version would find what an older one has made."""
    package = Path(scanbench.__file__).parent
    texts = [path.read_text("utf-8") for room in known.ROOMS for path in (package / room).rglob("*.py")]
    used = {room for text in texts for room in re.findall(r"^from scanbench\.(\w+)", text, re.MULTILINE)}
    assert used - {"garbage", "problems", "public"} == set(known.ROOMS)  # problems.py is in it by itself


def test_where_the_worker_dies_quick_code_runs_on(monkeypatch: pytest.MonkeyPatch) -> None:
    def dies(*_: object) -> Iterator[object]:
        raise WorkerDied

    monkeypatch.setattr(tiers_module, "optimised", dies)
    builder = Builder(None)
    built = builder.build(sources())
    plc = Resource(Loaded.make(built.program, built.engine))
    assert optimised(builder).engine is None
    assert not is_optimising(builder)
    plc.run(10)


@slow
def test_one_of_many_optimises(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Both begin with quick code; the second takes what the first has made."""
    builders = [Builder(tmp_path), Builder(tmp_path)]
    plcs = []
    for builder in builders:
        built = builder.build(sources())
        plcs.append(Resource(Loaded.make(built.program, built.engine)))
        assert is_optimising(builder)
    runs: list[int] = []

    def counted(parts: Iterable[Part], wanted: Callable[[], bool]) -> Iterator[tuple[Part, bytes]]:
        runs.append(1)
        yield from worker.optimised(parts, wanted)

    monkeypatch.setattr(tiers_module, "optimised", counted)
    found: list[Recode] = []
    done = threading.Semaphore(0)

    def take(recode: Recode) -> None:
        found.append(recode)
        done.release()

    for builder in builders:
        assert builder.tiers is not None
        builder.tiers.optimise(take)
    assert all(done.acquire(timeout=60) for _ in builders)
    assert all(recode.engine is not None for recode in found)
    assert len(runs) == 1


def resident_kb() -> int:
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4


@slow
def test_code_that_is_swapped_out_is_freed() -> None:
    builder = Builder(None)
    plc: Resource | None = None
    sizes = []
    gc.freeze()  # what other tests have left need not be looked at each time
    for version in range(32):
        built = builder.build(sources(step=version % 7))
        loaded = Loaded.make(built.program, built.engine, version)
        if plc is None:
            plc = Resource(loaded)
        else:
            plc.programs = LoadedPrograms(loaded)
            assert isinstance(plc.submit(ProgramChange("Ada", version)), Entry)
        plc.run(1)
        del loaded
        gc.collect()
        sizes.append(resident_kb())
    gc.unfreeze()
    assert sizes[-1] - sizes[12] < 8_000, sizes
