"""A text with marks, read as a project: `|` is where somebody asks."""

from scanbench.language.reading import Reading, Readings
from tests.caseformat import MODELS

FILE = "main.st"


def marked(text: str, model: str = "GENERIC-IEC", **others: str) -> tuple[Reading, int]:
    """The reading of a text without its mark, and where the mark was. `others`: more files by name without their ending."""
    position = text.index("|")
    files = {FILE: text.replace("|", "", 1), **{f"{name}.st": each for name, each in others.items()}}
    return Readings(MODELS[model]).read(files), position


def read(text: str, **others: str) -> Reading:
    """The same without a mark."""
    files = {FILE: text, **{f"{name}.st": each for name, each in others.items()}}
    return Readings(MODELS["GENERIC-IEC"]).read(files)


def at(reading: Reading, text: str, number: int = 0) -> int:
    """The position of the n-th occurrence of a text in the file, from 0."""
    position = -1
    for _ in range(number + 1):
        position = reading.text(FILE).index(text, position + 1)
    return position
