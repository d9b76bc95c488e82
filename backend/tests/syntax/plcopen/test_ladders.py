"""Random ladders of a PLCopen file: the rung that is read computes what the drawing does, also where it is no series and parallel one."""

from hypothesis import given, settings
from hypothesis import strategies as st

from scanbench.check.build import check_sources
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.syntax.plcopen.elements import Pin, Thing
from scanbench.syntax.plcopen.grouping import networks_of
from scanbench.syntax.plcopen.ladder import Rung
from tests.amounts import amount
from tests.caseformat import MODELS, find, write

INPUTS = tuple("abcd")
Drawn = tuple[list[Thing], dict[str, list[str]]]


@st.composite
def ladders(draw: st.DrawFn) -> Drawn:
    """Contacts and coils, each connected to some of those before it or to the rail; and what leads to each."""
    things = [Thing("0", "leftPowerRail", 1, (0, 0, 0, 0), outputs=[Pin("")])]
    into: dict[str, list[str]] = {}
    count = draw(st.integers(1, 9))
    for number in range(1, count + 1):
        ends = draw(st.lists(st.integers(0, number - 1), min_size=1, max_size=3, unique=True))
        coil = number == count or draw(st.integers(0, 3)) == 0
        kind, name = ("coil", f"q{number}") if coil else ("contact", draw(st.sampled_from(INPUTS)))
        thing = Thing(str(number), kind, number, (1 << 60, number, 0, number), name, negated=draw(st.booleans()))
        thing.inputs, thing.outputs = [Pin("", ends=tuple((str(each), "") for each in ends))], [Pin("")]
        things.append(thing)
        into[thing.id] = [str(each) for each in ends]
    return things, into


def evaluated(drawn: Drawn, values: dict[str, bool]) -> dict[str, bool]:
    """The coils, by the rules of the drawing: an element is on where power comes from any of what leads to it."""
    things, into = drawn
    power, coils = {"0": True}, {}
    for each in things[1:]:
        comes = any(power[end] for end in into[each.id])
        power[each.id] = comes
        if each.kind == "contact":
            power[each.id] = comes and values[each.name] != each.negated
        else:
            coils[each.name] = comes != each.negated
    return coils


@settings(max_examples=amount(600, 15), deadline=None)
@given(ladders())
def test_a_rung_computes_what_the_drawing_does(drawn: Drawn) -> None:
    things, _ = drawn
    rungs = [Rung(group, {"0"}).elements() for group in networks_of(things)]
    coils = [each.name for each in things if each.kind == "coil"]
    body = "".join(f"RUNG\n  {each}\nEND_RUNG\n" for each in rungs)
    source = f"PROGRAM Main\nVAR {', '.join((*INPUTS, *coils))} : BOOL; END_VAR\n{body}END_PROGRAM\n"
    program = check_sources({"main.st": source}, MODELS["GENERIC-IEC"]).program
    assert program is not None, source
    memory = bytearray(program.initial_image)
    engine = ReferenceEngine(program, memory)
    for number in range(16):
        values = {name: bool(number >> bit & 1) for bit, name in enumerate(INPUTS)}
        for name, value in values.items():
            write(program, f"Main.{name}", str(value).upper(), memory)
        engine.run(1)
        found = {name: find(program, f"Main.{name}", memory)[2] == "TRUE" for name in coils}
        assert found == evaluated(drawn, values), f"{values}\n{source}"
