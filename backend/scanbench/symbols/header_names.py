"""What the bytes are called that the system keeps for itself: in the header of the image, and in the list of violations."""

from scanbench.program.layout import Layout

_LIST_HEAD = 8

_FIELDS = (
    (Layout.CLOCK, 8, "virtual time"), (Layout.SCAN, 8, "number of the scan"), (Layout.BUDGET, 8, "loop rounds that are left"),
    (Layout.BUDGET_LIMIT, 8, "loop rounds of a scan"), (Layout.MODE, 1, "mode"), (Layout.FATAL, 1, "what stops the program"),
    (Layout.FORCE_COUNT, 4, "number of forces"), (Layout.EPOCH, 8, "clock at virtual time 0"), (Layout.STARTED, 8, "scan of the last start"),
    (Layout.ASKED_COUNT, 4, "errors that the program raised"), (Layout.INTERVAL, 8, "length of a scan"),
    (Layout.ORIGIN, 8, "virtual time of scan 0"), (Layout.STARTED_AT, 8, "virtual time of the last start"),
    (Layout.DEPTH, 4, "open calls of interfaces"), (Layout.SUBRANGE_ERROR, 1, "_SubrangeError"),
    (Layout.SUBRANGE_COUNT, 4, "_SubrangeErrorCount"),
)  # fmt: skip
_ASKED = ((0, 1, "kind"), (1, 1, "form"), (4, 4, "number"))
_VIOLATION = ((0, 4, "place"), (4, 4, "times"), (8, 8, "instance"), (16, 8, "value"), (24, 8, "first scan"), (32, 8, "last scan"))  # fmt: skip


def system_field(layout: Layout, offset: int) -> tuple[str, int, int] | None:
    """The name, beginning and bytes (1, 2, 4 or 8) of the field that has a byte; None if the system keeps nothing there. Where a byte has no
    meaning by itself its address is the name: `header+43`."""
    if offset < Layout.HEADER_SIZE:
        return _in_header(offset)
    at = offset - layout.paths
    if layout.paths and 0 <= at < 8 * Layout.PATH_LIMIT * Layout.VIOLATION_LIMIT:
        number, rest = divmod(at, 8 * Layout.PATH_LIMIT)
        return f"violation {number + 1}: call {rest // 8 + 1} (system)", offset - rest % 8, 8
    at = offset - layout.violations
    if not layout.violations or not 0 <= at < _LIST_HEAD + Layout.VIOLATION_LIMIT * Layout.VIOLATION_BYTES:
        return None
    if at < _LIST_HEAD:
        name = "number of violations in the list" if at < 4 else "violations that found no room"
        return f"{name} (system)", layout.violations + at // 4 * 4, 4
    number, rest = divmod(at - _LIST_HEAD, Layout.VIOLATION_BYTES)
    return _entry(f"violation {number + 1}", _VIOLATION, offset - rest, rest)


def _in_header(offset: int) -> tuple[str, int, int]:
    for begin, size, name in _FIELDS:
        if begin <= offset < begin + size:
            return name if name.startswith("_") else f"{name} (system)", begin, size
    if Layout.FORCES <= offset < Layout.FORCES_END:
        number, rest = divmod(offset - Layout.FORCES, 8)
        return f"force {number + 1} (system)", offset - rest, 8
    at = offset - Layout.ASKED
    if 0 <= at < 8 * Layout.ASKED_LIMIT:
        return _entry(f"error {at // 8 + 1} that the program raised", _ASKED, offset - at % 8, at % 8)
    return f"header+{offset}", offset, 1


def _entry(of: str, parts: tuple[tuple[int, int, str], ...], begin: int, rest: int) -> tuple[str, int, int]:
    for at, size, name in parts:
        if at <= rest < at + size:
            return f"{of}: {name} (system)", begin + at, size
    return f"{of}: byte {rest} (system)", begin + rest, 1
