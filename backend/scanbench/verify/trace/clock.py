"""Times as tools write them: a number of some unit, a date and time of day, or a time of day alone."""

import re
from collections.abc import Sequence
from datetime import date
from decimal import Decimal, InvalidOperation

_DATE = r"(?:(?P<y>\d{4})[-/.](?P<m>\d{1,2})[-/.](?P<d>\d{1,2})|(?P<a>\d{1,2})(?P<sep>[-/.])(?P<b>\d{1,2})[-/.](?P<y2>\d{4}))"
_TIME = (
    r"(?P<hh>\d{1,2})[:.](?P<mm>\d{2})[:.](?P<ss>\d{2})(?:[.,;:](?P<part>\d{1,9}))?(?:\s*(?P<half>[AaPp])\.?[Mm]\.?)?"
)
_BOTH = re.compile(
    rf"(?:DT#|DATE_AND_TIME#)?{_DATE}(?:[T ,/_-]\s*|\s+){_TIME}(?:Z|[+-]\d{{2}}:?\d{{2}})?", re.IGNORECASE
)
_ALONE = re.compile(rf"(?:TOD#)?{_TIME}", re.IGNORECASE)
_DAY = re.compile(_DATE)
_COMMA = re.compile(r"([+-]?\d*),(\d+(?:[eE][+-]?\d+)?)")
DAY = 86_400


def number(text: str, comma: bool) -> Decimal:
    """The decimal number in the text of a cell. Raises ValueError with the notation that is expected."""
    plain = text.strip().replace("\u2212", "-")
    found = _COMMA.fullmatch(plain)
    if found is not None:
        if not comma:
            raise ValueError(f"`{text}` has a comma: write the number with a decimal point")
        plain = f"{found.group(1)}.{found.group(2)}"
    try:
        value = Decimal(plain)
    except InvalidOperation:
        raise ValueError(f"`{text}` is not a number") from None
    if not value.is_finite():
        raise ValueError(f"`{text}` is not a finite number")
    return value


def is_date(text: str) -> bool:
    """Whether it is a date without a time of day."""
    return _DAY.fullmatch(text.strip()) is not None


def is_clock(text: str) -> bool:
    """Whether it is a date and time of day, or a time of day."""
    return _clock(text) is not None


def clock(text: str) -> tuple[int | None, Decimal]:
    """The day, as a number that counts days, or None where the text has none; and the seconds since midnight. A date of two
    numbers and a year has the month first with `/`, the day first otherwise, unless only the other way round is a date.
    Raises ValueError."""
    found = _clock(text)
    if found is None:
        raise ValueError(f"`{text}` is no date and time of day, as 2026-11-28 10:15:20.125 is")
    return found


def seconds(texts: Sequence[str]) -> list[Decimal]:
    """The times of a column in seconds, the first one is 0. Of times of day alone one that goes back by more than half a day is
    of the next day. Raises ValueError."""
    found: list[Decimal] = []
    first: Decimal | None = None
    days, last = 0, Decimal(0)
    for text in texts:
        day, second = clock(text)
        if day is None:
            days += 1 if second < last - DAY // 2 else 0
            last = second
        at = (days if day is None else day) * DAY + second
        first = at if first is None else first
        found.append(at - first)
    return found


def times_of(texts: Sequence[str], comma: bool) -> list[Decimal] | None:
    """The numbers or clock times of a column, so that they can be put in order; None where some text is neither."""
    try:
        return [number(each, comma) for each in texts]
    except ValueError:
        pass
    try:
        return seconds(texts)
    except ValueError:
        return None


def _clock(text: str) -> tuple[int | None, Decimal] | None:
    plain = text.strip().strip('"')
    both = _BOTH.fullmatch(plain)
    found = both or _ALONE.fullmatch(plain)
    if found is None:
        return None
    hours, minutes, whole = int(found["hh"]), int(found["mm"]), int(found["ss"])
    if found["half"]:
        hours = hours % 12 + (12 if found["half"].lower() == "p" else 0)
    if hours > 24 or minutes > 59 or whole > 60:
        return None
    part = Decimal(f"0.{found['part']}") if found["part"] else Decimal(0)
    day = _ordinal(found) if both else None
    if both and day is None:
        return None
    return day, hours * 3600 + minutes * 60 + whole + part


def _ordinal(found: re.Match[str]) -> int | None:
    if found["y"]:
        tries = [(found["y"], found["m"], found["d"])]
    else:
        one, other = found["a"], found["b"]
        tries = [(found["y2"], one, other), (found["y2"], other, one)]
        if found["sep"] != "/":
            tries.reverse()
    for year, month, day in tries:
        try:
            return date(int(year), int(month), int(day)).toordinal()
        except ValueError:
            continue
    return None
