"""Errors that are present while a new program takes over: they must be the same errors in its catalogue.

Only the project's own errors can differ (`plcmodel.user_errors`). A present error that is missing in the new catalogue could
never be recovered; one that writes different bits now would leave the old bits set. So such a change is refused with a message.
"""

from collections.abc import Mapping

from scanbench.faults.details import Chosen, choose
from scanbench.faults.present import Active
from scanbench.faults.reference import ErrorRef
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.runtime.command import Refusal


def why_not_carried(present: Mapping[str, Active], old: Program, new: Program) -> str:
    """Why the errors that are present cannot go over from one program to the other; empty when they can."""
    if old.layout.model is new.layout.model:
        return ""
    gone = [id for id in present if new.layout.model.error(id) is None]
    changed = [id for id, error in present.items() if id not in gone and _differs(error, old.layout, new.layout)]
    parts = [f"{_are(gone)} generated, and the new program's catalogue does not have {_it(gone)}"] if gone else []
    if changed:
        parts.append(f"{_are(changed)} generated, and the new program's catalogue has {_it(changed)} otherwise")
    return f"{'; '.join(parts)}: recover {', '.join([*gone, *changed])} first" if parts else ""


def _are(ids: list[str]) -> str:
    return f"{', '.join(ids)} {'is' if len(ids) == 1 else 'are'}"


def _it(ids: list[str]) -> str:
    return "it" if len(ids) == 1 else "them"


def _differs(error: Active, old: Layout, new: Layout) -> bool:
    return any(_deeds(ref, old) != _deeds(ref, new) for ref in error.refs)


def _deeds(ref: ErrorRef, layout: Layout) -> object:
    """What the error does to the PLC."""
    entry = layout.model.error(ref.id)
    chosen = Refusal("") if entry is None else choose(entry, dict(ref.details), layout)
    if not isinstance(chosen, Chosen):
        return None
    error = chosen.error
    return chosen.bits, chosen.code, error.severity, error.priority, error.keeps_memory, chosen.lasting, chosen.details
