"""Hit counts: at which of its hits a breakpoint acts."""

import re
from dataclasses import dataclass

_TEXT = re.compile(r"\s*(=|==|>=|>|%)?\s*(\d{1,15})\s*")


@dataclass(frozen=True, slots=True)
class HitRule:
    """`3`, `= 3`: the third time alone; `>= 3`: from the third on; `> 3`: after it; `% 3`: every third."""

    sign: str
    number: int

    def holds(self, hits: int) -> bool:
        """Whether this hit counts, the first being 1."""
        match self.sign:
            case ">=":
                return hits >= self.number
            case ">":
                return hits > self.number
            case "%":
                return hits % self.number == 0
            case _:
                return hits == self.number


def parse_hits(text: str) -> HitRule | str | None:
    """The rule; None for no text; a sentence that says what is wrong with it."""
    if not text.strip():
        return None
    found = _TEXT.fullmatch(text)
    if found is None:
        return f"`{text.strip()}` is no hit count: write 3, = 3, >= 3 or % 3"
    sign, number = (found.group(1) or "=").replace("==", "="), int(found.group(2))
    if number == 0 and sign in ("=", "%"):
        return "hits are counted from 1: write 1 or more"
    return HitRule(sign, number)
