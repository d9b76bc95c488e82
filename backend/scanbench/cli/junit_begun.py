"""The JUnit report of a command that has none yet: whatever ends it before, a build server never takes the report of the last time."""

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

OPTION = "--junit"
_REPORT = """\
<?xml version='1.0' encoding='utf-8'?>
<testsuites tests="1" failures="0" errors="1" skipped="0">
  <testsuite name="scanbench" tests="1" failures="0" errors="1" skipped="0">
    <testcase classname="scanbench" name="the command comes to a result">
      <error message="it was refused, or ended before it had one: what it printed says why" type="no_result"/>
    </testcase>
  </testsuite>
</testsuites>
"""
"""Written out here: what makes these reports otherwise takes long to be imported, and each command would wait for it."""
_MARK = b"<testsuites"
_HEAD = 200
"""Bytes in which a report says that it is one."""


def begin_junit(args: Sequence[str]) -> None:
    """Puts an error into the file that these arguments name, until the command writes its report there. A file with something else in it is
    left alone, and so is one that cannot be written: the command itself says so."""
    path = _named(args)
    if path is None or "--help" in args or "-h" in args:
        return
    with suppress(OSError):
        if path.exists() and path.stat().st_size and _MARK not in _head(path):
            return
        path.write_text(_REPORT, "utf-8")


def _named(args: Sequence[str]) -> Path | None:
    for at, each in enumerate(args):
        if each == OPTION and at + 1 < len(args):
            return Path(args[at + 1])
        if each.startswith(f"{OPTION}="):
            return Path(each.removeprefix(f"{OPTION}="))
    return None


def _head(path: Path) -> bytes:
    with path.open("rb") as file:
        return file.read(_HEAD)
