"""A failing scenario with the fewest steps that still fails in the same way.

Delta debugging (Zeller and Hildebrandt, *Simplifying and Isolating Failure-Inducing Input*, 2002): parts of the steps are left out, large ones
first, until none of those that are left can be left out alone.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

from scanbench.history.scenario import Scenario, Step
from scanbench.testing.play import Failed

Try = Callable[[Scenario], Failed | None]
"""Plays a scenario from a cold start."""


def shrink(scenario: Scenario, failed: Failed, attempt: Try) -> Scenario:
    """The shorter scenario. It ends where it fails, and its steps are a part of those that were there."""
    ends = max(failed.scan, max((each.last for each in scenario.expect if str(each) == failed.what), default=0))
    short = replace(
        scenario, scans=min(scenario.scans, ends), expect=tuple(each for each in scenario.expect if str(each) == failed.what),
        steps=tuple(step for step in scenario.steps if step.at <= ends),
    )  # fmt: skip

    def fails(steps: Sequence[Step]) -> bool:
        found = attempt(short.with_steps(steps))
        return found is not None and found.what == failed.what

    if not fails(short.steps):  # it needed more than it seems
        return scenario
    return short.with_steps(_fewest(list(short.steps), fails))


def _fewest(steps: list[Step], fails: Callable[[Sequence[Step]], bool]) -> list[Step]:
    parts = 2
    while len(steps) > 1:
        size = -(-len(steps) // parts)
        chunks = [steps[at : at + size] for at in range(0, len(steps), size)]
        for at, chunk in enumerate(chunks):
            rest = [step for other in chunks[:at] + chunks[at + 1 :] for step in other]
            if len(chunks) > 2 and fails(chunk):  # of two, the one is what the other leaves
                steps, parts = chunk, 2
                break
            if fails(rest):
                steps, parts = rest, max(parts - 1, 2)
                break
        else:
            if parts >= len(steps):
                return steps
            parts = min(len(steps), 2 * parts)
    return [] if steps and fails(()) else steps
