"""Observed code: the same statements and the same reads from each engine, and the image of code that is not observed."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

from scanbench.check.build import check_sources
from scanbench.engines.cache import BlobCache
from scanbench.engines.engine import Engine, Reason, Stop
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.interpreter.observed import observed_engine
from scanbench.engines.native import jit
from scanbench.engines.native.compiler import Compiler
from scanbench.engines.native.emit_observed import Observing
from scanbench.engines.native.emit_program import emit_program
from scanbench.engines.native.observed import ObservedBuilds
from scanbench.engines.native.observed import observed_engine as linked_engine
from scanbench.engines.observe import LIMIT, MakeObserved, Observed, ReadAt, Seen, areas_end
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.symbols.symbols import resolve
from tests.amounts import amount, nightly, some
from tests.caseformat import MODELS, first_difference, read_cases, run_case
from tests.programs import generate
from tests.programs.areas import areas
from tests.programs.calls import calls
from tests.programs.compare import OPTIMISED_EACH, checked, limited
from tests.programs.frames import frames
from tests.programs.library import library
from tests.programs.lists import instruction_lists
from tests.programs.objects import objects
from tests.programs.references import open_arrays, references

PROGRAMS = amount(200, 30)
SCANS = 3
CASES = Path(__file__).parent.parent / "cases"

native_engine = ObservedBuilds().engine
engines = pytest.mark.parametrize("make", [observed_engine, native_engine], ids=["reference", "native"])


@dataclass(slots=True)
class Noted:
    """What one scan did, for people: `3 %MX0.2` is a read of that bit in line 3."""

    reads: list[str]
    lines: list[int]
    stop: Stop


def check(*files: str, model: str = "GENERIC-IEC") -> Program:
    found = check_sources({f"{number or 'main'}.st": text for number, text in enumerate(files)}, MODELS[model])
    assert found.program is not None, "\n".join(map(str, found.problems))
    return found.program


def bits(program: Program, *names: str) -> list[tuple[int, int]]:
    """What is watched: every bit of these variables and addresses."""
    made = []
    for name in names:
        symbol = resolve(program, name)
        place = symbol.locate(program.initial_image)
        assert place is not None
        at, bit = place
        made += [(at, 1 << bit)] if bit is not None else [(at + number, 0xFF) for number in range(symbol.type.size)]
    return made


def noted(program: Program, stop: Stop, observed: Observed) -> Noted:
    """Takes what was noted, in words."""
    seen = observed[1].take()
    sites = observed[1].sites.statements
    start = program.layout.areas["M"]
    reads = []
    for read in seen.reads:
        assert read.mask
        at, line = read.offset - start, sites[read.site].span.line
        if read.mask == 0xFF:
            reads.append(f"{line} %MB{at}")
        else:
            reads += [f"{line} %MX{at}.{bit}" for bit in range(8) if read.mask >> bit & 1]
    return Noted(reads, sorted(sites[number].span.line for number in seen.reached), stop)


def scan(make: MakeObserved, text: str, watched: str, sets: Sequence[str] = ()) -> Noted:
    """One scan of a program, whose image is compared with that of code that is not observed."""
    program = check(text)
    memory = bytearray(program.initial_image)
    for each in sets:
        at, mask = bits(program, each)[0]
        memory[at] |= mask
    plain = bytearray(memory)
    engine, observer = make(program, memory)
    observer.watch(bits(program, *watched.split()))
    stop = engine.run(1)
    assert ReferenceEngine(program, plain).run(1) == stop
    assert not first_difference(program, memory, plain)
    return noted(program, stop, (engine, observer))


# ---- reads ------------------------------------------------------------------------------------------------------


@engines
def test_a_located_flag_is_its_bit(make: MakeObserved) -> None:
    text = """\
