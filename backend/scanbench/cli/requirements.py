"""What `scanbench errors sweep --requirements FILE` requires (docs/error-sweep.md): text -> rules, JSON -> grades."""

import json
from pathlib import Path

from scanbench.faults.reaction.required import Wanted
from scanbench.faults.reaction.required_rules import GRADES
from scanbench.faults.reference import parse_reference
from scanbench.plcmodel.model import Model
from scanbench.runtime.command import Refusal
from scanbench.syntax.requirements import RequirementsText
from scanbench.syntax.requirements import read_requirements as read_text

_HOW = 'it has to be one object, as in {"battery-error": "displayed", "special-io-unit-error:unit=3": "acted"}'


class BadRequirements(Exception):
    """The file cannot be used; the message says where and why."""


def wanted_of(text: str) -> Wanted | None:
    """The grade of this name; None if there is none."""
    return GRADES.get(text)


def read_requirements(path: Path, model: Model) -> dict[str, Wanted] | RequirementsText:
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
    return dict(_row(error, grade, model) for error, grade in told.items())


def _row(error: str, grade: object, model: Model) -> tuple[str, Wanted]:
    ref = parse_reference(model, error)
    if isinstance(ref, Refusal):
        raise BadRequirements(f"{error!r}: {ref.message}")
    wanted = wanted_of(grade) if isinstance(grade, str) else None
    if wanted is None:
        raise BadRequirements(f"{error}: {json.dumps(grade)} is no grade; there are {', '.join(GRADES)}")
    return str(ref), wanted
