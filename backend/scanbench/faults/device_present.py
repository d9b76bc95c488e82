"""Which errors the memory shows as present.

Several errors may share a flag. Then the details, and what else an error writes, tell them apart; where nothing does, the codes
that the memory shows. So a device that has one code word for many errors with one flag shows the most serious of those, as on
its tools.
"""

from collections.abc import Iterator, Mapping, Sequence
from itertools import product

from scanbench.faults.device_memory import Memory, number_text, said
from scanbench.faults.device_shapes import DeviceDetail, DeviceError, DeviceRecord
from scanbench.plcmodel.model import ErrorAddress, ErrorDetail, ErrorEntry, Location

_Reading = Mapping[str, tuple[str, int]]
"""By detail: its value as text, and what that adds to the code."""
_Found = tuple[ErrorEntry, _Reading, int | None]


def present(memory: Memory, log: Sequence[DeviceRecord]) -> Iterator[DeviceError]:
    """The most serious first."""
    found: list[_Found] = []
    unknown: list[ErrorEntry] = []
    for flag, errors in _by_flag(memory):
        if not memory.number(flag):
            continue
        here = list(_with_flag(memory, errors, log))
        found += here
        if not here:
            unknown.append(errors[0])
    for error, reading, code in sorted(found, key=lambda each: (each[0].priority, each[2] or 0)):
        others = [each for each, _, _ in found if each is not error] if code != memory.code else []
        yield _error(memory, error, _without_shared(error, reading, others), code)
    for error in unknown:
        yield DeviceError(
            "", f"An error with the flag {error.flag_text}", error.severity, "", error.flag_text, (), "", "", False, False
        )  # fmt: skip


def _without_shared(error: ErrorEntry, reading: _Reading, others: Sequence[ErrorEntry]) -> _Reading:
    """What is in words of its own: a word that details of other present errors are in, too, is about the error whose code is shown."""
    taken = {word for other in others for detail in other.details for word in _words(detail)}
    shared = {detail.name for detail in error.details if not taken.isdisjoint(_words(detail))}
    return {name: value for name, value in reading.items() if name not in shared}


def _words(detail: ErrorDetail) -> Iterator[tuple[str, int, int]]:
    """Where its number or text is; a bit is nobody else's."""
    for each in detail.addresses:
        if each.location is not None and each.kind not in ("Bit", "BitArray"):
            yield each.location.area.name, each.location.byte, each.shift


def _by_flag(memory: Memory) -> Iterator[tuple[Location, list[ErrorEntry]]]:
    found: dict[tuple[str, int, int | None], list[ErrorEntry]] = {}
    for error in memory.model.errors():
        found.setdefault((error.flag.area.name, error.flag.byte, error.flag.bit), []).append(error)
    return ((errors[0].flag, errors) for errors in found.values())


def _with_flag(memory: Memory, errors: Sequence[ErrorEntry], log: Sequence[DeviceRecord]) -> Iterator[_Found]:
    """The errors with this flag that the rest of the memory agrees with."""
    readings = {error.id: list(_readings(memory, error)) for error in errors if _agrees(memory, error)}
    fitting = [error for error in errors if readings.get(error.id)]
    for error in fitting:
        if len(fitting) == 1 or _has_own_marks(memory, error, fitting):
            yield from _with_codes(memory, error, readings[error.id], log)
        elif shown := [code for code in sorted(memory.codes) if _can_have(error, code)]:
            yield from _with_codes(memory, error, readings[error.id], log, shown[0])


def _with_codes(
    memory: Memory,
    error: ErrorEntry,
    readings: Sequence[_Reading],
    log: Sequence[DeviceRecord],
    code: int | None = None,
) -> Iterator[_Found]:
    for reading in readings:
        hidden = [detail for detail in error.details if _is_hidden(detail)]
        if not error.coded:
            yield error, reading, None
            continue
        if not hidden:
            yield error, reading, error.code + sum(more for _, more in reading.values())
            continue
        known = code if code is not None else _code_in(memory, error, log)
        if known is None:
            yield error, reading, None
            continue
        rest = known - error.code - sum(more for _, more in reading.values())
        yield error, {**reading, **dict(_from_code(hidden, rest))}, known


def _code_in(memory: Memory, error: ErrorEntry, log: Sequence[DeviceRecord]) -> int | None:
    """The code of this error that the memory shows: as a code of what is present, else as the newest in the log."""
    shown = (code for code in sorted(memory.codes) if _can_have(error, code))
    logged = (record.code for record in log if record.id == error.id)
    return next(shown, None) or next((int(each, 10 if error.form == "decimal" else 16) for each in logged), None)


def _can_have(error: ErrorEntry, code: int) -> bool:
    return any(code in each for each in error.codes)


