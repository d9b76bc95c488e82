"""Strings: overlapping source and target, cutting, what stays after the end; against Python's own."""

import itertools
import re
from collections.abc import Callable

import pytest

from tests.engines.native.plc import plc, ran

TEXTS = ["", "a", "ab", "abcdefg", "0123456789abcdef", "0123456789abcdefghijklmnopqrstuv", "x" * 79 + "y", "z" * 100]
NUMBERS = [-3, 0, 1, 2, 5, 40, 300]

SELF: dict[str, Callable[[str, str, int, int], str]] = {
    "s := CONCAT(s, t);": lambda s, t, n, p: s + t,
    "s := CONCAT(t, s);": lambda s, t, n, p: t + s,
    "s := CONCAT(s, s);": lambda s, t, n, p: s + s,
    "s := CONCAT(CONCAT(t, s), t);": lambda s, t, n, p: t + s + t,
    "s := LEFT(s, n);": lambda s, t, n, p: s[: max(n, 0)],
    "s := RIGHT(s, n);": lambda s, t, n, p: s[len(s) - min(max(n, 0), len(s)) :],
    "s := MID(s, n, p);": lambda s, t, n, p: s[p - 1 : p - 1 + max(n, 0)] if 1 <= p <= len(s) else "",
    "s := INSERT(s, t, p);": lambda s, t, n, p: insert(s, t, p),
    "s := INSERT(t, s, p);": lambda s, t, n, p: insert(t, s, p),
    "s := DELETE(s, n, p);": lambda s, t, n, p: delete(s, n, p),
    "s := REPLACE(s, CONCAT(t, t), n, p);": lambda s, t, n, p: replace(s, t + t, n, p),
    "s := REPLACE(s, t, n, p);": lambda s, t, n, p: replace(s, t + "", n, p),
    "s := REPLACE(s, MID(s, 3, 2), n, p);": lambda s, t, n, p: replace(s, s[1:4] if len(s) >= 2 else "", n, p),
    "s := CONCAT(MID(s, n, 2), LEFT(s, p));": lambda s, t, n, p: (
        (s[1 : 1 + max(n, 0)] if len(s) >= 2 else "") + s[: max(p, 0)]
    ),
}


def insert(s: str, t: str, p: int) -> str:
    at = min(max(p, 0), len(s))
    return s[:at] + t + s[at:]


def delete(s: str, n: int, p: int) -> str:
    return s if not 1 <= p <= len(s) or n <= 0 else s[: p - 1] + s[p - 1 + n :]


def replace(s: str, t: str, n: int, p: int) -> str:
    at = min(max(p, 1), len(s) + 1)
    return s[: at - 1] + t + s[at - 1 + max(n, 0) :]


@pytest.mark.parametrize("statement", SELF)
def test_a_string_made_of_itself(statement: str) -> None:
    made = plc(f"PROGRAM Main VAR s, t : STRING[80]; n, p : INT; END_VAR {statement} END_PROGRAM")
    at = made.offset("Main.s")
    for s, t in itertools.product(TEXTS[:-1], TEXTS[:5]):
        for n, p in itertools.product(NUMBERS, repeat=2) if re.search(r"\b[np]\b", statement) else [(1, 1)]:
            old = bytes(range(128, 208))
            made.memory[at + 2 : at + 82] = old
            for name, value in (("s", s), ("t", t)):
                made.set(f"Main.{name}", f"'{value}'")
            made.set("Main.n", str(n))
            made.set("Main.p", str(p))
            before = bytes(made.memory[at + 2 : at + 82])
            made.engine.run(1)
            expected = SELF[statement](s, t, n, p)[:80]
            assert made.value("Main.s") == expected, (s, t, n, p)
            assert made.memory[at + 2 + len(expected) : at + 82] == before[len(expected) :], (
                "more than that was written"
            )


@pytest.mark.parametrize("length", [0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33, 64, 65, 200, 254])
def test_copies_of_every_length(length: int) -> None:
    text = "".join(chr(97 + n % 26) for n in range(length))
    made = plc("PROGRAM Main VAR guard1 : LWORD; a : STRING[254]; guard2 : LWORD; b : STRING[254]; c : STRING[10]; same : "
               "BOOL; found : INT; END_VAR b := a; c := a; same := a = b; found := FIND(b, 'z'); END_PROGRAM")  # fmt: skip
    made.set("Main.a", f"'{text}'")
    made.engine.run(1)
    assert (made.value("Main.b"), made.value("Main.c")) == (text, text[:10])
    assert made.value("Main.same") is True
    assert made.value("Main.found") == text.find("z") + 1
    assert (made.value("Main.guard1"), made.value("Main.guard2")) == (0, 0)


