"""Writes and forces of in-outs go to what the block's last execution was given, by reference and by value alike."""

from dataclasses import replace
from functools import cache

import pytest

from scanbench.check.build import check_sources
from scanbench.debug.binding import Bindings
from scanbench.debug.bound_to import Bound
from scanbench.program.program import Program
from scanbench.runtime.command import Command, Entry, Refusal
from scanbench.runtime.forces import FORCED, Force, Release, forced_values
from scanbench.runtime.modes import SetMode
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.write import Write
from scanbench.symbols.symbols import UnknownPath
from tests.runtime.bench import ENGINES, change, model, value

SOURCE = """
VAR_GLOBAL error AT %A402 : WORD; located AT D120 : INT; END_VAR
VAR_GLOBAL CONSTANT LIMIT : INT := 5; END_VAR
TYPE Tank : STRUCT level : INT; open : BOOL; name : STRING[6]; END_STRUCT; Small : INT(-6..12); END_TYPE
FUNCTION_BLOCK Valve
VAR_IN_OUT level : INT; END_VAR
VAR n : INT; END_VAR
n := n + 1;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Pump
VAR_IN_OUT l : INT; END_VAR
VAR valve : Valve; END_VAR
valve(level := l);
END_FUNCTION_BLOCK
FUNCTION_BLOCK Line
VAR_IN_OUT t : Tank; END_VAR
VAR pump : ARRAY[1..2] OF Pump; END_VAR
pump[1](l := t.level); pump[2](l := t.level);
END_FUNCTION_BLOCK
FUNCTION_BLOCK Odd
VAR_IN_OUT s : Small; b : BOOL; text : STRING[6]; END_VAR
b := b;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Look
VAR_IN_OUT CONSTANT x : INT; END_VAR
END_FUNCTION_BLOCK
PROGRAM Main
VAR tank : ARRAY[1..3] OF Tank; i : INT; go : BOOL; a, b : INT; word : WORD; small : Small;
  line : Line; both, never, moving, here : Valve; odd : Odd; on_limit, on_sum, on_plain : Look; {extra}
END_VAR
VAR_TEMP t : INT; END_VAR
i := i MOD 3 + 1;
line(t := tank[2]);
both(level := a);
both(level := b);
IF go THEN never(level := a); END_IF;
moving(level := tank[i].level);
here(level := located);
odd(s := small, b := word.%X9, text := tank[1].name);
on_limit(x := LIMIT); on_sum(x := a + 1); on_plain(x := a);
i := i;
END_PROGRAM
"""
LINE = {text.strip(): number for number, text in enumerate(SOURCE.splitlines(), 1)}
FIRST_CALL = f"main.st:{LINE['both(level := a);']}"
CONVENTIONS = ("reference", "value")


@cache
def program(convention: str, extra: str = "") -> Program:
    made = replace(model(), in_out=convention)  # type: ignore[arg-type]
    checked = check_sources({"main.st": SOURCE.replace("{extra}", extra)}, made)
    assert checked.program is not None, checked.problems
    return checked.program


@pytest.fixture(params=[(engine, convention) for engine in ENGINES for convention in CONVENTIONS], ids=str)
def plc(request: pytest.FixtureRequest) -> Resource:
    engine, convention = request.param
    return Resource(Loaded.make(program(convention), engine))


def done(resource: Resource, command: Command) -> Entry:
    outcome = resource.submit(command)
    assert isinstance(outcome, Entry), outcome
    return outcome


def refused(resource: Resource, command: Command) -> str:
    before, entries = bytes(resource.memory), len(resource.journal)
    outcome = resource.submit(command)
    assert isinstance(outcome, Refusal), outcome
    assert (bytes(resource.memory), len(resource.journal)) == (before, entries)
    return f"{outcome.message} {' '.join(outcome.near)}"


def bound(resource: Resource, path: str) -> Bound:
    return Bindings(resource.program).of(resource.view, path)


