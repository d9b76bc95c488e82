"""Who may read and write what, on every model: the program (by the checker), a tool (by `Write`), the engine interface.

The expectation is written from what is known of the devices (the tables of the reference, not the model files): `FIRST
LAST program tool engine` for every range, all ranges together being all there is.
"""

from dataclasses import dataclass
from functools import cache

import pytest

from scanbench.check.build import check_sources
from scanbench.faults.inject import Generate
from scanbench.faults.reference import ErrorRef
from scanbench.plcmodel.as_used import as_used
from scanbench.plcmodel.model import Model
from scanbench.runtime.command import Entry, Refusal
from scanbench.runtime.resource import Resource
from scanbench.runtime.write import Write
from scanbench.symbols.symbols import resolve
from tests.runtime.bench import model as named
from tests.runtime.bench import plc

CS_CJ = """
CIO0 CIO6143 rw rw rw
W0 W511 rw rw rw
H0 H511 rw rw rw
A0 A447 r r rw
A448 A959 rw rw rw
T0 T4095 rw rw rw
C0 C4095 rw rw rw
D0 D32767 rw rw rw
CF0 CF1 r r rw
"""


def banks(count: int) -> str:
    """EM banks, numbered in hexadecimal."""
    return "".join(f"E{bank:X}_0 E{bank:X}_32767 rw rw rw\n" for bank in range(count))


MELSEC = """
X0 X1FFF rw rw rw
Y0 Y1FFF rw rw rw
M0 M8191 rw rw rw
L0 L8191 rw rw rw
F0 F2047 rw rw rw
V0 V2047 rw rw rw
B0 B1FFF rw rw rw
SB0 SB7FF rw rw rw
S0 S8191 rw rw rw
SM0 SM47 r r rw
SM48 SM399 rw rw rw
SM400 SM431 r r rw
SM432 SM2047 rw rw rw
T0 T2047 rw rw rw
C0 C1023 rw rw rw
D0 D12287 rw rw rw
W0 W1FFF rw rw rw
SW0 SW7FF rw rw rw
SD0 SD49 r r rw
SD50 SD50 rw rw rw
SD51 SD199 r r rw
SD200 SD209 rw rw rw
SD210 SD213 r r rw
SD214 SD419 rw rw rw
SD420 SD599 r r rw
SD600 SD2047 rw rw rw
R0 R32767 rw rw rw
"""
NJ = """
CIO0 CIO6143 rw rw rw
W0 W511 rw rw rw
H0 H1535 rw rw rw
D0 D32767 rw rw rw
SV0 SV31 r r rw
"""
GENERIC = """
%IW0 %IW511 r rw rw
%QW0 %QW511 rw rw rw
%MW0 %MW4095 rw rw rw
%MW4096 %MW4351 r r rw
"""
CJ2 = CS_CJ.replace("A448 A959", "A448 A1471") + "A10000 A11535 r r rw\n" + banks(4)
MATRIX = {
    **{f"CJ1M-CPU{member}": CS_CJ for member in (11, 12, 13, 21, 22, 23, 63)},
    "CP1H-XA40D": CS_CJ,
    "CS1G-CPU44H": CS_CJ + banks(1),
    "CS1H-CPU65H": CS_CJ + banks(3),
    "CS1D-CPU65H": CS_CJ + banks(3),
    "CJ2M-CPU33": CJ2,
    "Q03UD": MELSEC,
    "NJ501-1300": NJ + banks(25),
    "GENERIC-IEC": GENERIC,
}


@dataclass(frozen=True)
class Range:
    """One line of the table."""

    first: str
    last: str
    program: str
    tool: str
    engine: str


@cache
def ranges(name: str) -> tuple[Range, ...]:
    return tuple(Range(*line.split()) for line in MATRIX[name].split("\n") if line)


def kind(model: Model, address: str) -> str:
    location = model.locate(address)
    assert location is not None, model.why_not(address)
    return {1: "BOOL", 16: "WORD"}[location.bits]


@cache
def resource(name: str) -> Resource:
    return plc("PROGRAM Main VAR n : INT; END_VAR n := n + 1; END_PROGRAM", model_name=name)


def test_no_model_is_left_out(models: dict[str, Model]) -> None:
    assert models.keys() == MATRIX.keys()


