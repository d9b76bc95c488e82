"""All commands of FINS that a CPU Unit of Omron answers here, and how one is answered."""

from collections.abc import Awaitable, Callable, Mapping
from types import MappingProxyType

from scanbench.comm.door import Away, Door
from scanbench.comm.fins import control, errors, force, memory, unit
from scanbench.comm.fins.codes import End, Refused
from scanbench.comm.fins.flags import Flagged
from scanbench.comm.fins.frame import Request, answer

Handler = Callable[[Door, bytes], Awaitable[bytes]]

COMMANDS: Mapping[int, Handler] = MappingProxyType(
    {
        0x0101: memory.on_read,
        0x0102: memory.on_write,
        0x0103: memory.on_fill,
        0x0104: memory.on_multiple_read,
        0x0105: memory.on_transfer,
        0x0201: unit.on_parameter_read,
        0x0202: unit.on_parameter_write,
        0x0203: unit.on_parameter_write,
        0x0306: unit.on_program_read,
        0x0307: unit.on_program_write,
        0x0401: control.on_run,
        0x0402: control.on_stop,
        0x0501: unit.on_unit_data,
        0x0502: unit.on_connection_data,
        0x0601: unit.on_status,
        0x0620: control.on_cycle_time,
        0x0701: control.on_clock_read,
        0x0702: control.on_clock_write,
        0x0801: unit.on_loop_back,
        0x0920: errors.on_message,
        0x0C01: control.on_access_right,
        0x0C02: control.on_access_right,
        0x0C03: control.on_access_right,
        0x2101: errors.on_error_clear,
        0x2102: errors.on_log_read,
        0x2103: errors.on_log_clear,
        0x2140: errors.on_access_log_read,
        0x2141: errors.on_access_log_clear,
        0x2301: force.on_force,
        0x2302: force.on_force_cancel,
    }
)
CHANGING = frozenset({0x0102, 0x0103, 0x0105, 0x0202, 0x0203, 0x0307, 0x0401, 0x0402, 0x0702, 0x2101, 0x2103, 0x2141, 0x2301, 0x2302})  # fmt: skip
"""Those that change something: refused where a server only lets clients read."""
NAMES: Mapping[int, str] = MappingProxyType({
    0x0101: "memory area read", 0x0102: "memory area write", 0x0103: "memory area fill", 0x0104: "multiple memory area read",
    0x0105: "memory area transfer", 0x0201: "parameter area read", 0x0202: "parameter area write", 0x0203: "parameter area fill",
    0x0306: "program area read", 0x0307: "program area write", 0x0401: "run", 0x0402: "stop", 0x0501: "CPU Unit data read",
    0x0502: "connection data read", 0x0601: "CPU Unit status read", 0x0620: "cycle time read", 0x0701: "clock read",
    0x0702: "clock write", 0x0801: "loop back", 0x0920: "message read and clear", 0x0C01: "access right acquire",
    0x0C02: "access right forced acquire", 0x0C03: "access right release", 0x2101: "error clear", 0x2102: "error log read",
    0x2103: "error log clear", 0x2140: "access log read", 0x2141: "access log clear", 0x2301: "forced set and reset",
    0x2302: "forced set and reset cancel",
})  # fmt: skip
"""As the vendor calls them (W342, section 5-1-1)."""


async def respond(request: Request, door: Door, read_only: bool, error_bits: bool = True) -> tuple[bytes, End]:
    """The frame that answers a request, and its end code without the bits of errors. `error_bits`: the CPU Unit tells of its
    errors in each answer, as the device does."""
    flagged = Flagged(door)
    end, body, bits = End.OK, b"", 0
    try:
        try:
            body = await _handled(request, flagged, read_only)
        except Refused as refused:
            end = refused.code
        bits = await flagged.bits() if error_bits else 0
    except Away:
        end, body = End.SERVICE_BUSY, b""
    return answer(request, end | bits, body), end


async def _handled(request: Request, door: Door, read_only: bool) -> bytes:
    if request.unit:
        raise Refused(End.NO_UNIT)
    handler = COMMANDS.get(request.command)
    if handler is None:
        raise Refused(End.UNDEFINED)
    if read_only and request.command in CHANGING:
        raise Refused(End.PROTECTED)
    return await handler(door, request.body)
