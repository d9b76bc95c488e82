"""One file of a project -> tree, whatever it is written in: the ending of its name says how to read it."""

import re

from scanbench.problems import Problem
from scanbench.syntax import tree
from scanbench.syntax.foreign_files import parse_foreign
from scanbench.syntax.objects import is_object, parse_object
from scanbench.syntax.parse_st import parse_st
from scanbench.syntax.parse_stimulus import parse_stimulus
from scanbench.syntax.scl import ENDINGS as SCL_ENDINGS
from scanbench.syntax.scl import is_scl, parse_scl
from scanbench.syntax.source import Source
from scanbench.syntax.tcpou import parse_tc

TEXT_ENDINGS = (".st", ".iecst", ".exp")
"""Plain text; `.exp` is what older CODESYS exports."""
XML_ENDINGS = (".tcpou", ".tcdut", ".tcgvl", ".tcio")
ENDINGS = TEXT_ENDINGS + XML_ENDINGS + SCL_ENDINGS
"""Of the names of program files, in lower case."""
EXPORTED = re.compile(r"\s*(<\?xml[^>]*>\s*)?<TcPlcObject\b")
MAX_SIZE = 8_000_000
"""Characters of one file: 200,000 lines and more."""


STIMULUS_ENDING = ".csv"


def is_program_file(path: str) -> bool:
    """Whether a file of this path is part of a program, or in `plant/` and a stimulus."""
    return path.lower().endswith(ENDINGS) or (is_in_plant(path) and is_stimulus(path))


def is_in_plant(path: str) -> bool:
    """Whether a file of this path drives the inputs, and is no part of the program."""
    return "plant" in path.replace("\\", "/").lower().split("/")[:-1]


def is_stimulus(name: str) -> bool:
    """Whether it is a table of inputs by scan or time."""
    return name.lower().endswith(STIMULUS_ENDING)


def is_exported(name: str, text: str) -> bool:
    """Whether it is a file of TwinCAT: by its name, or by its first characters when the text was pasted into a file of a different name."""
    return name.lower().endswith(XML_ENDINGS) or EXPORTED.match(text) is not None


def parse_file(source: Source) -> tuple[tree.File, list[Problem]]:
    """The tree of what could be read, and every problem on the way, in the order of the text."""
    if len(source.text) > MAX_SIZE:
        message = f"This file has more than {MAX_SIZE:,} characters; split it up."
        return tree.File(source.name), [Problem("S003", message, source.span(0, 1))]
    if is_stimulus(source.name):
        return parse_stimulus(source)
    if is_exported(source.name, source.text):
        return parse_tc(source)
    if is_object(source.name, source.defined):
        return parse_foreign(source) or parse_object(source)
    return parse_foreign(source) or (parse_scl(source) if is_scl(source.name) else parse_st(source))
