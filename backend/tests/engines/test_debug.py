"""Debug engines: the same statements, frames, accesses and images from each, and the image of code that just runs."""

import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from zlib import crc32

import pytest

from scanbench.check.build import check_sources
from scanbench.check.typed.condition import Condition, compile_condition
from scanbench.engines.cache import BlobCache
from scanbench.engines.debug import NOTHING, READ, WRITE, DebugEngine, Frame, Listen
from scanbench.engines.engine import Engine, Pace, Reason, Stop
from scanbench.engines.interpreter.debugged import debug_engine as reference_engine
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.debugged import DebugBuilds
from scanbench.engines.native.emit_program import emit_program
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.symbols.symbols import resolve
from tests.amounts import amount, nightly, some
from tests.caseformat import MODELS, first_difference, read_cases, run_case
from tests.engines.test_observe import check
from tests.programs import generate
from tests.programs.areas import areas
from tests.programs.calls import calls
from tests.programs.compare import checked, limited
from tests.programs.frames import frames
from tests.programs.library import library
from tests.programs.lists import instruction_lists
from tests.programs.objects import objects
from tests.programs.references import open_arrays, references

PROGRAMS = amount(120, 15)
SCANS = 2
CASES = Path(__file__).parent.parent / "cases"
INGREDIENTS = (areas, calls, frames, library, instruction_lists, objects, references, open_arrays)

Make = Callable[[Program, bytearray], DebugEngine]
native_engine = DebugBuilds().engine
engines = pytest.mark.parametrize("make", [reference_engine, native_engine], ids=["reference", "native"])


@dataclass(slots=True)
class Told:
    """Writes down what it is told, and halts at a count."""

    engine: DebugEngine
    memory: bytearray
    program: Program
    halt: int = 0
    lines: list[str] = field(default_factory=list)
    images: list[int] = field(default_factory=list)
    """Of each statement: the state, and the variables of the POU's frame."""

    def statement(self, site: int, count: int, depth: int) -> bool:
        frames = self.engine.frames()
        assert (len(frames), frames[0].site, self.engine.count) == (depth, site, count)
        self.lines.append(f"{count} {self.line(site)} in {' '.join(map(self.shown, frames))}")
        pou = frames[0].pou
        members = [each for each in pou.frame.members.values() if not each.hidden]
        state = bytes(self.memory[: self.program.layout.state_size])
        for each in members:
            at = pou.frame_offset + each.offset
            state += self.memory[at : at + each.storage]
        self.images.append(crc32(state))
        return count == self.halt

    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        self.lines.append(
            f"{count} {self.line(site)} {'writes' if written else 'reads'} {offset} {size} {self.engine.bits}"
        )

    def line(self, site: int) -> str:
        span = self.engine.sites.statements[site].span
        return f"{span.line}:{span.column}"

    def shown(self, frame: Frame) -> str:
        return f"{frame.pou.name}({frame.instance})@{self.line(frame.site)}"


def everything(program: Program) -> Listen:
    """Every statement, every access."""
    return Listen(every=True, accesses=READ | WRITE)


def started(make: Make, program: Program, memory: bytearray, listen: Listen | None = None) -> tuple[DebugEngine, Told]:
    engine = make(program, memory)
    told = Told(engine, memory, program)
    engine.hook(told)
    engine.listen(everything(program) if listen is None else listen)
    return engine, told


def at(program: Program, name: str) -> range:
    """The bytes of a variable."""
    symbol = resolve(program, name)
    place = symbol.locate(program.initial_image)
    assert place is not None
    return range(place[0], place[0] + symbol.type.size)


def value(program: Program, name: str, memory: bytearray) -> int:
    bytes_of = at(program, name)
    return int.from_bytes(memory[bytes_of.start : bytes_of.stop], "little", signed=True)


# ---- counts and frames ------------------------------------------------------------------------------------------

NESTED = """\
FUNCTION Add : INT
VAR_INPUT a : INT; END_VAR
Add := a + 1;
END_FUNCTION
FUNCTION_BLOCK Counter
VAR n : INT; END_VAR
n := Add(n);
END_FUNCTION_BLOCK
PROGRAM Main VAR c, d : Counter; i, x : INT; t : TON; END_VAR
FOR i := 1 TO 2 DO
  c();
END_FOR;
WHILE x < Add(1) DO
  x := x + 2;
END_WHILE;
t(IN := TRUE, PT := T#1s);
d();
END_PROGRAM"""


