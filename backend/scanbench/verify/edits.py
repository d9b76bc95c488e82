"""Set data: inputs of single passes that somebody has edited, and what the monitor comes to on them."""

from dataclasses import dataclass, field, replace
from difflib import get_close_matches

from scanbench.engines.engine import Reason
from scanbench.problems import perhaps
from scanbench.program.types import StringType
from scanbench.runtime.command import Patch
from scanbench.runtime.trap import trap_info
from scanbench.symbols.leaves import Leaf
from scanbench.symbols.values import parse_value
from scanbench.verify.both import Both, Ran
from scanbench.verify.contract import Output, Row
from scanbench.verify.monitor import Inputs
from scanbench.verify.rows import written_by
from scanbench.verify.uses import Pass, Recorder


class BadEdit(Exception):
    """No such input, or no such value; the message says what there is."""

    def __init__(self, message: str, near: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.near = near


@dataclass(frozen=True, slots=True)
class Edit:
    """An input that is another."""

    leaf: Leaf
    value: bytes

    @property
    def patch(self) -> Patch:
        """In the image."""
        leaf = self.leaf
        if leaf.bit is None:
            return Patch.whole(leaf.offset, self.value)
        return Patch.of_bit(leaf.offset, leaf.bit, self.value != b"\0")


@dataclass(slots=True)
class Edits:
    """All of them, by scan and call, then by column."""

    _all: dict[tuple[int, int], dict[str, Edit]] = field(default_factory=dict)

    def copy(self) -> "Edits":
        """Another one, which may be given up."""
        return Edits({key: dict(each) for key, each in self._all.items()})

    def of(self, scan: int, call: int) -> dict[str, Edit]:
        """Those of a pass."""
        return self._all.get((scan, call), {})

    def set(self, both: Both, scan: int, call: int, column: str, text: str) -> None:
        """One more, of the scan that ran last. `BadEdit`."""
        ran, number = pass_of(both, call)
        inputs = _inputs(ran, number)
        leaf = inputs.get(column)
        if leaf is None:
            near = tuple(get_close_matches(column, inputs, 3, 0.5))
            raise BadEdit(f"`{column}` is no input of scan {scan}, call {call}.{perhaps(near)}", near)
        mine = self._all.setdefault((scan, call), {})
        if not text.strip():
            mine.pop(column, None)
            return
        try:
            value = parse_value(leaf.type, text)
        except ValueError as error:
            raise BadEdit(f"{column}: {error}") from error
        mine[column] = Edit(leaf, value.ljust(leaf.type.size, b"\0") if isinstance(leaf.type, StringType) else value)

    def run(self, both: Both, row: Row, edits: dict[str, Edit]) -> Row:
        """The row, with what the monitor comes to on edited inputs."""
        ran, number = pass_of(both, row.call)
        inputs = Inputs(ran.passes, ran.there)
        inputs.edits[number] = [each.patch for each in edits.values()]
        side = both.monitor.side

        def run() -> tuple[int, list[Pass]]:
            recorder = Recorder(side.resource, ran.view.reader.names, ran.view.range, ran.view.limit)
            stop = both.monitor.run(recorder, inputs)
            return stop.trap if stop.reason is Reason.TRAP else 0, recorder.passes

        trap, passes = side.again(ran.monitor, run)
        made = written_by(ran.view.reader, passes[number]) if number < len(passes) else {}
        outputs = {name: replace(each, set=made.get(name)) for name, each in row.outputs.items()}
        outputs.update({name: Output(None, None, value) for name, value in made.items() if name not in outputs})
        read = {
            name: replace(each, set=edits[name].value) if name in edits else each for name, each in row.inputs.items()
        }
        note = row.note
        if trap:
            error = trap_info(ran.monitor.loaded.program, trap, row.scan)
            note = "; ".join(filter(None, (note, f"on the set data it ends by a run-time error: {error}")))
        return replace(row, outputs=outputs, inputs=read, note=note)


def pass_of(both: Both, call: int) -> tuple[Ran, int]:
    """The run of the scan in which a call is, and its number there. `BadEdit`."""
    for ran in both.ran:
        if ran.calls < call <= ran.calls + len(ran.passes):
            return ran, call - ran.calls - 1
    count = both.ran[-1].calls + len(both.ran[-1].passes) if both.ran else 0
    raise BadEdit(f"the range ran {count} times in scan {both.ran_last}: there is no call {call}")


def _inputs(ran: Ran, number: int) -> dict[str, Leaf]:
    made = ran.passes[number]
    names = ran.view.reader.names.within(made.inside)
    found: dict[str, Leaf] = {}
    for access, _ in made.fresh():
        for leaf in names.at(access.offset, access.size, access.bits):
            if not leaf.passing:
                found.setdefault(leaf.name, leaf)
    return found
