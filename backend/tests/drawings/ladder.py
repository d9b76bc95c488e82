"""Random ladder diagrams, with what a straightforward evaluation of the rungs computes."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from tests.drawings.drawn import Drawn, Evaluate, Values
from tests.drawings.draws import Draws

VARIABLES = tuple("abcdefgh")
SCANS = 6


@dataclass(slots=True)
class State:
    """What a machine would remember."""

    values: dict[str, bool]
    seen: dict[int, bool] = field(default_factory=dict)
    """By edge, what it saw last."""
    links: dict[str, bool] = field(default_factory=dict)
    counters: dict[str, tuple[int, bool]] = field(default_factory=dict)
    """By counter: its count, and what was at CU last."""
    noted: list[tuple[bool, bool | None]] = field(default_factory=list)
    """Of each contact and coil in the order of the text: the value of its variable, as it is read or written there, and the power
    after a contact; None of a coil."""


Run = Callable[[State, bool], bool | None]
"""The power that comes in -> the power that goes on; None where the path ends."""


@dataclass(slots=True)
class Maker:
    """Draws rungs: the text and its meaning side by side."""

    draws: Draws
    numbers: Iterator[int]
    sent: list[str] = field(default_factory=list)
    """Links of the rung that are sure to have their power."""
    boxes: list[str] | None = None
    """The counters so far, where there are boxes."""

    def path(self, depth: int) -> tuple[str, Run]:
        parts = [self.element(depth) for _ in range(self.draws.integer(0 if depth < 3 else 1, 4))]

        def run(state: State, power: bool) -> bool | None:
            for _, each in parts:
                gone = each(state, power)
                assert gone is not None
                power = gone
            return power

        return " ".join(text for text, _ in parts), run

    def element(self, depth: int) -> tuple[str, Run]:
        boxes = [] if self.boxes is None else ["function", "counter"]
        kind = self.draws.one(["contact", "contact", "coil", "parallel", "link", *boxes])
        if kind == "function":
            return self.function()
        if kind == "counter":
            return self.counter()
        if kind == "parallel" and depth:
            return self.parallel(depth)
        if kind == "link" and self.sent:
            name = self.draws.one(self.sent)
            return f"#{name}", lambda state, power: power and state.links[name]
        name = self.draws.one(VARIABLES)
        if kind == "coil":
            mode = self.draws.one(["", "/", "S ", "R ", "P ", "N "])
            return f"({mode}{name})", self._coil(mode.strip(), name)
        mode = self.draws.one(["", "/", "P ", "N "])
        return f"[{mode}{name}]", self._contact(mode.strip(), name)

    def parallel(self, depth: int) -> tuple[str, Run]:
        branches: list[tuple[str, Run]] = []
        before = list(self.sent)
        for _ in range(self.draws.integer(1, 3)):
            text, run = self.path(depth - 1)
            if branches and self.draws.integer(0, 3) == 0:
                name = f"w{next(self.numbers)}"
                text, run = f"{text} -> #{name}", self._sending(run, name)
                before.append(name)
            branches.append((text, run))
        self.sent = before

        def joined(state: State, power: bool) -> bool | None:
            ends = [run(state, power) for _, run in branches]  # none is skipped
            return any(each for each in ends if each is not None)

        return f"< {' | '.join(text for text, _ in branches)} >", joined

    def function(self) -> tuple[str, Run]:
        """With EN: without power nothing is written but ENO."""
        result, g, first, second, eno = (self.draws.one(VARIABLES) for _ in range(5))

        def run(state: State, power: bool) -> bool:
            if power:
                state.values[result] = state.values[second if state.values[g] else first]
            state.values[eno] = not power
            return power

        return f"{result} := SEL(EN := ~, G := {g}, IN0 := {first}, IN1 := {second}, NOT ENO => {eno}).ENO", run

    def counter(self) -> tuple[str, Run]:
        """With EN, or without; its output goes to a link, or to a variable."""
        assert self.boxes is not None
        name = f"c{len(self.boxes)}"
        self.boxes.append(name)
        own, up, reset, out = (self.draws.one(VARIABLES) for _ in range(4))
        en = self.draws.one(["", "EN := ~, ", f"EN := < [{own}] >, "])
        cu = up if "~" in en else "~"
        link, taken, negated = self.draws.flag(), self.draws.flag(), self.draws.flag()
        wire = f"w{next(self.numbers)}"
        if link:
            self.sent.append(wire)
        target = f"#{wire}" if link else out
        text = f"{name}({en}CU := {cu}, R := {reset}, PV := 2, {'NOT ' if negated else ''}Q => {target}){'.Q' if taken else ''}"

        def run(state: State, power: bool) -> bool:
            called = True if not en else power if "~" in en else state.values[own]
            count, before = state.counters.get(name, (0, False))
            if called:
                now = state.values[up] if "~" in en else power
                count = 0 if state.values[reset] else count + (now and not before)
                state.counters[name] = count, now
                if not link:
                    state.values[out] = (count >= 2) != negated
            if link:
                state.links[wire] = called and (count >= 2) != negated
            return called and count >= 2 if taken else power

        return text, run

    def _sending(self, inner: Run, name: str) -> Run:
        def run(state: State, power: bool) -> None:
            state.links[name] = bool(inner(state, power))

        return run

    def _edge(self, state: State, number: int, mode: str, now: bool) -> bool:
        before = state.seen.get(number, False)
        state.seen[number] = now
        return now and not before if mode == "P" else before and not now

    def _contact(self, mode: str, name: str) -> Run:
        number = next(self.numbers)

        def run(state: State, power: bool) -> bool:
            value = seen = state.values[name]
            if mode in ("P", "N"):
                value = self._edge(state, number, mode, value)
            after = power and value != (mode == "/")
            state.noted.append((seen, after))
            return after

        return run

    def _coil(self, mode: str, name: str) -> Run:
        number = next(self.numbers)

        def run(state: State, power: bool) -> bool:
            if mode in ("S", "R"):
                state.values[name] = state.values[name] or power if mode == "S" else state.values[name] and not power
            elif mode in ("P", "N"):
                state.values[name] = self._edge(state, number, mode, power)
            else:
                state.values[name] = power != (mode == "/")
            state.noted.append((state.values[name], None))
            return power

        return run


def diagram(draws: Draws) -> tuple[str, list[Run], list[dict[str, bool]]]:
    """The text, the meaning of each rung, and what is written before each scan."""
    numbers = iter(range(10_000))
    texts, runs = [], []
    for _ in range(draws.integer(1, 12)):
        text, run = Maker(draws, numbers).path(3)
        texts.append(f"RUNG\n    {text}\nEND_RUNG\n")
        runs.append(run)
    sets = [
        {name: bool(value) for name, value in draws.values(dict.fromkeys(VARIABLES, (0, 1))).items()}
        for _ in range(SCANS)
    ]
    source = f"PROGRAM Main\nVAR {', '.join(VARIABLES)} : BOOL; END_VAR\n{''.join(texts)}END_PROGRAM\n"
    return source, runs, sets


def rungs(draws: Draws) -> tuple[str, list[tuple[Run, int | None]], list[dict[str, bool]]]:
    """As `diagram`, with boxes, and jumps to rungs below: of each rung with its meaning where its end leads to; -1: out of the body."""
    numbers, boxes = iter(range(10_000)), list[str]()
    texts: list[str] = []
    runs: list[tuple[Run, int | None]] = []
    count = draws.integer(1, 12)
    for number in range(count):
        text, run = Maker(draws, numbers, boxes=boxes).path(3)
        leaves = draws.one(["", "", "", "RETURN", *(f"JMP r{each}" for each in range(number + 1, count))])
        texts.append(f"RUNG r{number}:\n    {text} {leaves}\nEND_RUNG\n")
        runs.append((run, None if not leaves else int(leaves.partition(" r")[2] or -1)))
    sets = [
        {name: bool(value) for name, value in draws.values(dict.fromkeys(VARIABLES, (0, 1))).items()}
        for _ in range(SCANS)
    ]
    counters = f" {', '.join(boxes)} : CTU;" if boxes else ""
    source = f"PROGRAM Main\nVAR {', '.join(VARIABLES)} : BOOL;{counters} END_VAR\n{''.join(texts)}END_PROGRAM\n"
    return source, runs, sets


def drawn(draws: Draws) -> Drawn:
    return _drawn(*rungs(draws))


def plain(draws: Draws) -> Drawn:
    """Without boxes and jumps."""
    source, runs, sets = diagram(draws)
    return _drawn(source, [(run, None) for run in runs], sets)


def _drawn(source: str, runs: list[tuple[Run, int | None]], sets: list[dict[str, bool]]) -> Drawn:

    def begin() -> Evaluate:
        state = State(dict.fromkeys(VARIABLES, False))

        def evaluate(_: int, written: Values) -> Values:
            state.values.update((name, bool(value)) for name, value in written.items())
            state.noted.clear()
            at = 0
            while 0 <= at < len(runs):
                run, leads = runs[at]
                power = run(state, True)
                at = leads if power and leads is not None else at + 1
            return {name: int(value) for name, value in state.values.items()}

        return evaluate

    return Drawn(source, [{name: int(value) for name, value in each.items()} for each in sets], begin)
