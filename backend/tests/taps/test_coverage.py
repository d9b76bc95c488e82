"""Coverage: what was reached, the ways that were gone, what an edit keeps, and the LCOV of it."""

from collections.abc import Mapping

from scanbench.check.build import check_sources
from scanbench.engines.interpreter.debugged import debug_engine
from scanbench.program.program import Program
from scanbench.taps.coverage import CoverageTap
from scanbench.taps.covered import CoveredFile, CoveredOutcome, CoveredSite
from scanbench.taps.lcov import lcov
from tests.caseformat import MODELS

SOURCE = """PROGRAM Main
VAR n : INT; x : INT; END_VAR
n := n + 1;
IF n > 5 THEN
  x := 1;
ELSIF n > 1 THEN
  x := 2;
END_IF;
CASE n OF
  1: x := 3;
  2..3: x := 4;
END_CASE;
FOR x := 1 TO n - 1 DO n := n + 0; END_FOR;
WHILE x > 100 DO x := x - 1; END_WHILE;
REPEAT x := x + 1; UNTIL x > 3 END_REPEAT;
END_PROGRAM
"""


def ways(site: CoveredSite) -> tuple[tuple[str, bool], ...]:
    return tuple((each.name, each.taken) for each in site.outcomes)


def program_of(sources: Mapping[str, str]) -> Program:
    found = check_sources(sources, MODELS["GENERIC-IEC"], 10_000_000)
    assert found.program is not None, [str(each) for each in found.problems]
    return found.program


def covered(sources: Mapping[str, str], scans: int) -> CoverageTap:
    program = program_of(sources)
    engine = debug_engine(program, bytearray(program.initial_image))
    tap = CoverageTap(engine.sites, sources, 0)
    for _ in range(scans):
        engine.run(1)
        tap.note(engine.observer.take())
    return tap


def at(tap: CoverageTap, line: int, file: str = "a.st") -> CoveredSite:
    return next(site for each in tap.files if each.file == file for site in each.sites if site.line == line)


def test_statements_and_ways_after_one_scan_and_more() -> None:
    tap = covered({"a.st": SOURCE}, 1)
    assert at(tap, 3).reached
    assert ways(at(tap, 4)) == (("THEN", False), ("ELSIF 1", False), ("ELSE", True))
    assert not at(tap, 5).reached
    assert ways(at(tap, 9)) == (("CASE 1", True), ("CASE 2", False), ("ELSE", False))
    assert ways(at(tap, 13)) == (("BODY", False), ("NO ROUND", True))
    assert ways(at(tap, 14)) == (("BODY", False), ("NO ROUND", True))
    assert ways(at(tap, 15)) == ()
    assert (tap.scans, tap.since_scan) == (1, 0)
    later = covered({"a.st": SOURCE}, 4)
    assert ways(at(later, 4)) == (("THEN", False), ("ELSIF 1", True), ("ELSE", True))
    assert ways(at(later, 9)) == (("CASE 1", True), ("CASE 2", True), ("ELSE", True))
    assert ways(at(later, 13)) == (("BODY", True), ("NO ROUND", True))


def test_says_whether_anything_is_new() -> None:
    program = program_of({"a.st": SOURCE})
    engine = debug_engine(program, bytearray(program.initial_image))
    tap = CoverageTap(engine.sites, {"a.st": SOURCE}, 7)
    new = []
    for _ in range(9):
        engine.run(1)
        new.append(tap.note(engine.observer.take()))
    assert new == [True, True, False, True, False, True, False, False, False]
    assert (tap.since_scan, tap.scans) == (7, 9)


def test_an_edit_keeps_what_reads_as_it_did() -> None:
    other = "FUNCTION_BLOCK Other VAR m : INT; END_VAR\nm := m + 1;\nEND_FUNCTION_BLOCK\n"
    source = SOURCE.replace("x : INT;", "x : INT; o : Other;").replace("n := n + 1;", "n := n + 1; o();")
    before = {"a.st": source, "b.st": other}
    tap = covered(before, 4)
    assert at(tap, 2, "b.st").reached
    edited = source.replace("  x := 1;\n", "  x := 1;\n\n  x := 9;\n").replace("  x := 2;", "  x := 22;")
    after = {"a.st": "\n" + edited, "b.st": other}
    program = program_of(after)
    tap.change(debug_engine(program, bytearray(program.initial_image)).sites, after)
    assert at(tap, 4).reached
    assert ways(at(tap, 5)) == (("THEN", False), ("ELSIF 1", True), ("ELSE", True))
    assert not at(tap, 8).reached
    assert not at(tap, 10).reached, "another statement than the one that was reached"
    assert ways(at(tap, 12)) == (("CASE 1", True), ("CASE 2", True), ("ELSE", True))
    assert at(tap, 2, "b.st").reached


def test_lcov() -> None:
    text = lcov(covered({"a.st": SOURCE}, 1).files).splitlines()
    assert text[:2] == ["TN:", "SF:a.st"]
    assert text[-1] == "end_of_record"
    assert {"FN:3,Main", "FNDA:1,Main", "FNF:1", "FNH:1"} <= set(text)
    assert {"DA:3,1", "DA:5,0", "DA:10,1", "DA:11,0", "LF:10", "LH:7"} <= set(text)
    ways = [line for line in text if line.startswith("BRDA:4,")]
    assert [line.split(",")[2:] for line in ways] == [["0", "0"], ["1", "0"], ["2", "1"]]
    assert {"BRF:10", "BRH:4"} <= set(text)


def test_lcov_of_what_was_never_reached() -> None:
    text = lcov(
        [
            CoveredFile(
                "x.st",
                (CoveredSite(1, 1, 1, 9, "P", False, (CoveredOutcome("THEN", False), CoveredOutcome("ELSE", False))),),
            )
        ]
    )
    assert "BRDA:1,0,0,-" in text
    assert "DA:1,0" in text
    assert lcov([]) == ""
