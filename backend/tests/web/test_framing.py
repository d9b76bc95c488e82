import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scanbench.web.framing import BadFrame, Framing, framed, parsed

MESSAGES = st.lists(st.dictionaries(st.text(), st.text() | st.integers() | st.none()), max_size=5)


@given(MESSAGES, st.lists(st.integers(1, 40), min_size=1))
def test_messages_come_out_however_the_bytes_are_cut(messages: list[dict[str, object]], cuts: list[int]) -> None:
    data = b"".join(map(framed, messages))
    framing, found, at = Framing(), list[object](), 0
    for number in range(len(data)):
        length = cuts[number % len(cuts)]
        found += map(parsed, framing.feed(data[at : at + length]))
        at += length
    assert found == messages


def test_the_length_counts_bytes() -> None:
    message: dict[str, object] = {"text": "Füllstand µ"}
    data = framed(message)
    header, _, body = data.partition(b"\r\n\r\n")
    assert header == b"Content-Length: %d" % len(body)
    assert json.loads(body) == message


def test_other_headers_and_capitals_do_not_matter() -> None:
    assert Framing().feed(b"Content-Type: x\r\ncontent-length:2\r\n\r\n{}") == [b"{}"]


def test_what_is_no_json_is_a_text() -> None:
    assert parsed(b"{nonsense") == "{nonsense"


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"GET / HTTP/1.1\r\n\r\n", "no Content-Length"),
        (b"Content-Length: many\r\n\r\n", "no Content-Length"),
        (b"Content-Length: 99999999999\r\n\r\n", "larger than 64 MiB"),
        pytest.param(b"Content-Length: " + b"9" * 4900 + b"\r\n\r\n", "larger than 64 MiB", id="digits"),
        (b"x" * 5000, "no end"),
    ],
)
def test_what_is_no_message_is_told(data: bytes, reason: str) -> None:
    with pytest.raises(BadFrame, match=reason):
        Framing().feed(data)
