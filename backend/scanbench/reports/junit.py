"""JUnit, the one format of test results that every build server reads: a suite of cases."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from lxml import etree

from scanbench.plcmodel.document import xml_text

Outcome = Literal["passed", "failure", "error", "skipped"]


@dataclass(frozen=True, slots=True)
class Case:
    """One line of the report. An `error` is what could not be found out, a `failure` what was found."""

    group: str
    """Build servers show cases below it, split at its points."""
    name: str
    outcome: Outcome = "passed"
    message: str = ""
    """What a build server shows first."""
    kind: str = ""
    """One word; only of a failure or an error."""
    text: str = ""
    """All that is known, for people."""


def junit(suite: str, cases: Sequence[Case]) -> str:
    """The document."""
    numbers = {
        "tests": len(cases),
        **{f"{each}s": sum(case.outcome == each for case in cases) for each in ("failure", "error")},
        "skipped": sum(case.outcome == "skipped" for case in cases),
    }
    totals = {name: str(number) for name, number in numbers.items()}
    root = etree.Element("testsuites", totals)
    parent = etree.SubElement(root, "testsuite", {"name": xml_text(suite), **totals})
    for case in cases:
        _add(parent, case)
    return str(etree.tostring(root, encoding="utf-8", xml_declaration=True, pretty_print=True), "utf-8")


def _add(suite: etree._Element, case: Case) -> None:
    element = etree.SubElement(suite, "testcase", {"classname": xml_text(case.group), "name": xml_text(case.name)})
    if case.outcome == "passed":
        if case.text:
            etree.SubElement(element, "system-out").text = xml_text(case.text)
        return
    about = {"message": xml_text(case.message)}
    if case.outcome != "skipped":
        about["type"] = case.kind or case.outcome
    told = etree.SubElement(element, case.outcome, about)
    if case.text:
        told.text = xml_text(case.text)
