import pytest
from hypothesis import given
from hypothesis import strategies as st

from scanbench.plcmodel.load import load_all, model_directory
from scanbench.plcmodel.model import Model

MODELS = {model.name: model for model in load_all(model_directory())[0]}


@pytest.mark.parametrize(
    ("text", "area", "byte", "bit", "bits"),
    [
        ("D100", "D", 200, None, 16),
        ("d100", "D", 200, None, 16),
        ("DM100", "D", 200, None, 16),
        ("%D100", "D", 200, None, 16),
        ("D10000", "D", 20000, None, 16),
        ("W10", "W", 20, None, 16),
        ("W10.03", "W", 20, 3, 1),
        ("W10.3", "W", 20, 3, 1),
        ("A402.12", "A", 805, 4, 1),
        ("A40212", "A", 805, 4, 1),
        ("AR40212", "A", 805, 4, 1),
        ("A403.05", "A", 806, 5, 1),
        ("CIO 0.00", "CIO", 0, 0, 1),
        ("CIO0.00", "CIO", 0, 0, 1),
        ("0.00", "CIO", 0, 0, 1),
        ("100.15", "CIO", 201, 7, 1),
        ("CIO6143", "CIO", 12286, None, 16),
        ("H1.0", "H", 2, 0, 1),
        ("T5", "T", 10, None, 16),
        ("C4095", "C", 8190, None, 16),
        ("D100.08-15", "D", 201, None, 8),
        ("%IX0.0", "CIO", 0, 0, 1),
        ("%I0.7", "CIO", 0, 7, 1),
        ("%QX0.0", "CIO", 200, 0, 1),
        ("%QW1", "CIO", 202, None, 16),
        ("%MW3", "W", 6, None, 16),
        ("%md1", "W", 4, None, 32),
        ("%ML1", "W", 8, None, 64),
    ],
)
def test_the_omron_notation(cj1m: Model, text: str, area: str, byte: int, bit: int | None, bits: int) -> None:
    location = cj1m.locate(text)
    assert location is not None, cj1m.why_not(text)
    assert (location.area.name, location.byte, location.bit, location.bits) == (area, byte, bit, bits)
    assert cj1m.why_not(text) == ""


@pytest.mark.parametrize(
    ("text", "byte", "bit", "bits"),
    [
        ("%MX3.2", 3, 2, 1),
        ("%M3.2", 3, 2, 1),
        ("%MB3", 3, None, 8),
        ("%MW3", 6, None, 16),
        ("%MD1", 4, None, 32),
        ("%ML1", 8, None, 64),
    ],
)
def test_the_iec_notation_counts_in_the_width(generic: Model, text: str, byte: int, bit: int | None, bits: int) -> None:
    location = generic.locate(text)
    assert location is not None
    assert location[1:] == (byte, bit, bits)
    assert location.area.name == "M"


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("A402.16", "bit 16 does not exist, a word has bits 00 to 15"),
        ("D32768", "the last word is D32767"),
        ("A40216", "the last word is A959"),
        ("W512.00", "the last word is W511"),
        ("100", "is not an address of this model"),
        ("X100", "its areas are %I, %Q, %M, CIO, W, H, A, T, C, D"),
        ("%IX0.8", "a byte has bits 0 to 7"),
        ("%IX3", "needs one: %IX3.0 to .7"),
        ("%IW3.1", "only %IX has a bit"),
        ("%IW100", "the last one is %IW99"),
        ("%ID50", "the last one is %ID49"),
        ("D100.03-15", "the bytes of a word are .00-07 and .08-15"),
        ("D-1", "is not an address"),
        ("", "is not an address"),
        ("D99999999999999999999", "is not an address"),
    ],
)
def test_what_is_no_place_says_why(cj1m: Model, text: str, reason: str) -> None:
    assert cj1m.locate(text) is None
    assert reason in cj1m.why_not(text)
    assert "CJ1M-CPU63" in cj1m.why_not(text)


def test_a_model_without_vendor_areas_names_only_its_own(generic: Model) -> None:
    assert "its areas are %I, %Q, %M " in generic.why_not("D100")


@given(data=st.data())
def test_written_addresses_are_found_again(data: st.DataObject) -> None:
    model = MODELS[data.draw(st.sampled_from(sorted(MODELS)))]
    area = data.draw(st.sampled_from(model.areas))
    bits = data.draw(st.sampled_from([1, 8, 16]))
    byte = data.draw(st.integers(0, area.size - 1))
    bit = data.draw(st.integers(0, 7)) if bits == 1 else None
    if bits == 16:
        byte -= byte % 2
    text = model.format(area, byte, bit, bits)
    assert model.locate(text) == (area, byte, bit, bits), text


@given(st.text(max_size=20))
def test_no_text_is_too_strange(text: str) -> None:
    for model in MODELS.values():
        assert (model.locate(text) is None) == bool(model.why_not(text))
