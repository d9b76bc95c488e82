"""The objects of a body -> its networks, each in the order in which it runs."""

import re
from collections.abc import Iterator

from scanbench.syntax.plcopen.elements import LAST, Thing

_NAME = re.compile(r"(?<![\w.#])[A-Za-z_]\w*")
LEAVES = ("jump", "return")


def networks_of(things: list[Thing], ladder: bool = False, given: bool = False) -> Iterator[list[Thing]]:
    """What is connected, as one network each, from top to bottom; a power rail connects nothing. Inside they are in the order in which
    they run: sources before what they lead to, else by their place. Networks do not run in turn; rungs of a `ladder` may, where that changes
    nothing. `given`: the file has the whole order, also where a box then reads what an other one had in the scan before."""
    by_id = {each.id: each for each in things}
    leader = {each.id: each.id for each in things}

    def find(id: str) -> str:
        while leader[id] != id:
            leader[id] = leader[leader[id]]
            id = leader[id]
        return id

    rails = {each.id for each in things if each.kind in ("leftPowerRail", "rightPowerRail")}
    names: dict[str, str] = {}
    for each in things:
        if each.kind in ("connector", "continuation"):
            leader[find(each.id)] = find(names.setdefault(each.name.upper(), each.id))
        for id in (end for pin in each.inputs for end, _ in pin.ends if end in by_id):
            if id not in rails and each.id not in rails:
                leader[find(each.id)] = find(id)
    groups: dict[str, list[Thing]] = {}
    for each in things:
        if each.id not in rails and each.kind not in ("comment", "vendorElement", "error"):
            groups.setdefault(find(each.id), []).append(each)
    found = sorted(groups.values(), key=lambda one: min(each.place for each in one))
    yield from (ordered(group, given) for group in _apart(found, rails if ladder else set()))


def _apart(groups: list[list[Thing]], rails: set[str]) -> list[list[Thing]]:
    """Groups that run in turn are one network: what one writes, the other may read between two of its own boxes. What begins at a power
    rail is drawn as a rung of its own, and stays one where no such thing happens."""

    def one_network(before: list[Thing], group: list[Thing]) -> bool:
        last = max((each.place for each in before if each.kind != "inVariable"), default=None)
        if last is None or min(each.place for each in group) > last:
            return False
        drawn = (end in rails for each in (*before, *group) for pin in each.inputs for end, _ in pin.ends)
        return not any(drawn) or any(
            one.place > other.place and conflict(one, other, before + group) for one in before for other in group
        )

    made: list[list[Thing]] = []
    for group in groups:
        first = next((at for at, before in enumerate(made) if one_network(before, group)), len(made))
        made[first:] = [[*(each for before in made[first:] for each in before), *group]]
    return made


def ordered(group: list[Thing], given: bool = False) -> list[Thing]:
    """In the order of execution. Where there is a loop, what is first by its place goes on."""
    left = sorted(group, key=lambda each: (given and each.place[0] != LAST, each.place))
    known = {each.id for each in left if not given or each.place[0] == LAST}
    done: list[Thing] = []
    seen: set[str] = set()
    while left:
        ready = next(
            (
                each
                for each in left
                if all(end in seen or end not in known for pin in each.inputs for end, _ in pin.ends)
            ),
            left[0],
        )
        left.remove(ready)
        seen.add(ready.id)
        done.append(ready)
    return done


def conflict(one: Thing, other: Thing, group: list[Thing]) -> bool:
    """Whether one writes what the other reads or writes, or both leave the body: then their order matters. Names count without what
    follows their point, so that a block counts with its outputs."""
    if one.kind in LEAVES and other.kind in LEAVES:
        return True
    read, written = _names(one, group)
    also_read, also_written = _names(other, group)
    return bool(written & (also_read | also_written) or also_written & read)


def _names(each: Thing, group: list[Thing]) -> tuple[set[str], set[str]]:
    """What it reads, and what it writes."""
    match each.kind:
        case "coil" | "outVariable":
            return _of(each.name), _of(each.name)
        case "block":
            ends = {end for pin in each.inputs for end, _ in pin.ends}
            read = [one.name for one in group if one.id in ends and one.kind == "inVariable"]
            taken = [
                one.name for one in group if one.kind == "outVariable"
                for pin in one.inputs for end, _ in pin.ends if end == each.id
            ]  # fmt: skip
            pins = [pin.expression for pin in (*each.inputs, *each.outputs)]
            return _of(*read, *pins), _of(each.instance, *taken, *pins)
        case "contact" | "inVariable":
            return _of(each.name), set()
        case _:
            return set(), set()


def _of(*texts: str) -> set[str]:
    return {name.upper() for text in texts for name in _NAME.findall(text)}
