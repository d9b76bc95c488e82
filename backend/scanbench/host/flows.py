"""What the code of an instance saw, for who looks at it: in the thread of the scan loop, between two scans.

A scan that is over is run again from the nearest checkpoint. While the PLC runs that would take too long: the state before one scan is kept, that
scan is run as all are, and then once more from that state, by the debug flavour. What the PLC has come to is put back each time.
"""

from collections import deque

from scanbench.debug.flow import FlowHook
from scanbench.debug.flow_shown import FlowAsked, Flows
from scanbench.host.link import Link
from scanbench.recording.again import kept_moment, listen_again
from scanbench.recording.moment import Moment
from scanbench.recording.timeline import Timeline
from scanbench.runtime.clock import monotonic_ns
from scanbench.runtime.command import Refusal
from scanbench.runtime.resource import Resource
from scanbench.symbols.symbols import UnknownPath
from scanbench.wire import debugging as debug_protocol
from scanbench.wire import host as protocol

_SHARE = 10
"""While the PLC runs, at most one part in so many of the time goes to who looks."""


class FlowsOf:
    """Answers `WantFlow`."""

    def __init__(self, timeline: Timeline, link: Link) -> None:
        self._timeline, self._link = timeline, link
        self._waiting: deque[debug_protocol.WantFlow] = deque()
        self._due = 0

    @property
    def waiting(self) -> bool:
        """Whether somebody waits for a scan."""
        return bool(self._waiting)

    def ask(self, request: debug_protocol.WantFlow) -> None:
        """It is answered after the next scan, or by `answer` where none runs."""
        self._waiting.append(request)

    # ---- while it waits ---------------------------------------------------------------------------------------------

    def answer(self) -> None:
        """No scan runs: the last one is looked at, and what has run of the next one."""
        while self._waiting:
            request = self._waiting.popleft()
            try:
                self._post(request, self._still(request.asked))
            except UnknownPath as error:
                self._refuse(request, error)

    def _still(self, asked: FlowAsked) -> Flows:
        resource = self._timeline.resource
        scan, inside = resource.header.scan, resource.listening.inside
        version, file = resource.version, ""
        found, refused = [], ""
        wanted = [(scan - 1, 0)] if scan else []
        if inside is not None or resource.header.halted_by_trap:
            wanted.insert(0, (scan, inside.count if inside is not None else 0))
        for each, upto in wanted:
            hook = self._listened(asked, each, upto)
            if isinstance(hook, Refusal):
                refused = hook.message
            elif hook.version == version:
                found.append(hook.flow)
                file = hook.file
        return Flows(file, version, tuple(found), refused)

    def _listened(self, asked: FlowAsked, scan: int, upto: int) -> FlowHook | Refusal:
        made: list[FlowHook] = []

        def make(resource: Resource) -> FlowHook:
            made.append(FlowHook(resource, asked, upto))
            return made[0]

        refusal = listen_again(self._timeline, scan, make)
        return refusal if refusal is not None else made[0]

    # ---- while it runs ----------------------------------------------------------------------------------------------

    def begin(self) -> Moment | None:
        """Before the PLC runs: the state from which one scan is to be run again; then only that one is to run now."""
        if not self._waiting or monotonic_ns() < self._due or self._timeline.resource.begun:
            return None
        return kept_moment(self._timeline)

    def ran(self, begin: Moment) -> None:
        """The scan has run."""
        resource = self._timeline.resource
        if resource.header.scan != begin.scan + 1 or resource.loaded is not begin.loaded or resource.begun:
            return
        start, requests = monotonic_ns(), list(self._waiting)
        self._waiting.clear()
        for request in requests:
            made: list[FlowHook] = []

            def make(resource: Resource, asked: FlowAsked = request.asked, made: list[FlowHook] = made) -> FlowHook:
                made.append(FlowHook(resource, asked))
                return made[0]

            try:
                refusal = listen_again(self._timeline, begin.scan, make, begin)
                version = begin.loaded.version
                if refusal is not None:
                    self._post(request, Flows("", version, (), refusal.message))
                else:
                    self._post(request, Flows(made[0].file, version, (made[0].flow,)))
            except UnknownPath as error:
                self._refuse(request, error)
        now = monotonic_ns()
        self._due = now + _SHARE * (now - start)

    # ---- answers ----------------------------------------------------------------------------------------------------

    def _post(self, request: debug_protocol.WantFlow, flows: Flows) -> None:
        self._link.post(debug_protocol.FlowIs(request.ref, flows))

    def _refuse(self, request: debug_protocol.WantFlow, error: UnknownPath) -> None:
        scan = self._timeline.resource.header.scan
        self._link.post(protocol.Ack(request.ref, False, error.message, scan, tuple(error.near)))
