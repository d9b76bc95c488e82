"""Scenario files: steps at scans, and what is to hold. YAML, so that people read, write and compare them.

    project: ../plc                        # from the folder of this file; left out: that folder
    scans: 200                             # it runs so many
    steps:
      - {at: 5, do: write start=TRUE}      # before scan 5
      - {at: 10, do: "raise io-bus-error:rack=1,slot=3"}
    expect:
      - {after: 20, holds: lamp}           # when 20 scans ran
      - {from: 12, within: 5, holds: lamp} # now, or after one of the 5 scans from then on
      - {from: 30, to: 200, always: motor} # after each of these scans
      - {from: 0, to: 200, never: A401 <> 0}

What `do` says is a command as of the command line: write, force, release, raise, clear, mode, restart.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import yaml

ENDING = ".scenario.yaml"
VERBS = ("write", "force", "release", "raise", "clear", "mode", "restart", "break", "mend")
"""What `do` begins with."""
_KINDS: tuple[Literal["holds"], Literal["always"], Literal["never"]] = ("holds", "always", "never")
_MOST_SCANS = 10_000_000
_LARGEST = 1 << 20


class BadScenario(Exception):
    """A file that is no scenario; the message says where and why."""


@dataclass(frozen=True, slots=True)
class Step:
    """A command before a scan."""

    at: int
    do: str


@dataclass(frozen=True, slots=True)
class Expectation:
    """What is to hold: `holds` after one of the scans up to `last`, where it stays `first`; `always` and `never` after each."""

    kind: Literal["holds", "always", "never"]
    condition: str
    first: int
    last: int

    def __str__(self) -> str:
        if self.kind == "holds":
            where = (
                f"after {self.first}"
                if self.first == self.last
                else f"from {self.first} within {self.last - self.first}"
            )
        else:
            where = f"from {self.first} to {self.last}"
        return f"{where}: {self.kind} {self.condition}"


@dataclass(frozen=True, slots=True)
class Scenario:
    """A file as it was read."""

    scans: int
    steps: tuple[Step, ...]
    expect: tuple[Expectation, ...]
    project: str = "."
    notes: tuple[str, ...] = ()
    """What could not be taken over from where it was made of; comments at its top."""

    def with_steps(self, steps: Sequence[Step]) -> "Scenario":
        """The same with other steps."""
        return replace(self, steps=tuple(steps))


def read_scenario(text: str) -> Scenario:
    """What a file says; `BadScenario`."""
    if len(text) > _LARGEST:
        raise BadScenario(f"the file is larger than {_LARGEST >> 20} MiB")
    try:
        found = yaml.safe_load(text)
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        raise BadScenario(f"it is no YAML: {' '.join(str(error).split())}") from error
    top = _object(found, "the file", {"project", "scans", "steps", "expect"})
    scans = _number(top, "scans", "the file")
    steps = tuple(_step(each, f"steps[{at}]", scans) for at, each in enumerate(_list(top, "steps")))
    expect = tuple(_expectation(each, f"expect[{at}]", scans) for at, each in enumerate(_list(top, "expect")))
    return Scenario(scans, tuple(sorted(steps, key=lambda step: step.at)), expect, str(top.get("project", ".")))


def write_scenario(scenario: Scenario) -> str:
    """The text of a file."""
    content: dict[str, object] = {} if scenario.project == "." else {"project": scenario.project}
    content["scans"] = scenario.scans
    head = "".join(f"# {note}\n" for note in scenario.notes) + yaml.safe_dump(content, sort_keys=False)
    steps: list[dict[str, object]] = [{"at": step.at, "do": step.do} for step in scenario.steps]
    return head + _lines("steps", steps) + _lines("expect", [_shown(each) for each in scenario.expect])


def _lines(name: str, entries: Sequence[Mapping[str, object]]) -> str:
    """One line each."""
    if not entries:
        return ""
    flow = (
        yaml.safe_dump(dict(each), default_flow_style=True, sort_keys=False, width=1 << 20).strip() for each in entries
    )
    return f"{name}:\n" + "".join(f"- {each}\n" for each in flow)


def _shown(each: Expectation) -> dict[str, object]:
    if each.kind == "holds" and each.first == each.last:
        return {"after": each.first, "holds": each.condition}
    if each.kind == "holds":
        return {"from": each.first, "within": each.last - each.first, "holds": each.condition}
    return {"from": each.first, "to": each.last, each.kind: each.condition}


def _object(found: object, where: str, known: set[str]) -> Mapping[str, object]:
    if not isinstance(found, dict):
        raise BadScenario(f"{where} has to be names with values")
    unknown = [str(each) for each in found if each not in known]
    if unknown:
        raise BadScenario(f"{where}: {unknown[0]} is unknown; there are {', '.join(sorted(known))}")
    return found


def _list(top: Mapping[str, object], name: str) -> Sequence[object]:
    found = top.get(name) or ()
    if not isinstance(found, list | tuple):
        raise BadScenario(f"{name} has to be a list")
    return found


def _number(found: Mapping[str, object], name: str, where: str, most: int = _MOST_SCANS) -> int:
    value = found.get(name)
    if not isinstance(value, int) or isinstance(value, bool) or not 0 <= value <= most:
        raise BadScenario(f"{where}: {name} has to be a number from 0 to {most}")
    return value


def _step(found: object, where: str, scans: int) -> Step:
    entry = _object(found, where, {"at", "do"})
    do = entry.get("do")
    if not isinstance(do, str) or do.partition(" ")[0] not in VERBS:
        raise BadScenario(f"{where}: do has to begin with one of {', '.join(VERBS)}")
    return Step(_number(entry, "at", where, scans), do)


def _expectation(found: object, where: str, scans: int) -> Expectation:
    entry = _object(found, where, {"after", "from", "to", "within", *_KINDS})
    kind = next((each for each in _KINDS if each in entry), None)
    condition = None if kind is None else entry[kind]
    if isinstance(condition, bool):  # YAML reads a bare TRUE so
        condition = str(condition).upper()
    if kind is None or not isinstance(condition, str):
        raise BadScenario(f"{where}: holds, always or never has to be a condition, such as `Main.n > 3`")
    if kind == "holds" and "after" in entry:
        at = _number(entry, "after", where, scans)
        return Expectation(kind, condition, at, at)
    first = _number(entry, "from", where, scans)
    last = first + _number(entry, "within", where, scans) if kind == "holds" else _number(entry, "to", where, scans)
    least = first if kind == "holds" else first + 1
    if not least <= last <= scans:
        raise BadScenario(
            f"{where}: it ends with scan {last}, which is not from {least} to {scans}, where the scenario ends"
        )
    return Expectation(kind, condition, first, last)


def project_of(path: Path, scenario: Scenario) -> Path:
    """The folder or file with the program, of a scenario in this file."""
    return (path.parent / scenario.project).resolve()