def test_order_is_by_code_the_shorter_first() -> None:
    made = plc("PROGRAM Main VAR a, b : STRING[40]; lt, le, eq, ne, ge, gt : BOOL; END_VAR\n"
               "lt := a < b; le := a <= b; eq := a = b; ne := a <> b; ge := a >= b; gt := a > b; END_PROGRAM")  # fmt: skip
    for a, b in itertools.product(["", "a", "ab", "b", "abcdefghi", "abcdefghj", "abcdefghijklmnopqr"], repeat=2):
        made.set("Main.a", f"'{a}'")
        made.set("Main.b", f"'{b}'")
        made.engine.run(1)
        found = [made.value(f"Main.{name}") for name in ("lt", "le", "eq", "ne", "ge", "gt")]
        assert found == [a < b, a <= b, a == b, a != b, a >= b, a > b], (a, b)


@pytest.mark.parametrize("length", [1, 3, 8, 20, 64, 65, 150])
def test_find(length: int) -> None:
    made = plc("PROGRAM Main VAR a, b : STRING[200]; found : INT; END_VAR found := FIND(a, b); END_PROGRAM")
    hay = ("ab" * 100)[: length - 1] + "c"
    for needle in ("", "c", "bc", "abc", "ba", "ababababa", "x", hay, hay + "c"):
        made.set("Main.a", f"'{hay}'")
        made.set("Main.b", f"'{needle}'")
        made.engine.run(1)
        assert made.value("Main.found") == (hay.find(needle) + 1 if needle else 0), needle


def test_numbers_to_strings_and_back() -> None:
    made = ran("""PROGRAM Main
VAR i : LINT := -9223372036854775807; u : ULINT := 18446744073709551615; r : REAL := 0.1; d : LREAL := -1.0e300; z : LREAL;
a, b, c, e, f : STRING; n, m, k : LINT; x, y, w, v : LREAL; END_VAR
i := i - 1; a := LINT_TO_STRING(i); b := ULINT_TO_STRING(u); c := REAL_TO_STRING(r); e := LREAL_TO_STRING(d);
f := LREAL_TO_STRING(z / z);
n := STRING_TO_LINT(a); m := STRING_TO_LINT(' +99999999999999999999x'); k := STRING_TO_LINT('- 5');
x := STRING_TO_LREAL(e); y := STRING_TO_LREAL(' -1.5e3e4'); w := STRING_TO_LREAL('.e5'); v := STRING_TO_LREAL('1e999');
END_PROGRAM""")
    assert [made.value(f"Main.{name}") for name in "abcef"] == [
        "-9223372036854775808", "18446744073709551615", "0.1", "-1e+300", "nan"
    ]  # fmt: skip
    assert [made.value(f"Main.{name}") for name in "nmk"] == [-(1 << 63), (1 << 63) - 1, 0]
    assert (made.value("Main.x"), made.value("Main.y"), made.value("Main.w")) == (-1e300, -1500.0, 0.0)


def test_a_length_that_somebody_spoilt_cannot_be_read_past() -> None:
    made = ran("""PROGRAM Main VAR s AT %MW10 : STRING[6]; n AT %MW10 : UINT; copy : STRING[200]; l : INT; END_VAR
s := 'abcdef'; n := 65535; copy := s; l := LEN(s); END_PROGRAM""")
    assert (made.value("Main.copy"), made.value("Main.l")) == ("abcdef", 6)


def test_strings_through_functions() -> None:
    made = ran("""
FUNCTION Twice : STRING[20] VAR_INPUT s : STRING[10]; END_VAR Twice := CONCAT(s, s); END_FUNCTION
FUNCTION Change : STRING[10] VAR_IN_OUT s : STRING[10]; END_VAR VAR_OUTPUT old : STRING[10]; END_VAR
old := s; s := 'new'; Change := 'x'; END_FUNCTION
PROGRAM Main VAR a, b, c : STRING[10] := 'abc'; d : STRING; END_VAR
d := CONCAT(Twice('12'), Twice(CONCAT(Twice('z'), '!'))); b := CONCAT(a, Change(s := a, old => c)); END_PROGRAM""")
    assert [made.value(f"Main.{name}") for name in "abcd"] == ["new", "abcx", "abc", "1212zz!zz!"]
