"""A ladder of connected objects -> the text of a rung: series and parallel branches, and links for what is neither.

The objects become edges between points, labelled with text. Points with one edge in and one out are taken away, edges between the same points
become parallel branches, dead ends become branches of their own; where nothing of this is left to do, a point is cut by links.
"""

import re
from dataclasses import dataclass, field
from itertools import combinations

from scanbench.syntax.plcopen.diagram import formal, result_of
from scanbench.syntax.plcopen.elements import Pin, Thing
from scanbench.syntax.plcopen.grouping import conflict

RAIL, END = "rail", "end"
SIGNS = {"EQ": "=", "NE": "<>", "LT": "<", "LE": "<=", "GT": ">", "GE": ">="}
OPERATORS = frozenset(("AND", "OR", "XOR", "NOT", "MOD"))
"""Words of the language, which are no boxes in a rung."""
LADDER = frozenset(("contact", "coil", "block", "inVariable", "outVariable", "jump", "return"))
_MARK = re.compile("\0(.*?)\1")
"""The object that the text before it is of, as long as a rung is being made."""


class NoLadder(ValueError):
    """The group is no ladder: values that are no power go from box to box, or the like."""


@dataclass(frozen=True, slots=True)
class Edge:
    start: str
    to: str
    path: tuple[str, ...]
    """Elements from left to right."""
    order: float
    """Of branches the first one is above; what receives a link comes after all that send to it."""


