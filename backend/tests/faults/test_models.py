"""Every error of every model that ships: generated and recovered to the bit, alone and in any company."""

from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scanbench.faults.inject import Generate, Recover
from scanbench.faults.reference import ErrorRef
from scanbench.host.build import all_models
from scanbench.plcmodel.model import ErrorDetail, ErrorEntry, Location, Model
from scanbench.program.layout import Layout
from scanbench.runtime.command import Entry, Refusal, RestartKind
from scanbench.runtime.header import Mode
from scanbench.runtime.modes import SetMode
from scanbench.runtime.resource import Resource
from scanbench.runtime.restart import Restart
from tests.amounts import amount
from tests.runtime.bench import model, plc

MODELS = [each.name for each in all_models()[0]]
SOURCE = "PROGRAM Main\nVAR n : INT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"


def log_spans(resource: Resource) -> list[tuple[int, int]]:
    log, areas = resource.program.layout.model.log, resource.program.layout.areas
    time = resource.program.layout.model.error_time
    if time is not None:
        start = areas[time.first.area.name] + time.first.byte
        return [(start, start + len(time.fields))]
    if log is None:
        return []
    first, counter = (areas[place.area.name] + place.byte for place in (log.first, log.counter))
    return [(first, first + 2 * log.records * log.words), (counter, counter + 2)]


