"""What an in-out is bound to, and writing it, through the server."""

from itertools import count
from urllib.parse import quote

import pytest

from scanbench.client import Json, Plc, Refused, connect
from tests.web.server import Server
from tests.web.test_restart import until

SOURCE = """\
FUNCTION_BLOCK Valve {in_out 'value'}
VAR_IN_OUT level: INT(0..100); END_VAR
VAR n: INT; END_VAR
n := n + 1;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Pump
VAR_IN_OUT level: INT(0..100); END_VAR
VAR valve: Valve; END_VAR
valve(level := level);
END_FUNCTION_BLOCK
PROGRAM Main
VAR pump: Pump; tank: ARRAY[1..3] OF INT(0..100); go: BOOL; never: Valve; END_VAR
pump(level := tank[1]);
pump(level := tank[2]);
IF go THEN never(level := tank[3]); END_IF;
END_PROGRAM
"""

_NUMBERS = count()


class Bench:
    """A PLC that runs the program, paused."""

    def __init__(self, server: Server) -> None:
        name = f"in-outs {next(_NUMBERS)}"
        server.instance(name, "GENERIC-IEC", Main=SOURCE)
        self._client = connect(server.address, user="Ann")
        self.plc: Plc = self._client.plc(name)
        self._base = f"/api/instances/{self._client.plcs()[name]}"
        self.plc.run(scans=3)

    def ask(self, method: str, what: str, body: Json = None) -> Json:
        return self._client.ask(method, f"{self._base}/{what}", body)

    def binding(self, path: str) -> dict[str, Json]:
        found = self.ask("GET", f"binding?path={quote(path)}")
        assert isinstance(found, dict)
        return found

    def force(self) -> dict[str, Json]:
        """The one that there is."""
        forces = self.ask("GET", "forces")
        assert isinstance(forces, list)
        (force,) = forces
        assert isinstance(force, dict)
        return force


@pytest.fixture
def bench(server: Server) -> Bench:
    return Bench(server)


def test_the_binding_and_another_call(bench: Bench) -> None:
    plc = bench.plc
    found = bench.binding("Main.pump.valve.level")
    assert (found["ok"], found["convention"]) == (True, "value")
    listed = bench.binding("Main.pump.level")["sites"]
    assert isinstance(listed, list)
    sites = [each for each in listed if isinstance(each, dict)]
    assert [(each["actual"], each["line"], each["call"], each["last"]) for each in sites] == [
        ("Main.tank[1]", 13, "Main", False), ("Main.tank[2]", 14, "Main", True),
    ]  # fmt: skip
    assert plc.write("Main.pump.valve.level", 60) == "Main.pump.valve.level -> Main.tank[2] := 60"
    file = sites[0]["file"]
    assert plc.write("Main.pump.level", 7, f"{file}:13") == "Main.pump.level -> Main.tank[1] := 7"
    with plc.forced("Main.pump.level", 9, site=f"{file}:13"):
        assert plc.read("Main.tank[1]") == "9"
    plc.write("Main.tank[1]", 7)
    plc.run(scans=2)
    assert [plc.read(f"Main.tank[{number}]") for number in (1, 2, 3)] == ["7", "60", "0"]
    assert plc.read("Main.pump.valve.level") == "60"


def test_what_is_refused(bench: Bench) -> None:
    plc = bench.plc
    assert "not called yet" in str(bench.binding("Main.never.level")["message"])
    with pytest.raises(Refused, match="not called yet"):
        plc.write("Main.never.level", 1)
    with pytest.raises(Refused, match="0 to 100"):
        plc.write("Main.pump.level", 101)
    with pytest.raises(Refused):
        bench.binding("Main.pumps.level")


def test_forces_tell_what_they_hold_down(bench: Bench) -> None:
    plc = bench.plc
    plc.force("Main.pump.level", 50)
    plc.run(scans=2)
    force = bench.force()
    assert (force["path"], force["through"], force["author"]) == ("Main.tank[2]", "Main.pump.level", "Ann")
    # what a force does is told a few times a second
    until(lambda: [bench.force()[each] for each in ("before", "after_program", "after")] == ["50", "50", "50"])
    plc.release("Main.pump.level")
    assert bench.ask("GET", "forces") == []