@pytest.mark.parametrize("name", MATRIX)
def test_the_ranges_are_all_there_is(name: str) -> None:
    model = as_used(named(name), ())
    covered = {area.name: 0 for area in model.areas}
    for each in ranges(name):
        first, last = model.locate(each.first), model.locate(each.last)
        assert first is not None
        assert last is not None
        assert first.area is last.area
        covered[first.area.name] += last.word - first.word + 1
    assert covered == {area.name: area.words for area in model.areas}


@pytest.mark.parametrize("name", MATRIX)
def test_the_program(name: str) -> None:
    """It reads everything; an assignment to what it may only read is refused with the address and the model."""
    model, rows = named(name), ranges(name)
    ends = [(address, each.program) for each in rows for address in (each.first, each.last)]
    declared = "".join(f"v{i} AT {address} : {kind(model, address)};\n" for i, (address, _) in enumerate(ends))
    head = f"PROGRAM Main VAR\n{declared}b : BOOL; w : WORD;\nEND_VAR\n"
    kinds = [kind(model, address) for address, _ in ends]
    reads = "".join(f"{'b' if bits == 'BOOL' else 'w'} := v{i};\n" for i, bits in enumerate(kinds))
    assert check_sources({"read.st": head + reads + "END_PROGRAM"}, model).problems == ()
    writes = "".join(f"v{i} := {'TRUE' if bits == 'BOOL' else '1'};\n" for i, bits in enumerate(kinds))
    found = check_sources({"write.st": head + writes + "END_PROGRAM"}, model).problems
    refused = {problem.span.line - head.count("\n") - 1: problem for problem in found}
    assert set(refused) == {i for i, (_, rights) in enumerate(ends) if rights == "r"}
    for index, problem in refused.items():
        assert problem.code == "T011"
        assert problem.message == f"{ends[index][0]} is read-only for the program on a {name}; it can only be read."


@pytest.mark.parametrize("name", MATRIX)
def test_a_tool(name: str) -> None:
    """It sees everything; a write to what it may only read is refused with the address and the model."""
    virtual = resource(name)
    for each in ranges(name):
        for address in (each.first, each.last):
            symbol = resolve(virtual.program, address)
            assert symbol.locate(virtual.memory) is not None
            answer = virtual.submit(Write("Ada", address, "1"))
            if each.tool == "rw":
                assert isinstance(answer, Entry), answer
            else:
                assert isinstance(answer, Refusal), address
                assert answer.message.startswith(f"{symbol.path} is read-only for tools on {name}, as on the device")


def test_a_variable_that_reaches_into_protected_words_is_protected() -> None:
    """SM399 may be written, SM400 may not: a DWORD from SM384 on holds both."""
    text = "PROGRAM Main VAR both AT K8SM384 : DWORD; END_VAR {}END_PROGRAM"
    (problem,) = check_sources({"main.st": text.format("both := 1; ")}, named("Q03UD")).problems
    assert problem.message == "K4SM400 is read-only for the program on a Q03UD; it can only be read."
    virtual = plc(text.format(""), model_name="Q03UD")
    answer = virtual.submit(Write("Ada", "Main.both", "1"))
    assert isinstance(answer, Refusal)
    assert "is read-only for tools" in answer.message
    assert not resolve(virtual.program, "Main.both").writable


@pytest.mark.parametrize("name", MATRIX)
def test_the_engine_interface(name: str) -> None:
    """It may write everywhere, and what the catalogue writes is what tools may not."""
    model, virtual = named(name), plc("PROGRAM Main VAR n : INT; END_VAR n := n + 1; END_PROGRAM", model_name=name)
    for each in ranges(name):
        for address in (each.first, each.last):
            location = model.locate(address)
            assert location is not None
            assert location.area.access(location.word, "engine") == {"rw": "write", "r": "read"}[each.engine]
    error = next(each for each in model.errors() if each.severity == "nonfatal")
    assert isinstance(virtual.submit(Write("Ada", error.flag_text, "1")), Refusal)
    answer = virtual.submit(Generate("Ada", (ErrorRef(error.id),)))
    assert isinstance(answer, Entry), answer
    flag = virtual.program.layout.areas[error.flag.area.name] + error.flag.byte
    assert error.flag.bit is not None
    assert virtual.memory[flag] >> error.flag.bit & 1
