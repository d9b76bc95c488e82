"""The passes of the scan that ran last on both sides: their inputs, and what the monitor comes to on edited ones."""

from collections.abc import Mapping
from dataclasses import replace

from scanbench.runtime.trap import trap_info
from scanbench.symbols.leaves import Leaf
from scanbench.verify.both import Both, Ran
from scanbench.verify.contract import Output, Row
from scanbench.verify.control import trap_of
from scanbench.verify.edits import BadEdit, Edit
from scanbench.verify.monitor import Inputs
from scanbench.verify.rows import written_by
from scanbench.verify.uses import Pass, Recorder


def pass_of(both: Both, call: int) -> tuple[Ran, int]:
    """The run of the scan in which a call is, and its number there. `BadEdit`."""
    for ran in both.ran:
        if ran.calls < call <= ran.calls + len(ran.passes):
            return ran, call - ran.calls - 1
    count = both.ran[-1].calls + len(both.ran[-1].passes) if both.ran else 0
    raise BadEdit(f"the range ran {count} times in scan {both.ran_last}: there is no call {call}")


def inputs_of(both: Both, call: int) -> dict[str, Leaf]:
    """What a pass reads from outside of it. `BadEdit`."""
    ran, number = pass_of(both, call)
    made = ran.passes[number]
    names = ran.view.reader.names.within(made.inside)
    found: dict[str, Leaf] = {}
    for access, _ in made.fresh():
        for leaf in names.at(access.offset, access.size, access.bits):
            if not leaf.passing:
                found.setdefault(leaf.name, leaf)
    return found


def edited_row(both: Both, row: Row, edits: Mapping[str, Edit]) -> Row:
    """The row, with what the monitor comes to on edited inputs."""
    ran, number = pass_of(both, row.call)
    inputs = Inputs(ran.passes, ran.there)
    inputs.edits[number] = [each.patch for each in edits.values()]
    side = both.monitor.side

    def run() -> tuple[int, list[Pass]]:
        recorder = Recorder(side.resource, ran.view.reader.names, ran.view.range, ran.view.limit)
        return trap_of(both.monitor.run(recorder, inputs)), recorder.passes

    trap, passes = side.again(ran.monitor, run)
    made = written_by(ran.view.reader, passes[number]) if number < len(passes) else {}
    outputs = {name: replace(each, set=made.get(name)) for name, each in row.outputs.items()}
    outputs.update({name: Output(None, None, value) for name, value in made.items() if name not in outputs})
    read = {name: replace(each, set=edits[name].value) if name in edits else each for name, each in row.inputs.items()}
    note = row.note
    if trap:
        error = trap_info(ran.monitor.loaded.program, trap, row.scan)
        note = "; ".join(filter(None, (note, f"on the set data it ends by a run-time error: {error}")))
    return replace(row, outputs=outputs, inputs=read, note=note)
