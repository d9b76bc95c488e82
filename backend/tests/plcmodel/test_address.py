import pytest
from hypothesis import given
from hypothesis import strategies as st

from scanbench.host.build import all_models
from scanbench.plcmodel.model import Model

MODELS = {model.name: model for model in all_models()[0]}


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
    ("model", "text", "area", "byte", "bit", "bits", "written"),
    [
        ("Q03UD", "X1F", "X", 3, 7, 1, "X1F"),
        ("Q03UD", "x0a", "X", 1, 2, 1, "X0A"),
        ("Q03UD", "%X1F", "X", 3, 7, 1, "X1F"),
        ("Q03UD", "M100", "M", 12, 4, 1, "M100"),
        ("Q03UD", "%M100", "M", 12, 4, 1, "M100"),
        ("Q03UD", "SM400", "SM", 50, 0, 1, "SM400"),
        ("Q03UD", "D100", "D", 200, None, 16, "D100"),
        ("Q03UD", "D100.F", "D", 201, 7, 1, "D100.F"),
        ("Q03UD", "W1F", "W", 62, None, 16, "W1F"),
        ("Q03UD", "SD0", "SD", 0, None, 16, "SD0"),
        ("Q03UD", "ZR5", "R", 10, None, 16, "R5"),
        ("Q03UD", "K4M16", "M", 2, None, 16, "K4M16"),
        ("Q03UD", "K2X8", "X", 1, None, 8, "K2X8"),
        ("Q03UD", "%IX1.2", "X", 1, 2, 1, "X0A"),
        ("Q03UD", "%MW3", "D", 6, None, 16, "D3"),
        ("NJ501-1300", "E0_100", "E0", 200, None, 16, "E0_100"),
        ("NJ501-1300", "E18_32767.15", "E18", 65535, 7, 1, "E18_32767.15"),
        ("NJ501-1300", "EM0_1", "E0", 2, None, 16, "E0_1"),
        ("NJ501-1300", "_PLC_ErrSta", "SV", 2, None, 16, "SV1"),
        ("NJ501-1300", "_errsta.7", "SV", 0, 7, 1, "SV0.07"),
        ("CJ2M-CPU33", "A10000", "A10000", 0, None, 16, "A10000"),
        ("CJ2M-CPU33", "AR11535.15", "A10000", 3071, 7, 1, "A11535.15"),
        ("CJ2M-CPU33", "A147115", "A", 2943, 7, 1, "A1471.15"),
        ("CJ2M-CPU33", "A40212", "A", 805, 4, 1, "A402.12"),
        ("CJ1M-CPU13", "CF102", "CF", 2, 2, 1, "CF1.02"),
        ("CJ1M-CPU13", "P_First_Cycle", "A", 401, 3, 1, "A200.11"),
        ("CJ1M-CPU13", "P_Cycle_Time_Value", "A", 528, None, 32, "A264"),
    ],
)
def test_the_notation_of_others(
    model: str, text: str, area: str, byte: int, bit: int | None, bits: int, written: str
) -> None:
    location = MODELS[model].locate(text)
    assert location is not None, MODELS[model].why_not(text)
    assert (location.area.name, location.byte, location.bit, location.bits) == (area, byte, bit, bits)
    assert MODELS[model].format(*location) == written


@pytest.mark.parametrize(
    ("model", "text", "reason"),
    [
        ("Q03UD", "X2000", "the last one is X1FFF"),
        ("Q03UD", "M8192", "the last one is M8191"),
        ("Q03UD", "D1F", "the last word is D12287"),
        ("Q03UD", "M100.0", "M counts in bits"),
        ("Q03UD", "D100.10", "a word has bits 0 to F"),
        ("Q03UD", "K4M1", "begin at a multiple of 8"),
        ("Q03UD", "K4D0", "is not an address"),
        ("Q03UD", "K4X1FF8", "the last one is X1FFF"),
        ("NJ501-1300", "E19_0", "is not an address"),
        ("NJ501-1300", "E0_32768", "the last word is E0_32767"),
        ("NJ501-1300", "_ErrSta.16", "there is no bit 16 in 16 bits"),
        ("CJ1M-CPU13", "P_First_Cycle.0", "there is no bit 0 in 1 bits"),
        ("CJ2M-CPU33", "A11536", "the last word is A1471"),
        ("CJ1M-CPU13", "D100.F", "a word has bits 00 to 15"),
    ],
)
def test_what_is_no_place_of_others_says_why(model: str, text: str, reason: str) -> None:
    assert MODELS[model].locate(text) is None
    assert reason in MODELS[model].why_not(text)


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
        ("100", "C, D, CF; write it like CIO0 or %IW0"),
        ("%IX500.0", "the last one is %IX199.7"),
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
    assert "its areas are %I, %Q, %M; " in generic.why_not("D100")


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