@pytest.mark.parametrize(
    ("path", "text", "variable", "shown"),
    [
        ("Main.both.level", "7", "Main.b", "Main.both.level -> Main.b := 7"),
        ("Main.line.pump[2].valve.level", "8", "Main.tank[2].level", "-> Main.tank[2].level := 8"),
        ("Main.line.t.level", "9", "Main.tank[2].level", "Main.line.t.level -> Main.tank[2].level := 9"),
        ("main.LINE.t.open", "TRUE", "Main.tank[2].open", "Main.line.t.open -> Main.tank[2].open := TRUE"),
        ("Main.moving.level", "5", "Main.tank[2].level", "Main.moving.level -> Main.tank[2].level := 5"),
        ("Main.here.level", "-3", "located", "Main.here.level -> located (D120) := -3"),
        ("Main.odd.b", "TRUE", "Main.word.9", "Main.odd.b -> Main.word.9 := TRUE"),
        ("Main.odd.text", "'abc'", "Main.tank[1].name", "Main.odd.text -> Main.tank[1].name := 'abc'"),
        ("Main.odd.s", "-6", "Main.small", "Main.odd.s -> Main.small := -6"),
        ("Main.on_plain.x", "4", "Main.a", "Main.on_plain.x -> Main.a := 4"),
    ],
)
def test_a_write_goes_to_the_variable_and_says_so(
    plc: Resource, path: str, text: str, variable: str, shown: str
) -> None:
    plc.run(2)
    entry = done(plc, Write("Ada", path, text))
    assert entry.plan.message.endswith(shown)
    for _ in range(2):
        assert str(value(plc, variable)).upper() == text.strip("'").upper()
        assert value(plc, path) == value(plc, variable)
        plc.run(3)


def test_the_journal_names_the_variable(plc: Resource) -> None:
    plc.run(1)
    command = done(plc, Write("Ada", "main.both.LEVEL", "7")).command
    assert command == Write("Ada", "Main.b", "7", "Main.both.level")


def test_the_last_execution_counts_also_when_it_is_long_ago(plc: Resource) -> None:
    assert "Main.never.level: not called yet" in refused(plc, Write("Ada", "Main.never.level", "1"))
    plc.run(5)
    assert "not called yet" in refused(plc, Force("Ada", "Main.never.level", "1"))
    assert not bound(plc, "Main.never.level").ok
    done(plc, Write("Ada", "Main.go", "TRUE"))
    plc.run(1)
    done(plc, Write("Ada", "Main.go", "FALSE"))
    plc.run(10)
    done(plc, Write("Ada", "Main.never.level", "44"))
    assert value(plc, "Main.a") == 44


def test_a_different_call_can_be_picked(plc: Resource) -> None:
    plc.run(1)
    entry = done(plc, Write("Ada", "Main.both.level", "7", site=FIRST_CALL))
    assert (value(plc, "Main.a"), value(plc, "Main.b")) == (7, 0)
    assert entry.plan.message == "Main.both.level -> Main.a := 7"
    done(plc, Force("Ada", "Main.both.level", "8", site=FIRST_CALL))
    assert [*plc.view.derived(FORCED)] == ["MAIN.A"]
    said = refused(plc, Write("Ada", "Main.both.level", "7", site="main.st:1"))
    assert "main.st:1 is no call" in said
    assert FIRST_CALL in said
    assert "is no in-out" in refused(plc, Write("Ada", "Main.a", "7", site=FIRST_CALL))


@pytest.mark.parametrize(
    ("path", "text", "words"),
    [
        ("Main.both.level", "40000", ["Main.b", "INT", "-32768 to 32767"]),
        ("Main.both.level", "TRUE", ["Main.b", "INT"]),
        ("Main.odd.s", "13", ["Main.small", "-6 to 12"]),
        ("Main.odd.text", "'much too long'", ["Main.tank[1].name", "STRING[6]"]),
        ("Main.on_limit.x", "1", ["LIMIT", "constant"]),
        ("Main.on_sum.x", "1", ["computed", "gone"]),
        ("Main.line.t", "1", ["Tank", "members"]),
        ("Main.line.t.levl", "1", ["Main.line.t.level"]),
        ("Main.lin.t.level", "1", ["Main"]),
    ],
)
def test_refusals(plc: Resource, path: str, text: str, words: list[str]) -> None:
    plc.run(1)
    for command in (Write("Ada", path, text), Force("Ada", path, text)):
        said = refused(plc, command)
        if not ("STRING" in said and isinstance(command, Force)):
            assert all(word in said for word in words), said


