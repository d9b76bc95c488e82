"""The text of required reactions: every form, every mistake; what was written once is read for ever."""

import json
from dataclasses import asdict
from pathlib import Path

import pytest

from scanbench.syntax.requirements import RequirementsText, read_requirements

GOLDEN = Path(__file__).with_name("golden")


def said(found: RequirementsText) -> object:
    """What a text requires, without places; as JSON has it."""

    def plain(value: object) -> object:
        if isinstance(value, dict):
            return {name: plain(each) for name, each in value.items() if name != "span"}
        return list(map(plain, value)) if isinstance(value, tuple | list) else value

    return plain([asdict(rule) for rule in found.rules])


def test_the_golden_file_says_what_it_said() -> None:
    """`golden/1.json` was made of it once, by `said`."""
    found = read_requirements((GOLDEN / "1.reactions").read_text("utf-8"))
    assert found.problems == ()
    assert said(found) == json.loads((GOLDEN / "1.json").read_text("utf-8"))


@pytest.mark.parametrize(
    ("text", "where", "says"),
    [
        ("battery-error lamp", (1, 1), "needs `:` after it"),
        ("  lamp", (1, 3), "say first which error"),
        ("battery-error is present: lamp", (1, 1), "names no error"),
        ('battery-error in Running, , "x": lamp', (1, 18), "states are written as"),
        ("battery-error:\n  lamp within 3 scans now", (2, 23), "nothing but `until ...`"),
        ("battery-error:\n  always lamp within 3 scans", (2, 3), "`always` has no `within`"),
        ("battery-error:\n  lamp within 0 scans", (2, 8), "at least 1"),
        ("battery-error:\n  after recovery: at least acted", (2, 3), "about the whole reaction"),
        ("battery-error:\n  after recovery:", (2, 3), "there is no condition"),
    ],
)
def test_a_line_that_cannot_be_read_is_told_and_left_out(text: str, where: tuple[int, int], says: str) -> None:
    found = read_requirements(f"{text}\nall: lamp\n")
    (problem,) = found.problems
    assert (problem.span.line, problem.span.column) == where, problem
    assert says in problem.message
    assert found.rules[-1].error.text == "all"
    assert len(found.rules[-1].requirements) == 1


def test_lines_below_an_error_that_cannot_be_read_are_not_those_of_the_one_before() -> None:
    found = read_requirements("battery-error: lamp\nbasic-io error\n  motor\n")
    assert [each.text for rule in found.rules for each in rule.requirements] == ["lamp"]
