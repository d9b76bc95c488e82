"""Child main: `python -m scanbench.session.host FD`, where FD is the socket to the parent."""

import ctypes
import os
import signal
import socket
import sys
import threading

import zstandard

from scanbench.check.program import Program
from scanbench.runtime.header import Mode
from scanbench.runtime.journal import Journal
from scanbench.runtime.replay import replay
from scanbench.runtime.resource import Resource
from scanbench.session import protocol
from scanbench.session.host.build import BuildFailed, compile_sources, find_engines, make_engine
from scanbench.session.host.link import Link
from scanbench.session.host.lookup import look_up
from scanbench.session.host.loop import TICK_NS, BuildRefused, Loop, Swap

_PR_SET_PDEATHSIG = 1


def main() -> int:
    """Serves one PLC until the parent says `Quit`, or is gone."""
    _die_with_parent()
    sys.setswitchinterval(0.0002)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the parent's business
    with socket.socket(fileno=int(sys.argv[1])) as sock:
        return Host(Link(sock)).run()


class Host:
    """The link's thread and the loop's, and builds beside them."""

    def __init__(self, link: Link) -> None:
        self._link = link
        self._start: protocol.Start | None = None
        self._started = threading.Event()
        self._loop: Loop | None = None
        self._waiting: list[object] = []
        self._handover = threading.Lock()

    def run(self) -> int:
        """Runs the loop in the calling thread, which must be the main one."""
        thread = threading.Thread(target=self._serve, name="link", daemon=True)
        thread.start()
        self._started.wait()
        if self._start is None:
            return 0
        try:
            loop = self._make_loop(self._start)
        except (BuildFailed, ValueError, MemoryError) as error:
            self._link.post(protocol.StartFailed(str(error)))
            self._link.close()
            thread.join()
            return 1
        with self._handover:
            self._loop = loop
            for message in self._waiting:
                self._on_message(message)
        loop.run()
        self._link.close()
        thread.join()
        return 0

    def _make_loop(self, start: protocol.Start) -> Loop:
        program = compile_sources(start.sources)
        resource = _restored(program, start)
        note = find_engines().message
        self._link.post(protocol.Ready(note))
        return Loop(resource, self._link, start.sources.version, start.speed, start.paused, note)

    def _serve(self) -> None:
        self._link.serve(self._on_link, self._on_tick, TICK_NS)
        # The parent is gone, or the loop has ended: in both cases nothing is left to do here.
        self._started.set()
        with self._handover:
            if self._loop is None:
                self._waiting.append(protocol.Quit())
            else:
                self._loop.give(protocol.Quit())

    def _on_tick(self) -> None:
        if self._loop is not None:
            self._loop.tick()

    def _on_link(self, message: object) -> None:
        if isinstance(message, protocol.Start):
            self._start = message
            self._started.set()
            return
        with self._handover:
            if self._loop is None:
                self._waiting.append(message)
            else:
                self._on_message(message)

    def _on_message(self, message: object) -> None:
        assert self._loop is not None
        match message:
            case protocol.Lookup():
                self._link.post(look_up(self._loop.resource.program, message))
            case protocol.Build():
                threading.Thread(target=self._build, args=(message, self._loop), name="build", daemon=True).start()
            case _:
                self._loop.give(message)

    def _build(self, build: protocol.Build, loop: Loop) -> None:
        """Compiles while the old program runs; the loop swaps in its seam."""
        try:
            program = compile_sources(build.sources)
            memory = bytearray(program.layout.size)
            engine = make_engine(program, memory)
        except Exception as error:  # whatever it is, the old program goes on and somebody must be told
            loop.give(BuildRefused(build.ref, f"the build failed, the old program goes on: {error}"))
            return
        loop.give(Swap(build.ref, program, engine, memory, build.sources.version, build.author))


def _restored(program: Program, start: protocol.Start) -> Resource:
    """Cold, or as the last life of this PLC left it."""
    if start.checkpoint is None:
        return Resource(program, make_engine, Mode.MONITOR)
    state = zstandard.ZstdDecompressor().decompress(start.checkpoint.image)
    resource = Resource(program, make_engine, Mode.MONITOR, state)
    resource.adopt(Journal(start.journal[: start.checkpoint.entries]))
    replay(resource, start.journal[start.checkpoint.entries :], start.until)
    return resource


def _die_with_parent() -> None:
    """The kernel kills this process when its parent ends, however it ends."""
    parent = os.getppid()
    ctypes.CDLL(None, use_errno=True).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:
        sys.exit(1)


if __name__ == "__main__":
    sys.exit(main())
