"""Where the compiler embedded a check of a subrange, and where it proved that none is needed."""

from collections import Counter
from dataclasses import dataclass

from scanbench.language.reading import Reading


@dataclass(frozen=True, slots=True)
class Embedded:
    """One of them, after the expression that is checked."""

    position: int
    label: str
    about: str


def embedded(reading: Reading, file: str, start: int, end: int) -> list[Embedded]:
    """Those of a stretch of a file; none while the program has errors. Where two expressions end together, each is named."""
    sites = [
        (reading.position(file, each.span.end_line, each.span.end_column), each)
        for each in reading.checked.checks
        if each.span.file == file
    ]
    together = Counter(position for position, _ in sites)
    found = []
    for position, each in sites:
        if start <= position <= end:
            limits = f"{each.low}..{each.high}"
            label = f"{'✓' if each.needless else '⊂'} {limits}"
            if each.needless:
                about = f"No check necessary for `{each.variable}`: {each.needless}"
            else:
                about = f"Checked at run time: `{each.variable}` must be in {limits}"
            found.append(Embedded(position, f"{each.variable} {label}" if together[position] > 1 else label, about))
    return found
