"""Probes: what they note and where they halt is what the debug flavour says; the rest is as without them."""

import random
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from scanbench.check.build import check_sources
from scanbench.check.typed.local import Local, Locals
from scanbench.engines.cache import BlobCache
from scanbench.engines.debug import DebugEngine, Listen
from scanbench.engines.engine import Reason, Stop
from scanbench.engines.interpreter.debugged import debug_engine
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.interpreter.evaluate import Evaluator
from scanbench.engines.native import jit
from scanbench.engines.native.compiler import Compiler
from scanbench.engines.native.emit_probe import Probing
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.native.parts import Part, Parts
from scanbench.engines.native.probed import ProbedBuilds
from scanbench.engines.probe import BadProbe, Probe, ProbedEngine
from scanbench.program.layout import Layout
from scanbench.program.program import Pou, Program
from scanbench.program.types import Elementary, Kind
from scanbench.symbols.sites import Sites, sites_of
from tests.amounts import amount, nightly
from tests.caseformat import MODELS, first_difference
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

PROGRAMS = amount(120, 12)
SCANS = 3
PROBES = 6

LINES = """\
FUNCTION Twice : INT
VAR_INPUT a : INT; END_VAR VAR k : INT; END_VAR
k := a;
Twice := k * 2;
END_FUNCTION
FUNCTION_BLOCK Counter
VAR_INPUT by : INT; END_VAR VAR n : INT; END_VAR VAR_IN_OUT sum : INT; END_VAR
n := n + by;
IF n > 5 THEN
  sum := sum + 1;
END_IF;
END_FUNCTION_BLOCK
PROGRAM Main VAR a, b : Counter; s, t, x, i : INT; list : ARRAY[0..3] OF INT; END_VAR
a(by := 1, sum := s);
b(by := 2, sum := t);
FOR i := 1 TO 3 DO
  x := Twice(i);
END_FOR;
END_PROGRAM"""


def probe(program: Program, line: int, condition: str = "", halt: bool = True) -> Probe:
    """At the first statement of a line of main.st."""
    sites = sites_of(program)
    site = sites.at_line("main.st", line)[0]
    if not condition:
        return Probe(site, None, halt)
    return Probe(site, local(program, pou_of(sites, site), condition).expr, halt)


def pou_of(sites: Sites, site: int) -> Pou | None:
    return next((pou for pou, inside in sites.bodies.items() if site in inside), None)


def local(program: Program, pou: Pou | None, text: str) -> Local:
    found = Locals(program).condition(pou, text)
    assert isinstance(found, Local), found
    return found


def engine(program: Program, *probes: Probe, memory: bytearray | None = None) -> ProbedEngine:
    return ProbedBuilds().engine(program, memory or bytearray(program.initial_image), probes)


# ---- what is noted ------------------------------------------------------------------------------------------------


def test_the_last_scan_is_noted() -> None:
    program = check(LINES)
    memory = bytearray(program.initial_image)
    probed = engine(
        program,
        probe(program, 10, halt=False),
        probe(program, 10, "sum = 3", halt=False),
        probe(program, 14, "Main.a.n < 3", halt=False),
        probe(program, 3, "a = 2 AND k = 0", halt=False),
        probe(program, 3, "a = 4", halt=False),
        probe(program, 17, "list[i] = 0", halt=False),
        probe(program, 17, "list[i + 1] = 0", halt=False),
        probe(program, 17, "list[i + 3] = 0", halt=False),
        memory=memory,
    )
    assert set(probed.reached) == {None}
    assert probed.run(10) == Stop(Reason.DONE)
    # from the 5th scan on the index of the last two is outside in some or all rounds: a trap is FALSE
    assert probed.reached == (9, 8, 2, 9, None, 9, 9, None)
    assert probed.halted is None
    plain = bytearray(program.initial_image)
    NativeEngine(program, plain).run(10)
    assert not first_difference(program, memory, plain)
    probed.forget()
    assert set(probed.reached) == {None}
    probed.run(1)
    assert probed.reached.index(10) == 0


def test_it_halts_in_the_scan() -> None:
    program = check(LINES)
    memory = bytearray(program.initial_image)
    probed = engine(program, probe(program, 14, "FALSE"), probe(program, 10, "by = 1"), memory=memory)
    assert probed.run(100) == Stop(Reason.HALTED)
    assert (probed.halted, probed.reached, memory[Layout.SCAN]) == (1, (None, 5), 5)
    assert probed.run(0) == Stop(Reason.DONE)
    assert probed.halted is None


def test_a_probe_in_every_scan() -> None:
    program = check(LINES)
    probed = engine(program, probe(program, 16))
    assert probed.run(5).reason is Reason.HALTED
    assert (probed.halted, probed.reached) == (0, (0,))


def test_several_probes_at_one_statement() -> None:
    program = check(LINES)
    probed = engine(program, probe(program, 16, halt=False), probe(program, 16, "x > 0"), probe(program, 16))
    assert probed.run(5).reason is Reason.HALTED
    assert (probed.halted, probed.reached) == (2, (0, None, 0))


