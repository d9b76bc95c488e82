"""Files of TwinCAT: what is offered in them, and names in drawings, which have no text of their own everywhere."""

from scanbench.check.build import check_sources
from scanbench.language.complete import complete
from scanbench.language.navigate import named_at
from scanbench.language.reading import Readings
from scanbench.language.rename import CannotRename, places
from tests.caseformat import MODELS
from tests.syntax.test_tcsfc import act, jump, source, step, to


def test_a_step_of_a_chart_keeps_its_name() -> None:
    text = source(step("One", first=True), to("a"), step("Two"), to("b"), jump("One"))
    reading = Readings(MODELS["GENERIC-IEC"]).read({"FB.TcPOU": text})
    found = named_at(reading, "FB.TcPOU", text.index('"Two"') + 1)
    assert found is not None
    assert places(reading, found.symbol, "Three") == CannotRename("`TWO` is drawn in FB.TcPOU; rename it in TwinCAT.")


def test_completion_offers_no_words_that_the_xml_says() -> None:
    text = source(step("One", first=True), to("a"), jump("One"), more=act("Act", "y := 1;"))
    reading = Readings(MODELS["GENERIC-IEC"]).read({"FB.TcPOU": text})
    offered = {each.label for each in complete(reading, "FB.TcPOU", text.index("y := 1;"))}
    assert {"END_IF", "y"} <= offered
    assert offered.isdisjoint({"END_FUNCTION_BLOCK", "END_PROGRAM", "END_ACTION", "END_METHOD"})


def test_an_action_is_no_method() -> None:
    text = source(step("One", first=True), to("a"), jump("One"), more=act("Act", "y := 1;"))
    checked = check_sources({"FB.TcPOU": text}, MODELS["GENERIC-IEC"])
    assert [(each.name, each.kind) for each in checked.pous][:2] == [("FB", "function_block"), ("FB.Act", "action")]
