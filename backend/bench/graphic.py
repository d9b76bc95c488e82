"""`python -m bench graphic`: 500 rungs of 12 elements, held against the same logic as expressions of ST.

Each figure is the rungs' divided by the expressions': a scan of run code, a scan of the interpreter, from text to a program that was checked, from that to
machine code, both together, and from an edit of one rung to the first scan of the new program, as the host of a PLC makes it. And what looking at a drawing costs: ms of one scan whose 6,000 elements are noted, and of one with some 50 lines in sight. Run code has nothing of
that in it: it is a scan that is run again by the debug flavour.
"""

import argparse
import json
import random
import sys
from collections.abc import Callable
from functools import partial
from statistics import median
from time import thread_time_ns

from bench.building import change
from bench.run import MODEL
from scanbench.check.build import check_sources
from scanbench.debug.flow import FlowHook
from scanbench.debug.flow_shown import FlowAsked
from scanbench.engines.engine import Engine
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.debugged import DebugBuilds
from scanbench.engines.native.engine import NativeEngine
from scanbench.host.build import Builder
from scanbench.plcmodel.load import model_named
from scanbench.program.program import Program
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource
from scanbench.wire.host import Sources

RUNGS, CONTACTS, COILS = 500, 11, 500
NAMES = [f"x{number}" for number in range(300)]
SCANS, ROUNDS = 2_000, 15
EDITS = 7
INTERVAL_NS = 1_000_000


def programs() -> tuple[str, str]:
    """The rungs, and the expressions: two branches of three contacts, and five contacts after them, for each coil."""
    chance = random.Random(18)
    rungs, lines = [], []
    for number in range(RUNGS):
        named = [(chance.choice(NAMES), chance.random() < 0.3) for _ in range(CONTACTS)]
        drawn = [f"[{'/' if negated else ''}{name}]" for name, negated in named]
        said = [f"{'NOT ' if negated else ''}{name}" for name, negated in named]
        rungs.append(
            f"RUNG\n  < {' '.join(drawn[:3])} | {' '.join(drawn[3:6])} > {' '.join(drawn[6:])} (q{number})\nEND_RUNG\n"
        )
        lines.append(
            f"q{number} := ({' AND '.join(said[:3])} OR {' AND '.join(said[3:6])}) AND {' AND '.join(said[6:])};\n"
        )
    head = f"PROGRAM Main\nVAR {', '.join(NAMES)} : BOOL; {', '.join(f'q{each}' for each in range(COILS))} : BOOL; END_VAR\n"
    return f"{head}{''.join(rungs)}END_PROGRAM\n", f"{head}{''.join(lines)}END_PROGRAM\n"


def checked(text: str) -> Program:
    program = check_sources({"main.st": text}, model_named(MODEL)).program
    assert program is not None
    return program


def made(program: Program) -> Engine:
    return NativeEngine(program, bytearray(program.initial_image))


def took(work: Callable[[], object]) -> float:
    """ms of this thread: what else runs on the machine does not count."""
    begin = thread_time_ns()
    work()
    return (thread_time_ns() - begin) / 1e6


def noted(program: Program, last: int) -> float:
    """ms of a scan in which the power at each element is noted, with the lines up to `last` in sight; the median."""
    loaded = Loaded.make(program, NativeEngine)
    resource = Resource(loaded)
    loaded.debug = DebugBuilds().engine(program, loaded.memory)

    def look() -> None:
        hook = FlowHook(resource, FlowAsked("Main", "Main", last=last))
        with resource.listening.instead(hook, hook.listen):
            resource.run(1)
        hook.over()
        assert 40 < len(hook.flow.elements) <= RUNGS * (CONTACTS + 1)

    return median(took(look) for _ in range(ROUNDS))


class Edited:
    """A PLC whose program is edited: one rung, or the line that says the same, after the other."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._builder = Builder(None)
        built = self._builder.build(self._sources(text))
        self._plc = Resource(Loaded.make(built.program, built.engine))
        self._plc.run(1)

    def running(self, number: int) -> float:
        """ms from the text, in which another rung writes another variable, to its first scan."""
        coil = number * RUNGS // EDITS
        edited = self._text.replace(f"(q{coil})", f"(q{coil + 1})").replace(f"\nq{coil} :=", f"\nq{coil + 1} :=")
        assert edited != self._text
        return change(self._builder, self._plc, self._sources(edited))

    def _sources(self, text: str) -> Sources:
        return Sources(MODEL, {"main.st": text}, INTERVAL_NS, 1)


def measured(scans: int) -> dict[str, float]:
    """Ratios, rungs to expressions, each the median of rounds that take turns; and µs a scan of the rungs."""
    texts = programs()
    both = [checked(text) for text in texts]
    native = [made(program) for program in both]
    slow: list[Engine] = [
        ReferenceEngine(program, bytearray(program.initial_image)) for program in both
    ]  # fmt: skip
    times: dict[str, list[list[float]]] = {"run code": [], "interpreter": [], "check": [], "build": []}
    plcs = [Edited(text) for text in texts]
    times["edit"] = [[plc.running(number) for plc in plcs] for number in range(EDITS)]
    for _ in range(ROUNDS):
        times["run code"].append([took(partial(each.run, scans)) for each in native])
        times["interpreter"].append([took(partial(each.run, 1)) for each in slow])
    for _ in range(3):
        times["check"].append([took(partial(checked, text)) for text in texts])
        times["build"].append([took(partial(made, program)) for program in both])
    times["together"] = [
        [one + two for one, two in zip(*each, strict=True)] for each in zip(times["check"], times["build"], strict=True)
    ]
    found = {name: median(rungs / lines for rungs, lines in pairs) for name, pairs in times.items()}
    found["edit, ms"] = median(pair[0] for pair in times["edit"])
    found["noted, ms"], found["in sight, ms"] = (noted(both[0], last) for last in (1 << 30, 50))
    found["us a scan"] = median(pair[0] for pair in times["run code"]) * 1000 / scans
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scans", type=int, default=SCANS)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    given = parser.parse_args()
    found = measured(given.scans)
    lines = [json.dumps(found)] if given.json else [f"{name:<12} {value:8.2f}" for name, value in found.items()]
    sys.stdout.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
