"""The contract of who turns what the PLC notices in itself into commands: errors of the program, and what it asks for."""

from typing import NamedTuple, Protocol

from scanbench.check.system.network_text import OPERANDS
from scanbench.check.system.system_text import Form
from scanbench.program.layout import Layout
from scanbench.runtime.command import Command, View
from scanbench.runtime.trap import TrapInfo


class Asked(NamedTuple):
    """One entry of `Layout.ASKED`: the program called an instruction of the model."""

    instruction: int
    """Index into `Model.instructions`."""
    number: int
    form: int = 0
    """`check.system_text.Form`: what `instruction` and `number` say."""
    places: tuple[int, ...] = ()
    """Of a communications instruction: where its operands lie in the image."""


class Detect(Protocol):
    """Its commands are entered in the same seam, and journaled: a replay never asks again.

    A command that is refused is dropped, as nobody is there to read why.
    """

    def on_trap(self, info: TrapInfo, view: View) -> Command | None:
        """The error that represents a trap, of any kind; `Trapped` and the answers to `on_asked` were entered before."""

    def on_asked(self, asked: tuple[Asked, ...], view: View) -> tuple[Command, ...]:
        """What becomes of what the program asked for in the scan that just ended, or trapped."""


def read_asked(memory: bytearray | bytes | memoryview) -> tuple[Asked, ...]:
    """What the program asked for in the last scan."""
    count = min(int.from_bytes(memory[Layout.ASKED_COUNT : Layout.ASKED_COUNT + 4], "little"), Layout.ASKED_LIMIT)
    entries = [bytes(memory[at : at + 8]) for at in range(Layout.ASKED, Layout.ASKED + 8 * count, 8)]
    found, at = list[Asked](), 0
    while at < count:
        entry, at = entries[at], at + 1
        operands: tuple[int, ...] = ()
        if entry[1] == Form.NETWORK:
            operands = tuple(int.from_bytes(each, "little") for each in entries[at : at + len(OPERANDS)])
            at += len(OPERANDS)
        found.append(Asked(entry[0], int.from_bytes(entry[4:], "little"), entry[1], operands))
    return tuple(found)
