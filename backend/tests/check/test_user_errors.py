"""A project's own errors among its sources: problems like the compiler's, and the model that the layout refers to."""

from pathlib import Path

from scanbench.check.build import check_sources
from scanbench.check.incremental import Checks
from scanbench.host.build import all_models
from scanbench.plcmodel.as_used import as_used
from scanbench.recording.fingerprints import program_digest

GOOD = (Path(__file__).parents[1] / "plcmodel" / "broken_user_errors" / "GOOD.xml").read_text("utf-8")
MAIN = "PROGRAM Main\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n"
INTERVAL_NS = 10_000_000
MODEL = next(each for each in all_models()[0] if each.name == "CJ1M-CPU63")


def test_the_program_is_the_same_on_a_model_that_knows_more() -> None:
    plain = check_sources({"main.st": MAIN}, MODEL).program
    program = check_sources({"main.st": MAIN, "errors.xml": GOOD}, MODEL).program
    assert plain is not None
    assert program is not None
    assert program.layout.model.error("pump-hot") is not None
    assert plain.layout.model is as_used(MODEL, ())
    assert program_digest(program) == program_digest(plain)
    assert (program.pous, program.initial_image) == (program.pous, plain.initial_image)


def test_what_is_wrong_with_them_is_a_problem_like_others() -> None:
    sources = {"main.st": MAIN.replace("n + 1", "m + 1"), "errors.xml": GOOD.replace("W10.00", "W999.00")}
    for checked in (check_sources(sources, MODEL), Checks().check(sources, MODEL, INTERVAL_NS)):
        assert checked.program is None
        places = [(each.span.file, each.span.line, each.code) for each in checked.problems]
        assert places == [("errors.xml", 5, "M003"), ("main.st", 3, "T001")]
        assert [pou.name for pou in checked.pous] == ["Main"]


def test_only_they_prevent_a_program() -> None:
    checked = check_sources({"main.st": MAIN, "errors.xml": "<UserErrors>"}, MODEL)
    assert checked.program is None
    assert [each.code for each in checked.problems] == ["M001"]


def test_a_new_catalogue_checks_no_body_again() -> None:
    checks = Checks()
    first = checks.check({"main.st": MAIN, "errors.xml": GOOD}, MODEL, INTERVAL_NS).program
    second = checks.check({"main.st": MAIN, "errors.xml": GOOD.replace("pump-hot", "x")}, MODEL, INTERVAL_NS).program
    without = checks.check({"main.st": MAIN}, MODEL, INTERVAL_NS).program
    assert first is not None
    assert second is not None
    assert without is not None
    assert [first.pous[-1], second.pous[-1]] == [without.pous[-1]] * 2
    assert first.pous[-1] is second.pous[-1] is without.pous[-1]
    assert second.layout.model.error("x") is not None
    assert without.layout.model is as_used(MODEL, ())
    found = checks.diagnose({"main.st": MAIN, "errors.xml": GOOD.replace("4101", "41")}, MODEL, INTERVAL_NS)
    assert [each.code for each in found.problems] == ["M007"]
