"""The monitor: the same program on the reference interpreter, on the inputs of the control device, without disturbances."""

from collections.abc import Mapping, Sequence

from scanbench.engines.engine import Stop
from scanbench.faults.disturb.disturb import is_disturbance
from scanbench.recording.programs import ProgramCache, made, reference
from scanbench.runtime.command import Entry, Patch
from scanbench.runtime.forces import forced_table, table_patches
from scanbench.runtime.holds import HELD, held
from scanbench.runtime.journal import Journal
from scanbench.runtime.programs import Programs
from scanbench.runtime.resource import Resource
from scanbench.verify.sides import Side
from scanbench.verify.uses import Fresh, Pass, Recorder


class Monitor:
    """The monitor device: it is in the same seam as the control device, with the values that that one should have."""

    def __init__(self, programs: Programs, version: int) -> None:
        """`programs`: those of the control device; it shares what was checked, and nothing else."""
        self._programs = ProgramCache(lambda version: made(reference, version, programs.get(version).program))
        self.side = self._made(version)

    def _made(self, version: int) -> Side:
        resource = Resource(self._programs.get(version), programs=self._programs)
        resource.lenient = True  # entries inside of a scan count even where the control device takes a different path
        return Side(resource)

    def take_over(self, control: Side, own: bytes | None = None) -> None:
        """All that the control device has, but for what a disturbance holds there: that stays as it is here, or in `own`."""
        there, here = control.resource, self.side.resource
        if there.version != here.version:
            here.restore(self._programs.get(there.version), there.state, here.journal)
        bits, size = held(there.journal), there.program.layout.state_size
        kept = {at: (here.memory if own is None else own)[at] & mask for at, mask in bits.items()}
        here.memory[:size] = memoryview(there.memory)[:size]
        if bits:
            for at, mask in bits.items():
                here.memory[at] = here.memory[at] & ~mask | kept[at]
            for patch in table_patches(there.view, forced_table(there.view)):
                here.memory[patch.offset : patch.offset + len(patch.data)] = patch.data

    def restart(self, control: Side) -> None:
        """The same, with the journal of the control device as far as it counts here."""
        there = control.resource
        self.side = self._made(there.version)
        entries = [each for each in there.journal if not is_disturbance(each.command)]
        self.side.resource.journal = Journal(entries)
        own = bytearray(there.state)
        for each in there.journal.derived(HELD).values():  # what came meanwhile is what it would have
            own[each.offset] = own[each.offset] & ~each.came | each.real & each.came
        self.take_over(control, bytes(own))

    def enter(self, entry: Entry) -> None:
        """In the seam, unless it is a disturbance."""
        if not is_disturbance(entry.command):
            self.side.resource.reenter(entry)

    def wait_for(self, entries: Sequence[Entry]) -> None:
        """See `Side.wait_for`."""
        self.side.wait_for([each for each in entries if not is_disturbance(each.command)])

    def run(self, recorder: Recorder, inputs: "Inputs") -> Stop:
        """One scan, on these inputs."""
        recorder.on_first, recorder.on_begin = inputs.first, inputs.begin
        inputs.memory = self.side.memory
        return self.side.run(recorder, recorder.listen)


class Inputs:
    """What the monitor runs a scan on: what the passes of the control device read, and what somebody has edited."""

    def __init__(self, passes: Sequence[Pass], held: Mapping[int, tuple[int, int]]) -> None:
        """`held`: offset -> mask, and what the control device has there; it is the monitor's as the first statement begins."""
        self.fresh: list[list[Fresh]] = [each.fresh() for each in passes]
        self._held = held
        self.memory = bytearray()
        self.own: dict[int, int] = {}
        """What the monitor had there by itself."""
        self.expected: list[dict[int, int]] = [{} for _ in passes]
        """Of each pass: bytes that it would have read otherwise."""
        self.edits: dict[int, list[Patch]] = {}
        """By the number of a pass."""

    def first(self) -> None:
        """Input refresh and forces are over."""
        memory = self.memory
        for offset, (mask, value) in self._held.items():
            self.own[offset] = memory[offset]
            memory[offset] = memory[offset] & ~mask | value & mask

    def begin(self, number: int, made: Pass) -> None:
        """A pass begins."""
        memory = self.memory
        if number < len(self.fresh):
            expected = self.expected[number]
            for (_, _, offset, size, bits, _, value), mask in self.fresh[number]:
                if bits == 0xFF and mask is None:
                    if memory[offset : offset + size] == value:
                        continue
                elif memory[offset] & bits == value[0] and size == 1:
                    continue
                for at in range(size):
                    which = bits if mask is None else mask[at] & bits if size == 1 else mask[at]
                    now = memory[offset + at]
                    if (now ^ value[at]) & which:
                        expected[offset + at] = now
                        memory[offset + at] = now & ~which | value[at] & which
        for patch in self.edits.get(number, ()):
            for index, (mask_of, data) in enumerate(zip(patch.mask, patch.data, strict=True), patch.offset):
                memory[index] = memory[index] & ~mask_of | data & mask_of
