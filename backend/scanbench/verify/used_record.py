"""The used-variable record of one pass, use by use, with places: the scan is run again for it."""

from itertools import zip_longest

from scanbench.symbols.names import Names
from scanbench.verify.both import Both
from scanbench.verify.contract import Use
from scanbench.verify.monitor import Inputs
from scanbench.verify.passes import pass_of
from scanbench.verify.sides import Side
from scanbench.verify.uses import Access, Pass, Recorder


def detailed(both: Both, call: int) -> tuple[Names, Pass, Pass, Pass]:
    """A call in the scan that ran last: names there; the pass with the results that ran live; the same with the open calls of each use;
    that of the monitor, which has both. `BadEdit` when there is no such call."""
    ran, number = pass_of(both, call)
    view, control, monitor = ran.view, both.control.side, both.monitor.side
    inputs = Inputs(ran.passes, ran.there)

    def recorder(side: Side) -> Recorder:
        return Recorder(side.resource, view.reader.names, view.range, view.limit, detail=True)

    def run_control() -> list[Pass]:
        mine = recorder(control)
        control.run(mine, mine.listen)
        return mine.passes

    def run_monitor() -> list[Pass]:
        other = recorder(monitor)
        both.monitor.run(other, inputs)
        return other.passes

    first = control.again(ran.control, run_control)[number]
    passes = monitor.again(ran.monitor, run_monitor)
    return view.reader.names, ran.passes[number], first, passes[number] if number < len(passes) else Pass(None, 0, 0)


def uses_of(both: Both, call: int) -> tuple[Use, ...]:
    """Of a call in the scan that ran last. `BadEdit` when there is none."""
    all_names, live, first, second = detailed(both, call)
    places = pass_of(both, call)[0].view.reader.places
    names = all_names.within(first.inside)
    found = []
    for index, (one, right) in enumerate(zip_longest(live.log, second.log)):
        access: Access = one or right
        frames = first.frames_of[index] if one is not None else second.frames_of[index]
        place = places.of(access.site, frames)
        for leaf in names.at(access.offset, access.size, access.bits):
            there = None if one is None else leaf.cut(one.value, one.offset)
            same = right is not None and right[:6] == access[:6]
            here = leaf.cut(right.value, right.offset) if same else None
            found.append(Use(leaf.name, access.written, there, here, place))
    return tuple(found)
