"""How far long work is: told on a terminal only."""

import io
import re
import sys

import pytest

from scanbench.cli.progress import progress

COLOUR = re.compile(r"\x1b\[[1-9][\d;]*m")


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def shown(monkeypatch: pytest.MonkeyPatch, stream: io.StringIO) -> str:
    monkeypatch.setattr(sys, "stderr", stream)
    with progress(10, lambda: 5, lambda: "5 of 10 scans"):
        pass
    return stream.getvalue()


def test_on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.delenv("NO_COLOR", raising=False)
    text = shown(monkeypatch, Terminal())
    assert "5 of 10 scans" in text
    assert COLOUR.search(text)
    assert text.endswith(("\x1b[1A\x1b[2K", "\x1b[2K")), "the line goes when the work is done"


def test_without_colours_where_nobody_wants_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("NO_COLOR", "1")
    text = shown(monkeypatch, Terminal())
    assert "5 of 10 scans" in text
    assert not COLOUR.search(text)


def test_not_in_a_file_or_a_pipe(monkeypatch: pytest.MonkeyPatch) -> None:
    assert shown(monkeypatch, io.StringIO()) == ""
