"""Whether state decides anything: what differs and has not come to anything yet may still do so, or is only stored.

A copy of the error memory, the memory of an edge, what is worked out again in every scan is no state: what it decides shows at
once, in the run itself. State is a latch, a counter, a timer, and a copy of something else that is made because of the error. It decides when it can reach an output, what the PLC does by
itself, the plant, or the start of a task.
"""

from bisect import bisect_right
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from scanbench.faults.reaction.error_memory import error_bits
from scanbench.faults.reaction.flows import Flow, Flows
from scanbench.faults.reaction.places import Ref, meet, ref_of
from scanbench.program.layout import Layout
from scanbench.program.origin import in_library
from scanbench.program.program import Assign, Base, Pou, Program, Stmt
from scanbench.program.types import BOOL, ArrayType, Kind, Record, Type, has_instance
from scanbench.symbols.leaves import Leaf
from scanbench.symbols.symbols import resolve

_EDGES = ("R_TRIG", "F_TRIG")
_STEPS = 100_000
"""Statements that are followed; more, and it is taken to decide something."""

Space = tuple[Pou, int] | None
"""None: the image; else temporaries of a body that runs on an instance."""


class Node(NamedTuple):
    """A place that data is in."""

    space: Space
    ref: Ref
    """Of Base.IMAGE; of Base.FRAME in a space of its own; or through a reference."""


class Instance(NamedTuple):
    """A block or program in the image."""

    begin: int
    end: int
    record: Record
    path: str
    parent: int
    """Index of the one around it, -1 for none."""


class Instances:
    """Where the blocks and programs of a program lie."""

    def __init__(self, program: Program) -> None:
        self.all: list[Instance] = []
        for each in program.instances:
            if each.pou.kind == "program":
                self._add(each.pou.instance, each.offset, each.name, -1)
        owner = program.layout.globals
        for member in owner.members.values() if owner is not None else ():
            if member.storage:
                self._below(member.type, member.offset, member.name, -1)
        # in the order of their places; one that contains others comes before these
        order = sorted(range(len(self.all)), key=lambda each: (self.all[each].begin, -self.all[each].end, each))
        at = {old: new for new, old in enumerate(order)}
        self.all = [self.all[old]._replace(parent=at.get(self.all[old].parent, -1)) for old in order]
        self._begins = [each.begin for each in self.all]
        self.of: dict[str, list[Instance]] = {}
        """By the names of their types, and of what these extend."""
        for instance in self.all:
            record: Record | None = instance.record
            while record is not None:
                self.of.setdefault(record.name, []).append(instance)
                record = record.base

    def around(self, begin: int, end: int) -> Iterator[Instance]:
        """Those that hold any of these bytes, inner ones first."""
        first = bisect_right(self._begins, begin)
        for index in range(first, bisect_right(self._begins, end - 1)):
            yield self.all[index]
        index = first - 1
        while index >= 0:
            each = self.all[index]
            if each.end > begin:
                yield each
            index = each.parent

    def _add(self, record: Record, offset: int, path: str, parent: int) -> None:
        self.all.append(Instance(offset, offset + max(1, record.size), record, path, parent))
        self._members(record, offset, path, len(self.all) - 1)

    def _members(self, record: Record, offset: int, path: str, parent: int) -> None:
        for member in record.members.values():
            if member.storage and not member.bound:
                self._below(member.type, offset + member.offset, f"{path}.{member.name}", parent)

    def _below(self, type: Type, offset: int, path: str, parent: int) -> None:
        if not has_instance(type):
            return
        if isinstance(type, ArrayType):
            for index in range(type.count):
                at = index * type.element.size
                self._below(type.element, offset + at, f"{path}[{_index(type, at)}]", parent)
        elif isinstance(type, Record) and type.kind is Kind.BLOCK:
            self._add(type, offset, path, parent)
        elif isinstance(type, Record):
            self._members(type, offset, path, parent)


def _index(type: ArrayType, rest: int) -> str:
    """The index of the element that begins at this byte."""
    numbers = []
    for dimension, (low, _) in enumerate(type.bounds):
        number, rest = divmod(rest, type.stride(dimension))
        numbers.append(str(low + number))
    return ",".join(numbers)


