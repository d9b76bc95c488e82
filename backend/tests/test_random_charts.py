"""Random sequential function charts: both engines leave the same bytes, and what the rules of the standard give, followed one by one."""

from dataclasses import dataclass, field

from hypothesis import given, settings
from hypothesis import strategies as st

from scanbench.syntax.chart import TIMED
from tests.amounts import amount
from tests.batches import Drawn, collect

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


@st.composite
def charts(draw: st.DrawFn) -> tuple[Machine, list[dict[str, int]]]:
    count = draw(st.integers(2, 6))
    steps: list[list[Association]] = [[] for _ in range(count)]
    for action in (*OUTPUTS, *ACTIONS):
        timed = False  # two durations in simultaneous steps are refused
        for number in draw(st.lists(st.integers(0, count - 1), unique=True, max_size=3)):
            qualifier = draw(st.sampled_from(QUALIFIERS))
            if qualifier in TIMED and timed:
                qualifier = "N"
            timed |= qualifier in TIMED
            steps[number].append(Association(action, qualifier, 10 * draw(st.integers(0, 4))))
    some = st.lists(st.integers(0, count - 1), min_size=1, max_size=2, unique=True)
    transitions = [
        Transition(
            draw(some), draw(some), draw(st.sampled_from(("", *INPUTS))), draw(st.booleans()), draw(st.integers(0, 3))
        )
        for _ in range(draw(st.integers(1, 8)))
    ]
    inputs = st.fixed_dictionaries({}, optional={name: st.integers(0, 1) for name in INPUTS})
    return Machine(steps, transitions), draw(st.lists(inputs, min_size=SCANS, max_size=SCANS))


def text_of(machine: Machine) -> str:
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
    return f"PROGRAM Main\nVAR {names} : BOOL; {counts} : INT; END_VAR\n{steps}{actions}{lines}\nEND_PROGRAM\n"


def drawn(made: tuple[Machine, list[dict[str, int]]]) -> Drawn:
    machine, sets = made
    values = dict.fromkeys((*INPUTS, *OUTPUTS, *(f"{kind}{each}" for each in ACTIONS for kind in "nq")), 0)

    def expected(scan: int) -> dict[str, str]:
        values.update(sets[scan])
        machine.evaluate(values, scan * SCAN_MS)
        wanted = {
            name: str(bool(value)).upper() if name in (*INPUTS, *OUTPUTS) else str(value)
            for name, value in values.items()
        }
        wanted |= {f"S{step}.X": str(step in machine.active).upper() for step in range(len(machine.steps))}
        return wanted | {f"S{step}.T": f"T#{ms}ms" if ms else "T#0s" for step, ms in machine.times.items()}

    written = [{name: str(bool(value)).upper() for name, value in each.items()} for each in sets]
    return Drawn(text_of(machine), written, expected)


BATCH: list[Drawn] = []


@settings(max_examples=amount(1000, 15), deadline=None)
@given(charts())
def test_the_engines_and_the_rules_agree(made: tuple[Machine, list[dict[str, int]]]) -> None:
    collect(BATCH, drawn(made))