@engines
def test_statements_count_as_they_begin(make: Make) -> None:
    program = check(NESTED)
    memory = bytearray(program.initial_image)
    engine, told = started(make, program, memory, Listen(every=True))
    assert engine.run(1) == Stop(Reason.DONE)
    main, c, d = (at(program, name).start for name in ("Main.c", "Main.c", "Main.d"))
    assert told.lines == [
        f"1 10:1 in Main({main})@10:1",
        f"2 11:3 in Main({main})@11:3",
        f"3 7:1 in Counter({c})@7:1 Main({main})@11:3",
        f"4 3:1 in Add(0)@3:1 Counter({c})@7:1 Main({main})@11:3",
        f"5 11:3 in Main({main})@11:3",
        f"6 7:1 in Counter({c})@7:1 Main({main})@11:3",
        f"7 3:1 in Add(0)@3:1 Counter({c})@7:1 Main({main})@11:3",
        f"8 13:1 in Main({main})@13:1",
        f"9 3:1 in Add(0)@3:1 Main({main})@13:1",
        f"10 14:3 in Main({main})@14:3",
        f"11 3:1 in Add(0)@3:1 Main({main})@13:1",
        f"12 16:1 in Main({main})@16:1",
        f"13 17:1 in Main({main})@17:1",
        f"14 7:1 in Counter({d})@7:1 Main({main})@17:1",
        f"15 3:1 in Add(0)@3:1 Counter({d})@7:1 Main({main})@17:1",
    ]
    assert engine.count == 15
    assert engine.frames() == ()


@engines
def test_it_halts_before_a_statement(make: Make) -> None:
    program = check(NESTED)
    memory = bytearray(program.initial_image)
    engine, told = started(make, program, memory, Listen(count=7))
    told.halt = 7
    assert engine.run(1) == Stop(Reason.HALTED)
    assert [frame.pou.name for frame in engine.frames()] == ["Add", "Counter", "Main"]
    assert (engine.count, value(program, "Main.c.n", memory), value(program, "Main.i", memory)) == (7, 1, 2)
    assert memory[Layout.SCAN] == 0
    assert engine.begin == program.initial_image
    memory[:] = engine.begin
    engine.listen(NOTHING)
    assert engine.run(2) == Stop(Reason.DONE)
    plain = bytearray(program.initial_image)
    ReferenceEngine(program, plain).run(2)
    assert not first_difference(program, memory, plain)
    assert len(told.lines) == 1


@engines
def test_it_listens_to_sites_and_counts(make: Make) -> None:
    program = check(NESTED)
    engine, told = started(make, program, bytearray(program.initial_image))
    (site,) = engine.sites.at_line("main.st", 14)
    engine.listen(Listen(sites=frozenset({site}), count=3))
    engine.run(2)
    assert [line.split(" in ")[0] for line in told.lines] == ["3 7:1", "10 14:3", "3 7:1"]
    engine.hook(None)
    engine.listen(Listen(every=True))
    assert engine.run(1) == Stop(Reason.DONE)
    assert len(told.lines) == 3


@engines
def test_methods_tell_their_instance(make: Make) -> None:
    text = """\
FUNCTION_BLOCK Base
VAR n : INT; END_VAR
METHOD PUBLIC Get : INT
VAR_INPUT a : INT; END_VAR
Get := a + n;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Derived EXTENDS Base
METHOD PUBLIC OVERRIDE Get : INT
VAR_INPUT a : INT; END_VAR
Get := SUPER.Get(a) + 1;
END_METHOD
END_FUNCTION_BLOCK
PROGRAM Main VAR b : Base; d : Derived; r : REF_TO Base; x : INT; END_VAR
r := REF(d);
x := r^.Get(1);
x := b.Get(1);
END_PROGRAM"""
    program = check(text)
    engine, told = started(make, program, bytearray(program.initial_image), Listen(every=True))
    engine.run(1)
    b, d = (at(program, name).start for name in ("Main.b", "Main.d"))
    seen = [line.split(" in ")[1].partition(")")[0].partition("(")[2] for line in told.lines]
    assert [int(each) for each in seen] == [b, b, d, d, b, b]


