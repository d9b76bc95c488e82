"""Values of one PLC by REST: read, write, force, and how it runs; for scripts and `scanbench.client`."""

from typing import Annotated, Literal

from pydantic import Field

from scanbench.web.messages import Mode, RestartKind
from scanbench.web.messages_base import Scan, Wire
from scanbench.wire.symbols import SymbolInfo


class Value(Wire):
    """A variable, an address or an expression of ST, as it is between two scans (or where the PLC is halted)."""

    path: str = Field(description="instance path or address; empty for what is computed")
    value: str = Field(
        description="as it would be typed: TRUE, 42, T#5s, 'text'; of a structure how many members it has"
    )
    type: str
    address: str = Field(description="vendor notation where it is located; else empty")
    alias: str = Field(description="of an in-out or reference: what it leads to, `-> Main.tank[3].level (D120)`")


class Channel(Wire):
    """A word of inputs or outputs of a PLC, and what lies in it."""

    address: str = Field(description="in the vendor's notation; of areas that count bits that of its first bit")
    side: Literal["input", "output"]
    terminals: list[SymbolInfo] = Field(description="its bits, or the variables in it that are larger than a bit")
    unit: "ChannelUnit | None" = Field(default=None, description="the unit that hardware.json says it leads to")


class ChannelUnit(Wire):
    """A unit of the project's hardware, of which words of inputs and outputs are."""

    kind: str
    number: int | None
    rack: int | None
    slot: int | None
    name: str = Field(description="what hardware.json calls it; empty: it does not say")


class MemoryWord(Wire):
    """A word of a memory area, and what lies in it."""

    address: str = Field(description="in the vendor's notation: `D100`, `K4X20`, `%MW3`")
    symbols: list[SymbolInfo] = Field(description="variables that lie in it, at least in part")


class MemoryPlace(Wire):
    """A word of a memory area."""

    area: str
    word: int = Field(description="its number within the area")


class WordsFound(Wire):
    """Where a value was found in a memory area."""

    scan: Scan = Field(description="all words were looked at as they were before this scan")
    words: list[int] = Field(description="numbers of words within the area, ascending")
    more: bool = Field(description="there may be more: look again from after the last one")


class ReleaseForces(Wire):
    path: str | None = Field(default=None, description="null releases all")


class Drive(Wire):
    """As `Run` on the socket."""

    action: Literal["continue", "pause", "scan", "speed"]
    speed: float | None = Field(default=None, description="0.01 to 1000; 0 is as fast as possible")
    scans: Annotated[int, Field(ge=1, lt=1 << 53)] | None = None
    until: str | None = Field(default=None, description="a BOOL expression over instance paths and addresses")


class TravelTo(Wire):
    """As `Travel` on the socket."""

    scan: Scan | None = Field(description="shows the PLC as it was before this scan; null returns to live")
    count: Scan = Field(
        default=0, description="inside of the scan, before its statement of this count; 0: its beginning"
    )


class ChangeMode(Wire):
    """As `SetMode` on the socket."""

    mode: Mode


class RestartRequest(Wire):
    """As `Restart` on the socket."""

    kind: RestartKind
