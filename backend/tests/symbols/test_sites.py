"""Sites: each statement that a person wrote has one, and nothing else has."""

import pickle
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from pathlib import Path

import pytest

from scanbench.check.build import check_sources, program_files
from scanbench.check.incremental import Checks
from scanbench.check.libraries.catalogue import library_of_file
from scanbench.plcmodel.model import Model
from scanbench.problems import Span
from scanbench.program.program import Program
from scanbench.symbols.sites import sites_of
from scanbench.syntax import chart, networks, tree
from scanbench.syntax.chunks import read
from tests.caseformat import MODELS, Case, project_of, read_cases

CASES = Path(__file__).parent.parent / "cases"
STATEMENTS = (
    tree.Assignment, tree.ExpressionStatement, tree.IfStatement, tree.CaseStatement, tree.ForStatement, tree.WhileStatement,
    tree.RepeatStatement, tree.ExitStatement, tree.ContinueStatement, tree.ReturnStatement, tree.JumpStatement,
)  # fmt: skip
MODEL: Model = MODELS["GENERIC-IEC"]
Start = tuple[str, int, int]
"""Where it begins: file, line, column."""


def sources(case: Case) -> dict[str, str]:
    return program_files(project_of(case))


def of_rungs(body: networks.NetworkBody) -> Iterator[Span]:
    """The place that each element is known by; a parallel itself does nothing."""
    for network in body.networks:
        if isinstance(network, networks.Diagram):
            yield from (each.span for each in network.items if not network.off)
            continue
        for each in networks.elements(network.path) if not network.off else ():
            branched = isinstance(each, networks.Box) and any(
                isinstance(one, networks.Branch) for one in each.arguments
            )
            if not isinstance(each, networks.Parallel):
                yield each.after if isinstance(each, networks.Box) and branched else each.span


def of_chart(written: chart.Chart) -> Iterator[Span]:
    """Its steps, the first use of each action, its transitions, and the elements of their rungs."""
    yield from (each.span for each in written.steps)
    yield from (each.span for each in written.transitions)
    yield from (use.first.span for use in chart.uses(written))
    yield from of_rungs(written.conditions)


def written(node: object, used: set[str]) -> Iterator[Span]:
    """Where the statements, instructions and elements of rungs are, of the POUs that are used."""
    if isinstance(node, tuple | list):
        for each in node:
            yield from written(each, used)
    elif is_dataclass(node) and not isinstance(node, type):
        if isinstance(node, tree.PouDeclaration) and node.kind in ("program", "function"):
            first = node.body[0] if isinstance(node.body, tuple) and node.body else None
            if node.name.upper() not in used or (first is not None and first.span == node.span):
                return  # the latter is made of `{external}`: nobody wrote it
        if isinstance(node, networks.NetworkBody):
            yield from of_rungs(node)
            return
        if isinstance(node, chart.Chart):
            yield from of_chart(node)
            return
        if isinstance(node, tree.TryStatement):
            yield from (node.span, node.catch) if node.caught is not None else (node.span,)
        if isinstance(node, STATEMENTS):
            yield node.span
        elif isinstance(node, tree.IlInstruction):
            # a label alone does nothing, and what opens a parenthesis waits for what closes it
            if node.operator and not (node.deferred and node.operand is None):
                yield node.span
            return
        for each in fields(node):
            yield from written(getattr(node, each.name), used)


def starts(case: Case, program: Program) -> set[Start]:
    used = {pou.name.upper().rpartition(".")[2].partition("<")[0] for pou in program.tasked}
    found = [
        each
        for name, text in sources(case).items()
        if not name.startswith("plant/")
        for each in written(read(name, text).file, used)
    ]
    return {(span.file, span.line, span.column) for span in found}


@pytest.mark.parametrize("topic", sorted(path.stem for path in CASES.glob("*.case")))
def test_every_statement_of_the_cases_has_a_site(topic: str) -> None:
    for case in read_cases(CASES / f"{topic}.case"):
        program = check_sources(project_of(case), MODELS[case.model], case.interval_ns).program
        assert program is not None
        known, sites = starts(case, program), sites_of(program).statements
        connections = {each.name for task in program.tasks for each in task.programs if each.before or each.after}
        own = {pou.name for pou in program.tasked}
        for site in sites:
            where = site.span.file, site.span.line, site.span.column
            if site.pou in own - connections:
                assert where in known, f"{case.name}: nobody wrote {site}"
        have = {(site.span.file, site.span.line, site.span.column) for site in sites}
        calls_none = not any(pou.kind == "function_block" or "." in pou.name for pou in program.tasked)
        if calls_none:  # methods that nobody calls are no part of the program
            missing = {each for each in known - have if library_of_file(each[0]) is None}
            assert not missing, f"{case.name}: no site for {sorted(missing)}"