@engines
def test_connections_run_in_a_frame_of_their_program(make: Make) -> None:
    text = """\
PROGRAM Control VAR_INPUT on : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR
q := on;
END_PROGRAM
CONFIGURATION c
TASK t (INTERVAL := T#10ms, PRIORITY := 1);
PROGRAM one WITH t : Control (on := %MX0.0, q => %MX0.1);
PROGRAM two WITH t : Control;
END_CONFIGURATION"""
    program = check(text)
    engine, told = started(make, program, bytearray(program.initial_image), Listen(every=True))
    engine.run(1)
    one, two = (each.offset for task in program.tasks for each in task.programs)
    assert [line.partition(":")[0] + line.partition(" in ")[1] + line.partition(" in ")[2].partition("@")[0]
            for line in told.lines] == [
        f"1 6 in Control({one})", f"2 2 in Control({one})", f"3 6 in Control({one})", f"4 2 in Control({two})",
    ]  # fmt: skip


@engines
def test_the_plant_and_the_library_are_passed_over(make: Make) -> None:
    shared = """\
FUNCTION Level : INT
VAR_INPUT a : INT; END_VAR
Level := a + 1;
END_FUNCTION
PROGRAM Main VAR x : INT; t : CTU; END_VAR
x := Level(2);
t(CU := TRUE, PV := 3);
END_PROGRAM"""
    plant = "PROGRAM Plant VAR n : INT; END_VAR\nn := Level(1);\nEND_PROGRAM"
    found = check_sources({"main.st": shared, "plant/p.st": plant}, MODELS["GENERIC-IEC"])
    program = found.program
    assert program is not None, found.problems
    engine, told = started(make, program, bytearray(program.initial_image))
    engine.run(1)
    statements = [line.split(" in ")[0] for line in told.lines if " in " in line]
    assert statements == ["1 6:1", "2 3:1", "3 7:1"]
    inside = [line for line in told.lines if line.startswith("3 7:1 ") and " in " not in line]
    assert len(inside) > 5  # of the counter's body, in the name of the statement that calls it
    assert engine.observer.take().reached == {0, 1, 2}


# ---- accesses -----------------------------------------------------------------------------------------------------


def accesses(make: Make, text: str, watched: str, how: int = READ | WRITE) -> list[str]:
    """What one scan does to some variables: `3 reads Main.x`."""
    program = check(text)
    names = {at(program, name).start: name for name in watched.split()}
    listened = {offset: how for name in watched.split() for offset in at(program, name)}
    engine, told = started(make, program, bytearray(program.initial_image), Listen(bytes=listened))
    engine.run(1)
    lines = []
    for line in told.lines:
        _, where, verb, offset, _, _ = line.split()
        lines.append(f"{where.partition(':')[0]} {verb} {names.get(int(offset), '?')}")
    return lines


@engines
def test_reads_and_writes_are_told(make: Make) -> None:
    text = """\
TYPE S : STRUCT n : INT; m : INT; END_STRUCT; END_TYPE
FUNCTION Twice : INT
VAR_IN_OUT v : INT; END_VAR VAR_OUTPUT o : INT; END_VAR
v := v * 2;
Twice := v;
o := v;
END_FUNCTION
PROGRAM Main
VAR x, y, i : INT := 1; s, k : S; l : ARRAY[0..3] OF INT; r : REF_TO INT; w : STRING[4]; b : BYTE; q : BOOL; END_VAR
x := y;
y := Twice(x, o => i);
s := k;
l[i] := x;
r := REF(x);
r^ := r^ + 1;
w := 'ab';
b.%X3 := TRUE;
q := b.%X3;
FOR i := 1 TO 2 DO
  y := i;
END_FOR;
END_PROGRAM"""
    x, y, i = "Main.x", "Main.y", "Main.i"
    assert accesses(make, text, "Main.x") == [
        f"10 writes {x}", f"4 reads {x}", f"4 writes {x}", f"5 reads {x}", f"6 reads {x}", f"13 reads {x}",
        f"15 reads {x}", f"15 writes {x}",
    ]  # fmt: skip
    assert accesses(make, text, "Main.i Main.y", WRITE) == [
        f"11 writes {i}", f"11 writes {y}", f"19 writes {i}", f"20 writes {y}", f"19 writes {i}", f"20 writes {y}",
        f"19 writes {i}",
    ]  # fmt: skip
    assert accesses(make, text, "Main.i", READ) == [f"13 reads {i}", f"20 reads {i}", f"20 reads {i}"]
    assert accesses(make, text, "Main.s.m Main.k.m") == ["12 reads ?", "12 writes ?"]  # the whole structure
    assert accesses(make, text, "Main.l[2]") == ["13 writes Main.l[2]"]
    assert accesses(make, text, "Main.w Main.b Main.q") == [
        "16 writes Main.w", "17 writes Main.b", "18 reads Main.b", "18 writes Main.q",
    ]  # fmt: skip


