"""Random sequential function charts, with what the rules of the standard give, followed one by one."""

from dataclasses import dataclass, field

from scanbench.syntax.chart import TIMED
from tests.drawings.drawn import Drawn, Evaluate, Values
from tests.drawings.draws import Draws

INPUTS, OUTPUTS, ACTIONS = tuple("abc"), tuple("pqr"), ("Mix", "Fill")
SCANS, SCAN_MS = 25, 10
QUALIFIERS = ("N", "N", "S", "R", "P", "P0", "P1", "L", "D", "SD", "DS", "SL")


@dataclass(slots=True)
class Association:
    action: str
    qualifier: str
    ms: int

    def __str__(self) -> str:
        time = f", T#{self.ms}ms" if self.qualifier in TIMED else ""
        return f"{self.action}({self.qualifier}{time});"


@dataclass(slots=True)
class Transition:
    sources: list[int]
    targets: list[int]
    input: str
    """Empty: after the time of its first source."""
    negated: bool
    priority: int

    def __str__(self) -> str:
        def steps(numbers: list[int]) -> str:
            names = ", ".join(f"S{each}" for each in numbers)
            return names if len(numbers) == 1 else f"({names})"

        test = f"{'NOT ' if self.negated else ''}{self.input}" if self.input else f"S{self.sources[0]}.T >= T#20ms"
        priority = f"(PRIORITY := {self.priority}) " if self.priority else ""
        return f"TRANSITION {priority}FROM {steps(self.sources)} TO {steps(self.targets)} := {test}; END_TRANSITION"


@dataclass(slots=True)
class Timer:
    start: int | None = None

    def run(self, on: bool, ms: int, now: int) -> bool:
        if not on:
            self.start = None
            return False
        self.start = now if self.start is None else self.start
        return now - self.start >= ms


@dataclass(slots=True)
class Control:
    """What one action remembers."""

    q: bool = False
    sums: dict[str, bool] = field(default_factory=dict)
    """By qualifier, of the last evaluation."""
    stored: dict[str, bool] = field(default_factory=dict)
    timers: dict[str, Timer] = field(default_factory=dict)


@dataclass(slots=True)
class Machine:
    """A chart, followed as the standard tells it."""

    steps: list[list[Association]]
    transitions: list[Transition]
    active: set[int] = field(default_factory=lambda: {0})
    since: dict[int, int] = field(default_factory=dict)
    times: dict[int, int] = field(default_factory=dict)
    controls: dict[str, Control] = field(default_factory=dict)

    def actions(self) -> list[str]:
        return list(dict.fromkeys(each.action for step in self.steps for each in step))

    def evaluate(self, values: dict[str, int], now: int) -> None:
        for step in self.active:
            self.times[step] = now - self.since.setdefault(step, now)
        due = {name: self._control(name, now) for name in self.actions()}
        for ending in (True, False):
            for name, (runs, ends) in due.items():
                if ends != ending:
                    continue
                if name in OUTPUTS:
                    values[name] = self.controls[name].q
                elif runs:
                    values[f"n{name}"] += 1
                    values[f"q{name}"] += self.controls[name].q
        self._move(values)

    def _control(self, name: str, now: int) -> tuple[bool, bool]:
        state = self.controls.setdefault(name, Control())
        mine = [(number, each) for number, step in enumerate(self.steps) for each in step if each.action == name]
        on = {each.qualifier: False for _, each in mine}
        ms = {each.qualifier: each.ms for _, each in mine}
        for number, each in mine:
            on[each.qualifier] |= number in self.active
        reset = on.get("R", False)

        def kept(qualifier: str, value: bool) -> bool:
            state.stored[qualifier] = (value or state.stored.get(qualifier, False)) and not reset
            return state.stored[qualifier]

        def timed(qualifier: str, value: bool) -> bool:
            return state.timers.setdefault(qualifier, Timer()).run(value, ms[qualifier], now)

        q = on.get("N", False)
        if "S" in on:
            q |= kept("S", on["S"])
        if "L" in on:
            over = timed("L", on["L"])
            q |= on["L"] and not over
        if "D" in on:
            q |= timed("D", on["D"])
        if "SD" in on:
            q |= timed("SD", kept("SD", on["SD"]))
        if "DS" in on:
            q |= kept("DS", timed("DS", on["DS"]))
        if "SL" in on:
            stored = kept("SL", on["SL"])
            over = timed("SL", stored)
            q |= stored and not over
        before = state.sums
        state.sums = on
        q |= on.get("P", False) and not before.get("P", False)
        first = on.get("P1", False) and not before.get("P1", False)
        last = before.get("P0", False) and not on.get("P0", False)
        was, state.q = state.q, q and not reset
        ends = ((was and not state.q) or last) and not state.q and not first
        return state.q or ends or first, ends

    def _move(self, values: dict[str, int]) -> None:
        here, coming = set(self.active), set[int]()
        for each in sorted(self.transitions, key=lambda one: one.priority or 99):
            if not set(each.sources) <= here:
                continue
            if each.input:
                cleared = bool(values[each.input]) != each.negated
            else:
                cleared = self.times.get(each.sources[0], 0) >= 20
            if cleared:
                here -= set(each.sources)
                coming |= set(each.targets)
        self.active = here | coming
        for step in coming:
            self.times[step] = 0
            self.since.pop(step, None)


