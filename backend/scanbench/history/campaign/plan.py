"""Which disturbances a campaign tries: chosen by chance, the same for the same seed."""

from collections.abc import Sequence
from hashlib import blake2b
from typing import TypeVar

from scanbench.faults.disturb.definition import WRITING, Disturbance, DisturbanceKind, bits_of
from scanbench.history.campaign.contract import BadCampaign, CampaignWanted
from scanbench.history.places import inputs as inputs_of
from scanbench.program.bodies import every
from scanbench.program.program import Program
from scanbench.program.types import Elementary, StringType
from scanbench.symbols.sites import sites_of
from scanbench.symbols.symbols import Symbol, members, roots

T = TypeVar("T")
_TRIES = 100
"""For a variable that can be disturbed."""
_LONGEST = 20
"""Scans that an input is late or stuck, at most."""


class Draw:
    """Numbers that look like chance, the same on every machine."""

    def __init__(self, seed: int) -> None:
        self._seed, self._number = seed, 0

    def below(self, end: int) -> int:
        """From 0 on."""
        self._number += 1
        data = f"campaign/{self._seed}/{self._number}".encode()
        return int.from_bytes(blake2b(data, digest_size=8).digest(), "little") % end

    def one_of(self, all: Sequence[T]) -> T:
        """Any of them."""
        return all[self.below(len(all))]


def planned(program: Program, wanted: CampaignWanted) -> tuple[Disturbance, ...]:
    """So many disturbances. `BadCampaign` where the program has nothing that these kinds could disturb."""
    sites, inputs = _sites(program), inputs_of(program)
    variables = [each for each in roots(program) if each.type.size]
    there: dict[DisturbanceKind, bool] = {
        "flip": bool(variables), "result": bool(sites), "stuck": bool(inputs), "late": bool(inputs)
    }  # fmt: skip
    kinds = [each for each in wanted.kinds if there[each]]
    if not kinds:
        raise BadCampaign(f"the program has nothing to disturb in these ways: {', '.join(wanted.kinds)}")
    draw = Draw(wanted.seed)
    found = []
    for _ in range(wanted.count):
        kind = draw.one_of(kinds)
        scan = wanted.first + draw.below(wanted.last - wanted.first + 1)
        match kind:
            case "flip":
                symbol = _variable(program, variables, draw)
                found.append(Disturbance("flip", symbol.path, draw.below(bits_of(symbol)), scan=scan))
            case "result":
                found.append(Disturbance("result", site=draw.one_of(sites), scan=scan, seed=draw.below(1 << 32)))
            case _:
                scans = 1 + draw.below(_LONGEST)
                found.append(Disturbance(kind, draw.one_of(inputs), scan=scan, scans=scans))
    return tuple(found)


def _variable(program: Program, variables: Sequence[Symbol], draw: Draw) -> Symbol:
    """Any that is one value: from the roots down, so that a large array is no likelier than what is beside it."""
    for _ in range(_TRIES):
        symbol = draw.one_of(variables)
        while symbol.expandable:
            inside = members(program, symbol.path)
            if not inside:
                break
            symbol = draw.one_of(inside)
        if isinstance(symbol.type, Elementary | StringType) and not symbol.constant and not symbol.slots:
            return symbol
    raise BadCampaign("the program has hardly any variable in which a bit could turn over: choose other kinds")


def _sites(program: Program) -> list[str]:
    """The lines with a statement that writes something."""
    sites = sites_of(program)
    numbers = {sites.number(each) for pou in program.tasked for each in every(pou.body) if isinstance(each, WRITING)}
    spans = [sites.statements[each].span for each in numbers if each is not None]
    return [f"{file}:{line}" for file, line in sorted({(each.file, each.line) for each in spans})]
