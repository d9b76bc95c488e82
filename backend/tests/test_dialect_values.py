"""Random calculations in a dialect that computes in 64 bits: both engines, and what a calculation without types says."""

import random
from dataclasses import dataclass

import pytest

from scanbench.check.build import check_sources
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.syntax.language_file import with_dialect
from tests.caseformat import MODELS, find

UNSIGNED = {"BYTE": 8, "USINT": 8, "WORD": 16, "UINT": 16, "DWORD": 32, "UDINT": 32}
SIGNED = {"SINT": 8, "INT": 16, "DINT": 32}
STATEMENTS = 25
COMPARE = {"=": int.__eq__, "<>": int.__ne__, "<": int.__lt__, ">=": int.__ge__}


def cut(value: int, bits: int, signed: bool) -> int:
    value &= (1 << bits) - 1
    return value - (1 << bits) if signed and value >> (bits - 1) else value


@dataclass(slots=True)
class Maker:
    """Makes expressions of one sign, and what they are in 64 bits."""

    chance: random.Random
    types: dict[str, int]
    signed: bool
    values: dict[str, int]

    def expression(self, depth: int) -> tuple[str, int]:
        if depth == 0 or self.chance.random() < 0.2:
            if depth and self.chance.random() < 0.3:
                number = self.chance.choice((1, 2, 7, 100))
                name, value = self.variable()
                return f"({name} + {number})", cut(value + number, 64, self.signed)
            return self.variable()
        left, a = self.expression(depth - 1)
        if self.chance.random() < 0.2:
            number = self.chance.choice((2, 3, 10))
            return f"({left} / {number})", abs(a) // number * (-1 if a < 0 else 1)
        right, b = self.expression(depth - 1)
        operator = self.chance.choice("+-*")
        value = {"+": a + b, "-": a - b, "*": a * b}[operator]
        return f"({left} {operator} {right})", cut(value, 64, self.signed)

    def variable(self) -> tuple[str, int]:
        return self.chance.choice(sorted(self.values.items()))


@pytest.mark.parametrize("seed", range(6))
def test_both_engines_compute_what_64_bits_have(seed: int) -> None:
    chance = random.Random(seed)
    signed = seed % 2 == 1
    types = SIGNED if signed else UNSIGNED
    declared, lines, values = [], [], {}
    expected: dict[str, int] = {}
    for type, bits in types.items():
        for name in (f"a_{type}", f"b_{type}"):
            values[name] = cut(
                chance.choice((0, 1, (1 << bits) - 1, 1 << (bits - 1), chance.getrandbits(bits))), bits, signed
            )
            declared.append(f"{name} : {type} := {values[name]};")
    maker = Maker(chance, types, signed, values)
    for number in range(STATEMENTS):
        text, value = maker.expression(3)
        type, bits = chance.choice(sorted(types.items()))
        declared.append(f"r{number} : {type}; c{number} : BOOL; w{number} : {'LINT' if signed else 'ULINT'};")
        other, against = maker.expression(2)
        operator = chance.choice(sorted(COMPARE))
        lines += [f"r{number} := {text};", f"w{number} := {text};", f"c{number} := {text} {operator} {other};"]
        expected |= {f"r{number}": cut(value, bits, signed), f"w{number}": cut(value, 64, signed)}
        expected[f"c{number}"] = int(COMPARE[operator](value, against))
    source = "PROGRAM Main\nVAR\n{}\nEND_VAR\n{}\nEND_PROGRAM\n".format("\n".join(declared), "\n".join(lines))
    checked = check_sources(with_dialect({"a.st": source}, "codesys"), MODELS["GENERIC-IEC"])
    program = checked.program
    assert program is not None, "\n".join(str(each) for each in checked.problems if each.code != "W006")
    for engine in (ReferenceEngine, NativeEngine):
        memory = bytearray(program.initial_image)
        engine(program, memory).run(1)
        found = {}
        for name in expected:
            text = find(program, name, memory)[2]
            found[name] = int(text[3:], 16) if text.startswith("16#") else {"TRUE": 1, "FALSE": 0}.get(text) if text in ("TRUE", "FALSE") else int(text)  # fmt: skip
        assert found == expected, f"{engine.__name__}\n{source}"
