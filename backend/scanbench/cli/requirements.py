"""What `scanbench errors sweep --requirements FILE` requires (docs/error-sweep.md): text -> rules, JSON -> grades."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from scanbench.faults.reaction.required import Wanted
from scanbench.faults.reaction.required_rules import GRADES, settled, whole
from scanbench.faults.reference import ErrorRef, parse_reference
from scanbench.program.program import Program
from scanbench.runtime.command import Refusal
from scanbench.syntax.requirements import RequirementsText
from scanbench.syntax.requirements import read_requirements as read_text

_HOW = 'it has to be one object, as in {"battery-error": "displayed", "special-io-unit-error:unit=3": "acted"}'


class BadRequirements(Exception):
    """The file cannot be used; the message says where and why."""


def wanted_of(text: str) -> Wanted | None:
    """The grade of this name; None if there is none."""
    return GRADES.get(text)


@dataclass(frozen=True, slots=True)
class Grades:
    """What JSON says, on one program."""

    program: Program
    rows: Mapping[ErrorRef, Wanted]
    """By error with the details that were given; the row with the most counts."""

    def of(self, ref: ErrorRef) -> Wanted | None:
        """Of this error; None: nothing."""
        rows = [each for each in self.rows if self._is_about(each, ref)]
        return self.rows[max(rows, key=lambda each: len(each.details))] if rows else None

    def unused(self, raised: Sequence[ErrorRef]) -> list[str]:
        """The rows that are about none of these."""
        return [str(row) for row in self.rows if not any(self._is_about(row, ref) for ref in raised)]

    def _is_about(self, row: ErrorRef, ref: ErrorRef) -> bool:
        return row.id == ref.id and set(row.details) <= set(whole(self.program, ref).details)


def read_requirements(path: Path, program: Program) -> Grades | RequirementsText:
    """What a file requires, in the notation of `required.reactions`; or as JSON grades by error: there every name has to be known."""
    try:
        text = path.read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        why = error.strerror if isinstance(error, OSError) else str(error)
        raise BadRequirements(f"it cannot be read: {why}") from error
    if not text.lstrip().startswith(("{", "[")):
        return read_text(text, path.name)
    try:
        told = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise BadRequirements(f"it is no JSON: {error}; {_HOW}") from error
    if not isinstance(told, dict):
        raise BadRequirements(_HOW)
    return Grades(program, dict(_row(error, grade, program) for error, grade in told.items()))


def _row(error: str, grade: object, program: Program) -> tuple[ErrorRef, Wanted]:
    ref = parse_reference(program.layout.model, error)
    ref = ref if isinstance(ref, Refusal) else settled(program, ref)
    if isinstance(ref, Refusal):
        raise BadRequirements(f"{error!r}: {ref.message}")
    wanted = wanted_of(grade) if isinstance(grade, str) else None
    if wanted is None:
        raise BadRequirements(f"{error}: {json.dumps(grade)} is no grade; there are {', '.join(GRADES)}")
    return ref, wanted