def test_what_traps_after_a_probe_has_halted() -> None:
    program = check("PROGRAM Main VAR x, y : INT := 2; END_VAR\ny := y - 1;\nx := 10 / y;\nEND_PROGRAM")
    probed = engine(program, probe(program, 2, "y = 1"))
    assert probed.run(10) == Stop(Reason.HALTED)
    assert (probed.halted, probed.reached) == (0, (1,))


def test_traps_are_still_told() -> None:
    text = "PROGRAM Main VAR x, y : INT := 2; END_VAR\nx := 10 / y;\ny := y - 1;\nEND_PROGRAM"
    program = check(text)
    probed = engine(program, probe(program, 3, "x = 77"))
    stop = probed.run(10)
    assert (stop.reason, program.traps[stop.trap - 1].span.line, probed.halted) == (Reason.TRAP, 2, None)


def test_the_plant_is_passed_over() -> None:
    shared = """\
FUNCTION Level : INT
VAR_INPUT a : INT; END_VAR
Level := a + 1;
END_FUNCTION
PROGRAM Main VAR x : INT; go : BOOL; END_VAR
IF go THEN x := Level(2); END_IF;
END_PROGRAM"""
    plant = "PROGRAM Plant VAR n : INT; END_VAR\nn := Level(1);\nMain.go := n > 5;\nEND_PROGRAM"
    plant = plant.replace("\nMain.go := n > 5;", "")
    found = check_sources({"main.st": shared, "plant/p.st": plant}, MODELS["GENERIC-IEC"])
    program = found.program
    assert program is not None, found.problems
    memory = bytearray(program.initial_image)
    probed = engine(program, probe(program, 3), memory=memory)
    assert probed.run(3) == Stop(Reason.DONE)
    task = program.tasks[0].programs[0]
    memory[task.offset + task.pou.instance.members["GO"].offset] = 1
    assert probed.run(3) == Stop(Reason.HALTED)
    assert probed.reached == (3,)


def test_connections_of_a_configuration() -> None:
    text = """\
PROGRAM Control VAR_INPUT on : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR
q := on;
END_PROGRAM
CONFIGURATION c
TASK t (INTERVAL := T#10ms, PRIORITY := 1);
PROGRAM one WITH t : Control (on := %MX0.0, q => %MX0.1);
END_CONFIGURATION"""
    program = check(text)
    first, last = sites_of(program).at_line("main.st", 6)
    memory = bytearray(program.initial_image)
    condition = local(program, None, "%MX0.0").expr
    probed = engine(program, Probe(first, None, False), Probe(last, condition), memory=memory)
    probed.run(2)
    memory[program.layout.areas["M"]] = 1
    assert probed.run(2) == Stop(Reason.HALTED)
    assert (probed.halted, probed.reached) == (1, (2, 2))


def test_probes_that_cannot_be() -> None:
    program = check(LINES)
    with pytest.raises(BadProbe, match="statement 99: the program has 9 of them"):
        engine(program, Probe(99))
    with pytest.raises(BadProbe, match=r"main.st:8.*calls the program"):
        engine(program, probe(program, 8, "Twice(n) = 4"))


# ---- what is compiled -----------------------------------------------------------------------------------------------


def many(statements: int = 40) -> str:
    """Blocks that are too large to become part of others, and too many for one module; and a function that is small."""
    lines = "\n".join(f"n := n + {number};" for number in range(statements))
    blocks = "\n".join(
        f"FUNCTION_BLOCK B{number}\nVAR n : DINT; END_VAR\n{lines}\nEND_FUNCTION_BLOCK" for number in range(5)
    )
    return f"""\
FUNCTION Small : DINT
VAR_INPUT a : DINT; END_VAR
Small := a + 1;
END_FUNCTION
{blocks}
PROGRAM Main VAR b0 : B0; b1 : B1; b2 : B2; b3 : B3; b4 : B4; x : DINT; END_VAR
b0(); b1(); b2(); b3(); b4();
x := Small(x);
END_PROGRAM"""


def test_only_the_modules_with_probes_are_compiled(tmp_path: Path) -> None:
    program, cache = check(many()), BlobCache(tmp_path)
    Compiler(cache).build(program)
    compiled: list[str] = []

    def optimise(parts: Sequence[Part]) -> Iterator[tuple[Part, bytes]]:
        for part in parts:
            compiled.append(part.text)
            yield part, jit.compile_object(part.text, 2, jit.Timings())

    builds = ProbedBuilds(cache, optimise)  # type: ignore[arg-type]
    line = many().splitlines().index("FUNCTION_BLOCK B2") + 5
    memory = bytearray(program.initial_image)
    probed = builds.engine(program, memory, [probe(program, line, "n > 100000")])
    assert len(compiled) == 3  # the block, the numbers, and the scan, which looks at them in the end
    assert probed.run(1000) == Stop(Reason.HALTED)
    compiled.clear()
    builds.engine(program, memory, [probe(program, line, "n > 100000")])
    assert not compiled
    builds.engine(program, memory, [probe(program, 3, "a = 5")])
    assert len(compiled) == 2  # the function alone, and the scan with the program that the function became part of
    assert all('@"p.Small"' in text for text in compiled)
    probed = builds.engine(program, bytearray(program.initial_image), [probe(program, 3, "a = 5")])
    assert probed.run(1000) == Stop(Reason.HALTED)
    assert probed.reached == (5,)