PROGRAM Main VAR f AT %MX0.2 : BOOL; g AT %MX0.3 : BOOL; b AT %MB0 : BYTE; w AT %MW0 : WORD; x : BOOL; y : DWORD; END_VAR
x := f;
x := g;
y := b;
y := y OR w;
f := TRUE;
w := 7;
x := %MX0.2;
x := b.%X2;
END_PROGRAM"""
    found = scan(make, text, "%MX0.2")
    # a byte is read as a whole, of which one bit is watched
    assert found.reads == ["2 %MX0.2", "4 %MX0.2", "5 %MX0.2", "8 %MX0.2", "9 %MX0.2"]
    assert found.lines == list(range(2, 10))


@engines
def test_conditions_belong_to_their_statement(make: MakeObserved) -> None:
    text = """\
PROGRAM Main VAR f AT %MX0.0 : BOOL; n AT %MB1 : USINT; i, x : INT; END_VAR
IF x > 0 THEN
  x := 1;
ELSIF f THEN
  x := 2;
ELSE
  x := 3;
END_IF;
CASE n OF 0: x := n; ELSE x := 5; END_CASE;
WHILE n < 2 DO
  n := n + 1;
END_WHILE;
REPEAT
  x := 4;
UNTIL f = f END_REPEAT;
FOR i := n TO n + 1 BY USINT_TO_INT(n) DO
  x := 6;
END_FOR;
END_PROGRAM"""
    found = scan(make, text, "%MB0 %MB1")
    assert found.reads == ["2 %MX0.0", "9 %MB1", "9 %MB1", "10 %MB1", "11 %MB1", "13 %MX0.0", "16 %MB1"]
    assert found.lines == [2, 7, 9, 9, 10, 11, 13, 14, 16, 17]


@engines
def test_what_is_not_evaluated_is_not_read(make: MakeObserved) -> None:
    text = """\
PROGRAM Main VAR f AT %MX0.0 : BOOL; no : BOOL; x : BOOL; n : INT; m AT %MW1 : INT; END_VAR
x := no AND_THEN f;
x := NOT no OR_ELSE f;
x := no AND f;
x := NOT no AND_THEN f;
n := SEL(no, 1, m);
END_PROGRAM"""
    found = scan(make, text, "%MX0.0 %MW1")
    assert found.reads == ["4 %MX0.0", "5 %MX0.0", "6 %MB2", "6 %MB3"]


@engines
def test_blocks_note_what_each_of_them_reads(make: MakeObserved) -> None:
    text = """\
FUNCTION_BLOCK Lamp
VAR_INPUT on : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR VAR own AT %MX0.1 : BOOL; END_VAR
q := on;
IF q THEN
  q := own;
END_IF;
END_FUNCTION_BLOCK
PROGRAM Main VAR f AT %MX0.0 : BOOL; a, b : Lamp; x : BOOL; END_VAR
a(on := FALSE);
b(on := f, q => x);
x := a.q;
END_PROGRAM"""
    found = scan(make, text, "%MX0.0 %MX0.1", ["%MX0.0"])
    assert found.reads == ["10 %MX0.0", "5 %MX0.1"]
    assert found.lines == [3, 4, 5, 9, 10, 11]
    assert scan(make, text, "%MX0.0 %MX0.1").lines == [3, 4, 9, 10, 11]


@engines
def test_in_outs_and_references_read_where_they_are_followed(make: MakeObserved) -> None:
    text = """\
TYPE S : STRUCT n : INT; m : INT; END_STRUCT; END_TYPE
FUNCTION F : INT
VAR_IN_OUT flag : BOOL; s : S; END_VAR
IF flag THEN F := s.m; END_IF;
s.n := 5;
END_FUNCTION
FUNCTION_BLOCK B
VAR_IN_OUT w : INT; END_VAR VAR y : INT; END_VAR
y := w;
END_FUNCTION_BLOCK
PROGRAM Main
VAR f AT %MX0.4 : BOOL := TRUE; s AT %MW1 : S; b : B; x : INT; o : BOOL; own : S; rf : REF_TO BOOL; rs : REF_TO S; END_VAR
x := F(f, s);
x := F(o, own);
b(w := s.m);
rf := REF(f);
rs := REF(s);
o := rf^;
own := rs^;
rs^.n := 1;
x := rs^.n;
END_PROGRAM"""
    found = scan(make, text, "%MB0 %MW1 %MW2")
    assert found.reads == [
        "4 %MX0.4", "4 %MB4", "4 %MB5", "9 %MB4", "9 %MB5", "18 %MX0.4",
        "19 %MB2", "19 %MB3", "19 %MB4", "19 %MB5", "21 %MB2", "21 %MB3",
    ]  # fmt: skip


@engines
def test_elements_strings_and_indices(make: MakeObserved) -> None:
    text = """\
