"""One mistake, one message: what follows from it is not told as well."""

import pytest

from scanbench.check.build import check_sources
from tests.caseformat import MODELS

POU = (
    '<?xml version="1.0" encoding="utf-8"?><TcPlcObject Version="1.1.0.1"><POU Name="Main" Id="{1}"><Declaration>'
    "<![CDATA[PROGRAM Main VAR n : INT; END_VAR]]></Declaration><Implementation><ST><![CDATA[n := 1;]]></ST></Implementation>"
    "</POU></TcPlcObject>"
)
PLCOPEN = '<?xml version="1.0"?>\n<!DOCTYPE project [<!ENTITY x "y">]>\n<project xmlns="http://www.plcopen.org/xml/tc6_0201"/>\n'


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("Main.TcPOU", POU[:-20], "This is no well-formed XML"),
        ("Main.TcPOU", POU.replace("PROGRAM Main", "PROGRAM"), "the name of the PROGRAM expected"),
        ("p.xml", PLCOPEN, "This is a PLCopen XML file."),
        (
            "m.st",
            "PROGRAM Main\nVAR a, b : INT; END_VAR\nFOR a = 1 TO 5 DO\n b := a;\nEND_FOR\nEND_PROGRAM\n",
            "`:=` expected after the control variable of the FOR, found `=`.",
        ),
    ],
)
def test_one_mistake_is_told_once(name: str, text: str, message: str) -> None:
    problems = check_sources({name: text}, MODELS["GENERIC-IEC"]).problems
    assert len(problems) == 1
    assert problems[0].message.startswith(message)
