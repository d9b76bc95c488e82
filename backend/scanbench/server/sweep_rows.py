"""The rows and cells of a sweep, as they are kept and compared."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import get_args

from scanbench.faults.details import code_text_raised
from scanbench.faults.history import key_for
from scanbench.faults.reaction.compare import Outcome, outcome
from scanbench.faults.reaction.reaction import FINDINGS, WORST_FIRST, Verdict
from scanbench.faults.reference import error_of, named_reference, parse_reference
from scanbench.plcmodel.catalogue import path_text
from scanbench.plcmodel.model import Model
from scanbench.reports.reaction_json import from_json, to_json
from scanbench.runtime.command import Refusal
from scanbench.store.records import CellRow, Json, SweptError
from scanbench.typed import BadValue
from scanbench.wire.jobs import CellFound
from scanbench.wire.refused import Refused

VERDICTS: Mapping[str, Verdict] = {verdict: verdict for verdict in get_args(Verdict)}
"""By their names in the database."""


def rows_of(model: Model, wanted: Sequence[str] | None) -> tuple[SweptError, ...]:
    """The errors to be swept, in the order of the catalogue: whole kinds, or instances (`fal:number=5`)."""
    refs: dict[str, list[str]] = {}
    for text in wanted or ():
        ref = parse_reference(model, text)
        if isinstance(ref, Refusal):
            raise Refused(ref.message, ref.near)
        refs.setdefault(ref.id, []).append(str(ref))
    found = [
        SweptError(
            text, _named(error.name, text.partition(":")[2]), _code(model, text) or error.code_text, error.severity,
            path_text(group.name for group in groups),
        )
        for groups, error in model.errors_with_groups()
        for text in _texts(error.id, [error.id] if wanted is None else refs.get(error.id, []))
    ]  # fmt: skip
    if not found:
        raise Refused("no error is chosen: there is nothing to sweep")
    return tuple(found)


def _texts(id: str, texts: Sequence[str]) -> Iterable[str]:
    """Of a whole kind no instance besides."""
    return (id,) if id in texts else dict.fromkeys(texts)


def rows_planned(model: Model, known: Sequence[SweptError], planned: Sequence[str]) -> tuple[SweptError, ...]:
    """The rows of what is raised: with details as rows of their own."""
    by_id = {error_of(each.id): each for each in reversed(known)}
    names = {error_of(each.id): each.name.removesuffix(f" ({each.id.partition(':')[2]})") for each in known}
    return tuple(
        replace(
            by_id[error_of(text)],
            id=text,
            name=_named(names[error_of(text)], text.partition(":")[2]),
            code=_code(model, text) or by_id[error_of(text)].code,
        )
        for text in planned
        if error_of(text) in by_id
    )


def _code(model: Model, text: str) -> str:
    ref = named_reference(text)
    error = model.error(ref.id)
    return "" if error is None else code_text_raised(error, dict(ref.details))


def _named(name: str, details: str) -> str:
    return f"{name} ({details})" if details else name


def cell_of(found: CellFound) -> CellRow:
    """As it is kept."""
    reaction = found.reaction
    if reaction is None:
        unmet = sum(each.is_finding for each in found.untried)
        return CellRow(
            found.error, found.point, found.scan, None, note=found.note, required=len(found.untried), unmet=unmet,
            untried=found.untried,
        )  # fmt: skip
    return CellRow(
        found.error, found.point, found.scan, reaction.verdict, reaction.first_read, reaction.first_effect,
        reaction.difference_count, reaction.note or found.note, to_json(reaction),
        required=len(reaction.required), unmet=len(reaction.unmet),
    )  # fmt: skip


def outcomes_of(cells: Iterable[CellRow], kept: Mapping[tuple[str, str], Json]) -> list[Outcome]:
    """The cells, with what differed where that can be read."""
    found = []
    for cell in cells:
        told = kept.get((cell.error, cell.state))
        try:
            made = None if told is None else outcome(cell.error, cell.state, from_json(told))
        except BadValue:
            made = None
        found.append(
            made or Outcome(cell.error, cell.state, VERDICTS.get(cell.verdict or ""), cell.first_effect)
        )  # fmt: skip
    return found


def merged(model: Model, cells: Iterable[CellRow], accepted: Collection[tuple[str, str]]) -> list[CellRow]:
    """One cell for each error instance and state: of several with other details the worst: what is not as it is required, then what
    nobody accepted."""
    found: dict[tuple[str, str], CellRow] = {}
    for cell in cells:
        key = key_for(model, cell.error), cell.state
        if key not in found or _rank(cell, accepted) < _rank(found[key], accepted):
            found[key] = cell
    return list(found.values())


def _rank(cell: CellRow, accepted: Collection[tuple[str, str]]) -> tuple[bool, bool, int]:
    verdict = VERDICTS.get(cell.verdict or "")
    place = len(WORST_FIRST) if verdict is None else WORST_FIRST.index(verdict)
    return not cell.unmet, (cell.error, cell.state) in accepted and verdict in FINDINGS, place
