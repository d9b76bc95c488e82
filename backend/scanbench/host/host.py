"""The process of one PLC: the threads of the link, of the loop and of builds."""

import logging
import os
import signal
import socket
import sys
import threading
from pathlib import Path

from scanbench.engines.lifeline import end_with_parent
from scanbench.faults.arm import Arm
from scanbench.faults.shapes import Start, Wanted
from scanbench.host.build import Builder, BuildFailed
from scanbench.host.builds import Builds
from scanbench.host.limits import MemoryLimit, limit_files
from scanbench.host.link import Link
from scanbench.host.lookup import look_up, place_is, words_are
from scanbench.host.loop import Loop
from scanbench.host.opening import NoSpace, open_loop
from scanbench.wire import host as protocol
from scanbench.wire.memory import WantPlace, WantWords
from scanbench.wire.traces import ReadTrace

log = logging.getLogger("scanbench")
_NO_TICK_NS = 1_000_000_000
"""While there is no loop yet."""


def serve(sock: socket.socket, cache: Path | None, parent: int) -> int:
    """Serves one PLC until the process `parent` says `Quit`, or is gone; the exit code."""
    sys.setswitchinterval(0.0002)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the parent's business
    limit_files()
    with sock:
        return Host(Link(sock), Builder(cache), parent).run()


class Host:
    """Serves one PLC."""

    def __init__(self, link: Link, builder: Builder, parent: int) -> None:
        self._link, self._builder, self._parent = link, builder, parent
        self._memory = MemoryLimit()
        self._builds = Builds(builder, link, self._memory)
        self._start: protocol.Start | None = None
        self._started = threading.Event()
        self._loop: Loop | None = None
        self._waiting: list[object] = []
        self._handover = threading.Lock()
        self._no_space = False

    def run(self) -> int:
        """Runs the loop in the calling thread, which must be the main one."""
        thread = threading.Thread(target=self._serve, name="link", daemon=True)
        thread.start()
        self._started.wait()
        if self._start is None:
            return 0
        end_with_parent(self._parent)  # it has spoken, so it has adopted this process
        failure = self._lived(self._start)
        if failure is not None:
            self._link.post(protocol.StartFailed(failure, self._no_space))
        self._link.close()
        thread.join()
        return 0 if failure is None else 1

    def _lived(self, start: protocol.Start) -> str | None:
        """The PLC's life; returns why it must not be started again, if so."""
        try:
            self._memory.hold(start.memory_mib)
            loop = open_loop(start, self._builder, self._link)
            self._builds.serve_debugger(loop)
            self._builds.optimise(loop)
            with self._handover:
                self._loop = loop
                for message in self._waiting:
                    self._on_message(message)
            loop.run()
        except MemoryError as error:
            return self._memory.report(error)
        except (BuildFailed, ValueError) as error:
            if self._loop is not None:
                raise
            self._no_space = isinstance(error, NoSpace)
            return str(error)
        return None

    # ---- the link's thread ----------------------------------------------------------------------------------------

    def _serve(self) -> None:
        try:
            self._link.serve(self._on_link, self._on_tick, self._tick_ns)
        except MemoryError as error:
            self._link.last_words(protocol.StartFailed(self._memory.report(error)))
            os._exit(1)
        except BaseException:
            log.exception("the link of a PLC failed")
            os._exit(1)  # it cannot be reached any more: the parent starts it again
        # The parent is gone, or the loop has ended: in both cases nothing is left to do here.
        self._started.set()
        with self._handover:
            if self._loop is None:
                self._waiting.append(protocol.Quit())
            else:
                self._loop.give(protocol.Quit())

    def _tick_ns(self) -> int:
        return self._loop.tick_ns() if self._loop is not None else _NO_TICK_NS

    def _on_tick(self) -> None:
        if self._loop is not None:
            self._loop.tick()

    def _on_link(self, message: object) -> None:
        if isinstance(message, protocol.Start):
            self._start = message
            self._started.set()
            return
        if isinstance(message, protocol.Ping):
            self._link.post(protocol.Pong())
            return
        with self._handover:
            if self._loop is None:
                self._waiting.append(message)
            else:
                self._on_message(message)

    def _on_message(self, message: object) -> None:
        assert self._loop is not None
        match message:
            case ReadTrace():
                self._loop.traces.read(message)
            case protocol.Lookup():
                self._link.post(look_up(self._loop.resource.program, message))
            case WantWords():
                self._link.post(words_are(self._loop.resource.program, message))
            case WantPlace():
                self._link.post(place_is(self._loop.resource.program, message))
            case protocol.WantSources():
                self._link.post(self._loop.programs.told(message))
            case protocol.Submit(command=Arm(wanted=Wanted(start=Start(kind="line")))):
                self._builds.observe(message, self._loop)
            case protocol.Build() | protocol.Preview() | protocol.RollBack():
                self._builds.take(message, self._loop)
            case protocol.Attend():
                if message.anybody:
                    self._builds.get_ready(self._loop)
                self._loop.give(message)
            case _:
                self._loop.give(message)