def _from_code(hidden: Sequence[ErrorDetail], rest: int) -> Iterator[tuple[str, tuple[str, int]]]:
    """What a code says of the only detail that is in nothing but the code."""
    if len(hidden) != 1:
        return
    detail = hidden[0]
    if detail.control == "List":
        choice = next((each for each in detail.addresses if each.value == rest), None)
        if choice is not None:
            yield detail.name, (choice.id, rest)
    elif (detail.addresses[0].minimum or 0) <= rest <= (detail.addresses[0].maximum or 0):
        yield detail.name, (number_text(detail, rest), rest)


# ---- marks of an error ----------------------------------------------------------------------------------------------

_Mark = tuple[str, int, int | None, int | None]
"""A place that an error writes: area, byte and bit; and the value, where that is fixed."""


def _marks(error: ErrorEntry) -> dict[_Mark, ErrorAddress]:
    """What it writes besides its flag."""
    also = {_mark(each, each.value): each for each in error.also if each.location is not None and not each.id}
    details = (each for detail in error.details for each in detail.addresses)
    return also | {_mark(each, None): each for each in details if each.location is not None}


def _mark(address: ErrorAddress, value: int | None) -> _Mark:
    assert address.location is not None
    return address.location.area.name, address.location.byte, address.location.bit, value


def _has_own_marks(memory: Memory, error: ErrorEntry, fitting: Sequence[ErrorEntry]) -> bool:
    """Whether something is there that none of the others with the same flag would have written; a 0 is nothing."""
    marks = _marks(error)
    own = marks.keys() - {mark for other in fitting if other is not error for mark in _marks(other)}
    return any(_is_there(memory, marks[mark]) for mark in own)


def _is_there(memory: Memory, address: ErrorAddress) -> bool:
    assert address.location is not None
    if address.is_text:
        return bool(memory.characters(address))
    if address.kind == "Bit":
        return bool(memory.number(address.location))
    if address.kind == "BitArray":
        low, high = address.minimum or 0, address.maximum or 0
        return bool(memory.number(address.location._replace(bits=1), low, high - low + 1))
    return bool(memory.field(address))


def _agrees(memory: Memory, error: ErrorEntry) -> bool:
    """Whether the memory has what the error writes besides its flag and details."""
    for each in error.also:
        if each.location is None or each.id:
            continue
        if each.kind == "Bit":
            if not memory.number(each.location):
                return False
        elif each.value is not None and memory.field(each) != each.value:
            return False
    return True


# ---- details --------------------------------------------------------------------------------------------------------


def _is_hidden(detail: ErrorDetail) -> bool:
    return all(each.location is None for each in detail.addresses)


def _readings(memory: Memory, error: ErrorEntry) -> Iterator[_Reading]:
    """What the details can be; several where a word has a bit for each unit; none where they do not fit."""
    shown = [detail for detail in error.details if not _is_hidden(detail)]
    for values in product(*(list(_values(memory, detail)) for detail in shown)):
        yield {detail.name: value for detail, value in zip(shown, values, strict=True)}


def _values(memory: Memory, detail: ErrorDetail) -> Iterator[tuple[str, int]]:
    if detail.control == "List":
        on = [each for each in detail.addresses if each.location is not None and _is_on(memory, each)]
        if on:
            first = on[0]
            yield "+".join(each.id for each in on), (first.value or 0) if first.add_to_code and len(on) == 1 else 0
        return
    address = detail.addresses[0]
    if address.is_text:
        yield memory.characters(address), 0
        return
    low, high = address.minimum or 0, address.maximum if address.maximum is not None else (1 << address.width) - 1
    if address.kind == "BitArray":
        assert address.location is not None
        place = address.location._replace(bits=1)
        numbers = [n for n in range(low, high + 1) if memory.number(place, n, 1)]
    else:
        number = memory.field(address)
        numbers = [number] if number is not None and low <= number <= high else []
    for number in numbers:
        yield number_text(detail, number), number if address.add_to_code else 0


def _is_on(memory: Memory, choice: ErrorAddress) -> bool:
    assert choice.location is not None
    if choice.kind == "Bit":
        return bool(memory.number(choice.location))
    if choice.kind == "BitArray":
        return bool(memory.number(choice.location._replace(bits=1), choice.value or 0, 1))
    return memory.field(choice) == (choice.value if choice.value is not None else 1)


def _error(memory: Memory, error: ErrorEntry, reading: _Reading, code: int | None) -> DeviceError:
    details: list[DeviceDetail] = [
        said(detail, reading[detail.name][0]) for detail in error.details if detail.name in reading
    ]
    return DeviceError(
        id=error.id,
        name=error.name,
        severity=error.severity,
        code="" if code is None else error.show(code),
        flag=error.flag_text,
        details=tuple(each for each in details if each.value),
        text=memory.text_of(error, tuple(details)),
        cause=error.description,
        lasting=error.lasting,
        top=code is not None and code == memory.code,
    )
