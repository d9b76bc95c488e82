"""Where the processes of virtual PLCs, and job processes, come from: forked from one process that has everything imported, in milliseconds.

The zygote (`host/forking.py`) forks twice, and the server adopts the grandchild as its own child: so the server learns
how it ended, the kernel ends it with the server, and it does not notice when the zygote is gone: the next one is born in a
new zygote. Where forking is not to be had, every host is a Python of its own.
"""

import ctypes
import os
import select
import signal
import socket
import subprocess
import sys
import threading
from contextlib import suppress
from functools import cache
from pathlib import Path

import msgpack  # type: ignore[import-untyped]

from scanbench.engines.lifeline import interrupts_held

HOST, JOB, CHECK = "scanbench.host.host:serve", "scanbench.jobs.process:serve", "scanbench.jobs.process:serve_checks"
LANGUAGE, OPC_UA = "scanbench.web.lsp.process:serve", "scanbench.comm.opcua.process:serve"
"""Entries of the processes: of one PLC; of jobs; of what checks programs; of a language server; of an OPC UA server."""
ENTRIES = (HOST, JOB, CHECK, LANGUAGE, OPC_UA)
_PR_SET_CHILD_SUBREAPER = 36
_LARGEST_REPLY = 4096
_THRIFT = {
    "MALLOC_ARENA_MAX": "1",  # an arena for each thread is memory that no other thread can use
    "MALLOC_TRIM_THRESHOLD_": "65536",
    "MALLOC_MMAP_THRESHOLD_": "65536",  # what a build needed for a moment goes back to the system
    "OPENBLAS_NUM_THREADS": "1",  # threads of numpy that nobody needs, and that a fork would lose
}


class NoProcess(Exception):
    """A process could not be started; the message says why."""


class HostProcess:
    """The process of one PLC, or of a job, a child of this one."""

    def __init__(self, pid: int) -> None:
        self.pid = pid
        self._lock = threading.Lock()
        self._code: int | None = None

    def kill(self) -> None:
        """Ends it at once. `wait` comes after it all the same."""
        with self._lock:
            if self._code is None:
                with suppress(ProcessLookupError):
                    os.kill(self.pid, signal.SIGKILL)

    def wait(self, seconds: float | None = None) -> int | None:
        """How it ended: its exit code, or the negative number of a signal; None when it still runs after `seconds`."""
        if self._code is None and self._ended(seconds):
            with self._lock:
                if self._code is None:
                    self._code = _code_of(self.pid)
        return self._code

    def _ended(self, seconds: float | None) -> bool:
        try:
            handle = os.pidfd_open(self.pid)
        except ProcessLookupError:
            return True
        try:
            poll = select.poll()
            poll.register(handle, select.POLLIN)
            return bool(poll.poll(None if seconds is None else seconds * 1000))
        finally:
            os.close(handle)


class _Single:
    """A host that was started as a Python of its own."""

    def __init__(self, process: "subprocess.Popen[bytes]") -> None:
        self.pid, self._process = process.pid, process

    def kill(self) -> None:
        """As `HostProcess`."""
        self._process.kill()

    def wait(self, seconds: float | None = None) -> int | None:
        """As `HostProcess`."""
        try:
            return self._process.wait(seconds)
        except subprocess.TimeoutExpired:
            return None


Process = HostProcess | _Single


class Zygote:
    """Starts hosts. Thread-safe; a zygote that died, or does not answer, is replaced by the next `spawn`."""

    def __init__(self, reply_s: float = 60.0, grace_s: float = 3.0) -> None:
        """`reply_s` is how long it may take to fork, the start of Python included."""
        self.reply_s, self._grace_s = reply_s, grace_s
        self._closing = False
        self._lock = threading.Lock()
        self._process: subprocess.Popen[bytes] | None = None
        self._sock: socket.socket | None = None

    @property
    def pid(self) -> int | None:
        """Of the process that hosts are forked from."""
        return self._process.pid if self._process is not None else None

    def start(self) -> None:
        """Has the process ready before somebody waits for it."""
        if _can_fork():
            with self._lock:
                self._connected()

    def spawn(self, sock: socket.socket, cache: Path | None, entry: str = HOST) -> Process:
        """A host, or a job process, that speaks on `sock`, which is the caller's to close, and keeps what it builds in `cache`."""
        if not _can_fork():
            return _single(sock, cache, entry)
        request = msgpack.packb((entry, str(cache) if cache is not None else None))
        with self._lock:
            reply = self._asked(request, sock) or self._asked(request, sock)  # again, in a new zygote
        if not reply:
            raise NoProcess(
                "no process could be started: the one that hosts are forked from has ended twice. See the log"
            )
        answer = msgpack.unpackb(reply)
        if isinstance(answer, int):
            return HostProcess(answer)
        raise NoProcess(f"no process could be started: {answer}")

    def close(self) -> None:
        """Ends the process, whatever it does; hosts go on. Who waits for a host just now gets `NoProcess`."""
        self._closing = True
        if not self._lock.acquire(timeout=self._grace_s):
            process = self._process
            if process is not None:  # whoever has the lock waits for its reply
                process.kill()
            self._lock.acquire()
        try:
            self._end()
        finally:
            self._closing = False
            self._lock.release()

    def _asked(self, request: bytes, sock: socket.socket) -> bytes:
        """The reply, empty when the zygote is gone."""
        channel = self._connected()
        channel.settimeout(self.reply_s)
        try:
            socket.send_fds(channel, [request], [sock.fileno()])
            reply = channel.recv(_LARGEST_REPLY)
        except (ConnectionError, TimeoutError):
            reply = b""
        if not reply:
            self._end()
        return reply

    def _connected(self) -> socket.socket:
        if self._process is not None and self._process.poll() is not None:
            self._end()
        if self._sock is None:
            if self._closing:
                raise NoProcess("no process is started any more: the server ends")
            _adopt_orphans()
            ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
            with theirs:
                command = [sys.executable, "-m", "scanbench.host.forking", str(theirs.fileno()), *ENTRIES]
                try:
                    with interrupts_held():
                        self._process = subprocess.Popen(
                            command, pass_fds=(theirs.fileno(),), stdin=subprocess.DEVNULL, env=os.environ | _THRIFT
                        )
                except OSError as error:
                    ours.close()
                    raise NoProcess(f"no process could be started: {error}") from error
            self._sock = ours
        return self._sock

    def _end(self) -> None:
        if self._sock is not None:
            self._sock.close()  # it ends with it
            self._sock = None
        if self._process is not None:
            try:
                self._process.wait(self._grace_s)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
            self._process = None


@cache
def zygote() -> Zygote:
    """The zygote of this process."""
    return Zygote()


def _can_fork() -> bool:
    return sys.platform == "linux"


def _adopt_orphans() -> None:
    """Makes grandchildren whose parent ends children of this process."""
    if ctypes.CDLL(None, use_errno=True).prctl(_PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0) != 0:
        raise NoProcess("this system does not let a process adopt its grandchildren (Linux 3.4 or newer does)")


def _single(sock: socket.socket, cache: Path | None, entry: str) -> _Single:
    fd = sock.fileno()
    kept = [str(cache)] if cache is not None else []
    command = [sys.executable, "-m", "scanbench.host", str(fd), entry, *kept]
    return _Single(subprocess.Popen(command, pass_fds=(fd,), stdin=subprocess.DEVNULL))


def _code_of(pid: int) -> int:
    try:
        return os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
    except ChildProcessError:  # somebody else has asked for it
        return 0
