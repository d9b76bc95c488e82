"""Random function block diagrams, with what a straightforward evaluation of the lines computes."""

from collections.abc import Callable
from dataclasses import dataclass, field

from tests.drawings.drawn import Drawn, Evaluate, Values
from tests.drawings.draws import Draws

BOOLS, INTS = tuple("abcd"), tuple("xyz")
SCANS = 5
Value = Callable[[Values], int]
"""Of the values by variable, by wire (`#n`) and by number of an edge (`$1`)."""
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

    draws: Draws
    wires: dict[str, str] = field(default_factory=dict)
    """Those that can be read, with their types."""
    edges: int = 0

    def source(self, kind: str) -> tuple[str, Value]:
        """A variable or a wire."""
        names = [*(BOOLS if kind == "BOOL" else INTS), *(name for name, type in self.wires.items() if type == kind)]
        name = self.draws.one(names)
        return name, lambda values: values[name]

    def pin(self) -> tuple[str, Value]:
        """A BOOL at an input, perhaps negated or an edge."""
        text, value = self.source("BOOL")
        match self.draws.one(["plain", "not", "rise", "fall"]):
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
            match self.draws.one(["AND", "OR", "XOR", "GT", "pin"]):
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
        match self.draws.one(["ADD", "SUB", "SEL", "wire"]):
            case "ADD":
                return f"ADD({a}, {b})", lambda values: wrapped(left(values) + right(values))
            case "SUB":
                return f"SUB({a}, {b})", lambda values: wrapped(left(values) - right(values))
            case "SEL":
                g, which = self.pin()
                return f"SEL({g}, {a}, {b})", lambda values: right(values) if which(values) else left(values)
        return a, left

    def line(self, number: int, loops: dict[str, str]) -> tuple[str, Callable[[Values], None]]:
        kind = self.draws.one(["BOOL", "INT"])
        text, value = self.box(kind)
        wire = f"#w{number}"
        if wire in loops:
            kind = loops[wire]
            text, value = self.box(kind)
        if wire in loops or self.draws.flag():
            self.wires[wire] = kind
            type = f" : {kind}" if wire in loops else ""
            return f"{wire}{type} = {text};", lambda values: values.update({wire: value(values)})
        name = self.draws.one(BOOLS if kind == "BOOL" else INTS)
        operator = self.draws.one([":=", "S=", "R="] if kind == "BOOL" else [":="])

        def store(values: Values) -> None:
            found = value(values)
            if operator == ":=" or found:
                values[name] = found if operator == ":=" else int(operator == "S=")

        return f"{name} {operator} {text};", store


Made = tuple[str, list[Callable[[Values], None]], list[Values], list[str]]
"""The text, the meaning of each line, what is written before each scan, and the wires of loops."""


def diagram(draws: Draws) -> Made:
    count = draws.integer(1, 14)
    looped = draws.some(range(count), 0, min(count, 2))
    loops = {f"#w{number}": draws.one(["BOOL", "INT"]) for number in looped}
    maker = Maker(draws, dict(loops))
    lines = [maker.line(number, loops) for number in range(count)]
    ranges = {**dict.fromkeys(BOOLS, (0, 1)), **dict.fromkeys(INTS, (-40, 40))}
    sets = [draws.values(ranges) for _ in range(SCANS)]
    body = "".join(f"  {text}\n" for text, _ in lines)
    source = (
        f"PROGRAM Main\nVAR {', '.join(BOOLS)} : BOOL; {', '.join(INTS)} : INT; END_VAR\n"
        f"NETWORK\n{body}END_NETWORK\nEND_PROGRAM\n"
    )
    return source, [run for _, run in lines], sets, list(loops)


def drawn(draws: Draws) -> Drawn:
    source, runs, sets, loops = diagram(draws)

    def begin() -> Evaluate:
        values: Values = dict.fromkeys((*BOOLS, *INTS, *loops), 0)

        def evaluate(_: int, written: Values) -> Values:
            values.update(written)
            for run in runs:
                run(values)
            return {name: int(values[name]) for name in (*BOOLS, *INTS)}

        return evaluate

    return Drawn(source, sets, begin)
