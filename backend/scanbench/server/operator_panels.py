"""Operator panels: files of a project that the page draws and writes. No program has them: a build leaves them out."""

import json

from scanbench.wire.refused import Refused

PANEL_ENDING = ".panel.json"
"""Of the names of panels, in lower case. The text is JSON; `frontend/src/logic/operator/panel.ts` has its fields."""


def is_panel_file(path: str) -> bool:
    """Whether a file of a project is an operator panel."""
    return path.lower().endswith(PANEL_ENDING)


def refuse_broken(path: str, text: str) -> None:
    """A panel that is no JSON object is not saved: `Refused` says where it is broken. Of the fields the page alone knows."""
    try:
        panel = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise Refused(f"{path} is no JSON text: {error}") from error
    if not isinstance(panel, dict):
        raise Refused(f"{path} is no operator panel: its text has to be a JSON object")
