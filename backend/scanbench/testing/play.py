"""Plays a scenario on a PLC: its steps, and whether what it expects holds."""

from dataclasses import dataclass

from scanbench.check.typed.condition import Condition
from scanbench.history.scenario import Expectation, Scenario, Step
from scanbench.testing.command_text import read_command
from scanbench.testing.plc import NO_VALUE, Plc, PlcFailure, PlcRefused, untested
from scanbench.testing.raising import BadCommand
from scanbench.testing.said import with_near


@dataclass(frozen=True, slots=True)
class Failed:
    """The first thing that was not as it is to be."""

    what: str
    """`trap`, `refused: ...` or the expectation: the same failure of a shorter scenario has the same."""
    scan: int
    message: str


def play(plc: Plc, scenario: Scenario) -> Failed | None:
    """From the PLC's cold start. None: all of it was as expected."""
    player = _Player(plc, scenario)
    while True:
        failed = player.seam()
        if failed is not None or plc.scan >= scenario.scans:
            return failed
        failed = player.advance()
        if failed is not None:
            return failed


def nothing_expected(scenario: Scenario) -> str:
    """What is to be said of a scenario that went through and has no expectation: there is nothing that it was looked at for."""
    return f"nothing is expected: {scenario.scans} scans went by without a trap; write what is to hold below `expect:`"


class _Player:
    def __init__(self, plc: Plc, scenario: Scenario) -> None:
        self._plc, self._scenario = plc, scenario
        self._steps = list(scenario.steps)
        self._open = list(scenario.expect)
        self._begun: dict[Expectation, int] = {}
        """In how many scans the program had run when this began to be expected."""

    def seam(self) -> Failed | None:
        """What is expected after the scan that ran last, then what comes before the next one."""
        return self._look() or self._enter()

    def advance(self) -> Failed | None:
        """Runs until something could be different."""
        now = self._plc.scan
        bounds = (
            [step.at for step in self._steps] + [each.last for each in self._open] + [each.first for each in self._open]
        )
        end = min([self._scenario.scans, *(each for each in bounds if each > now)])
        try:
            self._plc.run_to_one([self._interesting(each) for each in self._open if each.first <= now], end - now)
        except PlcFailure as failure:
            return Failed("trap", self._plc.scan, str(failure))
        return None

    def _look(self) -> Failed | None:
        now = self._plc.scan
        for each in [each for each in self._open if each.first <= now]:
            begin = self._begun.setdefault(each, self._plc.ran)
            try:
                held = self._plc.truth(each.condition)
            except PlcRefused as refused:
                return Failed(f"refused: {each}", now, str(refused))
            is_right = held if each.kind == "holds" else held == (each.kind == "always")
            watched = now >= each.last if each.kind == "holds" else now > each.first
            if watched and not is_right:
                word = NO_VALUE if held is None else "holds" if held else "does not hold"
                said = f"`{each.condition}` {word} after {now} scans"
                return Failed(str(each), now, self._plc.told(said, each.condition))
            if each.kind != "holds" and now >= each.last and self._plc.ran == begin:
                return Failed(str(each), now, untested(each.condition, each.first, now))
            if now >= each.last or (each.kind == "holds" and held):
                self._open.remove(each)
        return None

    def _interesting(self, each: Expectation) -> Condition:
        """When the PLC has to be looked at."""
        if each.kind == "holds":
            return self._plc.condition(each.condition)
        wrong = f"NOT ({each.condition})" if each.kind == "always" else each.condition
        return self._plc.condition(wrong, unknown=True)

    def _enter(self) -> Failed | None:
        while self._steps and self._steps[0].at <= self._plc.scan:
            step = self._steps.pop(0)
            why = _entered(self._plc, step)
            if why:
                return Failed(
                    f"refused: {step.do}", self._plc.scan, f"`{step.do}` before scan {step.at} is refused: {why}"
                )
        return None


def _entered(plc: Plc, step: Step) -> str:
    """Why a step was not taken; empty: it was."""
    verb, _, text = step.do.partition(" ")
    try:
        plc.submit(read_command(plc.program, verb, text))
    except BadCommand as error:
        return str(error)
    except PlcRefused as error:
        return with_near(str(error), ())
    return ""
