"""The zygote: `python -m scanbench.host.forking FD ENTRY...` imports everything once, and forks a process for every request.

A request on the socket FD is the entry of the new process and the directory of the cache, with the new process's own socket; the
reply is the number of the process, or why there is none. It ends when the server closes the socket, or is gone.

A host is forked twice, so that the server, which adopts orphans, becomes its parent. This process has one thread, and must
never start a second one, because a fork would lose it.
"""

import logging
import os
import socket
import sys
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import msgpack  # type: ignore[import-untyped]

from scanbench.check.incremental import Checks
from scanbench.engines.lifeline import end_with_parent, ignore_interrupts
from scanbench.garbage import keep_what_is_there, without_collection
from scanbench.host.build import Builder, all_models
from scanbench.host.entry import Serve, entry
from scanbench.host.program_cache import key_of
from scanbench.plcmodel.load import NoModels
from scanbench.wire.host import Sources

_LARGEST_REQUEST = 65536
_WARM = "PROGRAM warm\nVAR t : TON; s : STRING; END_VAR\n  t(IN := NOT t.Q, PT := T#1s);\nEND_PROGRAM\n"
log = logging.getLogger("scanbench")


def main() -> int:
    """Forks until the socket is closed."""
    ignore_interrupts()
    server = os.getppid()
    end_with_parent(server)  # also when it is stopped, and so does not see that the socket is closed
    with socket.socket(fileno=int(sys.argv[1])) as channel:
        channel.set_inheritable(False)
        with without_collection():
            entries = {name: entry(name) for name in sys.argv[2:]}
            _warm()
        keep_what_is_there()  # a collection in a host would touch every object, and so copy every page
        while True:
            request, fds, _, _ = socket.recv_fds(channel, _LARGEST_REQUEST, 1)
            if not request:
                return 0
            name, cache = msgpack.unpackb(request)
            child = Child(entries[name], fds[0], Path(cache) if cache is not None else None, server)
            try:
                reply: int | str = _fork(channel, child)
            except OSError as error:
                reply = str(error)
            finally:
                for fd in fds:
                    os.close(fd)
            channel.send(msgpack.packb(reply))


def _warm() -> None:
    """Does once what every host would do: what is only imported or parsed when it is first needed."""
    builder = Builder(None)
    with suppress(NoModels):
        models, _ = all_models()
        for model in models[:1]:
            sources = Sources(model.name, {"warm.st": _WARM}, 10_000_000, 1)
            key_of(sources, model)
            program = Checks().check(sources.files, model, sources.interval_ns).program
            if program is not None and builder.tiers is not None:
                memory = bytearray(program.layout.size)
                builder.tiers.engine(program, memory, "").run(1)


@dataclass(frozen=True, slots=True)
class Child:
    """What is wanted: a process that speaks on `fd`."""

    work: Serve
    fd: int
    cache: Path | None
    server: int

    def serve(self) -> int:
        """Its life; the exit code."""
        return self.work(socket.socket(fileno=self.fd), self.cache, self.server)


def _fork(channel: socket.socket, child: Child) -> int:
    """The number of the new process."""
    told, telling = os.pipe()
    between = os.fork()
    if between == 0:
        _between(channel, child, told, telling)
    os.close(telling)
    try:
        number = os.read(told, 64)
    finally:
        os.close(told)
        os.waitpid(between, 0)  # now the host is the server's child
    if not number:
        raise OSError("out of processes or memory")
    return int(number)


def _between(channel: socket.socket, child: Child, told: int, telling: int) -> None:
    """The child: forks the host and is gone."""
    code = 1
    try:
        host = os.fork()
        if host == 0:
            channel.close()
            os.close(told)
            os.close(telling)
            code = child.serve()
        else:
            os.write(telling, str(host).encode())
            code = 0
    except BaseException:
        log.exception("the process of a PLC failed")
    finally:
        with suppress(OSError, ValueError):
            sys.stderr.flush()
            sys.stdout.flush()
        os._exit(code)  # whatever happens, a child never goes on with what its parent was doing


if __name__ == "__main__":
    sys.exit(main())
