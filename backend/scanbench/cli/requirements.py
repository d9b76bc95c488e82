"""What single errors have to do at least in `scanbench errors sweep --requirements FILE` (docs/error-sweep.md): JSON -> grades."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import get_args

from scanbench.faults.reaction.reaction import Grade
from scanbench.faults.reaction.required import Wanted
from scanbench.faults.reference import parse_reference
from scanbench.plcmodel.model import Model
from scanbench.runtime.command import Refusal

_HOW = 'it has to be one object, as in {"battery-error": "displayed", "special-io-unit-error:unit=3": "acted"}'
_WANTED: Mapping[str, Wanted] = {each: each for each in (*get_args(Grade), "none")}


class BadRequirements(Exception):
    """The file cannot be used; the message says where and why."""


def wanted_of(text: str) -> Wanted | None:
    """The grade of this name; None if there is none."""
    return _WANTED.get(text)


def read_requirements(path: Path, model: Model) -> dict[str, Wanted]:
    """The grades of a file by error. Every name in it has to be known: people write it, and make typing errors."""
    try:
        told = json.loads(path.read_text("utf-8"))
    except OSError as error:
        raise BadRequirements(f"it cannot be read: {error.strerror}") from error
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
        raise BadRequirements(f"{error}: {json.dumps(grade)} is no grade; there are {', '.join(_WANTED)}")
    return str(ref), wanted