@engines
def test_blocks_are_told_of_in_both_bodies(make: Make) -> None:
    text = """\
FUNCTION_BLOCK B
VAR_INPUT a : INT; END_VAR VAR_OUTPUT q : INT; END_VAR
q := a;
END_FUNCTION_BLOCK
PROGRAM Main VAR b : B; x, y : INT; t : TON; d : BOOL; END_VAR
b(a := x, q => y);
t(IN := TRUE, PT := T#0s, Q => d);
END_PROGRAM"""
    assert accesses(make, text, "Main.b.a Main.b.q Main.x Main.y") == [
        "6 reads Main.x", "6 writes Main.b.a", "3 reads Main.b.a", "3 writes Main.b.q", "6 reads Main.b.q",
        "6 writes Main.y",
    ]  # fmt: skip
    told = accesses(make, text, "Main.t.IN Main.d", WRITE)
    assert told == ["7 writes Main.t.IN", "7 writes Main.d"]
    assert set(accesses(make, text, "Main.t.Q", WRITE)) == {"7 writes Main.t.Q"}


# ---- the hook -----------------------------------------------------------------------------------------------------


class Calling:
    """A hook of functions."""

    def __init__(self, statement: Callable[[int, int], bool], access: Callable[[int], None] | None = None) -> None:
        self._statement, self._access = statement, access

    def statement(self, site: int, count: int, depth: int) -> bool:
        return self._statement(site, count)

    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        assert self._access is not None
        self._access(offset)


LOOP = """\
FUNCTION Add : INT
VAR_INPUT a : INT; END_VAR
Add := a + 1;
END_FUNCTION
PROGRAM Main VAR i, n, x : INT; END_VAR
FOR i := 1 TO 10 DO
  n := n + i;
END_FOR;
x := Add(n);
END_PROGRAM"""


@engines
def test_the_hook_may_write(make: Make) -> None:
    """A statement uses the values that were written before it: loop variables, arguments."""
    program = check(LOOP)
    memory = bytearray(program.initial_image)
    engine = make(program, memory)
    pou = next(each for each in program.pous if each.name == "Add")
    argument = pou.frame_offset + pou.frame.members["A"].offset

    def statement(site: int, count: int) -> bool:
        if count == 3:
            memory[at(program, "Main.i").start] = 100
        if engine.frames()[0].pou is pou:
            memory[argument] = 7
        return False

    engine.hook(Calling(statement))
    engine.listen(Listen(every=True))
    engine.run(1)
    assert (value(program, "Main.n", memory), value(program, "Main.x", memory)) == (55 - 2 + 100, 8)


@engines
def test_what_a_hook_raises_ends_the_scan(make: Make) -> None:
    program = check(LOOP)
    memory = bytearray(program.initial_image)
    engine = make(program, memory)

    def statement(site: int, count: int) -> bool:
        raise ZeroDivisionError(f"at {count}")

    engine.hook(Calling(statement))
    engine.listen(Listen(count=4))
    with pytest.raises(ZeroDivisionError, match="at 4"):
        engine.run(5)
    assert (memory[Layout.SCAN], engine.count, value(program, "Main.i", memory)) == (0, 4, 3)
    memory[:] = engine.begin
    engine.hook(None)
    assert engine.run(5) == Stop(Reason.DONE)

    def access(offset: int) -> None:
        raise KeyError(offset)

    engine.hook(Calling(lambda site, count: False, access))
    engine.listen(Listen(bytes={at(program, "Main.x").start: WRITE}))
    with pytest.raises(KeyError):
        engine.run(5)
    assert memory[Layout.SCAN] <= 6
    engine.hook(None)
    engine.listen(NOTHING)
    memory[:] = engine.begin
    assert engine.run(5) == Stop(Reason.DONE)