def chart(draws: Draws) -> tuple[Machine, list[Values]]:
    """The chart at its beginning, and what is written before each scan."""
    count = draws.integer(2, 6)
    steps: list[list[Association]] = [[] for _ in range(count)]
    for action in (*OUTPUTS, *ACTIONS):
        timed = False  # two durations in simultaneous steps are refused
        for number in draws.some(range(count), 0, min(count, 3)):
            qualifier = draws.one(QUALIFIERS)
            if qualifier in TIMED and timed:
                qualifier = "N"
            timed |= qualifier in TIMED
            steps[number].append(Association(action, qualifier, 10 * draws.integer(0, 4)))
    transitions = [
        Transition(
            draws.some(range(count), 1, 2), draws.some(range(count), 1, 2), draws.one(("", *INPUTS)),
            draws.flag(), draws.integer(0, 3),
        )
        for _ in range(draws.integer(1, 8))
    ]  # fmt: skip
    return Machine(steps, transitions), [draws.values(dict.fromkeys(INPUTS, (0, 1))) for _ in range(SCANS)]


def text_of(machine: Machine, within: bool = False) -> str:
    """The chart as the body of a program, or of an ACTION that this calls."""
    steps = "".join(
        f"{'INITIAL_' if number == 0 else ''}STEP S{number}:\n{''.join(f'  {each}' + chr(10) for each in step)}END_STEP\n"
        for number, step in enumerate(machine.steps)
    )
    used = [each for each in machine.actions() if each in ACTIONS]
    actions = "".join(
        f"ACTION {each}: n{each} := n{each} + 1; IF {each}.Q THEN q{each} := q{each} + 1; END_IF; END_ACTION\n"
        for each in used
    )
    counts = ", ".join(f"{kind}{each}" for each in ACTIONS for kind in "nq")
    lines = "\n".join(map(str, machine.transitions))
    names = ", ".join((*INPUTS, *OUTPUTS))
    own = f"Work();\n{actions}ACTION Work:\n{steps}{lines}\nEND_ACTION\n"
    body = own if within else f"{steps}{actions}{lines}\n"
    return f"PROGRAM Main\nVAR {names} : BOOL; {counts} : INT; END_VAR\n{body}END_PROGRAM\n"


def drawn(draws: Draws) -> Drawn:
    made, sets = chart(draws)
    within = draws.integer(0, 3) == 3

    def begin() -> Evaluate:
        machine = Machine(made.steps, made.transitions)
        values = dict.fromkeys((*INPUTS, *OUTPUTS, *(f"{kind}{each}" for each in ACTIONS for kind in "nq")), 0)

        def evaluate(scan: int, written: Values) -> Values:
            values.update(written)
            machine.evaluate(values, scan * SCAN_MS)
            active = {f"S{step}.X": int(step in machine.active) for step in range(len(machine.steps))}
            times = {f"S{step}.T": ms * 1_000_000 for step, ms in machine.times.items()}
            return {**values, **active, **times}

        return evaluate

    return Drawn(text_of(made, within), sets, begin)