def test_what_ends_early_gives_nothing() -> None:
    program = check(LINES)
    assert ProbedBuilds(None, lambda parts: iter(())).objects(program, [probe(program, 8)]) is None


def test_code_without_probes_is_what_it_was() -> None:
    program = check(LINES)
    plain = [part.text for part in Parts().of(program)]
    assert not any("@probes" in text for text in plain)
    parts = Parts()
    parts.of(program, Probing(program, [probe(program, 8)]))
    assert [part.text for part in parts.of(program)] == plain


# ---- both engines on everything -------------------------------------------------------------------------------------


class Looking:
    """What the debug flavour of the reference engine says of probes."""

    def __init__(self, engine: DebugEngine, program: Program, probes: Sequence[tuple[Probe, Local | None]]) -> None:
        self._engine, self._program = engine, program
        evaluator = Evaluator(program, engine.memory)  # type: ignore[attr-defined]
        self._probes = [(each, None if local is None else evaluator.condition(local)) for each, local in probes]
        self.reached: list[int | None] = [None] * len(probes)
        engine.hook(self)
        engine.listen(Listen(sites=frozenset(each.site for each, _ in probes)))
        self.scan = 0

    def statement(self, site: int, count: int, depth: int) -> bool:
        for number, (each, holds) in enumerate(self._probes):
            if each.site == site and (holds is None or holds(self._engine.frames()[0].instance)):
                self.reached[number] = self.scan
        return False

    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        raise AssertionError


def chosen(program: Program, source: random.Random, halting: bool) -> list[tuple[Probe, Local | None]]:
    """Some statements; half of them with a condition on a variable there."""
    sites, locals_ = sites_of(program), Locals(program)
    found: list[tuple[Probe, Local | None]] = []
    for site in source.sample(range(len(sites.statements)), min(PROBES, len(sites.statements))):
        pou = pou_of(sites, site)
        condition = None
        if source.random() < 0.6:
            condition = condition_of(locals_, pou, source)
        halt = halting and source.random() < 0.5
        found.append((Probe(site, None if condition is None else condition.expr, halt), condition))
    return found


def condition_of(locals_: Locals, pou: Pou | None, source: random.Random) -> Local | None:
    members = [] if pou is None else [*pou.frame.members.values(), *pou.instance.members.values()]
    texts = []
    for member in members:
        if not isinstance(member.type, Elementary) or member.hidden:
            continue
        if member.type.kind is Kind.BOOL:
            texts.append(member.name)
        elif member.type.kind is Kind.INT:
            texts += [f"{member.name} > 0", f"{member.name}.%X1", f"100 / {member.name} > 3"]
    if not texts:
        return None
    found = locals_.condition(pou, source.choice(texts))
    return found if isinstance(found, Local) and not found.calls else None


@nightly
@pytest.mark.parametrize("halting", [False, True], ids=["noting", "halting"])
def test_engines_agree_on_random_programs(halting: bool) -> None:
    reached = conditions = 0
    for seed in range(PROGRAMS):
        text = generate(seed, (areas, calls, frames, library, instruction_lists, objects, references, open_arrays))
        program = checked(text)
        if program is None:
            continue
        probes = chosen(program, random.Random(seed), halting)
        conditions += sum(local is not None for _, local in probes)
        try:
            reached += agree(program, probes)
        except Exception as error:
            error.add_note(f"seed {seed}:\n{[each.site for each, _ in probes]}\n{text}")
            raise
    assert reached > PROGRAMS
    assert conditions > PROGRAMS


def agree(program: Program, probes: Sequence[tuple[Probe, Local | None]]) -> int:
    images = [limited(program) for _ in range(3)]
    reference = debug_engine(program, images[0])
    looking = Looking(reference, program, probes)
    probed = engine(program, *(each for each, _ in probes), memory=images[1])
    plain = ReferenceEngine(program, images[2])
    for scan in range(SCANS):
        looking.scan = scan
        stop = reference.run(1)
        halted = [number for number, (each, _) in enumerate(probes) if each.halt and looking.reached[number] == scan]
        stops = Stop(Reason.HALTED) if halted else stop
        assert (probed.run(1), probed.halted) == (stops, halted[0] if halted else None), f"scan {scan}"
        assert probed.reached == tuple(looking.reached)
        if halted:
            break
        plain.run(1)
        for image in images[:2]:
            assert not first_difference(program, image, images[2])
        if stop.reason is Reason.TRAP:
            break
    return sum(each is not None for each in probed.reached)
