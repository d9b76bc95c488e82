"""The error simulator's dataclasses -> wire shapes, and back. Nothing is decided here."""

from collections.abc import Iterable, Mapping, Sequence

from scanbench.faults.history import RowReaction, Swept
from scanbench.plcmodel import model as plc
from scanbench.plcmodel.hardware import can_be_absent
from scanbench.web import messages_errors as wire
from scanbench.wire.host import Ack
from scanbench.wire.refused import Refused


def in_short(of: RowReaction | None) -> wire.ReactionState | None:
    """A reaction in a row of the history."""
    if of is None:
        return None
    return wire.ReactionState(state=of.state, verdict=of.verdict, scans=of.scans, unmet=of.unmet, message=of.message)


def swept(of: Swept | None) -> wire.ReactionState | None:
    """What a sweep found out, in a row of the history."""
    if of is None:
        return None
    return wire.ReactionState(state="done", verdict=of.verdict, scans=of.scans, unmet=of.unmet, message="")


Facts = Mapping[str, Sequence[plc.Fact]]
"""By the id of the error."""


def facts_by_error(model: plc.Model) -> Facts:
    """What the model states about each of its errors."""
    found: dict[str, list[plc.Fact]] = {}
    for fact in model.facts:
        if fact.kind == "error":
            found.setdefault(fact.subject, []).append(fact)
    return found


def groups(of: Iterable[plc.ErrorGroup], facts: Facts) -> list[wire.ErrorGroup]:
    """The catalogue."""
    return [
        wire.ErrorGroup(
            name=group.name, groups=groups(group.groups, facts),
            errors=[_error(error, () if error.user else facts.get(error.id, ())) for error in group.errors],
            wordings=_wordings(group.wordings),
        )
        for group in of
    ]  # fmt: skip


def _error(error: plc.ErrorEntry, facts: Iterable[plc.Fact]) -> wire.ErrorInfo:
    return wire.ErrorInfo(
        id=error.id, name=error.name, description=error.description, code=error.code_text, flag=error.flag_text,
        severity=error.severity, priority=error.priority, verified=error.verified, source=error.source,
        facts=[
            wire.Fact(of=each.of, value=each.value, source=each.source, verified=each.verified, inherited=each.inherited)
            for each in facts
        ],
        details=list(map(_detail, error.details)), absent=can_be_absent(error), user=error.user, wordings=_wordings(error.wordings),
    )  # fmt: skip


def _detail(detail: plc.ErrorDetail) -> wire.ErrorDetail:
    first = detail.addresses[0]
    is_list = detail.control == "List"
    return wire.ErrorDetail(
        name=detail.name, control=detail.control, kind=first.kind,
        description=detail.description or first.description,
        address="" if is_list else first.text, choices=list(map(_choice, detail.addresses)) if is_list else [],
        minimum=None if is_list else first.minimum, maximum=None if is_list else first.maximum,
        default=(detail.default or "") if is_list else _default(first), base=first.base,
        adds=not is_list and first.add_to_code, wordings=_wordings(detail.wordings or first.wordings),
        identifies=detail.identifies, hardware=detail.hardware,
    )  # fmt: skip


def _choice(address: plc.ErrorAddress) -> wire.ErrorChoiceInfo:
    return wire.ErrorChoiceInfo(
        id=address.id, description=address.description, address=address.text,
        adds=address.value if address.add_to_code else None, wordings=_wordings(address.wordings),
    )  # fmt: skip


def _default(address: plc.ErrorAddress) -> str:
    number = address.default if address.default is not None else address.minimum or 0
    return f"{number:X}" if address.base == 16 else str(number)


def _wordings(of: Iterable[plc.Wording]) -> list[wire.Wording]:
    return [wire.Wording(language=each.language, name=each.name, description=each.description) for each in of]


def command_result(ack: Ack) -> wire.CommandResult:
    """What became of a command that came by REST; `Refused` says why nothing did."""
    if not ack.ok:
        raise Refused(ack.message, ack.near)
    return wire.CommandResult(ok=True, message=ack.message, scan=ack.scan, near=list(ack.near))
