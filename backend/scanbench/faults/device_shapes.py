"""What a tool's window of errors shows: of this PLC's memory, in the notation of its vendor."""

from dataclasses import dataclass
from typing import Literal

from scanbench.plcmodel.catalogue import CodeForm, Severity
from scanbench.public import Public


@dataclass(frozen=True, slots=True)
class DeviceDetail(Public):
    """One detail of an error as the memory shows it."""

    name: str
    """As in the catalogue: `rack`."""
    value: str
    """A number, a text or the id of a choice; several choices that are on together are joined by `+`."""
    text: str
    """For people, in English: `Rack number: 1`."""


@dataclass(frozen=True, slots=True)
class DeviceError(Public):
    """An error that the memory shows as present."""

    id: str
    """Of the catalogue; empty where a flag is on and nothing says which of its errors it is."""
    name: str
    severity: Severity
    code: str
    """With what details add; empty where the memory does not say it."""
    flag: str
    details: tuple[DeviceDetail, ...]
    text: str
    """What the program said with it: the text of FAL or FALS."""
    cause: str
    """What the catalogue says about it."""
    lasting: bool
    """While its cause lasts it shows again as soon as it is cleared."""
    top: bool
    """Its code is the one in the code word."""


@dataclass(frozen=True, slots=True)
class DeviceRecord(Public):
    """A record of the device's own error log."""

    number: int
    """Its place in the log: 1 is the oldest that is there."""
    time: str
    """The PLC's clock at that moment, `2026-11-24 10:15:02`; empty where the record has no time."""
    code: str
    contents: str
    """The word with details, in hexadecimal; empty where the log has none."""
    id: str
    """Of the catalogue; empty where no error has this code."""
    name: str
    severity: Severity | None
    details: tuple[DeviceDetail, ...]
    text: str
    """What the program says now with this number; the log itself keeps no text."""


@dataclass(frozen=True, slots=True)
class DeviceMessage(Public):
    """A message that the program shows on tools (MSG)."""

    number: int
    text: str
    instruction: str


@dataclass(frozen=True, slots=True)
class DeviceStandby(Public):
    """Which CPU Unit controls, of a device with two."""

    duplex: bool
    """Both run; false: one is left (simplex)."""
    side: Literal["left", "right"]
    """The CPU Unit that controls."""
    causes: tuple[str, ...]
    """The errors for which the standby took over last, by id; empty where it never did since the start."""
    time: str
    """The PLC's clock when it took over last, `2026-11-24 10:15:02`; empty where it never did, or the memory does not say."""


@dataclass(frozen=True, slots=True)
class DeviceErrors(Public):
    """The device's own view of its errors, read from its memory at one scan."""

    scan: int
    past: bool
    """It is the past that is shown."""
    code: str
    """What the code word shows; all digits 0 where no error is present, empty where the model has no code word."""
    codes: CodeForm
    """How the model writes its codes: four or eight hexadecimal digits, or decimal."""
    has_log: bool
    """The model keeps an error log in its memory."""
    keeps_latest: bool
    """The model keeps the latest error with its time instead of a log."""
    errors: tuple[DeviceError, ...]
    """The most serious first."""
    log: tuple[DeviceRecord, ...]
    """The newest first."""
    messages: tuple[DeviceMessage, ...]
    standby: DeviceStandby | None = None
    """None where the device has one CPU Unit."""