@engines
def test_to_halt_after_an_access(make: Make) -> None:
    """As the contract says: every statement from there on, and an interrupt for where none comes any more."""
    program = check(LOOP)
    memory = bytearray(program.initial_image)
    engine = make(program, memory)

    def access(offset: int) -> None:
        engine.listen(Listen(every=True))
        engine.interrupt()

    engine.hook(Calling(lambda site, count: True, access))
    engine.listen(Listen(bytes={at(program, "Main.n").start: WRITE}))
    assert engine.run(5) == Stop(Reason.HALTED)
    assert (engine.count, value(program, "Main.n", memory)) == (3, 1)
    memory[:] = engine.begin
    engine.listen(Listen(bytes={at(program, "Main.x").start: WRITE}))
    assert engine.run(5) == Stop(Reason.INTERRUPTED)
    assert (memory[Layout.SCAN], value(program, "Main.x", memory)) == (1, 56)


@engines
def test_it_runs_as_any_engine(make: Make) -> None:
    program = check(LOOP)
    memory = bytearray(program.initial_image)
    engine: Engine = make(program, memory)
    assert engine.run(3) == Stop(Reason.DONE)
    condition = compile_condition(program, "Main.n > 300")
    assert isinstance(condition, Condition)
    engine.stop_when(condition)
    assert engine.run(100) == Stop(Reason.CONDITION)
    assert (memory[Layout.SCAN], engine.holds(condition)) == (6, True)
    engine.stop_when(None)
    pace = Pace(1, 0)
    assert engine.run(4, pace) == Stop(Reason.DONE)
    assert pace.scans == 4
    engine.interrupt()
    assert engine.run(4) == Stop(Reason.INTERRUPTED)
    thread = threading.Timer(0.05, engine.interrupt)
    thread.start()
    assert engine.run(1 << 40) == Stop(Reason.INTERRUPTED)
    thread.join()


@engines
def test_a_trap_leaves_count_and_frames(make: Make) -> None:
    text = """\
FUNCTION Share : INT
VAR_INPUT a : INT; END_VAR
Share := 10;
Share := Share / a;
END_FUNCTION
PROGRAM Main VAR x, y : INT := 2; END_VAR
x := Share(y);
y := y - 1;
END_PROGRAM"""
    program = check(text)
    memory = bytearray(program.initial_image)
    engine, told = started(make, program, memory, NOTHING)
    stop = engine.run(5)
    assert (stop.reason, program.traps[stop.trap - 1].span.line) == (Reason.TRAP, 4)
    assert engine.count == 3
    assert [told.shown(frame).partition("@")[2] for frame in engine.frames()] == ["4:1", "7:1"]
    assert engine.begin[Layout.SCAN] == 2


@engines
def test_ways_that_statements_go(make: Make) -> None:
    text = """\
PROGRAM Main VAR x : INT; i, n : INT; b, c : BOOL; END_VAR
IF b THEN x := 1; ELSIF c THEN x := 2; ELSE x := 3; END_IF;
IF b THEN x := 1; END_IF;
CASE n OF 0: x := 1; 1: x := 2; END_CASE;
FOR i := 1 TO n DO x := 4; END_FOR;
WHILE x < 3 AND n > 0 DO x := 3; END_WHILE;
REPEAT x := 5; UNTIL TRUE END_REPEAT;
FOR i := 1 TO 3 DO IF i = 2 THEN EXIT; END_IF; END_FOR;
n := n + 1; b := n = 2; c := TRUE;
END_PROGRAM"""
    program = check(text)
    engine = make(program, bytearray(program.initial_image))

    def seen() -> list[str]:
        engine.run(1)
        sites = engine.sites
        outcomes = [sites.outcomes[number] for number in sorted(engine.observer.take().outcomes)]
        return [f"{sites.statements[each.site].span.line} {each.name}" for each in outcomes]

    assert seen() == ["2 ELSE", "3 ELSE", "4 CASE 1", "5 NO ROUND", "6 NO ROUND", "8 BODY", "8 THEN", "8 ELSE"]
    assert seen() == ["2 ELSIF 1", "3 ELSE", "4 CASE 2", "5 BODY", "6 NO ROUND", "8 BODY", "8 THEN", "8 ELSE"]
    assert seen() == ["2 THEN", "3 THEN", "4 ELSE", "5 BODY", "6 NO ROUND", "8 BODY", "8 THEN", "8 ELSE"]


@engines
def test_it_is_observed_too(make: Make) -> None:
    program = check("PROGRAM Main VAR f AT %MX0.2 : BOOL; x : BOOL; END_VAR\nx := f;\nEND_PROGRAM")
    engine = make(program, bytearray(program.initial_image))
    engine.observer.watch([(program.layout.areas["M"], 4)])
    engine.run(1)
    (read,) = engine.observer.take().reads
    assert (read.site, read.offset, read.mask) == (0, program.layout.areas["M"], 4)


