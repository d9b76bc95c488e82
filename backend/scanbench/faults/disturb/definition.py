"""What is to go wrong with the control device, and when: the definition of a disturbance, and what is wrong with one."""

import math
from dataclasses import dataclass
from hashlib import blake2b
from typing import Literal, get_args

from scanbench.faults.lines import find_line
from scanbench.program.bodies import every
from scanbench.program.program import Assign, CallBlock, Evaluate, For, Program, SetBytes
from scanbench.program.types import BOOL, Elementary, StringType
from scanbench.runtime.command import Refusal, View
from scanbench.runtime.target import find
from scanbench.symbols.sites import sites_of
from scanbench.symbols.symbols import Symbol

DisturbanceKind = Literal["flip", "late", "stuck", "result"]
FOR_EVER = 1_000_000
"""So many scans mean: until it is taken back."""
MOST_SEED = (1 << 63) - 1
_NEVER = 1 << 62
WRITING = (Assign, SetBytes, CallBlock, Evaluate, For)


@dataclass(frozen=True, slots=True)
class Disturbance:
    """flip: one bit of memory is turned over. late: an input keeps what it had for `scans` scans, then the real value comes.
    stuck: the same, as of an input that is broken. result: of what a statement writes a bit is turned over."""

    kind: DisturbanceKind
    path: str = ""
    """flip, late, stuck: variable or address; late and stuck without: all inputs of the model."""
    bit: int | None = None
    """flip, result: of the value, from 0; None: any, by the seed."""
    site: str = ""
    """result: `Main.st:34`."""
    scan: int | None = None
    """In which scan; None: the next one."""
    probability: float = 0.0
    """Of each scan, from `scan` on; 0: once."""
    seed: int = 0
    scans: int = 1
    """late, stuck: how long; stuck with `FOR_EVER`: until it is taken back."""
    times: int = 0
    """With a probability: at most so often; 0: for ever."""

    @property
    def lasts(self) -> int | None:
        """Scans for which an input is held; None: until it is taken back."""
        return None if self.kind == "stuck" and self.scans >= FOR_EVER else self.scans


def describe(wanted: Disturbance) -> str:
    """What and when, for people: `Memory D120, bit 0, once in scan 500`."""
    bit = "any bit" if wanted.bit is None else f"bit {wanted.bit}"
    what = f"{what_of(wanted.kind, wanted.path, wanted.site)}"
    match wanted.kind:
        case "late":
            what += f" late by {_scans(wanted.scans)}"
        case "stuck":
            what += " stuck until taken back" if wanted.lasts is None else f" stuck for {_scans(wanted.scans)}"
        case _:
            what += f", {bit}"
    if not wanted.probability:
        return what + ("" if wanted.scan is None else f", once in scan {wanted.scan:,}")
    begin = "" if wanted.scan is None else f" from scan {wanted.scan:,} on"
    times = f", at most {wanted.times} time{'s' * (wanted.times != 1)}" if wanted.times else ""
    return f"{what}, with probability {wanted.probability:g} of each scan{begin}, seed {wanted.seed}{times}"


def what_of(kind: DisturbanceKind, path: str, site: str) -> str:
    """`Memory D120`, `Input 0.03`, `Result of Main.st:34`."""
    if kind == "result":
        return f"Result of {site}"
    if kind == "flip":
        return f"Memory {path}"
    return f"Input {path}" if path else "All inputs"


def chance(wanted: Disturbance, number: int, time: int, what: str) -> int:
    """A number of 64 bits that looks like chance: the same for the same seed, disturbance and time, on every machine."""
    return int.from_bytes(blake2b(f"{wanted.seed}/{number}/{time}/{what}".encode(), digest_size=8).digest(), "little")


def next_firing(wanted: Disturbance, number: int, time: int, first: int) -> int | None:
    """The scan in which it comes the next time, not before `first`, when it was tried `time` times; None: never.

    Computed at once and not scan by scan, so that the PLC can run up to there at its full speed.
    """
    if not wanted.probability:
        return first if time == 0 else None
    if wanted.probability >= 1:
        return first
    drawn = (chance(wanted, number, time, "scan") + 1) / (1 << 64)
    scans = math.log(drawn) / math.log1p(-wanted.probability)  # infinite for the least of probabilities
    return first + int(scans) if first + scans < _NEVER else None


def bits_of(symbol: Symbol) -> int:
    """How many bits its value has."""
    return 1 if symbol.type == BOOL else 8 * symbol.type.size


def place_of(site: str) -> tuple[str, int] | Refusal:
    """File and line of `Main.st:34`."""
    file, colon, line = site.strip().rpartition(":")
    if not colon or not line.isdigit():
        return Refusal(f"`{site}` is no place of the program: write file and line, as `Main.st:34`")
    return file, int(line)


