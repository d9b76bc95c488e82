"""Which fields of the debugger's messages hold a sentence of Scanbench; what the program or its author says passes as it is."""

from scanbench.translation.inside import Path, at_paths

_OF: dict[object, tuple[Path, ...]] = {
    "breakpoint": (("body", "breakpoint", "message"),),
    "exceptionInfo": (("body", "description"),),
    "initialize": (("body", "exceptionBreakpointFilters", "*", "description"),),
    "stopped": (("body", "description"), ("body", "text")),
}
"""By event, or by the command that is answered."""
_ENTERED = ("scanbench/force", "scanbench/release", "scanbench/raise")
_REFUSED: tuple[Path, ...] = (("message",), ("body", "error", "format"))


def said(message: dict[str, object], language: str) -> dict[str, object]:
    """A message to a client, with what Scanbench says in it in this language."""
    if language == "en":
        return message
    done = at_paths(message, _paths(message), language)
    assert isinstance(done, dict)
    return done


def _paths(message: dict[str, object]) -> tuple[Path, ...]:
    if message.get("success") is False:
        return _REFUSED
    name, body = message.get("event", message.get("command")), message.get("body")
    if not isinstance(body, dict):
        return ()
    if name == "output":
        by_author = "breakpoint" in (body.get("scanbench") or {})  # the text of a logpoint
        return () if by_author else (("body", "output"),)
    if name == "dataBreakpointInfo":
        return () if body.get("dataId") is not None else (("body", "description"),)
    if isinstance(name, str) and name.startswith("set") and name.endswith("Breakpoints"):
        return (("body", "breakpoints", "*", "message"),)
    return (("body", "message"),) if name in _ENTERED else _OF.get(name, ())
