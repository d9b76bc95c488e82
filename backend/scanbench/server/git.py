"""The `git` program: without a shell, bounded in time and output, and deaf to settings that would run something.

A repository may have been pulled from anywhere, so nothing in it is trusted: no hooks, no filters, no pager, no signatures, no remotes.
"""

import asyncio
import os
import shutil
from contextlib import suppress
from pathlib import Path

from scanbench.wire.refused import Refused

MISSING = (
    "the program git is not installed on the server: install it (apt-get install git), then try again. "
    "Versions of built programs are kept without it"
)
LONGEST_S = 30.0
LARGEST = 64 << 20
"""Bytes of an answer."""
_SETTINGS = (
    "core.hooksPath=/dev/null", "core.fsmonitor=false", "core.autocrlf=false", "core.quotePath=false", "commit.gpgSign=false",
    "log.showSignature=false", "gc.auto=0", "protocol.allow=never", "init.defaultBranch=main", "i18n.commitEncoding=UTF-8",
    "i18n.logOutputEncoding=UTF-8",
)  # fmt: skip
_ENVIRONMENT = {
    "GIT_CONFIG_NOSYSTEM": "1", "GIT_CONFIG_GLOBAL": "/dev/null", "GIT_TERMINAL_PROMPT": "0", "GIT_NO_LAZY_FETCH": "1",
    "GIT_LITERAL_PATHSPECS": "1", "GIT_NO_REPLACE_OBJECTS": "1", "GIT_OPTIONAL_LOCKS": "0", "LC_ALL": "C.UTF-8", "HOME": "/nonexistent",
}  # fmt: skip


def installed() -> bool:
    """Whether there is a program `git`."""
    return shutil.which("git") is not None


async def git(folder: Path, *arguments: str, stdin: bytes = b"") -> bytes:
    """What `git` prints for a working tree; `Refused` with its own words where it fails."""
    done, output, errors = await _run(folder, arguments, stdin)
    if done:
        said = errors.decode(errors="replace").strip().splitlines()
        raise Refused(f"git {arguments[0]} failed in {folder}: {said[-1] if said else f'it ended with {done}'}")
    return output


async def asked(folder: Path, *arguments: str) -> str | None:
    """One line of an answer; None where git says that there is no such thing."""
    done, output, _ = await _run(folder, arguments, b"")
    return None if done else output.decode(errors="replace").strip()


async def _run(folder: Path, arguments: tuple[str, ...], stdin: bytes) -> tuple[int, bytes, bytes]:
    program = shutil.which("git")
    if program is None:
        raise Refused(MISSING)
    settings = [word for setting in _SETTINGS for word in ("-c", setting)]
    where = [f"--git-dir={folder / '.git'}", f"--work-tree={folder}"]
    process = await asyncio.create_subprocess_exec(
        program, "--no-pager", *settings, *where, *arguments,
        cwd=folder, env={"PATH": os.environ.get("PATH", os.defpath), **_ENVIRONMENT},
        stdin=asyncio.subprocess.PIPE if stdin else asyncio.subprocess.DEVNULL, stdout=asyncio.subprocess.PIPE, stderr=asyncio.subprocess.PIPE,
    )  # fmt: skip
    try:
        async with asyncio.timeout(LONGEST_S):
            _, output, errors = await asyncio.gather(
                _fed(process, stdin), _bounded(process.stdout, arguments[0]), _bounded(process.stderr, arguments[0])
            )
            return await process.wait(), output, errors
    except TimeoutError as error:
        raise Refused(f"git {arguments[0]} did not end within {LONGEST_S:.0f} s in {folder}") from error
    finally:
        if process.returncode is None:
            process.kill()
            await process.wait()


async def _fed(process: asyncio.subprocess.Process, data: bytes) -> None:
    if process.stdin is None:
        return
    with suppress(
        BrokenPipeError, ConnectionResetError, RuntimeError
    ):  # it ended before it read everything: its exit code says why
        process.stdin.write(data)
        await process.stdin.drain()
    process.stdin.close()


async def _bounded(stream: asyncio.StreamReader | None, what: str) -> bytes:
    assert stream is not None
    read = bytearray()
    while part := await stream.read(1 << 16):
        read += part
        if len(read) > LARGEST:
            raise Refused(f"git {what} answers with more than {LARGEST >> 20} MiB: that is too large for a project")
    return bytes(read)
