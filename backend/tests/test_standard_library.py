"""Every conversion and every standard function with arguments of every type: refused, or the same on both engines."""

import random
import struct

import pytest

from scanbench.check.build import check_sources
from scanbench.check.standard.functions import FUNCTIONS
from scanbench.engines.engine import Reason
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.problems import Severity
from scanbench.program.types import ELEMENTARY, Kind
from tests.amounts import amount, nightly
from tests.caseformat import MODELS, first_difference, look_up

TYPES = [*ELEMENTARY, "STRING", "WSTRING"]
TEXTS = (
    "", "T#1d2h", "-5.5s3ms", "D#2024-02-29", "DT#1999-12-31-23:59:59.25", "12:02:03.4", "TRUE", " 1e5", "-77", "9" * 30,
    "16#1F", "x",
)  # fmt: skip
NUMBERS = (0, 1, -1, 9, 86_400_000_000_000, -86_400_000_000_001, -(1 << 63), (1 << 63) - 1, 0x1234567890ABCDEF)
REALS = (0.0, -0.0, -1.5, 2.5, 1e10, -1e30, float("inf"), float("-inf"), float("nan"), 1e-40)


def value_of(type: str, random: random.Random) -> bytes:
    """The bytes of some value, often one at an edge."""
    if type in ("STRING", "WSTRING"):
        text = random.choice(TEXTS)
        data = text.encode("latin-1" if type == "STRING" else "utf-16-le")
        return len(text).to_bytes(2, "little") + data
    size = ELEMENTARY[type].size
    if type == "BOOL":
        return bytes([random.randrange(2)])
    if ELEMENTARY[type].kind is Kind.REAL:
        return struct.pack("<f" if size == 4 else "<d", random.choice((*REALS, random.uniform(-1e6, 1e6))))
    return random.choice((*NUMBERS, random.getrandbits(63))).to_bytes(8, "little", signed=True)[:size]


def run(body: list[str], outputs: str, scans: int) -> int:
    """Runs the statements that the checker accepts on both engines; gives how many that are."""
    inputs = "".join(f"v_{type} : {type}; w_{type} : {type};" for type in TYPES)
    text = "PROGRAM Main\nVAR {} {} END_VAR\n{}\nEND_PROGRAM\n"
    checked = check_sources({"a": text.format(inputs, outputs, "\n".join(body))}, MODELS["GENERIC-IEC"])
    refused = {problem.span.line - 3 for problem in checked.problems if problem.severity is Severity.ERROR}
    body = [statement for number, statement in enumerate(body) if number not in refused]
    program = check_sources({"a": text.format(inputs, outputs, "\n".join(body))}, MODELS["GENERIC-IEC"]).program
    assert program is not None
    memories = [bytearray(program.initial_image) for _ in range(2)]
    engines = [ReferenceEngine(program, memories[0]), NativeEngine(program, memories[1])]
    chance = random.Random(1)
    for scan in range(scans):
        for name in [f"{letter}_{type}" for type in TYPES for letter in "vw"]:
            place = look_up(program, name).locate(memories[0])
            assert place is not None
            data = value_of(name[2:], chance)
            for memory in memories:
                memory[place[0] : place[0] + len(data)] = data
        stops = [engine.run(1) for engine in engines]
        assert stops[0] == stops[1]
        assert stops[0].reason is not Reason.TRAP, program.traps[stops[0].trap - 1]
        assert not first_difference(program, memories[0], memories[1]), f"scan {scan}"
    return len(body)


def test_every_conversion() -> None:
    body = [f"o_{a}_{b} := {a}_TO_{b}(v_{a});" for a in TYPES for b in TYPES]
    outputs = "".join(f"o_{a}_{b} : {b};" for a in TYPES for b in TYPES)
    assert run(body, outputs, 40) == 677


def test_every_bcd_and_truncation() -> None:
    bits, whole = (
        ("BYTE", "WORD", "DWORD", "LWORD"),
        [t for t, e in ELEMENTARY.items() if e.kind in (Kind.INT, Kind.UINT)],
    )
    names = [f"{a}_BCD_TO_{b}" for a in bits for b in whole] + [f"{b}_TO_BCD_{a}" for a in bits for b in whole]
    names += [f"{a}_TRUNC_{b}" for a in ("REAL", "LREAL") for b in whole]
    pairs = [(name, name.split("_")[0], name.split("_")[-1]) for name in names]
    body = [f"o_{name} := {name}(v_{source});" for name, source, _ in pairs]
    assert run(body, "".join(f"o_{name} : {target};" for name, _, target in pairs), 40) == len(names)


SAFE = [name for name in FUNCTIONS if name not in ("DIV", "DIV_TIME", "DIV_LTIME", "DIVTIME")]
"""The others trap."""


@nightly
@pytest.mark.parametrize("count", [1, 2, 3][: amount(3, 2)])
def test_every_function(count: int) -> None:
    """With arguments of one type, and with numbers after the first argument."""
    body: list[str] = []
    outputs = ""
    for name in SAFE:
        for type in TYPES:
            for other in {type, "INT", "TIME"} if count > 1 else {type}:
                arguments = [f"v_{type}", *[f"w_{other}"] * (count - 1)]
                number = len(body)
                outputs += f"o{number} : BOOL;"
                body.append(f"o{number} := {name}({', '.join(arguments)}) = {name}({', '.join(arguments)});")
    accepted = run(body, outputs, 10)
    assert accepted > 100