PROGRAM Main
VAR l AT %MW0 : ARRAY[0..7] OF WORD; i AT %MB20 : USINT := 3; t AT %MB30 : STRING[4]; x : WORD; k : ARRAY[0..7] OF WORD;
  u : STRING[4]; n : INT; END_VAR
x := l[i];
l[i] := 1;
k := l;
l := k;
u := t;
n := LEN(t);
t := 'abc';
END_PROGRAM"""
    found = scan(make, text, "%MW3 %MW7 %MB20 %MB31 %MB35")
    assert found.reads == [
        "4 %MB20", "4 %MB6", "4 %MB7", "5 %MB20", "6 %MB6", "6 %MB7", "6 %MB14", "6 %MB15",
        "8 %MB31", "8 %MB35", "9 %MB31", "9 %MB35",
    ]  # fmt: skip


@engines
def test_an_open_array_is_read_element_by_element(make: MakeObserved) -> None:
    text = """\
FUNCTION Sum : INT
VAR_IN_OUT l : ARRAY[*] OF INT; END_VAR VAR i : DINT; END_VAR
FOR i := LOWER_BOUND(l, 1) TO UPPER_BOUND(l, 1) - 1 DO
  Sum := Sum + l[i];
END_FOR;
END_FUNCTION
PROGRAM Main VAR a AT %MW2 : ARRAY[1..3] OF INT; x : INT; END_VAR
x := Sum(a);
END_PROGRAM"""
    assert scan(make, text, "%MW2 %MW3 %MW4").reads == ["4 %MB4", "4 %MB5", "4 %MB6", "4 %MB7"]


@engines
def test_a_library_block_reads_for_the_statement_that_calls_it(make: MakeObserved) -> None:
    text = """\
