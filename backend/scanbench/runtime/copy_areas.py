"""CopyAreas: a tool at a communication port has the PLC copy memory, within one seam."""

from dataclasses import dataclass
from typing import ClassVar

from scanbench.runtime.command import Category, Command, Plan, Refusal, View
from scanbench.runtime.write_areas import AreaWrite, WriteAreas


@dataclass(frozen=True, slots=True)
class CopyAreas(Command):
    """`size` bytes from one place to a second one, as they are in that seam; as `WriteAreas` otherwise."""

    category: ClassVar[Category] = "write"

    source: str
    """The area."""
    source_byte: int
    target: str
    target_byte: int
    size: int

    def plan(self, view: View) -> Plan | Refusal:
        """That of the write which it comes to."""
        area = view.model.area(self.source)
        if area is None or min(self.source_byte, self.size) < 0 or self.source_byte + self.size > area.size:
            return Refusal(f"{self.source}, byte {self.source_byte}: {view.model.name} has no such memory")
        begin = view.program.layout.areas[area.name] + self.source_byte
        data = bytes(view.memory[begin : begin + self.size])
        return WriteAreas(self.author, (AreaWrite(self.target, self.target_byte, data),)).plan(view)
