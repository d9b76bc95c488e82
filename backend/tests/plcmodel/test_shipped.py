"""Facts of the models that ship, as far as other rooms and the specification rely on them."""

import pytest

from scanbench.host.build import all_models
from scanbench.plcmodel.load import NoSuchModel, model_named
from scanbench.plcmodel.model import Location, Model

ALL = all_models()[0]
every_model = pytest.mark.parametrize("model", ALL, ids=[model.name for model in ALL])


def at(model: Model, text: str) -> Location:
    location = model.locate(text)
    assert location is not None, model.why_not(text)
    return location


def test_the_example_of_the_specification(cj1m: Model) -> None:
    error = cj1m.error("memory-error")
    assert error is not None
    location = error.detail("location")
    assert location is not None
    choice = location.choice("io-table-checksum")
    assert choice is not None
    assert choice.value is not None
    assert choice.add_to_code
    assert error.code + choice.value == 0x80F4
    assert choice.location == at(cj1m, "A403.05")
    assert error.flag == at(cj1m, "A401.15")
    assert cj1m.code_word == at(cj1m, "A400")


def test_the_flags_that_programs_check(cj1m: Model) -> None:
    flags = {error.id: error.flag_text for error in cj1m.errors()}
    assert flags["basic-io-error"] == "A402.12"
    assert flags["inner-board-error"] == "A402.08"
    assert flags["cpu-bus-unit-error"] == "A402.07"
    assert flags["special-io-unit-error"] == "A402.06"


def test_rack_and_slot_share_a_word(cj1m: Model) -> None:
    error = cj1m.error("io-bus-error")
    assert error is not None
    rack, slot = (detail.addresses[0] for detail in error.details)
    assert rack.location == slot.location == at(cj1m, "A404")
    assert (rack.shift, rack.width, rack.add_to_code) == (8, 8, True)
    assert (slot.shift, slot.width, slot.add_to_code) == (0, 8, False)


def test_fals_only_adds_to_the_code_and_keeps_the_memory(cj1m: Model) -> None:
    error = cj1m.error("fals")
    assert error is not None
    number = error.details[0].addresses[0]
    assert number.location is None
    assert (error.code, number.minimum, number.maximum, number.add_to_code) == (0xC100, 1, 511, True)
    assert error.keeps_memory


def test_both_severities_and_details_are_there(cj1m: Model, generic: Model) -> None:
    for model, least in ((cj1m, 20), (generic, 8)):
        errors = list(model.errors())
        assert len(errors) >= least
        assert {error.severity for error in errors} == {"fatal", "nonfatal"}
        assert {detail.control for error in errors for detail in error.details} == {"List", "Spin", "Edit"}
        for id in ("cycle-time-over", "program-error"):
            assert model.error(id) is not None


@every_model
def test_a_fatal_error_is_always_more_serious(model: Model) -> None:
    fatal = [error.priority for error in model.errors() if error.severity == "fatal"]
    others = [error.priority for error in model.errors() if error.severity == "nonfatal"]
    assert max(fatal) < min(others)


@every_model
def test_everything_has_a_japanese_name(model: Model) -> None:
    assert [wording.language for wording in model.wordings] == ["ja"]
    for error in model.errors():
        assert [wording.language for wording in error.wordings] == ["ja"], error.id
        assert error.wordings[0].name
        for detail in error.details:
            assert [wording.language for wording in detail.wordings] == ["ja"], (error.id, detail.name)


@every_model
def test_what_is_from_knowledge_is_not_called_verified(model: Model) -> None:
    assert [fact for fact in model.facts if not fact.source] == []
    assert [fact for fact in model.facts if fact.verified and "K-" in fact.source] == []


@every_model
def test_a_model_alone_is_the_same(model: Model) -> None:
    """Other files do not matter, but for those it is based on."""
    assert model_named(model.name) == model
    assert model_named(model.name.lower(), ALL) is model


def test_a_model_that_there_is_not() -> None:
    with pytest.raises(NoSuchModel, match="Did you mean `CJ1M-CPU13`"):
        model_named("cj1m-cpu19x", [model for model in ALL if model.name in ("CJ1M-CPU13", "Q03UD")])
    with pytest.raises(NoSuchModel, match=r"there are .*GENERIC-IEC"):
        model_named("???")


FATAL_CODES = "80F1 80C0 80CE 80CF 80E9 80EA 80E1 80E0 80F0 809F C100"
NONFATAL_CODES = "4100 008B 009A 009B 00E7 0200 0300 03FF 00F7 0400 0500"
CS_CODES, CS1D_CODES = "82F0 02F0 00A0", "0011 0010 0003 0600"


@pytest.mark.parametrize(
    ("name", "more", "less"),
    [
        ("CJ1M-CPU63", "02F0", ""),
        ("CJ1M-CPU13", "", ""),
        ("CJ1M-CPU23", "", ""),
        ("CJ1M-CPU12", "", "80EA"),
        ("CJ1M-CPU21", "", "80EA"),
        ("CS1H-CPU65H", CS_CODES, "80CE"),
        ("CS1G-CPU44H", CS_CODES, "80CE"),
        ("CS1D-CPU65H", f"{CS_CODES} {CS1D_CODES}", "80CE"),
        ("CJ2M-CPU33", "00F1", ""),
        ("CP1H-XA40D", "80CA 008A 00D1 00F1", "80CE 80CF 80EA"),
    ],
)
def test_an_omron_has_the_codes_of_its_kind(models: dict[str, Model], name: str, more: str, less: str) -> None:
    codes = {error.code_text for error in models[name].errors() if error.coded}
    assert codes == set(f"{FATAL_CODES} {NONFATAL_CODES} {more}".split()) - set(less.split())


