"""Random function block diagrams: both engines leave the same bytes, and what a straightforward evaluation of the lines computes."""

from collections.abc import Callable
from dataclasses import dataclass, field

from hypothesis import given, settings
from hypothesis import strategies as st

from tests.amounts import amount
from tests.batches import Drawn, collect

BOOLS, INTS = tuple("abcd"), tuple("xyz")
SCANS = 5
Values = dict[str, int]
"""By variable, by wire (`#n`) and by number of an edge (`$1`)."""
Value = Callable[[Values], int]
_JOINED: dict[str, Callable[[bool, bool], bool]] = {
    "AND": lambda one, two: one and two,
    "OR": lambda one, two: one or two,
    "XOR": lambda one, two: one != two,
}


def wrapped(value: int) -> int:
    return (value + 0x8000) % 0x10000 - 0x8000


@dataclass(slots=True)
class Maker:
    """Draws lines: the text and its meaning side by side."""

    draw: st.DrawFn
    wires: dict[str, str] = field(default_factory=dict)
    """Those that can be read, with their types."""
    edges: int = 0

    def source(self, kind: str) -> tuple[str, Value]:
        """A variable or a wire."""
        names = [*(BOOLS if kind == "BOOL" else INTS), *(name for name, type in self.wires.items() if type == kind)]
        name = self.draw(st.sampled_from(names))
        return name, lambda values: values[name]

    def pin(self) -> tuple[str, Value]:
        """A BOOL at an input, perhaps negated or an edge."""
        text, value = self.source("BOOL")
        match self.draw(st.sampled_from(["plain", "not", "rise", "fall"])):
            case "not":
                return f"NOT {text}", lambda values: not value(values)
            case "rise" | "fall" as mode:
                self.edges += 1
                key = f"${self.edges}"

                def edge(values: Values) -> int:
                    before, values[key] = values.get(key, 0), value(values)
                    return values[key] and not before if mode == "rise" else before and not values[key]

                return f"{'R' if mode == 'rise' else 'F'}_EDGE {text}", edge
        return text, value

    def box(self, kind: str) -> tuple[str, Value]:
        if kind == "BOOL":
            match self.draw(st.sampled_from(["AND", "OR", "XOR", "GT", "pin"])):
                case "GT":
                    (a, left), (b, right) = self.source("INT"), self.source("INT")
                    return f"GT({a}, {b})", lambda values: left(values) > right(values)
                case "pin":
                    return self.pin()
                case name:
                    (a, left), (b, right) = self.pin(), self.pin()
                    run = _JOINED[name]

                    def both(values: Values) -> int:
                        one, two = bool(left(values)), bool(right(values))
                        return run(one, two)

                    return f"{name}({a}, {b})", both
        (a, left), (b, right) = self.source("INT"), self.source("INT")
        match self.draw(st.sampled_from(["ADD", "SUB", "SEL", "wire"])):
            case "ADD":
                return f"ADD({a}, {b})", lambda values: wrapped(left(values) + right(values))
            case "SUB":
                return f"SUB({a}, {b})", lambda values: wrapped(left(values) - right(values))
            case "SEL":
                g, which = self.pin()
                return f"SEL({g}, {a}, {b})", lambda values: right(values) if which(values) else left(values)
        return a, left

    def line(self, number: int, loops: dict[str, str]) -> tuple[str, Callable[[Values], None]]:
        kind = self.draw(st.sampled_from(["BOOL", "INT"]))
        text, value = self.box(kind)
        wire = f"#w{number}"
        if wire in loops:
            kind = loops[wire]
            text, value = self.box(kind)
        if wire in loops or self.draw(st.booleans()):
            self.wires[wire] = kind
            type = f" : {kind}" if wire in loops else ""
            return f"{wire}{type} = {text};", lambda values: values.update({wire: value(values)})
        name = self.draw(st.sampled_from(BOOLS if kind == "BOOL" else INTS))
        operator = self.draw(st.sampled_from([":=", "S=", "R="] if kind == "BOOL" else [":="]))

        def store(values: Values) -> None:
            found = value(values)
            if operator == ":=" or found:
                values[name] = found if operator == ":=" else int(operator == "S=")

        return f"{name} {operator} {text};", store


@st.composite
def diagrams(draw: st.DrawFn) -> tuple[str, list[Callable[[Values], None]], list[Values], list[str]]:
    count = draw(st.integers(1, 14))
    loops = draw(
        st.dictionaries(
            st.integers(0, count - 1).map(lambda number: f"#w{number}"), st.sampled_from(["BOOL", "INT"]), max_size=2
        )
    )
    maker = Maker(draw, dict(loops))
    lines = [maker.line(number, loops) for number in range(count)]
    inputs = st.fixed_dictionaries(
        {}, optional={**{name: st.integers(0, 1) for name in BOOLS}, **{name: st.integers(-40, 40) for name in INTS}}
    )
    sets = draw(st.lists(inputs, min_size=SCANS, max_size=SCANS))
    body = "".join(f"  {text}\n" for text, _ in lines)
    source = (
        f"PROGRAM Main\nVAR {', '.join(BOOLS)} : BOOL; {', '.join(INTS)} : INT; END_VAR\n"
        f"NETWORK\n{body}END_NETWORK\nEND_PROGRAM\n"
    )
    return source, [run for _, run in lines], sets, list(loops)


Made = tuple[str, list[Callable[[Values], None]], list[Values], list[str]]


def drawn(made: Made) -> Drawn:
    source, runs, sets, loops = made
    values: Values = dict.fromkeys((*BOOLS, *INTS, *loops), 0)

    def shown(name: str, value: int) -> str:
        return str(bool(value)).upper() if name in BOOLS else str(value)

    def expected(scan: int) -> dict[str, str]:
        values.update(sets[scan])
        for run in runs:
            run(values)
        return {name: shown(name, values[name]) for name in (*BOOLS, *INTS)}

    return Drawn(source, [{name: shown(name, value) for name, value in each.items()} for each in sets], expected)


BATCH: list[Drawn] = []


@settings(max_examples=amount(1000, 20), deadline=None)
@given(diagrams())
def test_the_engines_and_the_evaluation_agree(made: Made) -> None:
    collect(BATCH, drawn(made))
