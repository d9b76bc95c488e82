"""Files of other tools that are no text of a program: what they are, and how their programs get here."""

import re

from scanbench.problems import Problem
from scanbench.syntax import tree
from scanbench.syntax.source import Source

HEAD = 4000
"""Characters at the beginning that say what a file is."""
ROOT = re.compile(r"\s*(?:<\?[^>]*>\s*|<!--.*?-->\s*|<!DOCTYPE[^>]*>\s*)*<([A-Za-z_][\w.:-]*)([^>]*)", re.DOTALL)
BINARY = ("PK\x03\x04", "\xd0\xcf\x11\xe0", "ÐÏ\x11à")
"""How archives begin, and the compound files of older tools."""
COPY = "copy the declarations and statements into a file .st"
ROOTS = {
    "rslogix5000content": f"a file of Rockwell's Studio 5000 (L5X); {COPY}: its tags become VAR_GLOBAL",
    "exportfile": f"an export of CODESYS (.export), which is not read; {COPY}",
    "tcsmproject": "a project file of TwinCAT; give the folder that it is in: the .TcPOU, .TcDUT and .TcGVL files are read",
    "document": f"a file of Siemens TIA Portal; export the block as source (.scl), or {COPY}",
}


def parse_foreign(source: Source) -> tuple[tree.File, list[Problem]] | None:
    """One message for a whole file of this kind; None for a text that may be a program."""
    what = _what(source.text[:HEAD])
    if what is None:
        return None
    return tree.File(source.name), [Problem("X001", f"This is {what}.", source.span(0, 1))]


def _what(head: str) -> str | None:
    head = head.lstrip("\ufeff")
    if head.startswith(BINARY):
        return f"an archive or the project file of a tool (CODESYS: .project), and no text; open it there and {COPY}"
    found = ROOT.match(head)
    if found is None:
        return None
    tag, attributes = found[1].rpartition(":")[2].lower(), found[2]
    if "plcopen.org" in attributes:
        return f"a PLCopen XML file, which is not read yet; open it in the tool that it is from and {COPY}"
    if tag == "project":
        return "a project file of Visual Studio (TwinCAT: .plcproj); give the folder that it is in: the .TcPOU, .TcDUT and .TcGVL files are read"
    return ROOTS.get(tag, f"XML (`{found[1][:40]}`), and no text of a program; {COPY}")
