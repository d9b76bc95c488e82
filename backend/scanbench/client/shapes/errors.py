"""Answers of the REST API: errors. Made by `python -m tests.client_shapes`; do not edit."""

from typing import Literal, NotRequired, TypedDict


class DeviceDetail(TypedDict):
    """One detail of an error as the memory shows it."""

    name: str
    """As in the catalogue: `rack`."""
    value: str
    """A number, a text or the id of a choice; several choices that are on together are joined by `+`."""
    text: str
    """For people, in English: `Rack number: 1`."""


class DeviceError(TypedDict):
    """An error that the memory shows as present."""

    id: str
    """Of the catalogue; empty where a flag is on and nothing says which of its errors it is."""
    name: str
    severity: Literal["fatal", "nonfatal"]
    code: str
    """With what details add; empty where the memory does not say it."""
    flag: str
    details: list[DeviceDetail]
    text: str
    """What the program said with it: the text of FAL or FALS."""
    cause: str
    """What the catalogue says about it."""
    lasting: bool
    """While its cause lasts it shows again as soon as it is cleared."""
    top: bool
    """Its code is the one in the code word."""


class DeviceRecord(TypedDict):
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
    severity: Literal["fatal", "nonfatal"] | None
    details: list[DeviceDetail]
    text: str
    """What the program says now with this number; the log itself keeps no text."""


class DeviceMessage(TypedDict):
    """A message that the program shows on tools (MSG)."""

    number: int
    text: str
    instruction: str


class DeviceStandby(TypedDict):
    """Which CPU Unit controls, of a device with two."""

    duplex: bool
    """Both run; false: one is left (simplex)."""
    side: Literal["left", "right"]
    """The CPU Unit that controls."""
    causes: list[str]
    """The errors for which the standby took over last, by id; empty where it never did since the start."""
    time: str
    """The PLC's clock when it took over last, `2026-11-24 10:15:02`; empty where it never did, or the memory does not say."""


class DeviceErrors(TypedDict):
    """The device's own view of its errors, read from its memory at one scan."""

    scan: int
    past: bool
    """It is the past that is shown."""
    code: str
    """What the code word shows; all digits 0 where no error is present, empty where the model has no code word."""
    codes: Literal["hex4", "hex8", "decimal"]
    """How the model writes its codes: four or eight hexadecimal digits, or decimal."""
    has_log: bool
    """The model keeps an error log in its memory."""
    keeps_latest: bool
    """The model keeps the latest error with its time instead of a log."""
    errors: list[DeviceError]
    """The most serious first."""
    log: list[DeviceRecord]
    """The newest first."""
    messages: list[DeviceMessage]
    standby: DeviceStandby | None
    """None where the device has one CPU Unit."""


class ArmedFault(TypedDict):
    """A fault that was armed and is not over, for people."""

    id: int
    errors: list[str]
    text: str
    """Start and shape in a sentence."""
    by: str
    state: Literal["waiting", "running"]
    raised: int
    """How often until now."""
    next_scan: int | None
    """Of its next step, when that is known."""


class ErrorAcknowledged(TypedDict):
    """Somebody acknowledged an error at an alarm list."""

    by: str
    at: str
    """ISO 8601, UTC."""
    scan: int
    remark: str
    """empty: none."""


class ReactionState(TypedDict):
    """In short, for the tables. `recording`: the window is not over; `failed`: `message` says why there is none."""

    state: Literal["recording", "done", "failed"]
    verdict: (
        Literal[
            "acted",
            "decided",
            "displayed",
            "stored",
            "no_effect",
            "not_reached",
            "never_read",
            "stopped",
            "reacted",
            "stored_only",
        ]
        | None
    )
    scans: int | None
    """scans until the first effect, from 1."""
    unmet: int
    """so much is not as it is required, unexpected restarts counted."""
    message: str


class ErrorHistoryRow(TypedDict):
    """One row per error instance: has this version of the program been tested against it?"""

    id: str
    instance: str
    """which of its kind (`fal:number=5`), what `recover` takes; empty: the kind, of which none is known yet."""
    fitted: bool
    """false: the project's hardware.json does not have it."""
    label: str
    """what hardware.json calls the unit or the number."""
    name: str
    severity: Literal["fatal", "nonfatal"]
    status: Literal["never", "generated", "cleared"]
    code: str
    details: str
    generated_at: str | None
    """ISO 8601, UTC."""
    recovered_at: str | None
    generated_scan: int | None
    recovered_scan: int | None
    recovered_by: str
    """who did it; empty: it is present, or went with a restart."""
    recovered_way: Literal["simulator", "tool", "program"] | None
    """simulator: recovered, its cause is gone, too; tool, program: cleared in the device's own way."""
    acknowledged: ErrorAcknowledged | None
    """who acknowledged it the last time that it was raised; null: nobody."""
    by: str | None
    origin: Literal["simulator", "plc", "program"] | None
    count: int
    reaction: ReactionState | None
    """of the last time; null when nobody compared."""
    swept: ReactionState | None
    """what the newest sweep of this version found out, the worst of its states."""


class FaultStart(TypedDict):
    """When a fault begins: now, before `scan`, when `condition` holds, when the statement at `file`:`line` is reached."""

    kind: NotRequired[Literal["now", "scan", "condition", "line"]]
    scan: NotRequired[int | None]
    condition: NotRequired[str]
    file: NotRequired[str]
    line: NotRequired[int]


class FaultShape(TypedDict):
    """How a fault goes on. stay: until it is recovered. for: `scans`. intermittent: present for `scans` of each `period`, `times` times (null: until it is taken back), varied by chance when there is a `seed`. chatter: on and off in turn, scan by scan, `times` times. unacknowledged: recovered after `scans`, before `acknowledge` (a condition) holds. chance: while it is gone, it comes in each scan with a probability of `per_million` millionths, and is present for `scans`; `seed` decides in which."""

    kind: NotRequired[Literal["stay", "for", "intermittent", "chatter", "unacknowledged", "chance"]]
    scans: NotRequired[int]
    period: NotRequired[int]
    times: NotRequired[int | None]
    seed: NotRequired[int | None]
    acknowledge: NotRequired[str]
    per_million: NotRequired[int]


class PreviewedWrite(TypedDict):
    """A bit or a word, with its values before and after."""

    address: str
    """In the vendor's notation."""
    before: str
    after: str
    what: Literal["detail", "code", "flag", "log", "time", "outputs", "other"]
    error: str
    """Which error writes it; empty for the code word, the log, the time and what the PLC itself does."""


class PreviewedErrors(TypedDict):
    """What raising errors would do: what the plan says, or why it would be refused."""

    ok: bool
    message: str
    scan: int
    writes: list[PreviewedWrite]
    """In the order of the memory."""
    more: int
    """Words that change besides, and are not named."""


class HistoryVersion(TypedDict):
    """A version of the program that has an error history on a PLC."""

    version: int
    running: bool
    raised: int
    """Errors that were raised on it."""
    at: str | None
    """When it was built; None: the project does not know it, as after a run that was imported."""
    author: str


class HistoryOfVersion(TypedDict):
    """The error history of one version, in the order of the catalogue."""

    version: int
    running: bool
    rows: list[ErrorHistoryRow]
