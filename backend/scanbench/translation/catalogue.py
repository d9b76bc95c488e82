"""The files of a catalogue: an English template on a line of its own, and below it, indented, how it is said in the other language.

`{0}`, `{1}` are what a sentence is about, in the order of the English one. `{1-}` leaves an argument out, as an ending that the other language does not have.
This module imports nothing of ours: every room may use it.
"""

import re
from functools import cache
from importlib.resources import files

LANGUAGES = ("ja",)
"""Those that there is a catalogue of. English needs none: it is what everybody writes."""
PLACE = re.compile(r"\{(\d+)(-?)\}")


class BadCatalogue(ValueError):
    """A file that is not as the README says; the message says where."""


def read(name: str, text: str) -> dict[str, str]:
    """The pairs of one file."""
    pairs: dict[str, str] = {}
    english = ""
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip() or line.startswith("# "):
            continue
        said = line.strip().replace("\\n", "\n")
        if not line.startswith("    "):
            if english:
                raise BadCatalogue(f"{name}:{number}: the line above has no translation")
            if said in pairs:
                raise BadCatalogue(f"{name}:{number}: this is translated twice")
            english = said
        elif english:
            pairs[english] = said
            english = ""
        else:
            raise BadCatalogue(f"{name}:{number}: this translates nothing")
    if english:
        raise BadCatalogue(f"{name}: the last line has no translation")
    return pairs


@cache
def catalogue(language: str) -> dict[str, str]:
    """All of it, by the English template without the spaces around it."""
    pairs: dict[str, str] = {}
    for file in sorted(files("scanbench.translation").joinpath(language).iterdir(), key=lambda each: each.name):
        if file.name.endswith(".txt"):
            pairs.update(read(file.name, file.read_text("utf-8")))
    return pairs