# ---- the flavours -------------------------------------------------------------------------------------------------


def test_code_that_runs_is_what_it_was() -> None:
    assert "debug" not in emit_program(check(NESTED))


def test_debugged_code_is_kept(tmp_path: Path) -> None:
    program = check(NESTED)
    made = DebugBuilds(BlobCache(tmp_path)).objects(program)
    kept = {path.read_bytes() for path in tmp_path.glob("*.kept")}
    assert len(kept) == len(made.objects) == 2
    assert DebugBuilds(BlobCache(tmp_path)).objects(check(NESTED)).objects == made.objects


# ---- both engines on everything -----------------------------------------------------------------------------------


def agree(program: Program) -> int:
    """Runs a program on both; gives the number of statements. Then halts in the midst of the last scan, and goes on."""
    images = [limited(program) for _ in range(3)]
    running = [
        started(make, program, image) for make, image in zip((reference_engine, native_engine), images, strict=False)
    ]
    plain = ReferenceEngine(program, images[2])
    statements = 0
    for number in range(SCANS):
        begin = bytes(images[2])
        stops = [engine.run(1) for engine, _ in running]
        assert {plain.run(1)} == set(stops), f"scan {number}"
        for image in images[:2]:
            assert not first_difference(program, image, images[2]), f"scan {number}"
        (reference, first), (native, second) = running
        assert_same(first.lines, second.lines)
        assert_same(first.images, second.images)
        assert {reference.begin[: program.layout.state_size], native.begin[: program.layout.state_size]} == {
            begin[: program.layout.state_size]
        }
        assert reference.count == native.count == len(first.images) > 0
        assert reference.frames() == native.frames()
        assert reference.observer.take() == native.observer.take()
        statements += len(first.images)
        seen = list(first.images)
        halts(program, running, (images, stops[0], seen))
        for _, told in running:
            told.lines.clear()
            told.images.clear()
        if stops[0].reason is Reason.TRAP:
            break
    return statements


def halts(
    program: Program,
    running: Sequence[tuple[DebugEngine, Told]],
    ran: tuple[list[bytearray], Stop, list[int]],
) -> None:
    """In the scan that just ran, at some of its statements."""
    images, stop, seen = ran
    for engine, told in running:
        for count in {1, len(seen) // 3 + 1, len(seen)}:
            told.memory[:] = engine.begin
            told.halt = count
            told.images.clear()
            engine.listen(Listen(count=count))
            assert engine.run(3) == Stop(Reason.HALTED)
            assert (told.images, engine.count) == ([seen[count - 1]], count)
        told.halt = 0
        told.memory[:] = engine.begin
        assert engine.run(1) == stop
        assert not first_difference(program, told.memory, images[2])
        engine.observer.take()
        engine.listen(everything(program))


def assert_same(a: Sequence[object], b: Sequence[object]) -> None:
    for number, (one, other) in enumerate(zip(a, b, strict=False)):
        assert one == other, f"number {number}, after {a[max(number - 5, 0) : number]}"
    assert len(a) == len(b), f"{[*a[len(b) :], *b[len(a) :]][:3]}"


@nightly
def test_engines_agree_on_random_programs() -> None:
    compared = statements = 0
    for seed in range(PROGRAMS):
        source = generate(seed, INGREDIENTS)
        program = checked(source)
        if program is None:
            continue
        compared += 1
        try:
            statements += agree(program)
        except Exception as error:
            error.add_note(f"seed {seed}:\n{source}")
            raise
    assert compared > PROGRAMS * 0.9
    assert statements > 20 * PROGRAMS


@nightly
@pytest.mark.parametrize("topic", some(sorted(path.stem for path in CASES.glob("*.case")), 9, 5))
def test_engines_agree_on_all_cases(topic: str) -> None:
    for case in read_cases(CASES / f"{topic}.case"):
        told: dict[str, Told] = {}

        def telling(make: Make, name: str, told: dict[str, Told] = told) -> Callable[[Program, bytearray], Engine]:
            def made(program: Program, memory: bytearray) -> Engine:
                engine, told[name] = started(make, program, memory)
                return engine

            return made

        run_case(case, [telling(reference_engine, "reference"), telling(native_engine, "native")])
        assert_same(told["reference"].lines, told["native"].lines)
        assert_same(told["reference"].images, told["native"].images)
