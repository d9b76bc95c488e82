"""What a change of a trace leaves as it is."""

from scanbench.taps.trace import TraceDefinition, TraceTrigger
from scanbench.web.messages_trace import ChangeTrace
from scanbench.web.translate_trace import changed

NOW = TraceDefinition("T", ("Main.n", "Main.m"), 2, 400, TraceTrigger("Main.b", before=70), repeat=True)


def test_what_is_left_out_stays() -> None:
    assert changed(NOW, ChangeTrace()) == NOW
    assert changed(NOW, ChangeTrace(name=" U ", scans=500)) == TraceDefinition(
        "U", NOW.signals, 2, 500, NOW.trigger, repeat=True
    )


def test_null_takes_the_trigger_away() -> None:
    body = {"trigger": None, "repeat": False}
    assert changed(NOW, ChangeTrace.model_validate(body)) == TraceDefinition("T", NOW.signals, 2, 400)


def test_signals_are_added_once_and_removed() -> None:
    body = ChangeTrace(add=["Main.m", " Main.x "], remove=["Main.n", "Main.gone"])
    assert changed(NOW, body).signals == ("Main.m", "Main.x")