def test_two_users_in_one_scan(plc: Resource) -> None:
    plc.run(1)
    done(plc, Write("Ada", "Main.both.level", "1"))
    done(plc, Write("Bob", "Main.b", "2"))
    plc.run(1)
    assert value(plc, "Main.both.level") == 2
    assert [(each.scan, each.command.author, each.command.path) for each in plc.journal if isinstance(each.command, Write)] == [
        (1, "Ada", "Main.b"), (1, "Bob", "Main.b"),
    ]  # fmt: skip


def test_a_stopped_plc_takes_it_at_once(plc: Resource) -> None:
    plc.run(1)
    done(plc, SetMode("Ada", "PROGRAM"))
    done(plc, Write("Ada", "Main.both.level", "3"))
    assert value(plc, "Main.b") == 3


def test_an_online_change_cuts_the_connection_until_the_next_call(plc: Resource) -> None:
    plc.run(1)
    done(plc, Write("Ada", "Main.both.level", "5"))
    convention = "value" if plc.program.layout.copies.all else "reference"
    change(plc, program(convention, "more : ARRAY[0..99] OF LINT;"), type(plc.engine))
    assert "not called yet" in refused(plc, Write("Ada", "Main.both.level", "6"))
    assert value(plc, "Main.b") == 5
    plc.run(1)
    done(plc, Write("Ada", "Main.both.level", "6"))
    assert value(plc, "Main.b") == 6


def test_a_force_holds_the_variable_while_the_binding_moves_on(plc: Resource) -> None:
    plc.run(1)
    assert value(plc, "Main.i") == 1
    done(plc, Force("Ada", "Main.moving.level", "50"))
    plc.run(1)
    assert (value(plc, "Main.tank[1].level"), value(plc, "Main.moving.level")) == (50, 0)
    forced = forced_values(plc.view)
    assert [(each.path, each.through, each.author, each.scan) for each in forced] == [
        ("Main.tank[1].level", "Main.moving.level", "Ada", 1)
    ]
    done(plc, Release("Ada", "Main.moving.level"))
    assert forced_values(plc.view) == ()
    assert value(plc, "Main.tank[1].level") == 50
    done(plc, Write("Ada", "Main.tank[1].level", "1"))
    plc.run(4)
    assert value(plc, "Main.tank[1].level") == 1


def test_a_force_moves_with_its_variable(plc: Resource) -> None:
    plc.run(1)
    done(plc, Force("Ada", "Main.both.level", "9"))
    convention = "value" if plc.program.layout.copies.all else "reference"
    change(plc, program(convention, "front : ARRAY[0..9] OF LINT;"), type(plc.engine))
    plc.run(2)
    assert value(plc, "Main.b") == 9
    done(plc, Release("Ada", "Main.both.level"))
    assert not plc.view.derived(FORCED)


def test_the_same_bytes_are_not_forced_under_two_names(plc: Resource) -> None:
    plc.run(1)
    done(plc, Force("Ada", "Main.here.level", "1"))
    said = refused(plc, Force("Bob", "D120", "2"))
    assert "as located by Ada" in said
    done(plc, Force("Bob", "Main.here.level", "3"))
    assert value(plc, "D120") == 3
    done(plc, Release("Bob", "located"))
    done(plc, Force("Bob", "D120", "4"))
    done(plc, Force("Bob", "Main.word.9", "TRUE"))
    assert "as Main.word.9" in refused(plc, Force("Bob", "Main.word", "0"))
    done(plc, Force("Bob", "Main.word.8", "TRUE"))


