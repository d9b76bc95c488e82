"""What is built while a PLC runs: a change of its program, what that would do, and optimised code."""

import logging
import threading
from collections.abc import Callable

from scanbench.engines.probe import Probe
from scanbench.host.build import Builder
from scanbench.host.debugcode import Debuggable, Probed, probed
from scanbench.host.limits import MemoryLimit
from scanbench.host.link import Link
from scanbench.host.loop import Loop
from scanbench.host.observed import Observable
from scanbench.host.swaps import BuildRefused, Swap
from scanbench.runtime.migrate_image import NEW, REMOVED, Change, changes
from scanbench.runtime.programs import Loaded
from scanbench.wire import host as protocol

log = logging.getLogger("scanbench")
LOST_LIMIT = 500
"""So many variables are named that would begin again."""


class Builds:
    """Builds in threads of their own, one at a time; the loop goes on meanwhile."""

    def __init__(self, builder: Builder, link: Link, memory: MemoryLimit) -> None:
        self._builder, self._link, self._memory = builder, link, memory
        self._building = threading.Lock()
        self._ready = False
        self._probed = builder.flavours.probed(aside=True)

    def take(self, message: protocol.Build | protocol.Preview | protocol.RollBack, loop: Loop) -> None:
        """Begins what is asked for; the answer comes when it is done."""
        match message:
            case protocol.Build():
                _in_background("build", lambda: self._build(message.ref, message.sources, message.author, loop))
            case protocol.Preview():
                _in_background("preview", lambda: self._preview(message, loop))
            case protocol.RollBack():
                sources = loop.previous_sources()
                if sources is None:
                    loop.give(
                        BuildRefused(message.ref, "there is no program to go back to: this is the first one of the run")
                    )
                else:
                    _in_background("build", lambda: self._build(message.ref, sources, message.author, loop))

    def observe(self, submit: protocol.Submit, loop: Loop) -> None:
        """Builds observed code of what runs; the command that waits for a statement is entered when that is there."""
        _in_background("observe", lambda: self._observe(submit, loop))

    def get_ready(self, loop: Loop) -> None:
        """Somebody looks, and may edit or debug: checks what runs, once, so that the next check is a short one, and builds
        debugged code of it, so that a breakpoint holds at once."""
        ready, self._ready = self._ready, True
        if not ready or loop.timeline.live.debug is None:
            _in_background("prepare", lambda: self._prepare(loop, not ready))

    def serve_debugger(self, loop: Loop) -> None:
        """Builds what the debugger asks for from now on."""
        loop.debugging.build = lambda: self.debug(loop)
        debugger = loop.debugging.debugger
        debugger.want_probes = lambda loaded, probes: self.probe(loop, loaded, probes)
        debugger.search_with(self._builder.flavours.probed(aside=False))

    def debug(self, loop: Loop) -> None:
        """Builds debugged code of what runs; the loop gets it."""
        _in_background("debug", lambda: self._debug(loop))

    def optimise(self, loop: Loop) -> None:
        """Begins to optimise the program that was built last, if that is left to do."""
        if self._builder.tiers is not None:
            self._builder.tiers.optimise(loop.give)

    def _build(self, ref: int, sources: protocol.Sources, author: str, loop: Loop) -> None:
        with self._building:
            try:
                loaded = loop.programs.make(sources)
                if loop.resource.listening.observing:
                    self._builder.flavours.prepare_observed(loaded.program)
                debugger = loop.debugging.debugger
                if debugger.busy or debugger.breakpoints.placed:  # disabled ones, too: they have to find their places
                    self._debuggable(loaded).put_in_place()
            except Exception as error:  # whatever it is, the old program goes on and somebody must be told
                why = f"the build failed, the old program goes on: {self._why(error)}"
                loop.give(BuildRefused(ref, why))
                return
            loop.give(Swap(ref, loaded, sources, author))
            self.optimise(loop)

    def _preview(self, preview: protocol.Preview, loop: Loop) -> None:
        change, refusal, program = Change(), "", loop.live_program
        with self._building:
            try:
                program = self._builder.preview(preview.sources)
                change = changes(loop.live_program, program)
            except Exception as error:  # as above
                refusal = f"the build failed: {self._why(error)}"
        refusal = refusal or loop.change_refusal(program)
        forgotten = change.forgotten
        others = [each for each in change.lost if each.reason in (NEW, REMOVED)]
        lost = tuple((forgotten + others)[:LOST_LIMIT])
        self._link.post(protocol.Previewed(preview.ref, change.counted, lost, len(change.lost), refusal))

    def _observe(self, submit: protocol.Submit, loop: Loop) -> None:
        with self._building:
            loaded = loop.timeline.live
            version = loaded.version
            try:
                program = loaded.renewed()
                self._builder.flavours.prepare_observed(program)
            except Exception as error:  # as above
                why = f"no code could be built that tells when a statement is reached: {self._why(error)}"
                loop.give(BuildRefused(submit.ref, why))
                return
        loop.give(Observable(version, program, submit))

    def _prepare(self, loop: Loop, edit: bool) -> None:
        with self._building:
            try:
                if edit:
                    self._builder.prepare(loop.programs.sources(loop.timeline.live.version))
            except (MemoryError, LookupError) as error:  # the first edit takes longer, or says the same
                log.warning("not ready for an edit: %s", self._why(error))
        self._debug(loop)

    def _debug(self, loop: Loop) -> None:
        with self._building:
            loaded = loop.timeline.live
            try:
                code = self._debuggable(loaded)
            except Exception as error:  # as above
                why = f"no code could be built that can be halted: {self._why(error)}"
                code = Debuggable(loaded, None, None, why)
        loop.give(code)

    def probe(self, loop: Loop, loaded: Loaded, probes: tuple[Probe, ...]) -> None:
        """Builds code with probes, in whose place the debug flavour runs meanwhile."""
        _in_background("probe", lambda: self._probe(loop, loaded, probes))

    def _probe(self, loop: Loop, loaded: Loaded, probes: tuple[Probe, ...]) -> None:
        with self._building:
            if loop.timeline.live is not loaded:
                return
            try:
                engine = probed(self._probed, loaded, probes)
            except Exception as error:  # as above: it is slower without
                log.warning("breakpoints stay slow: %s", self._why(error))
                return
        if engine is not None:
            loop.give(Probed(loaded, engine))

    def _debuggable(self, loaded: Loaded) -> Debuggable:
        if loaded.debug is not None:
            return Debuggable(loaded, loaded.fresh, None)
        program = loaded.renewed()
        return Debuggable(loaded, program, self._builder.flavours.debug(program, loaded.memory))

    def _why(self, error: Exception) -> str:
        return self._memory.report(error) if isinstance(error, MemoryError) else str(error)


def _in_background(name: str, work: Callable[[], None]) -> None:
    threading.Thread(target=work, name=name, daemon=True).start()
