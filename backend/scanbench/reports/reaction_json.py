"""A reaction as JSON and back: for the database, for records, for the command line."""

from collections.abc import Mapping
from dataclasses import asdict

from scanbench.faults.reaction.reaction import Reaction
from scanbench.typed import make_kept


def to_json(reaction: Reaction) -> dict[str, object]:
    """Numbers, texts, lists and objects, with the names of `reaction.py`."""
    told = asdict(reaction)
    return {name: list(value) if isinstance(value, tuple) else value for name, value in told.items()}


def from_json(told: Mapping[str, object]) -> Reaction:
    """The reaction that `to_json` wrote, perhaps of a newer version; `BadValue` says which field is missing or of the wrong kind."""
    return make_kept(Reaction, told)
