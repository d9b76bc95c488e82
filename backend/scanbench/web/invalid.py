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
    bound = _bound(str(flaw["type"]), about if isinstance(about, Mapping) else {}, place)
    if bound:
        return bound
    return f"{place}: {flaw['msg']}" if place else str(flaw["msg"])


def _bound(type: str, about: Mapping[str, object], place: str) -> str:
    """A value that is too long, short, large or small; empty for any other flaw."""
    if not place:
        return ""
    match type:
        case "string_too_long":
            return f"{place}: at most {about['max_length']} characters"
        case "string_too_short":
            return f"{place}: at least {about['min_length']} characters"
        case "greater_than_equal":
            return f"{place}: at least {about['ge']}"
        case "less_than_equal":
            return f"{place}: at most {about['le']}"
        case "greater_than":
            return f"{place}: more than {about['gt']}"
        case "less_than":
            return f"{place}: less than {about['lt']}"
    return ""