def standby_spans(resource: Resource) -> list[tuple[int, int]]:
    """The words that say which CPU Unit controls, and why."""
    layout = resource.program.layout
    places = () if layout.model.standby is None else layout.model.standby.places
    starts = ((layout.areas[place.area.name] + 2 * place.word, place.bits) for place in places)
    return [(start, start + 2 * -(-bits // 16)) for start, bits in starts]


def taken_over_for(name: str) -> set[str]:
    """The errors for which a standby takes over, by id."""
    standby = model(name).standby
    return set() if standby is None else {id for id, _ in standby.causes}


def areas_without_log(resource: Resource) -> bytes:
    """All areas of the model; the error log, the time of the latest error, and which CPU Unit controls, blanked."""
    memory = bytearray(resource.memory)
    for start, end in (*log_spans(resource), *standby_spans(resource)):
        memory[start:end] = bytes(end - start)
    areas = resource.program.layout.areas
    return b"".join(memory[areas[area.name] : areas[area.name] + area.size] for area in resource.view.model.areas)


def bits(resource: Resource, place: Location) -> int:
    start = resource.program.layout.areas[place.area.name] + place.byte
    data = int.from_bytes(resource.memory[start : start + max(1, place.bits // 8)], "little")
    return data >> place.bit & 1 if place.bit is not None else data


def every_choice(error: ErrorEntry) -> list[dict[str, str]]:
    """Each choice of each detail once, the others as they are by default; lowest and highest of a number."""
    found: list[dict[str, str]] = [{}]
    for detail in error.details:
        found += [{detail.name: text} for text in _texts(detail)]
    return found


def _texts(detail: ErrorDetail) -> list[str]:
    if detail.control == "List":
        return [address.id for address in detail.addresses]
    address = detail.addresses[0]
    write: Callable[[int], str] = "{:X}".format if address.base == 16 else str
    if address.is_text:
        return ["", "A", "~" * (address.maximum or 0)]
    return [write(number) for number in (address.minimum, address.maximum) if number is not None]


def test_there_are_models() -> None:
    assert {"CJ1M-CPU63", "GENERIC-IEC"} <= set(MODELS)


@pytest.mark.parametrize("name", MODELS)
def test_every_error_with_every_detail(name: str) -> None:
    resource = plc(SOURCE, model_name=name)
    before = areas_without_log(resource)
    known: Model = resource.view.model
    for error in known.errors():
        for details in every_choice(error):
            resource.submit(SetMode("Ada", "MONITOR"))
            start = areas_without_log(resource)
            outcome = resource.submit(Generate("Ada", (ErrorRef(error.id, tuple(details.items())),)))
            assert isinstance(outcome, Entry), (error.id, details, outcome)
            assert bits(resource, error.flag) == 1, error.id
            goes_on = error.severity == "nonfatal" or error.id in taken_over_for(name)
            assert resource.runnable is goes_on
            if known.code_word is not None:
                assert error.show(bits(resource, known.code_word)) in outcome.plan.message
            assert isinstance(resource.submit(Recover("Bob", (error.id,))), Entry)
            assert resource.header.mode is (Mode.MONITOR if goes_on else Mode.PROGRAM)
            assert areas_without_log(resource) == start == before, (error.id, details)


RESTARTS: dict[str, RestartKind] = {"cold": "cold", "warm": "warm", "power": "power"}
_STEPS = st.sampled_from(["generate", "generate", "again", "recover", "clear", *RESTARTS, "PROGRAM", "RUN"])


@pytest.mark.parametrize("name", MODELS)
@settings(max_examples=amount(60, 10), deadline=None)
@given(data=st.data())
def test_whatever_happened_nothing_is_left(name: str, data: st.DataObject) -> None:
    ids = [error.id for error in model(name).errors()]
    resource = plc(SOURCE, model_name=name)
    before = areas_without_log(resource)
    fatal = {error.id for error in model(name).errors() if error.severity == "fatal"}
    present: set[str] = set()
    stopping: set[str] = set()
    switching, duplex = taken_over_for(name), True
    for _ in range(data.draw(st.integers(1, 12))):
        step = data.draw(_STEPS)
        if step == "generate":
            wanted = data.draw(st.lists(st.sampled_from(ids), min_size=1, max_size=4, unique=True))
            outcome = resource.submit(Generate("Ada", tuple(map(ErrorRef, wanted))))
            # refused whole, unless all of them are new
            assert isinstance(outcome, Entry) is not bool(present & set(wanted))
            if isinstance(outcome, Entry):
                present |= set(wanted)
                now = fatal & set(wanted)
                if now and duplex and now <= switching:
                    duplex = False
                else:
                    stopping |= now
        elif step == "again" and present:
            id = data.draw(st.sampled_from(sorted(present)))
            error = model(name).error(id)
            assert error is not None
            details = tuple(data.draw(st.sampled_from(every_choice(error))).items())
            if not error.several:
                assert isinstance(resource.submit(Generate("Bob", (ErrorRef(id, details),))), Refusal)
            assert isinstance(resource.submit(Generate("Bob", (ErrorRef(id, details),), again=True)), Entry)
            if id in fatal and id not in stopping and not error.several:
                pass  # the standby took over for it: it has other details now
            elif duplex and id in switching:
                duplex = False
                stopping.discard(id)
            else:
                stopping |= fatal & {id}
        elif step == "recover" and present:
            gone = data.draw(st.lists(st.sampled_from(sorted(present)), min_size=1, unique=True))
            assert isinstance(resource.submit(Recover("Ada", tuple(gone))), Entry)
            present -= set(gone)
            stopping -= set(gone)
            duplex |= bool(switching & set(gone)) and not switching & present
        elif step == "clear":
            assert isinstance(resource.submit(Recover("Ada", None)), Entry)
            present, stopping, duplex = set(), set(), True
        elif step in RESTARTS:
            assert isinstance(resource.submit(Restart("Ada", RESTARTS[step])), Entry)
            present, stopping, duplex = set(), set(), True
        elif step in Mode.__members__:
            assert isinstance(resource.submit(SetMode("Ada", step)), Refusal) is (bool(stopping) and step == "RUN")
        _assert_flags(resource, present)
        assert bool(resource.header.halt) is bool(stopping)
    resource.submit(Recover("Ada", None))
    assert areas_without_log(resource) == before
    assert resource.memory[Layout.FATAL] == 0


def _assert_flags(resource: Resource, present: set[str]) -> None:
    """The flags of what is present are on, those that nothing present shares are off, the code is that of the worst."""
    known: Model = resource.view.model
    on = [error for error in known.errors() if error.id in present]
    shared = {error.flag for error in on} | {each.location for error in on for each in error.also}
    for error in known.errors():
        if error.id in present:
            assert bits(resource, error.flag) == 1, error.id
        elif error.flag not in shared:
            assert bits(resource, error.flag) == 0, error.id
    if known.code_word is not None:
        code = bits(resource, known.code_word)
        coded = [error for error in on if error.coded]
        assert bool(code) is bool(coded)
        worst = min((error.priority for error in coded), default=0)
        assert not coded or any(e.code <= code <= e.code + _most(e) for e in coded if e.priority == worst)


def _most(error: ErrorEntry) -> int:
    """The most that its details can add to its code."""
    adding = ([a for a in detail.addresses if a.add_to_code] for detail in error.details)
    return sum(max((a.value or a.maximum or 0xFF for a in addresses), default=0) for addresses in adding)


def choices(name: str, error: str, detail: str) -> list[str]:
    entry = model(name).error(error)
    found = None if entry is None else entry.detail(detail)
    assert found is not None
    return [each.id for each in found.addresses]


def test_no_detail_is_offered_for_hardware_that_a_model_does_not_have() -> None:
    racks = {
        name: "expansion-racks" in choices(name, "too-many-io", "cause")
        for name in MODELS
        if name[:2] in ("CJ", "CS", "CP")
    }
    without = {"CJ1M-CPU11", "CJ1M-CPU12", "CJ1M-CPU21", "CJ1M-CPU22", "CP1H-XA40D"}
    assert {name for name, has in racks.items() if not has} == without
    assert "units-on-rack" not in choices("CP1H-XA40D", "too-many-io", "cause")
    assert "memory-card-transfer" not in choices("CP1H-XA40D", "memory-error", "location")
    # only a CS1 has C200H units and SYSMAC BUS, whose refresh an interrupt task can hold up
    for name in racks:
        assert ("too-long" in choices(name, "interrupt-task-error", "cause")) == name.startswith("CS1")
    cj = model("CJ1M-CPU13").error("interrupt-task-error")
    assert cj is not None
    assert cj.details[0].default == "duplicate-refresh"
