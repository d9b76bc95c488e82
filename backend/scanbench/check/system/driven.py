"""What the columns of tables of inputs drive, so that no two of them drive the same."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from scanbench.check.context import Report
from scanbench.problems import Span
from scanbench.program.program import Place, Pou


@dataclass(frozen=True, slots=True)
class Driven:
    """What one column drives: its place is always the same."""

    place: Place
    text: str
    span: Span


@dataclass(slots=True)
class Taken:
    """Who drives which bits."""

    _bytes: dict[tuple[str, int], list[tuple[int, Driven]]] = field(default_factory=dict)

    def take(self, driven: Driven) -> Driven | None:
        """Notes what this column drives; the first one that drives some of it already."""
        place, found = driven.place, None
        size = 1 if place.bit is not None else place.type.size
        mask = 0xFF if place.bit is None else 1 << place.bit
        for offset in range(place.offset, place.offset + size):
            others = self._bytes.setdefault((place.variable, offset), [])
            found = found or next((other for bits, other in others if bits & mask), None)
            others.append((mask, driven))
        return found


def warn_of_contention(report: Report, tables: Mapping[Pou, Sequence[Driven]]) -> None:
    """Tables run in the order of their files: where two drive the same, what the first one says has no effect."""
    taken, told = Taken(), set[Span]()
    for pou in sorted(tables, key=lambda each: each.span.file):
        for driven in tables[pou]:
            other = taken.take(driven)
            if other is not None and other.span not in told:
                told.add(other.span)
                report.warn(
                    "W001",
                    f"`{other.text}` is driven by {driven.span.file} too, which comes later in every scan, so its values win.",
                    other.span,
                )
