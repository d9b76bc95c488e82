"""Files of other tools that are no text of a program: what they are, and how their programs get here."""

import re

from scanbench.problems import Problem
from scanbench.syntax import tree
from scanbench.syntax.source import Source

HEAD = 4000
"""Characters at the beginning that say what a file is."""
ROOT = re.compile(
    r"\s*(?:<\?[^>]*>\s*|<!--.*?-->\s*|<!DOCTYPE[^\[>]*(?:\[.*?\]\s*)?>\s*)*<([A-Za-z_][\w.:-]*)([^>]*)", re.DOTALL
)
BINARY = ("PK\x03\x04", "\xd0\xcf\x11\xe0", "\ufffd\ufffd\x11\ufffd")
"""How archives begin, and the compound files of older tools; also where their bytes were no text."""
ROOTS = {
    "rslogix5000content": (
        "This is a file of Rockwell's Studio 5000 (L5X). Import it: `scanbench import FILE DIR`, or New project in the page."
    ),
    "exportfile": "This is an export of CODESYS (.export), which is not read. Copy the declarations and statements into a file .st.",
    "document": "This is a file of the TIA Portal, which is not read. Copy the declarations and statements into a file .st.",
    "tcsmproject": (
        "This is a project file of TwinCAT. Give the folder that it is in: its .TcPOU, .TcDUT and .TcGVL files are read."
    ),
    "project": (
        "This is a project file of TwinCAT. Give the folder that it is in: its .TcPOU, .TcDUT and .TcGVL files are read."
    ),
}


def parse_foreign(source: Source) -> tuple[tree.File, list[Problem]] | None:
    """One message for a whole file of this kind; None for a text that may be a program."""
    message = _what(source.text[:HEAD])
    return None if message is None else (tree.File(source.name), [Problem("X001", message, source.span(0, 1))])


def _what(head: str) -> str | None:
    head = head.lstrip("\ufeff")
    if head.startswith(BINARY):
        return (
            "This is an archive or the project of a tool (CODESYS: .project), and no text. Open it there, and copy the "
            "declarations and statements into a file .st."
        )
    found = ROOT.match(head)
    if found is None:
        return None
    if "plcopen.org" in found[2] or "TC65SC65BWG7TF10" in found[2]:
        return "This is a PLCopen XML file. Import it: `scanbench import FILE DIR`, or New project in the page."
    known = ROOTS.get(found[1].rpartition(":")[2].lower())
    return known or (
        f"This is XML (`{found[1][:40]}`), and no text of a program. Copy the declarations and statements into a file .st."
    )
