"""Child main: `python -m scanbench.session.host FD [CACHE]`: FD is the socket to the parent, CACHE a directory."""

import ctypes
import os
import signal
import socket
import sys
import threading
from pathlib import Path

import zstandard

from scanbench.runtime.header import Mode
from scanbench.runtime.journal import Journal
from scanbench.runtime.replay import replay
from scanbench.runtime.resource import Resource
from scanbench.session import protocol
from scanbench.session.host.build import Builder, BuildFailed, Built
from scanbench.session.host.link import Link
from scanbench.session.host.lookup import look_up
from scanbench.session.host.loop import TICK_NS, Loop
from scanbench.session.host.swaps import BuildRefused, Swap

_PR_SET_PDEATHSIG = 1


def main() -> int:
    """Serves one PLC until the parent says `Quit`, or is gone."""
    _die_with_parent()
    sys.setswitchinterval(0.0002)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the parent's business
    with socket.socket(fileno=int(sys.argv[1])) as sock:
        return Host(Link(sock), Builder(Path(sys.argv[2]) if len(sys.argv) > 2 else None)).run()


class Host:
    """The link's thread and the loop's, and builds beside them."""

    def __init__(self, link: Link, builder: Builder) -> None:
        self._link, self._builder = link, builder
        self._building = threading.Lock()
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
        threading.Thread(target=self._prepare, args=(self._start.sources,), name="prepare", daemon=True).start()
        loop.run()
        self._link.close()
        thread.join()
        return 0

    def _make_loop(self, start: protocol.Start) -> Loop:
        resource = _restored(self._builder.build(start.sources), start)
        note = self._builder.message
        self._link.post(protocol.Ready(note))
        loop = Loop(resource, self._link, start.sources.version, start.speed, start.paused, note, self._builder.tiers)
        self._optimise(loop)
        return loop

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
        """Compiles while the old program runs; the loop swaps in its seam. One build at a time."""
        with self._building:
            try:
                built = self._builder.build(build.sources)
                memory = bytearray(built.program.layout.size)
                engine = built.engine(built.program, memory)
            except Exception as error:  # whatever it is, the old program goes on and somebody must be told
                loop.give(BuildRefused(build.ref, f"the build failed, the old program goes on: {error}"))
                return
            loop.give(Swap(build.ref, built.program, engine, memory, build.sources.version, build.author))
            self._optimise(loop)

    def _prepare(self, sources: protocol.Sources) -> None:
        with self._building:
            self._builder.prepare(sources)

    def _optimise(self, loop: Loop) -> None:
        if self._builder.tiers is not None:
            self._builder.tiers.optimise(loop.give)


def _restored(built: Built, start: protocol.Start) -> Resource:
    """Cold, or as the last life of this PLC left it."""
    if start.checkpoint is None:
        return Resource(built.program, built.engine, Mode.MONITOR)
    state = zstandard.ZstdDecompressor().decompress(start.checkpoint.image)
    resource = Resource(built.program, built.engine, Mode.MONITOR, state)
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
