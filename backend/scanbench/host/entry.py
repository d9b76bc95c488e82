"""What the process of a PLC, or of jobs, begins with: a function that is named as text, so that nobody here has to know it."""

import socket
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

Serve = Callable[[socket.socket, Path | None, int], int]
"""Serves on the socket, keeps what it builds in the directory, until the process of this number is gone; the exit code."""


def entry(name: str) -> Serve:
    """The function `module:function`."""
    module, function = name.split(":")
    found: Serve = getattr(import_module(module), function)
    return found