def single_value(view: View, path: str) -> Symbol | Refusal:
    """The variable or address of this path, which has to be one value."""
    symbol = find(view, path)
    if isinstance(symbol, Refusal):
        return symbol
    if not isinstance(symbol.type, Elementary | StringType):
        return Refusal(f"{symbol.path} is {symbol.type.name}, not a single value: name one of its members instead")
    if symbol.constant:
        return Refusal(
            f"{symbol.path} is a constant: it is part of the code, no bit of it is in memory that could turn over"
        )
    return symbol


def flaw(wanted: Disturbance, view: View) -> Refusal | None:
    """Why this cannot be: what is wrong, and what to do."""
    return _bad_numbers(wanted) or _bad_time(wanted, view) or _bad_place(wanted, view)


def _bad_numbers(wanted: Disturbance) -> Refusal | None:
    if wanted.kind not in get_args(DisturbanceKind):
        return Refusal(f"{wanted.kind} is no kind of disturbance", get_args(DisturbanceKind))
    if not 0 <= wanted.probability <= 1:
        return Refusal(f"the probability is {wanted.probability:g}: it must be 0 (once) to 1 (in each scan)")
    limits = {
        "seed": (wanted.seed, 0, MOST_SEED),
        "scans": (wanted.scans, 1, FOR_EVER),
        "times": (wanted.times, 0, FOR_EVER),
    }
    for name, (number, least, most) in limits.items():
        if not least <= number <= most:
            return Refusal(f"{name} is {number}: it must be {least} to {most}")
    if wanted.times and not wanted.probability:
        return Refusal(
            f"{wanted.times} times of what? Give a probability of each scan, or leave `times` at 0: it comes once"
        )
    if wanted.bit is not None and wanted.kind in ("late", "stuck"):
        return Refusal(f"an input that is {wanted.kind} is so with all its bits: name the bit in its path, as `0.03`")
    return None


def _bad_time(wanted: Disturbance, view: View) -> Refusal | None:
    if wanted.scan is not None and wanted.scan < view.header.scan:
        return Refusal(f"scan {wanted.scan} is over: the PLC is at scan {view.header.scan}")
    return None


def _bad_place(wanted: Disturbance, view: View) -> Refusal | None:
    if wanted.kind == "result":
        found = writing_sites(view.statements, wanted.site)
        return found if isinstance(found, Refusal) else _bad_bit(view.statements, found, wanted)
    if wanted.kind == "flip" and not wanted.path.strip():
        return Refusal("say of which variable or address a bit is to turn over, as `D120` or `Main.count`")
    if not wanted.path.strip():
        if any(each.letter == "I" for each in view.model.iec_maps):
            return None
        return Refusal(
            f"{view.model.name} has no area of inputs: name the variable or address that is to be {wanted.kind}"
        )
    symbol = single_value(view, wanted.path)
    if isinstance(symbol, Refusal):
        return symbol
    bits = bits_of(symbol)
    if wanted.bit is not None and wanted.bit >= bits:
        has = "bit 0 only" if bits == 1 else f"bits 0 to {bits - 1}"
        return Refusal(f"{symbol.path} is {symbol.type.name} and has {has}: there is no bit {wanted.bit}")
    return None


def _bad_bit(program: Program, found: frozenset[int], wanted: Disturbance) -> Refusal | None:
    """Of assignments alone it is known before they run how large their result is."""
    sites = sites_of(program)
    writing = [stmt for pou in program.tasked for stmt in every(pou.body) if sites.number(stmt) in found]
    types = [each.target.type for each in writing if isinstance(each, Assign)]
    if wanted.bit is None or len(types) < len(writing) or not all(isinstance(each, Elementary) for each in types):
        return None
    bits = max((1 if each == BOOL else 8 * each.size for each in types), default=0)
    if not bits or wanted.bit < bits:
        return None
    has = "bit 0 only" if bits == 1 else f"bits 0 to {bits - 1}"
    return Refusal(f"the result of {wanted.site} has {has}: there is no bit {wanted.bit}")


def writing_sites(program: Program, site: str) -> frozenset[int] | Refusal:
    """The statements of a line that write anything."""
    place = place_of(site)
    if isinstance(place, Refusal):
        return place
    found = find_line(program, *place)
    if isinstance(found, Refusal):
        return found
    sites = sites_of(program)
    numbers = {sites.number(stmt) for pou in program.tasked for stmt in every(pou.body) if isinstance(stmt, WRITING)}
    writing = frozenset(found) & frozenset(each for each in numbers if each is not None)
    if not writing:
        return Refusal(f"the statement at {site} writes nothing itself: name a line with an assignment or a call")
    return writing


def _scans(count: int) -> str:
    return f"{count:,} scan{'s' * (count != 1)}"
