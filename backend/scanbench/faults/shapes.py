"""Faults with a shape in time: when they begin, how long they stay, how often they come back. All of it is journaled.

`Arm` enters what is wanted; from then on the journal says what is due (`ARMED`), and the resource enters each step as a
`Generate` or `Recover` of its own, so that a replay re-enters steps and never asks again.
"""

from dataclasses import dataclass
from typing import Literal

from scanbench.faults.reference import ErrorRef


@dataclass(frozen=True, slots=True)
class Start:
    """When it begins: now; before `scan`; when `condition` holds after a scan; when the statement at `file`:`line` was reached."""

    kind: Literal["now", "scan", "condition", "line"] = "now"
    scan: int | None = None
    condition: str = ""
    file: str = ""
    line: int = 0


@dataclass(frozen=True, slots=True)
class Shape:
    """How it goes on.

    stay: until somebody recovers it. for: recovered after `scans`. intermittent: a `period` of scans of which it is present
    `scans`, again and again, `times` times or until it is taken back; with a `seed` the two vary by chance around these, the
    same chance for the same seed. chatter: present and gone in turn, a scan each, `times` times. unacknowledged: recovered after `scans`, before anybody
    acknowledges it; at once when `acknowledge` holds first, and then the log says so. chance: while it is gone, it comes in each
    scan with a probability of `per_million` millionths, and is present for `scans`; which scans that are follows from `seed`.
    """

    kind: Literal["stay", "for", "intermittent", "chatter", "unacknowledged", "chance"] = "stay"
    scans: int = 1
    period: int = 2
    times: int | None = None
    seed: int | None = None
    acknowledge: str = ""
    per_million: int = 1_000


@dataclass(frozen=True, slots=True)
class Wanted:
    """Errors with a beginning and a shape; `gap` scans from one to the next, 0: all in one seam."""

    errors: tuple[ErrorRef, ...]
    start: Start = Start()
    shape: Shape = Shape()
    gap: int = 0


MOST = 1_000_000_000
"""Scans that a number of a shape may be at most: some months at 10 ms."""
MOST_SEED = (1 << 32) - 1
MILLION = 1_000_000
_MIX = 0x9E3779B97F4A7C15
_WORD = (1 << 64) - 1


def step_count(shape: Shape) -> int | None:
    """How many steps it has, the even ones raise and the odd ones recover; None: it ends when it is taken back."""
    match shape.kind:
        case "stay":
            return 1
        case "for" | "unacknowledged":
            return 2
    return None if shape.times is None else 2 * shape.times


def lasts(shape: Shape, step: int) -> int:
    """Scans from this step to the next one, at least 1; a function of the shape and the number of the step alone."""
    if shape.kind == "chatter":
        return 1
    if shape.kind == "chance":
        return shape.scans if step % 2 == 0 else _absent(shape, step)
    if shape.kind != "intermittent":
        return shape.scans
    mean = shape.scans if step % 2 == 0 else shape.period - shape.scans
    return mean if shape.seed is None else 1 + _chance(shape.seed, step) % (2 * mean - 1)


def waits_first(shape: Shape) -> int:
    """Scans from its beginning to its first step."""
    return _absent(shape, -1) - 1 if shape.kind == "chance" else 0


def flaw(wanted: Wanted) -> str | None:
    """What no scan can be made of, in words."""
    shape, start = wanted.shape, wanted.start
    numbers = {"scans": (shape.scans, 1), "gap": (wanted.gap, 0)}
    if shape.kind == "intermittent":
        numbers["period"] = (shape.period, 2)
    if shape.times is not None:
        numbers["times"] = (shape.times, 1)
    if shape.seed is not None:
        numbers["seed"] = (shape.seed, 0)
    for name, (number, least) in numbers.items():
        most = MOST_SEED if name == "seed" else MOST
        if not least <= number <= most:
            return f"{name} is {number}: it must be {least} to {most}"
    if shape.kind == "chance" and not 1 <= shape.per_million <= MILLION:
        return f"the probability is {shape.per_million} millionths: it must be 1 to {MILLION}"
    if shape.kind == "intermittent" and shape.scans >= shape.period:
        return (
            f"it would be present for {shape.scans} of every {shape.period} scans, so it would never go: "
            "make `scans` smaller than `period`, or let it stay"
        )
    if start.kind == "scan" and start.scan is None:
        return "say before which scan it begins"
    return None


def describe_shape(wanted: Wanted) -> str:
    """When and how, for people."""
    text = f"{_begins(wanted.start)}, {_goes(wanted.shape)}"
    if wanted.gap and len(wanted.errors) > 1:
        text += f", {_scans(wanted.gap)} from one to the next"
    return text


def _begins(start: Start) -> str:
    match start.kind:
        case "scan":
            return f"before scan {start.scan}"
        case "condition":
            return f"when {start.condition}"
        case "line":
            return f"when {start.file}:{start.line} was reached"
    return "now"


def _goes(shape: Shape) -> str:
    times = "" if shape.times is None else f", {shape.times} time{'s' * (shape.times != 1)}"
    match shape.kind:
        case "for":
            return f"for {_scans(shape.scans)}"
        case "chatter":
            return f"on and off in turn{times}"
        case "intermittent":
            chance = "" if shape.seed is None else f", varied by chance {shape.seed}"
            return f"{_scans(shape.scans)} of every {shape.period}{times}{chance}"
        case "chance":
            percent = f"{shape.per_million / 10_000:.4f}".rstrip("0").rstrip(".")
            return f"for {_scans(shape.scans)}, with a probability of {percent} % in each scan{times}, by chance {shape.seed or 0}"
        case "unacknowledged":
            first = f", unless {shape.acknowledge} comes first" if shape.acknowledge else ""
            return f"gone after {_scans(shape.scans)}, before it is acknowledged{first}"
    return "until it is recovered"


def _scans(count: int) -> str:
    return f"{count} scan{'s' * (count != 1)}"


def _absent(shape: Shape, step: int) -> int:
    """After how many scans it comes, at least 1: the first of independent trials that succeeds, found by halving. Whole numbers
    alone, so that every machine comes to the same."""
    drawn = _chance(shape.seed or 0, step)
    if shape.per_million >= MILLION:
        return 1
    stays = ((MILLION - shape.per_million) << 64) // MILLION
    low, high = 0, 1
    while _power(stays, high) > drawn and high < MOST:
        low, high = high, min(2 * high, MOST)
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if _power(stays, middle) > drawn else (low, middle)
    return high


def _power(base: int, exponent: int) -> int:
    """A fraction of 2**64 to a power, rounded down."""
    result = 1 << 64
    while exponent:
        if exponent & 1:
            result = result * base >> 64
        base = base * base >> 64
        exponent >>= 1
    return result


def _chance(seed: int, step: int) -> int:
    """A number of 64 bits that looks like chance (SplitMix64): the same on every machine."""
    value = (seed * 2 + 1) * _MIX + (step + 1) * _MIX & _WORD
    value = (value ^ value >> 30) * 0xBF58476D1CE4E5B9 & _WORD
    value = (value ^ value >> 27) * 0x94D049BB133111EB & _WORD
    return value ^ value >> 31