def test_a_release_by_a_different_name(plc: Resource) -> None:
    """Of the very same bits it is one; of others it is told who holds them, and nothing changes."""
    plc.run(1)
    done(plc, Force("Ada", "Main.here.level", "1"))
    assert done(plc, Release("Bob", "D120")).command == Release("Bob", "located")
    assert (forced_values(plc.view), plc.header.force_count) == ((), 0)
    done(plc, Force("Ada", "located", "7"))
    for path in ("located.0", "D120.00", "located.%B1"):
        assert "forced as located by Ada: release that" in refused(plc, Release("Bob", path))
    done(plc, Force("Ada", "Main.word.9", "TRUE"))
    assert "forced as Main.word.9 by Ada" in refused(plc, Release("Bob", "Main.word"))
    assert "not forced" in refused(plc, Release("Bob", "Main.word.8"))
    done(plc, Force("Ada", "Main.tank[1].level", "7"))
    for path in ("Main.tank", "Main.tank[1]", "Main"):
        assert "Main.tank[1].level" in refused(plc, Release("Bob", path))
    assert [each.path for each in forced_values(plc.view)] == ["located", "Main.word.9", "Main.tank[1].level"]
    done(plc, Release("Bob", "D120"))
    done(plc, Force("Bob", "D120", "3"))
    assert done(plc, Release("Ada", "Main.here.level")).command == Release("Ada", "D120")


@pytest.mark.parametrize("convention", CONVENTIONS)
def test_bindings(convention: str) -> None:
    plc = Resource(Loaded.make(program(convention), ENGINES[0]))
    plc.run(3)
    both = bound(plc, "Main.both.level")
    assert both.ok
    assert both.convention == convention
    assert [(each.actual, each.call, each.last, each.scan) for each in both.sites] == [
        ("Main.a", "Main", False, 2), ("Main.b", "Main", True, 2),
    ]  # fmt: skip
    assert next(f"{each.file}:{each.line}" for each in both.sites) == FIRST_CALL
    deep = bound(plc, "Main.line.pump[2].valve.level")
    assert [(each.actual, each.call, each.line) for each in deep.sites] == [
        ("Main.tank[2].level", "Main.line.pump[2]", LINE["valve(level := l);"])
    ]
    here = bound(plc, "Main.here.level").sites[0]
    assert (here.actual, here.address) == ("located", "D120")
    never = bound(plc, "Main.never.level")
    assert (never.ok, never.sites[0].actual, never.sites[0].last) == (False, "Main.a", False)
    assert never.sites[0].scan is None
    assert "constant" in bound(plc, "Main.on_limit.x").sites[0].message
    assert "no in-out" in bound(plc, "Main.a").message
    with pytest.raises(UnknownPath):
        bound(plc, "Main.nix")


TURNS = """
FUNCTION_BLOCK Valve
VAR_IN_OUT level : INT; END_VAR
level := level;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Group
VAR_IN_OUT level : INT; END_VAR
VAR valve : Valve; valves : ARRAY[0..1] OF Valve; i : INT; END_VAR
valve(level := level);
i := 1 - i;
valves[i](level := level);
END_FUNCTION_BLOCK
PROGRAM Main
VAR n, i : INT; fbs : ARRAY[0..2] OF Valve; groups : ARRAY[0..1] OF Group; one : Group; link : REF_TO Valve; two : ARRAY[0..1] OF Valve; END_VAR
i := (i + 1) MOD 3;
fbs[i](level := n);
groups[i MOD 2](level := n);
one(level := n);
link := REF(two[i MOD 2]);
link^(level := n);
END_PROGRAM
"""


@pytest.mark.parametrize("convention", CONVENTIONS)
def test_the_scan_is_told_only_of_calls_that_reach_the_instance_each_time(convention: str) -> None:
    made = replace(model(), in_out=convention)  # type: ignore[arg-type]
    checked = check_sources({"main.st": TURNS}, made)
    assert checked.program is not None, checked.problems
    plc = Resource(Loaded.make(checked.program, ENGINES[0]))
    plc.run(6)
    scans = {
        path: {each.scan for each in bound(plc, path).sites if each.last}
        for path in (
            "Main.fbs[0].level", "Main.fbs[1].level", "Main.groups[1].level", "Main.groups[0].valve.level",
            "Main.one.level", "Main.one.valve.level", "Main.one.valves[0].level", "Main.two[0].level",
        )
    }  # fmt: skip
    known = {path for path, found in scans.items() if found == {5}}
    assert known == {"Main.one.level", "Main.one.valve.level"}
    assert all(found == {None} for path, found in scans.items() if path not in known)
