"""Arithmetic at the edges, against plain Python."""

import math
import struct

import pytest

from tests.engines.native.plc import plc, ran

WIDTHS = {"SINT": 8, "INT": 16, "DINT": 32, "LINT": 64}


def wrapped(value: int, bits: int) -> int:
    return (value + (1 << bits - 1)) % (1 << bits) - (1 << bits - 1)


def truncated(a: int, b: int) -> int:
    return abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)


@pytest.mark.parametrize("type", WIDTHS)
def test_signed_integers_wrap(type: str) -> None:
    bits = WIDTHS[type]
    low, high = -(1 << bits - 1), (1 << bits - 1) - 1
    edges = [low, low + 1, -7, -1, 0, 1, 2, 10, high]
    made = plc(f"""PROGRAM Main VAR a, b, sum, difference, product, quotient, rest, minus, size : {type}; END_VAR
sum := a + b; difference := a - b; product := a * b; rest := a MOD b; minus := -a; size := ABS(a);
IF b <> 0 THEN quotient := a / b; END_IF; END_PROGRAM""")
    for a in edges:
        for b in edges:
            made.set("Main.a", str(a))
            made.set("Main.b", str(b))
            made.engine.run(1)
            expected = {"sum": a + b, "difference": a - b, "product": a * b, "minus": -a, "size": abs(a)}
            expected["rest"] = 0 if b == 0 else a - b * truncated(a, b)
            if b:
                expected["quotient"] = truncated(a, b)
            for name, value in expected.items():
                assert made.value(f"Main.{name}") == wrapped(value, bits), (name, a, b)


@pytest.mark.parametrize("divisor", [-1, -7, -128, 1, 2, 3, 127])
def test_division_by_constants(divisor: int) -> None:
    made = plc(f"PROGRAM Main VAR a, q, r : SINT; END_VAR q := a / {divisor}; r := a MOD {divisor}; END_PROGRAM")
    for a in range(-128, 128):
        made.memory[made.offset("Main.a")] = a & 255
        made.engine.run(1)
        quotient = wrapped(truncated(a, divisor), 8)
        assert (made.value("Main.q"), made.value("Main.r")) == (quotient, a - divisor * truncated(a, divisor))


NUMBERS = [0.0, -0.0, 0.5, 1.5, 2.5, -0.5, -1.5, -2.5, 1e10, -1e10, 3e9, 1e30, -1e30, math.inf, -math.inf, math.nan]


@pytest.mark.parametrize(
    ("type", "low", "high"),
    [("SINT", -128, 127), ("UINT", 0, 65535), ("DINT", -(1 << 31), (1 << 31) - 1), ("LINT", -(1 << 63), (1 << 63) - 1),
     ("ULINT", 0, (1 << 64) - 1)],
)  # fmt: skip
@pytest.mark.parametrize("real", ["REAL", "LREAL"])
def test_reals_to_integers_round_to_even_and_saturate(type: str, low: int, high: int, real: str) -> None:
    made = plc(f"PROGRAM Main VAR x : {real}; n, t : {type}; END_VAR n := {real}_TO_{type}(x); END_PROGRAM")
    layout = "<f" if real == "REAL" else "<d"
    for number in NUMBERS:
        data = struct.pack(layout, number)
        made.memory[made.offset("Main.x") : made.offset("Main.x") + len(data)] = data
        made.engine.run(1)
        exact = struct.unpack(layout, data)[0]
        if math.isnan(exact):
            expected = 0
        elif math.isinf(exact):
            expected = high if exact > 0 else low
        else:
            expected = min(max(round(exact), low), high)
        assert made.value("Main.n") == expected, number


def test_every_nan_is_stored_as_the_canonical_one() -> None:
    made = ran("""PROGRAM Main
VAR z, inf, a, b, c : REAL; d, e : LREAL; list : ARRAY[0..3] OF REAL; i : INT; word AT %MD0 : DWORD; r AT %MD0 : REAL; END_VAR
inf := 1.0 / z; a := inf - inf; b := z / z; c := -a; d := SQRT(LREAL#-1.0 + d); e := REAL_TO_LREAL(c);
word := 16#FFFF_FFFF; FOR i := 0 TO 3 DO list[i] := r + 1.0; END_FOR; END_PROGRAM""")
    for name in ("a", "b", "c", "list[0]", "list[3]"):
        assert made.raw(f"Main.{name}") == bytes.fromhex("0000c07f"), name
    for name in ("d", "e"):
        assert made.raw(f"Main.{name}") == bytes.fromhex("000000000000f87f"), name


def single(x: float) -> float:
    return float(struct.unpack("<f", struct.pack("<f", x))[0])


def test_real_is_single_precision_and_not_contracted() -> None:
    made = plc("PROGRAM Main VAR a, b, c, r : REAL; END_VAR r := a * b + c; END_PROGRAM")
    a, b = single(1.0000001), single(1.0000001)
    c = single(-single(a * b))
    for name, value in (("a", a), ("b", b), ("c", c)):
        at = made.offset(f"Main.{name}")
        made.memory[at : at + 4] = struct.pack("<f", value)
    made.engine.run(1)
    assert made.value("Main.r") == 0.0, "a fused multiply-add would show the rounding error"


def test_libm_is_not_replaced_by_something_close() -> None:
    made = plc("PROGRAM Main VAR x : LREAL := 1.1; a, b, c : LREAL; END_VAR\n"
               "a := EXPT(x, 2.0); b := EXPT(x, 0.5); c := SIN(x); END_PROGRAM")  # fmt: skip
    made.engine.run(1)
    assert (made.value("Main.a"), made.value("Main.b")) == (math.pow(1.1, 2.0), math.pow(1.1, 0.5))
    assert made.value("Main.c") == math.sin(1.1)


@pytest.mark.parametrize("count", [-65, -64, -17, -1, 0, 1, 15, 16, 17, 63, 64, 65, 1 << 40])
def test_shifts_and_rotations(count: int) -> None:
    made = ran(f"""PROGRAM Main VAR w : WORD := 16#8421; n : LINT := {count}; l, r, rl, rr : WORD; END_VAR
l := SHL(w, n); r := SHR(w, n); rl := ROL(w, n); rr := ROR(w, n); END_PROGRAM""")
    inside = 0 <= count < 16
    assert made.value("Main.l") == (0x8421 << count & 0xFFFF if inside else 0)
    assert made.value("Main.r") == (0x8421 >> count if inside else 0)
    turn = count % 16
    assert made.value("Main.rl") == (0x8421 << turn | 0x8421 >> 16 - turn) & 0xFFFF
    assert made.value("Main.rr") == (0x8421 >> turn | 0x8421 << 16 - turn) & 0xFFFF
