"""Types and values of OPC UA: what a client is given is taken back as the same bytes."""

import pytest
from asyncua import ua

from scanbench.comm.opcua.forms import NoValue, form_of
from scanbench.comm.opcua.tree import MOST_NODES, items
from scanbench.program.types import ELEMENTARY, ArrayType, StringType, Type
from tests.runtime.bench import program

TYPES: tuple[Type, ...] = (
    *ELEMENTARY.values(), StringType(10), StringType(10, 2), ArrayType(((0, 2),), ELEMENTARY["INT"]),
    ArrayType(((1, 2), (0, 1)), StringType(3)),
)  # fmt: skip


@pytest.mark.parametrize("type", TYPES, ids=str)
def test_a_value_that_was_read_can_be_written(type: Type) -> None:
    form = form_of(type)
    assert form is not None
    other = b"\1\0\x41"[: type.size].ljust(type.size, b"\0")
    whole_day = type.name in ("DATE", "LDATE")
    for data in (bytes(type.size), b"\1" + bytes(type.size - 1), bytes(type.size) if whole_day else other):
        shown = form.value(data)
        assert shown.VariantType is form.variant
        again = form.data(ua.ua_binary.variant_from_binary(ua.utils.Buffer(ua.ua_binary.variant_to_binary(shown))))
        assert form.value(again.ljust(type.size, b"\0")) == shown


def test_what_is_no_value_of_the_type_is_refused() -> None:
    word, text = form_of(ELEMENTARY["USINT"]), form_of(StringType(3))
    assert word is not None
    assert text is not None
    with pytest.raises(NoValue):
        word.data(ua.Variant(256, ua.VariantType.Byte))
    with pytest.raises(TypeError):
        word.data(ua.Variant(1, ua.VariantType.Int16))
    with pytest.raises(TypeError):
        word.data(ua.Variant([1], ua.VariantType.Byte))
    for wrong in ("abcd", "日"):
        with pytest.raises(NoValue):
            text.data(ua.Variant(wrong, ua.VariantType.String))
    ended = form_of(StringType(3, zero=True))
    assert ended is not None
    assert ended.data(ua.Variant("ab", ua.VariantType.String)) == b"ab\0"
    assert ended.value(b"ab\0z").Value == "ab"
    with pytest.raises(NoValue):
        ended.data(ua.Variant("a\0b", ua.VariantType.String))


def test_the_nodes_of_a_program_are_so_many_and_no_more() -> None:
    found = items(
        program(
            "TYPE S : STRUCT a : INT; b : ARRAY[1..50000] OF INT; END_STRUCT END_TYPE\n"
            "PROGRAM Main VAR s : ARRAY[1..5] OF S; r : REF_TO INT; big : ARRAY[1..200, 1..200] OF S0; END_VAR END_PROGRAM\n"
            "TYPE S0 : STRUCT x : BYTE; END_STRUCT END_TYPE"
        )
    )
    paths = {each.path for each in found}
    assert {"Main", "Main.s", "Main.s[5]", "Main.s[5].a", "Main.s[5].b", "Main.big[1,1].x"} <= paths
    assert "Main.r" not in paths, "what it refers to is found where it lives"
    assert len(found) < MOST_NODES
