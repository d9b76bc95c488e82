"""Error memory on every model beside a naive model of it: what is present written one after the other onto zeros."""

from collections.abc import Mapping

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scanbench.faults.inject import Generate, Recover
from scanbench.faults.reference import ErrorRef
from scanbench.plcmodel.model import ErrorAddress, ErrorEntry, Location
from scanbench.runtime.command import Entry, Refusal
from scanbench.runtime.resource import Resource
from tests.amounts import amount
from tests.faults.test_models import MODELS, SOURCE, every_choice, log_spans, standby_spans
from tests.runtime.bench import model, plc

Bit = tuple[str, int]
"""Area, and bit from its start."""
Details = Mapping[str, str]


def first_bit(place: Location) -> Bit:
    return place.area.name, place.byte * 8 + (place.bit or 0)


def writes(address: ErrorAddress, number: int) -> dict[Bit, int]:
    """The bits that one address of the catalogue means."""
    if address.location is None:
        return {}
    area, start = first_bit(address.location)
    if address.kind == "Bit":
        return {(area, start): 1}
    if address.kind == "BitArray":
        return {(area, start + number): 1}
    if address.kind == "BCD":
        number = sum(int(digit) << 4 * place for place, digit in enumerate(reversed(str(number))))
    start, width = (start, 8 * (address.maximum or 0)) if address.base == 0 else (start + address.shift, address.width)
    return {(area, start + bit): number >> bit & 1 for bit in range(width)}


def told(error: ErrorEntry, details: Details) -> tuple[dict[Bit, int], int]:
    """All bits of an error with these details, and its code."""
    found: dict[Bit, int] = {}
    numbers: dict[str, int] = {}
    code = error.code
    for detail in error.details:
        if detail.control == "List":
            id = details.get(detail.name, detail.default or detail.addresses[0].id)
            address = next(each for each in detail.addresses if each.id == id)
            number = address.value if address.value is not None else 1
        else:
            address = detail.addresses[0]
            start = address.default if address.default is not None else address.minimum
            text = details.get(detail.name)
            if address.base == 0:
                number = sum(ord(letter) << 8 * place for place, letter in enumerate(text or ""))
            else:
                number = (start or 0) if text is None else int(text, address.base)
        found |= writes(address, number)
        numbers[detail.name] = number
        code += number if address.add_to_code else 0
    found[first_bit(error.flag)] = 1
    for address in error.also:
        found |= writes(address, numbers.get(address.id, 1) if address.value is None else address.value)
    return found, code


Key = tuple[str, tuple[str, ...]]
"""An id, and what tells its instances apart, where the device has several of them."""


def key_of(error: ErrorEntry, details: Details) -> Key:
    names = [each.name for each in error.details if each.identifies == "several"]
    return error.id, tuple(details.get(each, str(_first(error, each))) for each in names) if error.several else ()


def _first(error: ErrorEntry, name: str) -> object:
    """What a detail is where nobody says it."""
    detail = next(each for each in error.details if each.name == name)
    address = detail.addresses[0]
    if detail.control == "List":
        return detail.default or address.id
    return address.default if address.default is not None else address.minimum or 0


def text_of(name: str, key: Key) -> str:
    error = model(name).error(key[0])
    assert error is not None
    names = [each.name for each in error.details if each.identifies == "several"]
    return str(ErrorRef(key[0], tuple(zip(names, key[1], strict=False)))) if key[1] else key[0]


def expected(name: str, present: Mapping[Key, Details]) -> dict[Bit, int]:
    """What is not 0."""
    memory: dict[Bit, int] = {}
    shown: list[tuple[int, int]] = []
    for (id, _), details in present.items():
        error = model(name).error(id)
        assert error is not None
        bits, code = told(error, details)
        memory |= bits
        if error.coded:
            shown.append((error.priority, code))
    word = model(name).code_word
    if word is not None and shown:
        area, start = first_bit(word)
        memory |= {(area, start + bit): min(shown)[1] >> bit & 1 for bit in range(word.bits)}
    for query in model(name).queries:
        area, start = first_bit(query.code)
        there = [
            (error.priority, told(error, details)[1])
            for error in model(name).errors()
            for (id, _), details in present.items()
            if error.id == id and error.flag.word == query.flags.word
        ]
        memory |= {(area, start + bit): min(there, default=(0, 0))[1] >> bit & 1 for bit in range(32)}
    return {bit: value for bit, value in memory.items() if value}


def found(resource: Resource) -> dict[Bit, int]:
    """What is not 0 in the memory of the model; the log is another matter."""
    memory = bytearray(resource.memory)
    for start, end in (*log_spans(resource), *standby_spans(resource)):
        memory[start:end] = bytes(end - start)
    areas = resource.program.layout.areas
    return {
        (area.name, 8 * byte + bit): 1
        for area in resource.view.model.areas
        for byte in _not_zero(memory, areas[area.name], area.size)
        for bit in range(8)
        if memory[areas[area.name] + byte] >> bit & 1
    }


def _not_zero(memory: bytearray, start: int, size: int) -> list[int]:
    data = bytes(memory[start : start + size])
    return [byte for byte, value in enumerate(data) if value] if data.strip(b"\0") else []


@pytest.mark.parametrize("name", MODELS)
@settings(max_examples=amount(50, 8), deadline=None)
@given(data=st.data())
def test_any_order_any_company(name: str, data: st.DataObject) -> None:
    errors = list(model(name).errors())
    resource = plc(SOURCE, model_name=name)
    assert found(resource) == {}
    present: dict[Key, Details] = {}
    for _ in range(data.draw(st.integers(1, 10))):
        step = data.draw(st.sampled_from(["generate", "generate", "again", "recover"]))
        if step == "recover" and present:
            gone = data.draw(st.lists(st.sampled_from(sorted(present)), min_size=1, unique=True))
            texts = tuple(text_of(name, key) for key in gone)
            assert isinstance(resource.submit(Recover("Ada", texts)), Entry)
            present = {key: details for key, details in present.items() if key not in gone}
        else:
            batch = data.draw(st.lists(st.sampled_from(errors), min_size=1, max_size=3))
            drawn = [(error, data.draw(st.sampled_from(every_choice(error)))) for error in batch]
            chosen = {key_of(error, details): details for error, details in drawn}
            refs = tuple(ErrorRef(key[0], tuple(details.items())) for key, details in chosen.items())
            outcome = resource.submit(Generate("Ada", refs, again=step == "again"))
            if step != "again" and present.keys() & chosen.keys():
                assert isinstance(outcome, Refusal)
                continue
            assert isinstance(outcome, Entry), outcome
            for key, details in chosen.items():  # what is raised again counts as the latest
                present.pop(key, None)
                present[key] = details
        assert found(resource) == expected(name, present)
    assert isinstance(resource.submit(Recover("Ada", None)), Entry)
    assert found(resource) == {}