FUNCTION Twice : BOOL
VAR_INPUT a : BOOL; END_VAR VAR_IN_OUT q : R_TRIG; END_VAR
q(CLK := a);
Twice := q.Q;
END_FUNCTION
PROGRAM Main VAR f AT %MX0.0 : BOOL; t : TON; r : R_TRIG; s AT %MB8 : STRING[10]; k : STRING[10]; x : BOOL; END_VAR
t(IN := f, PT := T#1s);
x := Twice(f, r);
k := CONCAT(s, 'x');
END_PROGRAM"""
    found = scan(make, text, "%MX0.0 %MB10")
    assert found.reads == ["7 %MX0.0", "8 %MX0.0", "9 %MB10"]
    assert found.lines == [3, 4, 7, 8, 9]


LIBRARY = """\
FUNCTION Both : BOOL
VAR_INPUT a : BOOL; END_VAR VAR_IN_OUT b : INT; END_VAR
Both := a AND b > 0;
END_FUNCTION
FUNCTION_BLOCK Keep
VAR_INPUT a : BOOL; END_VAR VAR_IN_OUT b : INT; END_VAR VAR x : BOOL; END_VAR
x := Both(a, b);
END_FUNCTION_BLOCK"""
USER = """\
FUNCTION Own : BOOL
VAR_INPUT a : INT; END_VAR VAR n : INT; END_VAR
n := a; Own := Both(TRUE, n);
END_FUNCTION
PROGRAM Main VAR w AT %MW2 : INT; k : Keep; x : BOOL; END_VAR
k(a := Own(1), b := w);
x := Own(2) AND Both(Own(3), w) AND Own(4);
END_PROGRAM"""


@engines
def test_library_code_follows_in_outs_for_its_caller(make: MakeObserved) -> None:
    """Between two statements of the user, another's body has run: the library does not read in its name."""
    found = check_sources({"main.st": USER, "<standard>/more.st": LIBRARY}, MODELS["GENERIC-IEC"])
    assert found.program is not None, found.problems
    engine, observer = make(found.program, bytearray(found.program.initial_image))
    observer.watch(bits(found.program, "%MB4"))
    seen = noted(found.program, engine.run(1), (engine, observer))
    assert seen.reads == ["6 %MB4", "7 %MB4"]
    assert seen.lines == [3, 3, 6, 7]


@engines
def test_an_instruction_does_not_read_its_own_flag(make: MakeObserved) -> None:
    program = check("PROGRAM Main VAR x : BOOL; END_VAR\nFAL(5);\nx := %A402.15;\nEND_PROGRAM", model="CJ1M-CPU63")
    engine, observer = make(program, bytearray(program.initial_image))
    (flag,) = bits(program, "A402.15")
    observer.watch([flag])
    engine.run(2)
    assert observer.take() == Seen(frozenset({0, 1}), (ReadAt(1, *flag),))


@engines
def test_methods_and_what_chooses_them(make: MakeObserved) -> None:
    text = """\
FUNCTION_BLOCK Base
VAR n : INT; END_VAR
METHOD PUBLIC Get : INT
VAR_INPUT a : INT; END_VAR
Get := a + n;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Derived EXTENDS Base
VAR w AT %MW3 : INT; END_VAR
METHOD PUBLIC OVERRIDE Get : INT
VAR_INPUT a : INT; END_VAR
Get := SUPER.Get(a) + w;
END_METHOD
END_FUNCTION_BLOCK
PROGRAM Main VAR b : Base; d : Derived; r : REF_TO Base; x : INT; f AT %MW0 : INT; END_VAR
r := REF(d);
x := r^.Get(f);
x := b.Get(1);
END_PROGRAM"""
    found = scan(make, text, "%MW0 %MW3")
    assert found.reads == ["17 %MB0", "17 %MB1", "12 %MB6", "12 %MB7"]
    assert found.lines == [5, 12, 16, 17, 18]


@engines
def test_instructions_of_il(make: MakeObserved) -> None:
    text = """\
PROGRAM Main VAR f AT %MX0.0 : BOOL; x : BOOL; n AT %MW1 : INT; k : INT; END_VAR
LD f
JMPC over
LD n
ADD 1
ST k
S x
over: LD f
ST x
RETC
LD n
ST k
END_PROGRAM"""
    text = text.replace("S x\n", "LD f\nS x\n")
    found = scan(make, text, "%MX0.0 %MW1", ["%MX0.0"])
    assert found.reads == ["2 %MX0.0", "9 %MX0.0"]
    assert found.lines == [2, 3, 9, 10, 11]
    found = scan(make, text, "%MX0.0 %MW1")
    assert found.reads == [
        "2 %MX0.0", "4 %MB2", "4 %MB3", "7 %MX0.0", "9 %MX0.0", "12 %MB2", "12 %MB3",
    ]  # fmt: skip
    assert found.lines == list(range(2, 14))


@engines
def test_loops_that_are_left(make: MakeObserved) -> None:
    text = """\
VAR_GLOBAL m AT %MW1 : INT; END_VAR FUNCTION F : INT
VAR i : INT; END_VAR VAR_EXTERNAL m : INT; END_VAR
FOR i := 1 TO 5 DO
  IF i = 2 THEN CONTINUE; END_IF;
  IF i = 3 THEN EXIT; END_IF;
  F := F + 1;
END_FOR;
IF F = 1 THEN
  RETURN;
END_IF;
F := m;
END_FUNCTION
PROGRAM Main VAR x : INT; END_VAR
x := F();
END_PROGRAM"""
    found = scan(make, text, "%MW1")
    assert found.reads == []
    assert found.lines == [3, 4, 4, 5, 5, 6, 8, 9, 14]


@engines
def test_a_trap_keeps_what_was_read_before_it(make: MakeObserved) -> None:
    text = """\
PROGRAM Main VAR a AT %MW0 : INT; b AT %MW1 : INT; c AT %MW2 : INT; l : ARRAY[0..1] OF INT; x : INT; END_VAR
x := 1;
l[a + 5] := b / a + c;
x := c;
END_PROGRAM"""
    found = scan(make, text, "%MB0 %MB2 %MB4")
    assert found.stop.reason is Reason.TRAP
    assert found.reads == ["3 %MB2", "3 %MB0"]
    assert found.lines == [2, 3]


@engines
def test_a_program_goes_on_after_a_trap(make: MakeObserved) -> None:
    program = check("PROGRAM Main VAR w AT %MW0 : INT; t : TON; x : INT; END_VAR\nx := 1 / w;\nx := w;\nEND_PROGRAM")
    memory = bytearray(program.initial_image)
    engine, observer = make(program, memory)
    observer.watch(bits(program, "%MB0"))
    assert noted(program, engine.run(1), (engine, observer)).lines == [2]
    memory[bits(program, "%MB0")[0][0]] = 1
    found = noted(program, engine.run(1), (engine, observer))
    assert (found.lines, found.reads) == ([2, 3], ["2 %MB0", "3 %MB0"])


@engines
def test_statements_that_the_compiler_takes_apart_are_one(make: MakeObserved) -> None:
    text = """\
FUNCTION F : INT
VAR_INPUT a : INT; EN : BOOL; END_VAR VAR_OUTPUT o : BOOL; END_VAR
F := a; o := a > 0;
END_FUNCTION
FUNCTION_BLOCK B
VAR_INPUT c : BOOL R_EDGE; END_VAR VAR q : BOOL; n : INT := 4; END_VAR VAR_TEMP t : ARRAY[1..3] OF INT; END_VAR
q := c;
END_FUNCTION_BLOCK
PROGRAM Main VAR f AT %MX0.0 : BOOL; x : INT; y, ok : BOOL; b : B; END_VAR
F(EN := f, a := 1, ENO => ok, o => y);
y S= f;
y R= f;
b(EN := NOT f, c := f, ENO => ok);
END_PROGRAM"""
    found = scan(make, text, "%MX0.0")
    assert found.reads == ["10 %MX0.0", "11 %MX0.0", "12 %MX0.0", "13 %MX0.0"]
    assert found.lines == [7, 10, 11, 12, 13]


# ---- what is not the user's program -----------------------------------------------------------------------------

PLANT = """\
PROGRAM Plant VAR n : INT; END_VAR
n := Level(1);
END_PROGRAM"""
SHARED = """\
VAR_GLOBAL w AT %MW4 : INT; END_VAR FUNCTION Level : INT
VAR_INPUT a : INT; END_VAR VAR_EXTERNAL w : INT; END_VAR
Level := a + w;
END_FUNCTION
PROGRAM Main VAR x : INT; go AT %MX0.0 : BOOL; END_VAR
IF go THEN x := Level(2); END_IF;
END_PROGRAM"""


@engines
def test_the_plant_is_not_observed(make: MakeObserved) -> None:
    found = check_sources({"main.st": SHARED, "plant/p.st": PLANT}, MODELS["GENERIC-IEC"])
    program = found.program
    assert program is not None, found.problems
    memory = bytearray(program.initial_image)
    engine, observer = make(program, memory)
    assert {site.span.file for site in observer.sites.statements} == {"main.st"}
    observer.watch(bits(program, "%MW4", "%MX0.0"))
    seen = noted(program, engine.run(1), (engine, observer))
    assert (seen.lines, seen.reads) == ([6], ["6 %MX0.0"])
    memory[bits(program, "%MX0.0")[0][0]] = 1
    seen = noted(program, engine.run(1), (engine, observer))
    assert (seen.lines, seen.reads) == ([3, 6, 6], ["6 %MX0.0", "3 %MB8", "3 %MB9"])


@engines
def test_connections_of_a_configuration_read_too(make: MakeObserved) -> None:
    text = """\
PROGRAM Control VAR_INPUT on : BOOL; END_VAR VAR x : BOOL; END_VAR
x := on;
END_PROGRAM
CONFIGURATION c
TASK t (SINGLE := %MX2.0, INTERVAL := T#10ms, PRIORITY := 1);
PROGRAM one WITH t : Control (on := %MX0.0);
END_CONFIGURATION"""
    found = scan(make, text, "%MX0.0 %MX2.0")
    assert found.reads == ["6 %MX0.0"]  # to look whether a task is due is nobody's
    assert found.lines == [2, 6]


@engines
@pytest.mark.parametrize("model", sorted(MODELS))
def test_system_programs_are_not_observed(make: MakeObserved, model: str) -> None:
    program = check("PROGRAM Main VAR x : INT; END_VAR\nx := x + 1;\nEND_PROGRAM", model=model)
    engine, observer = make(program, bytearray(program.initial_image))
    observer.watch((at, 0xFF) for at in range(Layout.HEADER_SIZE, areas_end(program.layout)))
    assert engine.run(3).reason is Reason.DONE
    assert observer.take() == Seen(frozenset({0}), ())


# ---- watching and taking ----------------------------------------------------------------------------------------

COPY = "PROGRAM Main VAR a AT %MW0 : WORD; b AT %MW1 : WORD; x : WORD; END_VAR\nx := a;\nx := b;\nEND_PROGRAM"


@engines
def test_a_new_watch_replaces_the_first(make: MakeObserved) -> None:
    program = check(COPY)
    engine, observer = make(program, bytearray(program.initial_image))
    engine.run(1)
    assert observer.take() == Seen(frozenset({0, 1}), ())
    start = bits(program, "%MW0")[0][0]
    observer.watch([(start, 1), (start, 2), (start + 1, 0)])
    engine.run(2)
    assert observer.take().reads == (ReadAt(0, start, 3),)
    assert observer.take() == Seen(frozenset(), ())
    observer.watch([(start + 2, 0x80)])
    engine.run(1)
    assert observer.take().reads == (ReadAt(1, start + 2, 0x80),)
    observer.watch([])
    engine.run(1)
    assert observer.take().reads == ()


@engines
def test_only_memory_of_the_model_can_be_watched(make: MakeObserved) -> None:
    program = check(COPY)
    _, observer = make(program, bytearray(program.initial_image))
    for offset, mask in ((Layout.SCAN, 1), (areas_end(program.layout), 1), (-1, 1), (Layout.HEADER_SIZE, 256)):
        with pytest.raises(ValueError, match="no area of the model"):
            observer.watch([(offset, mask)])


@engines
def test_a_read_is_noted_once_with_all_its_bits(make: MakeObserved) -> None:
    text = """\
PROGRAM Main VAR a AT %MX0.0 : BOOL; b AT %MX0.5 : BOOL; x : BOOL; i : INT; END_VAR
FOR i := 1 TO 100 DO x := a OR x OR b; END_FOR;
END_PROGRAM"""
    assert scan(make, text, "%MB0").reads == ["2 %MX0.0", "2 %MX0.5"]


@engines
def test_more_reads_than_there_is_room_for_are_counted(make: MakeObserved) -> None:
    count = 3000
    lines = "\n".join(f"l{number} := m;" for number in range(4))
    text = (
        f"PROGRAM Main VAR m AT %MB0 : ARRAY[1..{count}] OF BYTE; l0, l1, l2, l3 : ARRAY[1..{count}] OF BYTE; END_VAR\n"
        f"{lines}\nEND_PROGRAM"
    )
    program = check(text)
    engine, observer = make(program, bytearray(program.initial_image))
    start = program.layout.areas["M"]
    observer.watch((start + number, 0xFF) for number in range(count))
    engine.run(1)
    seen = observer.take()
    assert len(seen.reads) == LIMIT
    assert seen.lost == 4 * count - LIMIT
    assert seen.reads[count] == ReadAt(1, start, 0xFF)
    engine.run(1)
    assert observer.take() == seen


# ---- the flavours -----------------------------------------------------------------------------------------------


def test_code_that_is_not_observed_is_what_it_was() -> None:
    program = check(COPY)
    assert "@observed" not in emit_program(program)
    assert "@observed" in emit_program(program, Observing(program))
    plain = {part.key(0) for part in Compiler().build(program, 0).parts}
    assert jit.object_key(emit_program(program, Observing(program)), 0) not in plain


def test_observed_code_is_kept(tmp_path: Path) -> None:
    cache, program = BlobCache(tmp_path), check(COPY)
    made = ObservedBuilds(cache).objects(program)
    kept = [path.read_bytes() for path in tmp_path.glob("*.kept")]
    assert len(kept) == 1
    assert kept[0].endswith(made[0])
    assert ObservedBuilds(cache).objects(check(COPY)) == made


# ---- both engines on everything -----------------------------------------------------------------------------------


def optimised(program: Program, memory: bytearray) -> Observed:
    """The code as it is at O2, where the compiler moves what it may."""
    code = jit.compile_object(emit_program(program, Observing(program)), 2, jit.Timings())
    return linked_engine(program, memory, [code])


def agree(program: Program, others: Sequence[MakeObserved]) -> int:
    """Runs a program on all; gives the number of reads."""
    makers = [observed_engine, *others]
    images = [limited(program) for _ in range(len(makers) + 1)]
    running = [make(program, image) for make, image in zip(makers, images, strict=False)]
    plain = ReferenceEngine(program, images[-1])
    for _, observer in running:
        observer.watch((at, 0xFF) for at in range(Layout.HEADER_SIZE, areas_end(program.layout)))
    reads = 0
    for number in range(SCANS):
        stops = [engine.run(1) for engine, _ in running]
        assert {plain.run(1)} == set(stops), f"scan {number}"
        for image in images[:-1]:
            assert not first_difference(program, image, images[-1]), f"scan {number}"
        seen = [observer.take() for _, observer in running]
        assert all(each == seen[0] for each in seen), f"scan {number}: {seen}"
        assert seen[0].reached
        reads += len(seen[0].reads)
        if stops[0].reason is Reason.TRAP:
            break
    return reads


@nightly
def test_engines_agree_on_random_programs() -> None:
    ingredients = (areas, calls, frames, library, instruction_lists, objects, references, open_arrays)
    compared = reads = 0
    for seed in range(PROGRAMS):
        source = generate(seed, ingredients)
        program = checked(source)
        if program is None:
            continue
        compared += 1
        try:
            reads += agree(program, [native_engine] if seed % OPTIMISED_EACH else [native_engine, optimised])
        except Exception as error:
            error.add_note(f"seed {seed}:\n{source}")
            raise
    assert compared > PROGRAMS * 0.9
    assert reads > 5 * PROGRAMS


@nightly
@pytest.mark.parametrize("topic", some(sorted(path.stem for path in CASES.glob("*.case")), 9, 1))
def test_engines_agree_on_all_cases(topic: str) -> None:
    for case in read_cases(CASES / f"{topic}.case"):
        seen: dict[str, list[Seen]] = {}

        def watching(make: MakeObserved, notes: list[Seen]) -> Callable[[Program, bytearray], Engine]:
            def made(program: Program, memory: bytearray) -> Engine:
                engine, observer = make(program, memory)
                observer.watch((at, 0xFF) for at in range(Layout.HEADER_SIZE, areas_end(program.layout)))
                run = engine.run

                def run_and_take(scans: int) -> Stop:
                    stop = run(scans)
                    notes.append(observer.take())
                    return stop

                engine.run = run_and_take  # type: ignore[method-assign,assignment]
                return engine

            return made

        makers = {"reference": observed_engine, "native": native_engine}
        run_case(case, [watching(make, seen.setdefault(name, [])) for name, make in makers.items()])
        assert seen["reference"] == seen["native"], case.name