@dataclass(slots=True)
class Rung:
    """One connected group as a rung."""

    group: list[Thing]
    rails: set[str]
    _edges: list[Edge] = field(default_factory=list)
    _things: dict[str, Thing] = field(default_factory=dict)
    _order: dict[str, float] = field(default_factory=dict)
    """Of the points, in the order of execution."""
    _links: int = 0
    _own: dict[tuple[str, str], list[Thing]] = field(default_factory=dict)
    """What is in the way from the rail to an input that has contacts of its own, by box and input."""

    def elements(self) -> str:
        """The path of the rung; `NoLadder` where it cannot be one."""
        self._things = {each.id: each for each in self.group}
        if not all(each.kind in LADDER for each in self.group) or not any(
            end in self.rails for each in self.group for pin in each.inputs for end, _ in pin.ends
        ):
            raise NoLadder
        self._find_own()
        self._add_all(self.group)
        self._reduce()
        written = " ".join(self._edges[0].path) if self._edges else ""
        self._check_order([self._things[id] for id in _MARK.findall(written)])
        return _MARK.sub("", written)

    def _check_order(self, written: list[Thing]) -> None:
        """In a rung they run from left to right and from top to bottom: not in their own order, where that matters, it is none."""
        at = {each.id: number for number, each in enumerate(self.group)}
        for one, other in combinations(written, 2):
            if at[one.id] > at[other.id] and conflict(one, other, self.group):
                raise NoLadder

    # ---- objects to edges -------------------------------------------------------------------------------------

    def _find_own(self) -> None:
        """Of a box with several inputs that get power all but one have contacts of their own, which lead nowhere else. The one is that
        whose contacts lead elsewhere too, else that whose first contact runs first."""
        at = {each.id: number for number, each in enumerate(self.group)}
        for box in (each for each in self.group if each.kind == "block"):
            pins = [pin for pin in box.inputs if any(self._is_power(end) for end, _ in pin.ends)]
            ways = {pin.name: self._way(pin) for pin in pins}
            shared = [pin for pin in pins if not self._leads_only(ways[pin.name], box, pin)]
            if len(shared) > 1 or len(ways) < len(pins):
                raise NoLadder
            if len(pins) > 1:
                main = (
                    shared[0]
                    if shared
                    else min(pins, key=lambda pin: min((at[one.id] for one in ways[pin.name]), default=-1))
                )
                self._own |= {(box.id, pin.name): ways[pin.name] for pin in pins if pin is not main}

    def _way(self, pin: Pin) -> list[Thing]:
        """What leads from the rail to an input, in the order in which it runs."""
        found: set[str] = set()
        left = [end for end, _ in pin.ends]
        while left:
            id = left.pop()
            if id in self._things and id not in found:
                found.add(id)
                left += [end for one in self._things[id].inputs for end, _ in one.ends]
        return [each for each in self.group if each.id in found]

    def _leads_only(self, way: list[Thing], box: Thing, pin: Pin) -> bool:
        """Whether all of a way leads to this input of the box, and nowhere else."""
        ids = {each.id for each in way if each.kind != "inVariable"}
        other = [
            end for each in self.group if each.id not in ids and each.kind != "outVariable"
            for one in each.inputs if (each is not box or one is not pin) for end, _ in one.ends
        ]  # fmt: skip
        return box.id not in ids and ids.isdisjoint(other)

    def _add_all(self, group: list[Thing]) -> None:
        """All but what is in an argument of a box of the group."""
        inside = {each.id for box in group for (id, _), way in self._own.items() if id == box.id for each in way}
        ids = {each.id for each in group} - inside
        for number, each in enumerate(self.group):
            if each.id in ids:
                self._add(each, number)

    def _branch(self, box: Thing, pin: Pin) -> str:
        """The contacts of an input, as an argument."""
        if all(end in self.rails for end, _ in pin.ends):
            return "TRUE"
        own = Rung(self.group, self.rails, _things=self._things, _own=self._own)
        own._add_all(self._own[box.id, pin.name])
        own._order["pin"] = len(self.group)
        for end, _ in pin.ends:
            if not self._is_power(end):
                raise NoLadder
            own._edges.append(Edge(RAIL if end in self.rails else f"out {end}", "pin", (), 0))
        own._reduce()
        if own._links or own._edges[0].to != "pin":
            raise NoLadder
        path = own._edges[0].path
        return path[0] if len(path) == 1 and path[0].startswith("<") else f"< {' '.join(path)} >"

    def _add(self, each: Thing, order: int) -> None:
        if each.kind == "outVariable" and (each.edge or each.storage or not self._of_box(each)):
            raise NoLadder
        if each.kind in ("inVariable", "outVariable"):
            return
        power = self._power(each)
        self._order |= {f"in {each.id}": order, f"out {each.id}": order + 0.1}
        text = self._text(each, power)
        ends = each.kind in ("jump", "return") or not self._goes_on(each)
        to = END if ends else f"out {each.id}"
        if power is None or not all(self._is_power(end) for end, _ in power.ends):
            raise NoLadder
        self._edges.append(Edge(f"in {each.id}", to, (f"{text}\0{each.id}\1",), order))
        for end, _ in power.ends:
            start = RAIL if end in self.rails else f"out {end}"
            self._edges.append(Edge(start, f"in {each.id}", (), order))

    def _power(self, each: Thing) -> Pin | None:
        """The input that power comes to; an other one has contacts of its own."""
        found = (pin for pin in each.inputs if any(self._is_power(end) for end, _ in pin.ends))
        return next((pin for pin in found if (each.id, pin.name) not in self._own), None)

    def _of_box(self, each: Thing) -> bool:
        ends = [self._things.get(end) for pin in each.inputs for end, _ in pin.ends]
        return len(ends) == 1 and ends[0] is not None and ends[0].kind == "block"

    def _is_power(self, end: str) -> bool:
        thing = self._things.get(end)
        return end in self.rails or (thing is not None and thing.kind in ("contact", "coil", "block"))

    def _consumers(self, each: Thing) -> list[tuple[Thing, str]]:
        return [
            (other, output)
            for other in self.group
            for pin in other.inputs
            for end, output in pin.ends
            if end == each.id
        ]

    def _goes_on(self, each: Thing) -> bool:
        return any(other.kind != "outVariable" for other, _ in self._consumers(each))

    def _text(self, each: Thing, power: Pin | None) -> str:
        if each.kind == "contact":
            mode = {"rising": "P ", "falling": "N "}.get(each.edge, "")
            if each.negated and mode:
                raise NoLadder
            return f"[{'/' if each.negated else mode}{each.name}]"
        if each.kind == "coil":
            mode = {"rising": "P ", "falling": "N "}.get(each.edge, "") or {"set": "S ", "reset": "R "}.get(
                each.storage, ""
            )
            if each.negated and mode:
                raise NoLadder
            return f"({'/' if each.negated else mode}{each.name})"
        if each.kind == "jump":
            return f"JMP {each.name}"
        return "RETURN" if each.kind == "return" else self._box(each, power)

    def _box(self, each: Thing, power: Pin | None) -> str:
        if not each.instance and each.name.upper() in OPERATORS:
            raise NoLadder
        arguments = []
        for pin in each.inputs:
            own = (each.id, pin.name) in self._own
            if pin.negated or pin.edge or (pin is not power and not own and len(pin.ends) > 1):
                raise NoLadder
            value = "~" if pin is power else self._branch(each, pin) if own else self._operand(pin)
            if value not in ("", "???"):
                arguments.append(f"{formal(pin.name)} := {value}" if pin.name else value)
        outputs = {output for other, output in self._consumers(each) if other.kind != "outVariable"}
        named = {self._named(each, output) for output in outputs}
        result = result_of(each)
        if len(named) > 1 or any(pin.negated and (pin is result or pin.name in named) for pin in each.outputs):
            raise NoLadder
        target = ""
        for pin in each.outputs:
            taken, negated = self._taken(each, pin)
            if pin is result and negated:
                raise NoLadder
            if pin is result:
                target = taken
            elif taken:
                arguments.append(f"{'NOT ' if negated else ''}{pin.name} => {taken}")
        goes_on = next(iter(named), "")
        if named and result is not None and goes_on == result.name:
            return self._comparison(each, power)
        call = f"{each.instance or each.name}({', '.join(arguments)})"
        return f"{f'{target} := ' if target else ''}{call}{f'.{goes_on}' if goes_on else ''}"

    def _comparison(self, each: Thing, power: Pin | None) -> str:
        """Sysmac Studio draws a comparison as a box in the way of the power: its result has no name, and is FALSE without power.
        Otherwise the result of a function is no power by itself."""
        sign = SIGNS.get(each.name.upper())
        values = [self._operand(pin) for pin in each.inputs if pin is not power]
        if sign is None or len(values) != 2 or any(pin.name for pin in each.outputs):
            raise NoLadder
        return f"[{values[0]} {sign} {values[1]}]"

    def _named(self, each: Thing, output: str) -> str:
        found = each.output(output)
        return output if found is None else found.name

    def _taken(self, each: Thing, pin: Pin) -> tuple[str, bool]:
        """The variable that takes an output, and whether it is negated on the way."""
        found = [
            other for other, output in self._consumers(each)
            if other.kind == "outVariable" and self._named(each, output) == pin.name
        ]  # fmt: skip
        if len(found) > 1:
            raise NoLadder
        return (found[0].name, found[0].negated != pin.negated) if found else (pin.expression, pin.negated)

    def _operand(self, pin: Pin) -> str:
        if not pin.ends:
            return pin.expression
        source = self._things.get(pin.ends[0][0])
        if source is None or source.kind != "inVariable":
            raise NoLadder
        return f"NOT ({source.name})" if source.negated else source.name

    # ---- edges to one path ------------------------------------------------------------------------------------

    def _reduce(self) -> None:
        while len(self._edges) > 1 or (self._edges and self._edges[0].start != RAIL):
            if not (self._series() or self._parallel() or self._tails() or self._joint() or self._cut()):
                raise NoLadder

    def _series(self) -> bool:
        for first in self._edges:
            after = [each for each in self._edges if each.start == first.to]
            before = [each for each in self._edges if each.to == first.to]
            if first.to != END and len(after) == 1 and len(before) == 1:
                second = after[0]
                self._replace((first, second), Edge(first.start, second.to, first.path + second.path, first.order))
                return True
        return False

    def _parallel(self) -> bool:
        """Edges between the same points; those to the end are dead ends, see `_tails`."""
        for first in self._edges:
            same = [
                each for each in self._edges if (each.start, each.to) == (first.start, first.to) and first.to != END
            ]
            if len(same) > 1:
                self._replace(same, Edge(first.start, first.to, (branches(same),), max(each.order for each in same)))
                return True
        return False

    def _tails(self) -> bool:
        """All that goes on from a point are dead ends: they are one."""
        for start in dict.fromkeys(each.start for each in self._edges):
            mine = [each for each in self._edges if each.start == start]
            if len(mine) > 1 and all(each.to == END for each in mine):
                self._replace(mine, Edge(start, END, (branches(mine),), mine[0].order))
                return True
        return False

    def _joint(self) -> bool:
        """Several points that each lead to the same several points, and nowhere else, meet in one: all their power goes on to all of them."""
        for first in self._edges:
            targets = {each.to for each in self._edges if each.start == first.start}
            into = [each for each in self._edges if each.to in targets]
            starts = {each.start: each.order for each in reversed(into)}
            ways = {(each.start, each.to) for each in self._edges if each.start in starts}
            whole = {(start, to) for start in starts for to in targets}
            if (
                len(starts) < 2
                or len(targets) < 2
                or END in targets
                or ways != whole
                or any(each.path for each in into)
            ):
                continue
            joint = f"joint {first.start}"
            self._order[joint] = max(self._order.get(each, -1) for each in starts) + 0.05
            after = {each.to: each.order for each in into}
            self._edges = [each for each in self._edges if each not in into]
            self._edges += [Edge(start, joint, (), order) for start, order in starts.items()]
            self._edges += [Edge(joint, to, (), order) for to, order in after.items()]
            return True
        return False

    def _cut(self) -> bool:
        """A point that several ways lead to becomes the end of each, with a link; what follows begins at the rail with the links."""
        points = {each.to for each in self._edges if each.to != END}
        if not points:
            return False
        point = min(points, key=self._order.__getitem__)
        into = [each for each in self._edges if each.to == point]
        names = []
        for each in into:
            self._links += 1
            names.append(f"#p{self._links}")
            self._replace((each,), Edge(each.start, END, (*each.path, f"-> {names[-1]}"), each.order))
        receives = names[0] if len(names) == 1 else f"< {' | '.join(names)} >"
        for each in [each for each in self._edges if each.start == point]:
            order = max(each.order, *(one.order for one in into)) + 0.5
            self._replace((each,), Edge(RAIL, each.to, (receives, *each.path), order))
        return True

    def _replace(self, old: "list[Edge] | tuple[Edge, ...]", new: Edge) -> None:
        self._edges = [each for each in self._edges if each not in old]
        self._edges.append(new)


def branches(edges: list[Edge]) -> str:
    """Parallel branches from top to bottom, in the order in which they run."""
    return f"< {' | '.join(' '.join(each.path) for each in sorted(edges, key=lambda one: one.order))} >"
