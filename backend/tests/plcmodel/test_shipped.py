"""Facts of the models that ship, as far as other rooms and the specification rely on them."""

from scanbench.plcmodel.model import Location, Model


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


def test_a_fatal_error_is_always_more_serious(cj1m: Model, generic: Model) -> None:
    for model in (cj1m, generic):
        fatal = [error.priority for error in model.errors() if error.severity == "fatal"]
        others = [error.priority for error in model.errors() if error.severity == "nonfatal"]
        assert max(fatal) < min(others)


def test_everything_has_a_japanese_name(cj1m: Model, generic: Model) -> None:
    for model in (cj1m, generic):
        for error in model.errors():
            assert [wording.language for wording in error.wordings] == ["ja"], error.id
            assert error.wordings[0].name


def test_what_is_from_knowledge_is_not_called_verified(cj1m: Model) -> None:
    marked = [(error.source, error.verified) for error in cj1m.errors()]
    marked += [(special.source, special.verified) for special in cj1m.specials]
    assert all(source for source, _ in marked)
    assert not any(verified for source, verified in marked if "K-" in source)
    assert any(verified for _, verified in marked)


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
