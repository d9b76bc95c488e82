"""What is wrong with a message or a body that is not of its shape, in a sentence for whoever sent it."""

from collections.abc import Mapping


def said(flaw: Mapping[str, object], place: str) -> str:
    """Of one of the errors that pydantic found, at `place` (`errors.0.id`, or nothing for all of it)."""
    type, given = str(flaw["type"]), flaw.get("ctx")
    about: Mapping[str, object] = given if isinstance(given, Mapping) else {}
    if type == "union_tag_invalid" and about:
        return f"there is no {about['tag']}; there are {str(about['expected_tags']).replace(chr(39), '')}"
    if type == "union_tag_not_found":
        return "type is missing"
    if type == "json_invalid":
        return f"this is not JSON that can be read: {about.get('error', '')}"
    if not place:
        return "something is missing" if type == "missing" else _kind(type, "this") or str(flaw["msg"])
    if type == "extra_forbidden":
        return f"{place} is unknown"
    if type == "missing":
        return f"{place} is missing"
    if type == "value_error":  # a sentence of ours
        return f"{place}: {about.get('error', flaw['msg'])}"
    return _bound(type, about, place) or _choice(type, about, place) or _kind(type, place) or f"{place}: {flaw['msg']}"


def _kind(type: str, place: str) -> str:
    """A value of a different kind; empty for any other flaw."""
    match type.split("_")[0]:
        case "int":
            return f"{place} has to be a whole number"
        case "float" | "finite" | "decimal":
            return f"{place} has to be a number"
        case "bool":
            return f"{place} has to be true or false"
        case "string" if type in ("string_type", "string_unicode", "string_sub_type"):
            return f"{place} has to be a text"
        case "list" | "tuple" | "set":
            return f"{place} has to be a list"
        case "dict" | "model" | "mapping" | "dataclass":
            return f"{place} has to be an object with names and values"
    return ""


def _choice(type: str, about: Mapping[str, object], place: str) -> str:
    """A value that is none of those which there are; empty for any other flaw."""
    if type not in ("literal_error", "enum"):
        return ""
    there_are = str(about["expected"]).replace("'", "").replace(" or ", ", ")
    return f"{place} has to be one of these: {there_are}"


def _bound(type: str, about: Mapping[str, object], place: str) -> str:
    """A value that is too long, short, large or small; empty for any other flaw."""
    match type:
        case "string_too_long":
            return f"{place}: at most {about['max_length']} characters"
        case "string_too_short":
            return f"{place}: at least {about['min_length']} characters"
        case "too_long":
            return f"{place}: at most {about['max_length']} entries"
        case "too_short":
            return f"{place}: at least {about['min_length']} entries"
        case "greater_than_equal":
            return f"{place}: at least {about['ge']}"
        case "less_than_equal":
            return f"{place}: at most {about['le']}"
        case "greater_than":
            return f"{place}: more than {about['gt']}"
        case "less_than":
            return f"{place}: less than {about['lt']}"
    return ""