TEXT = """\
FUNCTION_BLOCK Count
VAR_INPUT up : BOOL R_EDGE; END_VAR VAR_OUTPUT n : INT := 5; END_VAR VAR_TEMP t : ARRAY[1..2] OF INT; k : INT := 1; END_VAR
METHOD PUBLIC Clear : BOOL
  n := 0; Clear := TRUE;
END_METHOD
IF up THEN n := n + k; END_IF;
END_FUNCTION_BLOCK
FUNCTION Old : INT
VAR_INPUT a : INT; END_VAR
Old := a;
END_FUNCTION
PROGRAM Main VAR c : Count; x : INT; ok : BOOL; t : TON; END_VAR
c(up := NOT ok); IF c.n > 3 THEN c.Clear(); END_IF;
CASE x OF 1: x := Old(EN := ok, a := 2, ENO => ok); ELSE x := 1; END_CASE;
t(IN := ok, PT := T#1s);
ok S= t.Q;
END_PROGRAM
"""


def lines(program: Program) -> list[tuple[int, int, str]]:
    return [(each.span.line, each.span.column, each.pou) for each in sites_of(program).statements]


def program_of(text: str) -> Program:
    found = check_sources({"main.st": text}, MODEL)
    assert found.program is not None, found.problems
    return found.program


def test_statements_in_order() -> None:
    assert lines(program_of(TEXT)) == [
        (4, 3, "Count.Clear"), (4, 11, "Count.Clear"), (6, 1, "Count"), (6, 12, "Count"), (10, 1, "Old"),
        (13, 1, "Main"), (13, 18, "Main"), (13, 34, "Main"), (14, 1, "Main"), (14, 14, "Main"), (14, 58, "Main"),
        (15, 1, "Main"), (16, 1, "Main"),
    ]  # fmt: skip


def test_numbers_and_lines_of_statements() -> None:
    program = program_of(TEXT)
    sites = sites_of(program)
    main = next(pou for pou in program.pous if pou.name == "Main")
    numbers = [sites.number(each) for each in main.body]
    assert [number for number in numbers if number is not None] == [5, 6, 8, 11, 12]
    assert sites.bodies[main] == (5, 6, 7, 8, 9, 10, 11, 12)
    assert sites.at_line("main.st", 13) == (5, 6, 7)
    assert sites.at_line("main.st", 12) == ()
    assert sites.at_line("other.st", 13) == ()
    copied = pickle.loads(pickle.dumps(main.body[-1]))
    assert copied == main.body[-1]
    assert sites.number(copied) is None


def test_a_program_from_the_disk_has_the_same_sites() -> None:
    program = program_of(TEXT)
    again: Program = pickle.loads(pickle.dumps(program))
    assert sites_of(again).statements == sites_of(program).statements
    assert list(sites_of(again).bodies.values()) == list(sites_of(program).bodies.values())


def test_a_program_that_was_edited_has_the_sites_of_the_new_text() -> None:
    checks = Checks()
    edited = TEXT.replace("  n := 0;", "\n  n := 0; n := 1;").replace("Old := a;", "Old := a + 1; Old := 2;")
    for text in (TEXT, edited, TEXT):
        found = checks.check({"main.st": text}, MODEL, 10_000_000).program
        assert found is not None
        assert lines(found) == lines(program_of(text))


def test_outcomes_are_the_ways_that_people_wrote() -> None:
    source = """PROGRAM Main VAR a, b : BOOL; n : INT; END_VAR
IF a THEN n := 1; ELSIF b THEN n := 2; ELSIF n > 3 THEN n := 3; END_IF;
CASE n OF 1: n := 2; 2, 3: n := 1; ELSE n := 0; END_CASE;
FOR n := 1 TO 3 DO ; END_FOR; WHILE a DO a := FALSE; END_WHILE; REPEAT a := TRUE; UNTIL a END_REPEAT;
a S= b;
END_PROGRAM
"""
    program = check_sources({"case.st": source}, MODEL, 10_000_000).program
    assert program is not None
    sites = sites_of(program)
    found = [(sites.statements[each.site].span.line, each.name) for each in sites.outcomes]
    assert found == [
        (2, "THEN"), (2, "ELSIF 1"), (2, "ELSIF 2"), (2, "ELSE"), (3, "CASE 1"), (3, "CASE 2"), (3, "ELSE"),
        (4, "BODY"), (4, "NO ROUND"), (4, "BODY"), (4, "NO ROUND"),
    ]  # fmt: skip
    body = program.tasked[0].body
    numbered = [stmt for stmt in body if sites.outcome(stmt, 0) is not None]
    assert [sites.outcome(stmt, 1) for stmt in numbered] == [1, 5, 8, 10]
