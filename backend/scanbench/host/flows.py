"""What the code of an instance saw, for who looks at it: in the thread of the scan loop, between two scans.

A scan that is over is run again from the nearest checkpoint. While the PLC runs that would take too long: the state before one scan is kept, that
scan is run as all are, and then once more from that state, by the debug flavour. What the PLC has come to is put back each time.
"""

from collections import deque
from collections.abc import Callable

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
_MOST = 256
"""Questions that wait, at most: a page asks the next one only when it has an answer."""


class FlowsOf:
    """Answers `WantFlow`."""

    def __init__(
        self, timeline: Timeline, link: Link, unready: Callable[[debug_protocol.WantFlow], None]
    ) -> None:  # fmt: skip
        """`unready` takes a question back while there is no debugged code of the program that runs."""
        self._timeline, self._link, self._unready = timeline, link, unready
        self._waiting: deque[debug_protocol.WantFlow] = deque()
        self._due = 0

    @property
    def waiting(self) -> bool:
        """Whether somebody waits for a scan."""
        return bool(self._waiting)

    def ask(self, request: debug_protocol.WantFlow) -> None:
        """It is answered after the next scan, or by `answer` where none runs."""
        if len(self._waiting) >= _MOST:
            scan = self._timeline.resource.header.scan
            message = f"{_MOST} questions about what the code sees wait already: ask again later"
            self._link.post(protocol.Ack(request.ref, False, message, scan))
            return
        self._waiting.append(request)

    def _given_back(self) -> bool:
        """Whether a new program runs since it was asked, whose debugged code has to be built first: not here, between two scans."""
        if self._timeline.live.debug is not None:
            return False
        waiting, self._waiting = self._waiting, deque()
        for request in waiting:
            self._unready(request)
        return True

    # ---- while it waits ---------------------------------------------------------------------------------------------

    def answer(self) -> None:
        """No scan runs: the last one is looked at, and what has run of the next one."""
        if self._given_back():
            return
        while self._waiting:
            same = self._same()
            try:
                flows = self._still(same[0].asked)
                for request in same:
                    self._post(request, flows)
            except UnknownPath as error:
                for request in same:
                    self._refuse(request, error)

    def _same(self) -> list[debug_protocol.WantFlow]:
        """Who has waited longest, and all who ask the same: they wait no longer."""
        asked = self._waiting[0].asked
        same = [each for each in self._waiting if each.asked == asked]
        self._waiting = deque(each for each in self._waiting if each.asked != asked)
        return same

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
        return Flows(file, version, tuple(found), refused, asked.first, asked.last)

    def _listened(
        self, asked: FlowAsked, scan: int, upto: int, begin: Moment | None = None
    ) -> FlowHook | Refusal:  # fmt: skip
        made: list[FlowHook] = []

        def make(resource: Resource) -> FlowHook:
            made.append(FlowHook(resource, asked, upto))
            return made[0]

        refusal = listen_again(self._timeline, scan, make, begin)
        return refusal if refusal is not None else made[0]

    # ---- while it runs ----------------------------------------------------------------------------------------------

    def begin(self) -> Moment | None:
        """Before the PLC runs: the state from which one scan is to be run again; then only that one is to run now."""
        if not self._waiting or monotonic_ns() < self._due or self._timeline.resource.begun:
            return None
        return None if self._given_back() else kept_moment(self._timeline)

    def ran(self, begin: Moment) -> None:
        """The scan has run. As many questions are answered as there is time for, at least one; the others wait for a later scan."""
        resource = self._timeline.resource
        if resource.header.scan != begin.scan + 1 or resource.loaded is not begin.loaded or resource.begun:
            return
        start = now = monotonic_ns()
        upto = start + begin.loaded.program.interval_ns // _SHARE
        while self._waiting:
            self._answer_same(begin)
            now = monotonic_ns()
            if now >= upto:
                break
        self._due = now + _SHARE * (now - start)

    def _answer_same(self, begin: Moment) -> None:
        """Answers who has waited longest, and all who ask the same."""
        same = self._same()
        try:
            asked = same[0].asked
            hook = self._listened(asked, begin.scan, 0, begin)
            version = begin.loaded.version
            if isinstance(hook, Refusal):
                flows = Flows("", version, (), hook.message)
            else:
                flows = Flows(hook.file, version, (hook.flow,), "", asked.first, asked.last)
            for request in same:
                self._post(request, flows)
        except UnknownPath as error:
            for request in same:
                self._refuse(request, error)

    # ---- answers ----------------------------------------------------------------------------------------------------

    def _post(self, request: debug_protocol.WantFlow, flows: Flows) -> None:
        self._link.post(debug_protocol.FlowIs(request.ref, flows))

    def _refuse(self, request: debug_protocol.WantFlow, error: UnknownPath) -> None:
        scan = self._timeline.resource.header.scan
        self._link.post(protocol.Ack(request.ref, False, error.message, scan, tuple(error.near)))
