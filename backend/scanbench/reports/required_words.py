"""What became of requirements, in words: for tables, JUnit and pages."""

from collections.abc import Mapping

from scanbench.faults.reaction.reaction import UNTRIED, Outcome, OutputRestart, Reaction, RequiredResult
from scanbench.faults.reaction.sweep import Cell

OUTCOMES: Mapping[Outcome, str] = {"passed": "passed", "failed": "failed", "not_checked": "not checked"}
NOT_TRIED = "not tried"


def outcome_of(each: RequiredResult) -> str:
    """What it came to, in a word."""
    return NOT_TRIED if each.reason in UNTRIED else OUTCOMES[each.outcome]


def is_grade(each: RequiredResult) -> bool:
    """Whether it asks for a grade."""
    return any(value.path == "verdict" for value in each.values)


def evidence(each: RequiredResult) -> str:
    """The scan and the values that decided it, or why nothing was checked."""
    values = ", ".join(f"{value.path} = {value.value}" for value in each.values)
    since = " after the recovery" if each.recovery else ""
    scan = f"scan {each.scan}{since}" if each.scan is not None and each.outcome != "not_checked" else ""
    return ": ".join(filter(None, (scan, "; ".join(filter(None, (values, each.note))))))


def required_lines(cell: Cell) -> list[str]:
    """A line for each requirement, and for each output that went on again."""
    found = [f"{outcome_of(each)}: {each.text} ({evidence(each)})" for each in cell.required]
    return [*found, *map(restarted, () if cell.reaction is None else cell.reaction.restarts)]


def restarted(each: OutputRestart) -> str:
    """A sentence about an output."""
    went = f"{each.path} went on again by itself in scan {each.scan} after the recovery"
    return f"{went}; `{each.allowed_by}` allows it" if each.allowed_by else f"unexpected restart: {went}"


def unexpected(reaction: Reaction | None) -> list[OutputRestart]:
    """The restarts that no requirement allows."""
    return [] if reaction is None else [each for each in reaction.restarts if not each.allowed_by]