def test_the_racks_of_the_cj1m(models: dict[str, Model]) -> None:
    for member, most in ((11, 0), (12, 0), (13, 1), (21, 0), (22, 0), (23, 1), (63, 3)):
        error = models[f"CJ1M-CPU{member}"].error("io-bus-error")
        assert error is not None
        assert error.details[0].addresses[0].maximum == most


def test_only_the_example_adds_to_the_code_of_a_memory_error(models: dict[str, Model]) -> None:
    for name in ("CJ1M-CPU13", "CS1H-CPU65H", "CP1H-XA40D"):
        error = models[name].error("memory-error")
        assert error is not None
        assert not any(choice.add_to_code for choice in error.details[0].addresses)


def test_other_vendors_show_their_codes_their_way(models: dict[str, Model]) -> None:
    melsec, nj = models["Q03UD"], models["NJ501-1300"]
    assert len(list(melsec.errors())) >= 20
    assert len(list(nj.errors())) >= 20
    battery, low = melsec.error("battery-error"), nj.error("low-battery")
    assert battery is not None
    assert low is not None
    assert battery.code_text == "1600"
    assert low.code_text == "000B0000"
    assert low.code_limit == 0xFFFF_FFFF
    assert melsec.code_word == at(melsec, "SD0")
    assert nj.code_word == at(nj, "SV20")._replace(bits=32)
    assert [place.text for place in battery.also] == ["SM0", "SM5", "SD4", "SM51", "SM52"]
    assert nj.error("program-error") is None


def test_an_annunciator_shows_its_number_where_the_device_does(models: dict[str, Model]) -> None:
    error = models["Q03UD"].error("annunciator")
    assert error is not None
    assert error.flag_text == "SM62"
    assert [place.text for place in error.also if place.id == "number"] == ["SD62", "SD16"]
    assert error.details[0].addresses[0].location == at(models["Q03UD"], "K4F0")


@every_model
def test_the_system_words_are_there(model: Model) -> None:
    roles = {special.role for special in model.specials}
    assert {"first-cycle", "cycle-time", "longest-cycle-time", "on", "off"} <= roles
    if model.name != "NJ501-1300":  # its clock is no word of memory, its pulses are functions
        assert {"pulse", "clock"} <= roles
    for special in model.specials:
        assert (special.period_ns > 0) == (special.role == "pulse")
        assert (special.unit_ns > 0) == special.role.endswith("cycle-time")
        assert len(special.fields) * 8 == (special.location.bits if special.role == "clock" else 0)


def test_the_clock_pulses_of_the_cj1m(cj1m: Model) -> None:
    pulses = {special.symbol: special.period_ns for special in cj1m.specials if special.role == "pulse"}
    assert pulses == {
        "P_0_02s": 20_000_000,
        "P_0_1s": 100_000_000,
        "P_0_2s": 200_000_000,
        "P_1s": 1_000_000_000,
        "P_1min": 60_000_000_000,
    }


@pytest.mark.parametrize(
    ("name", "instruction", "error", "low", "high", "clears"),
    [
        ("CJ1M-CPU63", "FAL", "fal", 1, 511, 0),
        ("CS1D-CPU65H", "FALS", "fals", 1, 511, None),
        ("CP1H-XA40D", "FAL", "fal", 1, 511, 0),
        ("Q03UD", "SETF", "annunciator", 1, 2047, 0),
        ("NJ501-1300", "SetAlarm", "user-fault-level-1", 1, 5000, None),
        ("GENERIC-IEC", "UserError", "user-error", 1, 4095, 0),
        ("GENERIC-IEC", "UserStop", "user-stop", 1, 4095, None),
    ],
)
def test_instructions(
    models: dict[str, Model], name: str, instruction: str, error: str, low: int, high: int, clears: int | None
) -> None:
    found = next(each for each in models[name].instructions if each.name == instruction)
    assert (found.error, found.minimum, found.maximum, found.clears) == (error, low, high, clears)
    entry = models[name].error(error)
    assert entry is not None
    assert entry.detail(found.detail) is not None


def test_the_error_memory_is_closed_to_programs_and_tools(cj1m: Model) -> None:
    area = cj1m.area("A")
    assert area is not None
    assert [area.access(400, who) for who in ("program", "tool", "engine")] == ["read", "read", "write"]
    assert [area.access(500, who) for who in ("program", "tool", "engine")] == ["write", "write", "write"]
    assert area.access(960, "engine") == "none"


def test_what_a_fatal_error_does(cj1m: Model) -> None:
    assert cj1m.fatal.hold == at(cj1m, "A500.12")
    assert [area.name for area in cj1m.fatal.cleared] == ["CIO", "W", "T"]
    assert [(words.area.name, words.first, words.last) for words in cj1m.fatal.outputs] == [("CIO", 100, 159)]
    assert cj1m.log is not None
    assert (cj1m.log.first, cj1m.log.records, cj1m.log.words) == (at(cj1m, "A100"), 20, 5)
    assert cj1m.special("first-cycle") == at(cj1m, "A200.11")
    assert cj1m.special("nothing") is None
