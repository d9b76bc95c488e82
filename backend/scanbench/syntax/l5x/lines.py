"""What is written in a routine: its lines of Structured Text, or the rungs of its ladder."""

import re
from collections.abc import Iterator

from scanbench.syntax.xml_tree import Element, attribute, child, children, kind, text_of

_BEGIN = re.compile(r"\A[ \t]*\n")
_END = re.compile(r"\n[ \t]*\Z")


def written(routine: Element) -> str:
    """The text of a routine, with the lines that Studio 5000 numbers."""
    if attribute(routine, "Type") == "ST":
        return "\n".join(_lines(child(routine, "STContent")))
    return "\n".join(text for text, _ in rungs(routine))


def rungs(routine: Element) -> list[tuple[str, str]]:
    """Those of a ladder, each as it is written, and its comment."""
    found = children(child(routine, "RLLContent"), "Rung")
    return [(text_of(child(each, "Text")).strip(), text_of(child(each, "Comment")).strip()) for each in found]


def contents(routine: Element) -> int:
    """How many versions of itself a routine has: more than one, where it is edited online."""
    return sum(1 for _ in children(routine, "STContent", "RLLContent"))


def _lines(content: Element | None) -> Iterator[str]:
    """Each `Line`, and text outside of them, which Studio does not write, but other tools do: each of its lines is one."""
    if content is None:
        return
    if (content.text or "").strip():
        yield from _bare(content.text or "")
    for each in content:
        if kind(each) == "Line":
            yield _END.sub("", _BEGIN.sub("", text_of(each)))
        if (each.tail or "").strip():
            yield from _bare(each.tail or "")


def _bare(text: str) -> list[str]:
    return _END.sub("", _BEGIN.sub("", text)).split("\n")
