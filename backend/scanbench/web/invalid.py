"""What is wrong with a message or a body that is not of its shape, in a sentence for whoever sent it."""

from collections.abc import Mapping


def said(flaw: Mapping[str, object], place: str) -> str:
    """Of one of the errors that pydantic found, at `place` (`errors.0.id`, or nothing for all of it)."""
    about = flaw.get("ctx")
    if flaw["type"] == "union_tag_invalid" and isinstance(about, Mapping):
        return f"there is no {about['tag']}; there are {str(about['expected_tags']).replace(chr(39), '')}"
    if flaw["type"] == "union_tag_not_found":
        return "type is missing"
    if flaw["type"] == "extra_forbidden":
        return f"{place} is unknown"
    return f"{place}: {flaw['msg']}" if place else str(flaw["msg"])
