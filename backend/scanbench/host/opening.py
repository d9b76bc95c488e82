"""How the process of a PLC begins: with the run that its file holds, or a new one."""

import errno
from collections.abc import Mapping
from pathlib import Path

from scanbench.faults.agenda import agenda_of_faults
from scanbench.faults.detect import Detection
from scanbench.host.build import Builder, BuildFailed
from scanbench.host.link import Link
from scanbench.host.loop import Loop
from scanbench.host.programs import HostPrograms
from scanbench.host.run_files import run_limit, sources_in
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.format import RunFileError
from scanbench.recording.timeline import Timeline
from scanbench.runtime.agenda import Agenda
from scanbench.runtime.clock import wall_time
from scanbench.runtime.command import Refusal
from scanbench.runtime.resource import is_no_space
from scanbench.runtime.set_clock import SetClock
from scanbench.wire import host as protocol
from scanbench.wire.codec import ENTRIES, pack_body


class NoSpace(BuildFailed):
    """There is no room for the run."""


def open_loop(start: protocol.Start, builder: Builder, link: Link) -> Loop:
    """The loop of a PLC, ready to run; `BuildFailed` says why there can be none. Tells the parent what it goes on with."""
    path = Path(start.run)
    fresh = not path.exists()
    try:
        timeline, programs = _begun(start, path, builder) if fresh else _resumed(start, path, builder)
        if start.driven is not None:
            timeline.drive(pack_body(start.driven))
    except (RunFileError, LookupError) as error:
        raise BuildFailed(f"{error}. A new run can begin: the old file is kept aside") from error
    except OSError as error:
        message = f"the run file {path} cannot be used: {error.strerror or error}"
        if is_no_space(error):
            raise NoSpace(f"{message}. The PLC goes on when there is room: free some space on the disk") from error
        raise BuildFailed(message) from error
    link.post(protocol.Ready(builder.message, programs.sources(timeline.resource.version), fresh))
    return Loop(timeline, programs, link, start, builder.message, builder.tiers)


def _begun(start: protocol.Start, path: Path, builder: Builder) -> tuple[Timeline, HostPrograms]:
    sources = start.sources
    programs = HostPrograms(builder, {sources.version: sources})
    timeline = Timeline.begin(
        path, programs, sources.version, pack_body(sources), ENTRIES, start.name, Detection(), run_limit(start.run_mib),
        _agenda(builder),
    )  # fmt: skip
    refusal = timeline.submit(SetClock("server", wall_time()))
    if isinstance(refusal, Refusal):  # a run that has not begun must not take the place of one that waits aside
        timeline.recording.close()
        path.unlink()
        raise OSError(errno.ENOSPC, refusal.message)
    return timeline, programs


def _resumed(start: protocol.Start, path: Path, builder: Builder) -> tuple[Timeline, HostPrograms]:
    def programs_of(kept: Mapping[int, KeptProgram]) -> HostPrograms:
        return HostPrograms(builder, {each.version: sources_in(each) for each in kept.values()})

    timeline = Timeline.resume(
        path, programs_of, ENTRIES, start.until, Detection(), run_limit(start.run_mib), _agenda(builder)
    )  # fmt: skip
    assert isinstance(timeline.programs, HostPrograms)
    return timeline, timeline.programs


def _agenda(builder: Builder) -> Agenda:
    return agenda_of_faults(builder.flavours.observed)