class _Uses:
    """Flows by the bytes that they use."""

    def __init__(self) -> None:
        self._near: dict[int, list[tuple[Ref, Flow]]] = {}
        self._wide: list[tuple[Ref, Flow]] = []

    def add(self, ref: Ref, flow: Flow) -> None:
        """A flow that uses these bytes."""
        if ref.end - ref.begin > 64:
            self._wide.append((ref, flow))
            return
        for part in range(ref.begin // 16, (ref.end - 1) // 16 + 1):
            self._near.setdefault(part, []).append((ref, flow))

    def find(self, begin: int, end: int, mask: int) -> Iterator[Flow]:
        """Flows that use any of these."""
        wide = end - begin > 4096
        parts = self._near if wide else range(begin // 16, (end - 1) // 16 + 1)
        for ref, flow in (*self._wide, *(each for part in parts for each in self._near.get(part, ()))):
            if ref.begin < end and begin < ref.end and (end - begin > 1 or ref.end - ref.begin > 1 or ref.mask & mask):
                yield flow


class _Body:
    """The flows of a body, by what they use."""

    def __init__(self, flows: Iterable[Flow]) -> None:
        self.flows = tuple(flows)
        self.reads: dict[Base | None, _Uses] = {}
        self.writes: dict[Base | None, _Uses] = {}
        for flow in self.flows:
            for ref in flow.reads | flow.controls:
                self.reads.setdefault(ref.base, _Uses()).add(ref, flow)
            for ref in flow.writes:
                self.writes.setdefault(ref.base, _Uses()).add(ref, flow)


class Deciding:
    """What the state of one program decides."""

    def __init__(self, program: Program) -> None:
        self._program, self.instances, flows = program, Instances(program), Flows()
        plant = {each.pou for each in program.plant}
        self._bodies = {pou: _Body(flows.of(pou)) for pou in program.pous if self._runs(pou)}
        around = [*program.plant, *(each for task in program.tasks for each in task.programs)]
        joined = [stmt for each in around for stmt in (*each.before, *each.after)]
        self._joined = _Body(flows.of_statements(joined))
        self._plant = plant
        self._library = {pou.instance.name for pou in program.pous if in_library(pou.span)}
        self._contexts: dict[Pou, tuple[int, ...]] = {}
        self._bodies_of: dict[str, list[Pou]] = {}
        for pou in self._bodies:
            self._contexts[pou] = tuple(each.begin for each in self.instances.of.get(pou.instance.name, ()))
            self._bodies_of.setdefault(pou.instance.name, []).append(pou)
        self._ends = list(self._sinks())
        self._errors = [Ref(Base.IMAGE, each.offset, each.offset + 1, each.mask) for each in error_bits(program)]
        self._published = list(self._accesses())
        self._answers: dict[str, bool] = {}
        self._of_stmt: dict[int, list[tuple[Pou | None, Flow]]] = {}
        for owner, body in (*self._bodies.items(), (None, self._joined)):
            for flow in body.flows:
                self._of_stmt.setdefault(id(flow.stmt), []).append((owner, flow))

    @staticmethod
    def _runs(pou: Pou) -> bool:
        return pou.kind != "function" and not in_library(pou.span)

    def _sinks(self) -> Iterator[Ref]:
        """Where data must come to for something to be decided."""
        layout, model = self._program.layout, self._program.layout.model
        yield Ref(Base.IMAGE, 0, Layout.SUBRANGE_ERROR)
        for words in model.fatal.outputs:
            base = layout.areas[words.area.name]
            yield Ref(Base.IMAGE, base + 2 * words.first, base + 2 * words.last + 2)
        for each in model.iec_maps:
            if each.letter == "Q":
                base = layout.areas[each.area.name] + 2 * each.first
                yield Ref(Base.IMAGE, base, base + 2 * each.words)
        for special in model.specials:
            place = special.location
            begin = layout.areas[place.area.name] + place.byte
            mask = 0xFF if place.bit is None else 1 << place.bit % 8
            yield Ref(Base.IMAGE, begin, begin + max(1, place.bits // 8), mask)
        for task in self._program.tasks:
            if task.single is not None:
                yield ref_of(task.single)
        for instance in self._program.plant:
            yield Ref(Base.IMAGE, instance.offset, instance.offset + max(1, instance.pou.instance.size))

    def _accesses(self) -> Iterator[Ref]:
        """What VAR_ACCESS names."""
        for access in self._program.accesses:
            symbol = resolve(self._program, access.path)
            if not symbol.slots:
                mask = 0xFF if symbol.bit is None else 1 << symbol.bit
                yield Ref(Base.IMAGE, symbol.offset, symbol.offset + max(1, symbol.type.size), mask)

    # ---- questions ------------------------------------------------------------------------------------------------

    def acts(self, leaf: Leaf) -> bool:
        """Whether this is where something comes out: an output, what the PLC shows of itself, the plant and what it writes."""
        ref = _ref(leaf)
        if self._is_end(ref):
            return True
        found = self._program.layout.area_at(leaf.offset)
        if found is None:
            return False
        area, byte = found
        inputs = (
            each for each in self._program.layout.model.iec_maps if each.letter == "I" and each.area.name == area.name
        )
        if self._plant and any(each.first <= byte // 2 < each.first + each.words for each in inputs):
            return True
        return any(part.program == "read" for part in area.ranges if part.first <= byte // 2 <= part.last)

    def shows(self, leaf: Leaf) -> bool:
        """Whether only tools read this: a VAR_ACCESS, or memory of the model that the program writes and does not use."""
        ref = _ref(leaf)
        if any(meet(each, ref) for each in self._published):
            return True
        found = self._program.layout.area_at(leaf.offset)
        if found is None or found[0].access(found[1] // 2, "tool") == "none":
            return False
        return not self._is_used(Node(None, ref))

    def handles(self, stmt: Stmt) -> bool:
        """Whether this very statement writes an output, or state that something is decided by, whatever instance it runs on."""
        is_bool = isinstance(stmt, Assign) and stmt.target.type == BOOL
        for pou, flow in self._of_stmt.get(id(stmt), ()):
            spaces: list[Space] = [None] if pou is None else [(pou, start) for start in self._contexts[pou]]
            nodes = [self._node(ref, space) for space in spaces for ref in flow.writes]
            if flow.acts or (nodes and all(self._comes_out(node, is_bool) for node in nodes)):
                return True
        return False

    def decides(self, leaf: Leaf) -> bool:
        """Whether this is state that something is decided by."""
        known = self._answers.get(leaf.name)
        if known is None:
            known = self._answers[leaf.name] = self._decides(_ref(leaf), leaf.type.kind is Kind.BOOL)
        return known

    def block_of(self, leaf: Leaf) -> tuple[str, int, int] | None:
        """The library's block that it is in: its path, and the bytes from and to which it is in the image."""
        block = self._library_block(_ref(leaf))
        return None if block is None else (block.path, block.begin, block.end)

    def _comes_out(self, node: Node, is_bool: bool) -> bool:
        """Whether what is written there is an output, or state that decides one. What only asks the PLC for something is not."""
        if node.space is not None or node.ref.base is not Base.IMAGE or node.ref.begin < Layout.HEADER_SIZE:
            return False
        return self._is_end(node.ref) or self._decides(node.ref, is_bool)

    def _is_used(self, node: Node) -> bool:
        """Whether a statement reads it for something else than itself."""
        for flow, space, _ in self._using(node, writing=False):
            if flow.acts or flow.call is not None or not all(self._same(ref, space, node) for ref in flow.writes):
                return True
        return False

    def _decides(self, ref: Ref, is_bool: bool) -> bool:
        block = self._library_block(ref)
        if block is not None:
            if block.record.name.upper() in _EDGES:
                return False
            return self._reaches(Node(None, Ref(Base.IMAGE, block.begin, block.end)))
        node = Node(None, ref)
        return self._is_state(node, is_bool) and self._reaches(node)

    def _is_state(self, node: Node, is_bool: bool) -> bool:
        """Whether it depends on what was before: not where it is worked out again whenever its body runs, nor a
        copy of error memory."""
        if self._reaches(node, itself=True):
            return True
        writers = list(self._using(node, writing=True))
        if any(not flow.controls for flow, _, _ in writers):
            return False
        if all(flow.constant or flow.source is not None for flow, _, _ in writers):
            copies = [each for each in writers if not each[0].constant]
            return not copies or any(
                (is_bool and _latches(flow, here)) or not self._is_of_error(flow, space) for flow, space, here in copies
            )
        return True

    def _is_of_error(self, copy: Flow, space: Space) -> bool:
        """Whether what is copied is error memory, or made of it: then it is no new state, but remembers what was seen."""
        assert copy.source is not None
        start = self._node(copy.source, space)
        waiting, seen = [start], {start}
        while waiting and len(seen) < _STEPS:
            node = waiting.pop()
            if node.space is None and any(meet(each, node.ref) for each in self._errors):
                return True
            for flow, here, _ in self._using(node, writing=True):
                for ref in flow.reads:
                    each = self._node(ref, here)
                    if each not in seen:
                        seen.add(each)
                        waiting.append(each)
        return False

    def _library_block(self, ref: Ref) -> Instance | None:
        blocks = [each for each in self.instances.around(ref.begin, ref.end) if each.record.name in self._library]
        return blocks[-1] if blocks else None

    # ---- following ------------------------------------------------------------------------------------------------

    def _reaches(self, start: Node, itself: bool = False) -> bool:
        """Whether it comes to anything; `itself`: whether its value comes back to it, whatever decides about that."""
        waiting, seen, done = [start], {start}, set[tuple[int, Space]]()
        while waiting:
            node = waiting.pop()
            for flow, space in self._readers(node):
                if (id(flow), space) in done or (
                    itself and not any(self._same(each, space, node) for each in flow.reads)
                ):
                    continue
                done.add((id(flow), space))
                if len(done) > _STEPS or (
                    not itself and (flow.acts or (space is not None and space[0] in self._plant))
                ):
                    return True
                for each in self._written(flow, space, not itself):
                    if each.space is None and (meet(each.ref, start.ref) if itself else self._is_end(each.ref)):
                        return True
                    if each not in seen:
                        seen.add(each)
                        waiting.append(each)
        return False

    def _same(self, ref: Ref, space: Space, node: Node) -> bool:
        made = self._node(ref, space)
        return made.space == node.space and meet(made.ref, node.ref)

    def _readers(self, node: Node) -> Iterator[tuple[Flow, Space]]:
        if node.ref.end == 0:  # a body that runs
            assert node.space is not None
            for flow in self._bodies[node.space[0]].flows:
                yield flow, node.space
            return
        for flow, space, _ in self._using(node, writing=False):
            yield flow, space

    def _using(self, node: Node, writing: bool) -> Iterator[tuple[Flow, Space, Ref]]:
        """Flows that read or write a node, with the instance that runs there, and the place as it counts there."""
        ref = node.ref
        if ref.base is not Base.SELF and node.space is not None:
            body = self._bodies[node.space[0]]
            uses = (body.writes if writing else body.reads).get(Base.FRAME)
            for flow in uses.find(ref.begin, ref.end, ref.mask) if uses is not None else ():
                yield flow, node.space, ref
            return
        for pou, body in (*self._bodies.items(), (None, self._joined)):
            uses = (body.writes if writing else body.reads).get(ref.base)
            for flow in uses.find(ref.begin, ref.end, ref.mask) if uses is not None else ():
                for start in self._contexts[pou] if pou is not None else (0,):
                    yield flow, None if pou is None else (pou, start), ref
        if ref.base is None:
            return
        for each in self.instances.around(ref.begin, ref.end):
            here = Ref(Base.SELF, max(0, ref.begin - each.begin), ref.end - each.begin, ref.mask)
            record: Record | None = each.record
            while record is not None:
                for pou in self._bodies_of.get(record.name, ()):
                    body = self._bodies[pou]
                    uses = (body.writes if writing else body.reads).get(Base.SELF)
                    for flow in uses.find(here.begin, here.end, here.mask) if uses is not None else ():
                        yield flow, (pou, each.begin), here
                record = record.base

    def _written(self, flow: Flow, space: Space, runs: bool) -> Iterator[Node]:
        for ref in flow.writes:
            yield self._node(ref, space)
        if flow.call is not None and runs:
            at = self._node(flow.call.instance, space)
            pou = flow.call.pou
            known = self._contexts.get(pou, ())
            for start in [each for each in known if at.ref.begin <= each < at.ref.end] or known:
                yield Node((pou, start), Ref(Base.FRAME, 0, 0))

    @staticmethod
    def _node(ref: Ref, space: Space) -> Node:
        if ref.base is None:
            return Node(None, ref)
        if ref.base is Base.IMAGE or space is None:
            return Node(None, ref)
        if ref.base is Base.FRAME:
            return Node(space, ref)
        return Node(None, Ref(Base.IMAGE, space[1] + ref.begin, space[1] + ref.end, ref.mask))

    def _is_end(self, ref: Ref) -> bool:
        return ref.base is Base.IMAGE and any(meet(each, ref) for each in self._ends)


def _ref(leaf: Leaf) -> Ref:
    return Ref(Base.IMAGE, leaf.offset, leaf.offset + max(1, leaf.type.size), leaf.bits)


def _latches(copy: Flow, here: Ref) -> bool:
    """Whether a BOOL is copied because of what is there, or because of what is copied: it stays on then. For both it is the memory
    of an edge."""
    return any(meet(each, here) for each in copy.controls) != (copy.source in copy.controls)
