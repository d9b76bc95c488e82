"""Random function block diagrams, with what a straightforward evaluation of the lines computes."""

from collections.abc import Callable, Sequence
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
    network: str = ""
    """Before the names of wires in `Values`: each network has its own."""
    blocks: list[str] = field(default_factory=list)

    def source(self, kind: str) -> tuple[str, Value]:
        """A variable or a wire."""
        names = [*(BOOLS if kind == "BOOL" else INTS), *(name for name, type in self.wires.items() if type == kind)]
        name = self.draws.one(names)
        key = self.network + name if name in self.wires else name
        return name, lambda values: values[key]

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
            key = self.network + wire
            return f"{wire}{type} = {text};", lambda values: values.update({key: value(values)})
        name = self.draws.one(BOOLS if kind == "BOOL" else INTS)
        operator = self.draws.one([":=", "S=", "R="] if kind == "BOOL" else [":="])

        def store(values: Values) -> None:
            found = value(values)
            if operator == ":=" or found:
                values[name] = found if operator == ":=" else int(operator == "S=")

        return f"{name} {operator} {text};", store

    def enabled(self, number: int) -> tuple[str, Callable[[Values], None]]:
        """A function with EN: a wire gets its result, or 0, or a variable does, or keeps its value."""
        (en, on), (g, which), (a, left), (b, right) = self.pin(), self.pin(), self.source("INT"), self.source("INT")
        wire, target, eno = self.draws.flag(), self.draws.one(INTS), self.draws.one(BOOLS)
        text = f"SEL(EN := {en}, G := {g}, IN0 := {a}, IN1 := {b}, NOT ENO => {eno})"
        name, key = (f"#w{number}", f"{self.network}#w{number}") if wire else (target, target)
        if wire:
            self.wires[name] = "INT"

        def run(values: Values) -> None:
            enabled, second = bool(on(values)), bool(which(values))
            if enabled:
                values[key] = right(values) if second else left(values)
            elif wire:
                values[key] = 0
            values[eno] = int(not enabled)

        return f"{name} {'=' if wire else ':='} {text};", run

    def counter(self, number: int) -> tuple[str, Callable[[Values], None]]:
        """A counter with EN, and outputs that go to wires."""
        name = f"c{len(self.blocks)}"
        self.blocks.append(name)
        (en, on), (cu, up), (r, reset) = self.pin(), self.pin(), self.pin()
        eno, out, negated = self.draws.one("ab"), self.draws.one("cd"), self.draws.flag()
        count, full = f"{self.network}#v{number}", f"{self.network}#w{number}"
        if plain := self.draws.flag():
            text = f"Q => #w{number}"
            self.wires[f"#w{number}"] = "BOOL"
        else:
            text = f"{'NOT ' if negated else ''}Q => {out}"
        self.wires[f"#v{number}"] = "INT"

        def run(values: Values) -> None:
            enabled, rising, ends = bool(on(values)), bool(up(values)), bool(reset(values))
            if enabled:
                rose = rising and not values.get(f"{name}.CU", 0)
                values[f"{name}.CU"] = int(rising)
                values[f"{name}.CV"] = 0 if ends else values.get(f"{name}.CV", 0) + rose
            q = values.get(f"{name}.CV", 0) >= 2
            values[count] = values[f"{name}.CV"] if enabled else 0
            if plain:
                values[full] = int(q and enabled)
            elif enabled:
                values[out] = int(q != negated)
            values[eno] = int(not enabled)

        return f"{name}(EN := {en}, CU := {cu}, R := {r}, PV := 2, {text}, CV => #v{number}, NOT ENO => {eno});", run

    def leave(self, labels: Sequence[str]) -> tuple[str, Callable[[Values], None]]:
        """A jump to a network below, or RETURN."""
        label = self.draws.one(["", *labels])
        text, value = self.pin()

        def run(values: Values) -> None:
            if value(values) and "leave" not in values:
                values["leave"] = int(label[1:] or -1)

        return f"{f'JMP {label}' if label else 'RETURN'} IF {text};", run


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


def networks(draws: Draws) -> tuple[str, list[list[Callable[[Values], None]]], list[Values], list[str]]:
    """As `diagram`, with several networks whose wires have the same names, boxes with EN, and jumps over networks."""
    maker = Maker(draws)
    texts: list[str] = []
    runs: list[list[Callable[[Values], None]]] = []
    kept: list[str] = []
    count = draws.integer(1, 4)
    for network in range(count):
        size = draws.integer(1, 7)
        looped = draws.some(range(size), 0, min(size, 2))
        loops = {f"#w{number}": draws.one(["BOOL", "INT"]) for number in looped}
        maker.wires, maker.network = dict(loops), str(network)
        kept += (f"{network}{wire}" for wire in loops)
        labels = [f"n{each}" for each in range(network + 1, count)]
        lines = []
        for number in range(size):
            kind = "line" if f"#w{number}" in loops else draws.one(["line", "line", "enabled", "counter", "leave"])
            if kind == "line":
                lines.append(maker.line(number, loops))
            elif kind == "leave":
                lines.append(maker.leave(labels))
            else:
                lines.append(maker.enabled(number) if kind == "enabled" else maker.counter(number))
        body = "".join(f"  {text}\n" for text, _ in lines)
        texts.append(f"NETWORK n{network}:\n{body}END_NETWORK\n")
        runs.append([run for _, run in lines])
    ranges = {**dict.fromkeys(BOOLS, (0, 1)), **dict.fromkeys(INTS, (-40, 40))}
    sets = [draws.values(ranges) for _ in range(SCANS)]
    counters = f" {', '.join(maker.blocks)} : CTU;" if maker.blocks else ""
    source = (
        f"PROGRAM Main\nVAR {', '.join(BOOLS)} : BOOL; {', '.join(INTS)} : INT;{counters} END_VAR\n"
        f"{''.join(texts)}END_PROGRAM\n"
    )
    return source, runs, sets, kept


def drawn(draws: Draws) -> Drawn:
    return _drawn(*networks(draws))


def plain(draws: Draws) -> Drawn:
    """One network, without blocks, EN and jumps."""
    source, runs, sets, loops = diagram(draws)
    return _drawn(source, [runs], sets, loops)


def _drawn(source: str, runs: list[list[Callable[[Values], None]]], sets: list[Values], loops: list[str]) -> Drawn:

    def begin() -> Evaluate:
        values: Values = dict.fromkeys((*BOOLS, *INTS, *loops), 0)

        def evaluate(_: int, written: Values) -> Values:
            values.update(written)
            at = 0
            while 0 <= at < len(runs):
                for run in runs[at]:
                    run(values)
                at = values.pop("leave", at + 1)
            return {name: int(values[name]) for name in (*BOOLS, *INTS)}

        return evaluate

    return Drawn(source, sets, begin)
