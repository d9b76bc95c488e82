"""From a place in the written text back to the field: each line is searched once, and long texts are not searched at all."""

from scanbench.plcmodel.drafts import DraftError, Drafts, DraftText
from scanbench.plcmodel.write_catalogue import write_catalogue


def test_a_place_is_found_without_searching_twice() -> None:
    texts = (DraftText("en", "n" * 12_000, 'code="1" ' * 2_000),)
    written = write_catalogue(Drafts((DraftError(id="a-1", group=("g",), code="4101", flag="W0.00", texts=texts),)))
    lines = written.text.split("\n")
    error = next(number for number, text in enumerate(lines, 1) if "<Error " in text)
    told = next(number for number, text in enumerate(lines, 1) if "<Description>" in text)
    assert written.field_at(told, 40) == "errors.0.texts.0.description"
    assert not written._attributes
    assert [written.field_at(error, lines[error - 1].index(f'{name}="') + 1) for name in ("Id", "ErrorCode", "ErrorFlag")] == [
        "errors.0.id", "errors.0.code", "errors.0.flag",
    ]  # fmt: skip
    assert list(written._attributes) == [error]
