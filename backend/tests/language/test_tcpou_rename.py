"""A name in a drawing of a TwinCAT file: a new name for it is refused where the file does not have its text."""

from scanbench.language.navigate import named_at
from scanbench.language.reading import Readings
from scanbench.language.rename import CannotRename, places
from tests.caseformat import MODELS
from tests.syntax.test_tcsfc import jump, source, step, to


def test_a_step_of_a_chart_keeps_its_name() -> None:
    text = source(step("One", first=True), to("a"), step("Two"), to("b"), jump("One"))
    reading = Readings(MODELS["GENERIC-IEC"]).read({"FB.TcPOU": text})
    found = named_at(reading, "FB.TcPOU", text.index('"Two"') + 1)
    assert found is not None
    assert places(reading, found.symbol, "Three") == CannotRename("`TWO` is drawn in FB.TcPOU; rename it in TwinCAT.")
