"""What a program asks of other PLCs by SEND, RECV and CMND, and what comes back. (W340, network instructions; K-H where not said.)

The request is in the journal, so people see it, and so is its answer, which comes from outside: a replay needs nobody to answer. The
control words, from C on:

    SEND, RECV                       CMND
    0  words                         0  bytes of the command
                                     1  bytes of the response
    1  bits 0-7: network             2
    2  bits 0-7: unit, 8-15: node    3
    3  bits 0-3: retries, 8-11: port (15: any that is free), 15: no answer is wanted       4
    4  how long an answer is waited for, in 0.1 s; 0 is 2 s                                5
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from scanbench.check.system.network_text import NAMES, Instruction
from scanbench.faults.inject import ACTIVE
from scanbench.plcmodel.model import Location
from scanbench.plcmodel.network import Port, ports
from scanbench.runtime.command import Category, Command, Entry, Patch, Plan, Refusal, View
from scanbench.runtime.journal import Fold

TIMEOUT, NO_AREA, WRONG_SIZE = 0x0205, 0x1101, 0x1001
"""Completion codes: no answer came in time; an operand that lies in no memory area; more than an instruction may move."""
_MOST_WORDS, _MOST_BYTES = 990, 1990
_TENTH_NS, _USUAL_TENTHS = 100_000_000, 20
_ANY_PORT = 15


@dataclass(frozen=True, slots=True)
class NetworkRequest(Command):
    """An instruction was executed: its port is in use until the answer, `NetworkAnswer`, is there."""

    category: ClassVar[Category] = "system"

    instruction: Instruction
    port: int
    network: int
    node: int
    unit: int
    area: str
    """SEND and RECV: where in the other PLC; its words are numbered as here."""
    word: int
    count: int
    """SEND and RECV: words; CMND: the most bytes of the response."""
    data: bytes
    """SEND: words as they lie in memory; CMND: the command, as it is sent."""
    answered: bool
    """An answer is waited for."""
    to_area: str
    """RECV and CMND: where the answer is written."""
    to_byte: int
    scans: int
    """So many scans after this one nobody waits any more."""
    fails: int = 0
    """The completion code with which it ends at once; 0: it is sent."""

    def plan(self, view: View) -> Plan | Refusal:
        """The port cannot be used, and shows no error."""
        port = _port(view, self.port)
        if port is None:
            return Refusal(f"{view.model.name} has no communications port {self.port}")
        patches = (_bit(view, port.enabled, False), _bit(view, port.error.flag, False), _word(view, port.code, 0))
        return Plan(patches, f"{self.instruction} by port {self.port}: {self._what(view)}")

    def _what(self, view: View) -> str:
        other = f"network {self.network}, node {self.node}"
        area = view.model.area(self.area)
        if self.instruction == "CMND" or area is None:
            return f"command {self.data[:2].hex().upper()} to {other}"
        place = view.model.format(area, 2 * self.word, None, 16)
        if self.instruction == "SEND":
            return f"{self.count} words to {place} of {other}"
        return f"{self.count} words from {place} of {other}"


@dataclass(frozen=True, slots=True)
class NetworkAnswer(Command):
    """An instruction ends: with what the other PLC sent, or without."""

    category: ClassVar[Category] = "system"

    port: int
    since: int
    """The scan of its request."""
    end: int
    """The completion code: 0 is done."""
    data: bytes = b""
    """As it is to lie in memory."""

    def plan(self, view: View) -> Plan | Refusal:
        """The data, the completion code and the flags of the port."""
        waiting, port = view.derived(WAITING).get(self.port), _port(view, self.port)
        if waiting is None or port is None or waiting.since != self.since:
            return Refusal(f"nobody waits for this answer on port {self.port} any more")
        request = waiting.request
        patches = [
            _bit(view, port.enabled, True), _bit(view, port.error.flag, self.end != 0), _word(view, port.code, self.end),
        ]  # fmt: skip
        area = view.model.area(request.to_area)
        if self.data:
            if area is None or request.to_byte + len(self.data) > area.size:
                return Refusal(f"the answer does not fit into {request.to_area}")
            patches.insert(0, Patch.whole(view.program.layout.areas[area.name] + request.to_byte, self.data))
        done = "done" if not self.end else f"completion code {self.end:04X}"
        return Plan(tuple(patches), f"{request.instruction} by port {self.port}: {done}")


@dataclass(frozen=True, slots=True)
class PortsReady(Command):
    """The ports can be used: the program that is there now has instructions for them."""

    def plan(self, view: View) -> Plan | Refusal:
        """The bits of those that nobody waits at."""
        waiting = view.derived(WAITING)
        free = [each for each in ports(view.model) if each.number not in waiting]
        return Plan(tuple(_bit(view, each.enabled, True) for each in free), "communications ports enabled")


@dataclass(frozen=True, slots=True)
class Waiting:
    """An instruction that was executed and has not ended."""

    request: NetworkRequest
    since: int
    """The scan."""

    @property
    def until(self) -> int:
        """The scan before which it ends in any case."""
        return self.since + self.request.scans


def _step(waiting: Mapping[int, Waiting], entry: Entry) -> Mapping[int, Waiting]:
    match entry.command:
        case NetworkRequest() as request:
            return {**waiting, request.port: Waiting(request, entry.scan)}
        case NetworkAnswer(port=port):
            return {number: each for number, each in waiting.items() if number != port}
    return {} if waiting and entry.plan.starts_fresh else waiting


WAITING: Fold[Mapping[int, Waiting]] = Fold({}, _step)
"""What has not ended, by its port."""


def asked_of_others(view: View, instruction: int, places: tuple[int, ...], taken: set[int]) -> NetworkRequest | None:
    """What an instruction asks for; None where its port is in use, is there not, or an operand is none. `taken`: the ports that
    were asked for in this seam."""
    if instruction >= len(NAMES) or len(places) != 3:
        return None
    name = NAMES[instruction]
    source, target, control = places
    more = name == "CMND"
    words = _words(view, control, 6 if more else 5)
    if words is None:
        return None
    count, (network, node, options, tenths) = words[0], words[1 + more : 5 + more]
    free = [
        each.number
        for each in ports(view.model)
        if each.number not in view.derived(WAITING) and each.number not in taken
    ]
    wanted = options >> 8 & 15
    port = next((each for each in reversed(free) if wanted in (each, _ANY_PORT)), None)
    if port is None:
        return None
    taken.add(port)
    wait = (1 + (options & 15)) * (tenths or _USUAL_TENTHS) * _TENTH_NS
    scans = max(1, -(-wait // view.program.interval_ns))
    there, here = view.program.layout.area_at(target if name == "SEND" else source), view.program.layout.area_at(target)
    size = count if more else 2 * count
    data = b"" if name == "RECV" else bytes(view.memory[source : source + size])
    fails = 0
    if size > (_MOST_BYTES if more else 2 * _MOST_WORDS) or not size:
        fails, data = WRONG_SIZE, b""
    elif (there is None and not more) or (here is None and name != "SEND"):
        fails = NO_AREA
    if more:
        data = _turned(data + b"\0" * (len(data) % 2))[:size]
    return NetworkRequest(
        "program", name, port, network & 0xFF, node >> 8, node & 0xFF,
        there[0].name if there is not None and not more else "", there[1] // 2 if there is not None and not more else 0,
        words[1] if more else count, data, not options >> 15,
        here[0].name if here is not None else "", here[1] if here is not None else 0, scans, fails,
    )  # fmt: skip


def error_on(view: View, port: int) -> str:
    """The id of the error that is present on a port; empty: none."""
    found = _port(view, port)
    return found.error.id if found is not None and found.error.id in view.derived(ACTIVE) else ""


def _port(view: View, number: int) -> Port | None:
    return next((each for each in ports(view.model) if each.number == number), None)


def _words(view: View, place: int, count: int) -> list[int] | None:
    data = bytes(view.memory[place : place + 2 * count])
    if len(data) < 2 * count:
        return None
    return [int.from_bytes(data[at : at + 2], "little") for at in range(0, 2 * count, 2)]


def _turned(data: bytes) -> bytes:
    """Words high byte first: so the bytes of a command lie in them."""
    turned = bytearray(len(data))
    turned[0::2], turned[1::2] = data[1::2], data[0::2]
    return bytes(turned)


def _bit(view: View, place: Location, on: bool) -> Patch:
    assert place.bit is not None
    return Patch.of_bit(view.program.layout.areas[place.area.name] + place.byte, place.bit, on)


def _word(view: View, place: Location, value: int) -> Patch:
    return Patch.whole(view.program.layout.areas[place.area.name] + place.byte, value.to_bytes(2, "little"))
