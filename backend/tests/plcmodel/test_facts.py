"""Facts of a model: each with a source of its own, or with that of the element around it."""

from pathlib import Path

import pytest

from scanbench.plcmodel.facts import share
from scanbench.plcmodel.load import load_file, model_directory
from scanbench.plcmodel.model import Model

MODEL = """<?xml version="1.0" encoding="UTF-8"?>
<Model Name="FACTS" Vendor="maker">
  <Memory><Area Name="S" Words="100" Source="manual, p. 1" Verified="yes"/></Memory>
  <System ErrorCode="S0" Source="K-H"/>
  <ErrorGroup>
    <Name>Errors</Name>
    <Error Id="alarm" ErrorCode="4000" ErrorFlag="S1.00" Severity="nonfatal" Priority="2" Source="known">
      <Name>Alarm</Name>
      {facts}
    </Error>
  </ErrorGroup>
</Model>
"""


def load(tmp_path: Path, facts: str) -> tuple[Model | None, list[str]]:
    path = tmp_path / "facts.xml"
    path.write_text(MODEL.format(facts=facts), "utf-8")
    model, problems = load_file(path, model_directory())
    return model, [f"{each.code} {each.message}" for each in problems]


def test_a_fact_has_its_own_source_or_that_of_its_element(tmp_path: Path) -> None:
    model, problems = load(tmp_path, '<Fact Of="flag code" Source="manual, p. 7" Verified="yes"/>')
    assert model is not None, problems
    found = {
        fact.of: (fact.value, fact.source, fact.verified, fact.inherited)
        for fact in model.facts
        if fact.kind == "error"
    }
    assert found == {
        "flag": ("S1.00", "manual, p. 7", True, False),
        "code": ("4000", "manual, p. 7", True, False),
        "severity": ("nonfatal", "known", False, True),
        "priority": ("2", "known", False, True),
        "cause": ("passing", "known", False, True),
        "log": ("none", "known", False, True),
        "text": ("Alarm", "known", False, True),
    }
    assert share(model.facts) == (5, 11)  # words, access and retention of the area, and two of the error


@pytest.mark.parametrize(
    ("fact", "reason"),
    [
        ('<Fact Of="flag" Source="known"/>', "Verified"),
        ('<Fact Of="flag" Verified="no"/>', "Source"),
        ('<Fact Of="flag" Source="" Verified="no"/>', "Source"),
        ('<Fact Of="hold" Source="known" Verified="no"/>', "M010 this Error states no fact 'hold', it has flag, code"),
        ('<Fact Of="flag flag" Source="known" Verified="no"/>', "M004 Fact 'flag' is there twice"),
    ],
)
def test_what_a_fact_must_say(tmp_path: Path, fact: str, reason: str) -> None:
    model, problems = load(tmp_path, fact)
    assert model is None
    assert reason in problems[0]
