"""Text -> raising an error, or a fault with a shape in time.

battery-error                                    raised
battery-error for 5                              and recovered 5 scans later
battery-error every 100 on 10 times 3 seed 7     present for 10 of every 100 scans, three times, varied by chance 7
battery-error chatter times 4                    on and off in turn
battery-error chance 0.5% on 3 seed 7            in each scan with this probability, present for 3 scans
battery-error for 9 unless Main.ack              recovered after 9 scans, or when it is acknowledged before
battery-error when Main.n > 3                    begins when this holds; `when main.st:12`: when that line is reached
battery-error while basic-io-error               begins as soon as the other one is present (its flag is on)
battery-error + io-bus-error:rack=1 gap 3        one 3 scans after the other; without a gap in one seam
"""

import re
from dataclasses import replace

from scanbench.check.typed.condition import BadCondition, compile_condition
from scanbench.faults.arm import Arm
from scanbench.faults.inject import Generate
from scanbench.faults.lines import find_line
from scanbench.faults.reference import ErrorRef, parse_reference
from scanbench.faults.shapes import Shape, Start, Wanted
from scanbench.program.program import Program
from scanbench.runtime.command import Command, Refusal
from scanbench.testing.said import with_near

_LINE = re.compile(r"(\S.*\.\w+):(\d+)")
_WORDS = ("for", "every", "on", "times", "seed", "gap", "chance")
_PERCENT = re.compile(r"(\d{1,3})(?:\.(\d{1,4}))?%")
_HOW = "write e.g. `battery-error for 5`, `battery-error every 100 on 10 times 3 seed 7`, `battery-error chance 0.5%`, `battery-error when Main.n > 3`"


class BadCommand(Exception):
    """A text that is no command; the message says why, and what to write."""


def read_raise(program: Program, author: str, text: str) -> Command:
    """The command; `BadCommand`."""
    body, when = _cut(text, "when")
    body, other = _cut(body, "while")
    if other is not None:
        when = _present(program, other, when)
    body, unless = _cut(body, "unless")
    references, words = _shape_words(body)
    errors = tuple(read_error(program, each) for each in references.split(" + "))
    if not words and when is None and unless is None:
        return Generate(author, errors)
    numbers, chatter = _numbers(words)
    wanted = Wanted(errors, _start(when), _shape(numbers, chatter, unless), numbers.get("gap", 0))
    _must_mean_something(program, wanted)
    return Arm(author, wanted)


def read_error(program: Program, reference: str) -> ErrorRef:
    """An error of the model, with details: `io-bus-error:rack=1`; `BadCommand`."""
    error = parse_reference(program.layout.model, reference)
    if isinstance(error, Refusal):
        raise BadCommand(with_near(error.message, error.near))
    return error


def _present(program: Program, other: str, when: str | None) -> str:
    """The condition that an error is present."""
    if when is not None:
        raise BadCommand("`while` and `when` both say when it begins: leave one out")
    entry = program.layout.model.error(read_error(program, other).id)
    assert entry is not None
    return entry.flag_text


def _must_mean_something(program: Program, wanted: Wanted) -> None:
    """Before anything runs: the program is there already, and names and lines can be looked up in it."""
    start = wanted.start
    for condition in filter(None, (start.condition, wanted.shape.acknowledge)):
        bad = compile_condition(program, condition)
        if isinstance(bad, BadCondition):
            raise BadCommand(f"`{condition}`: {with_near(bad.message, bad.near)}")
    if start.kind == "line":
        found = find_line(program, start.file, start.line)
        if isinstance(found, Refusal):
            raise BadCommand(found.message)


def _cut(text: str, word: str) -> tuple[str, str | None]:
    """What comes before a word, and after it; None where the word is missing."""
    parts = re.split(rf"\s{word}\s", f" {text} ", maxsplit=1)
    return parts[0].strip(), parts[1].strip() if len(parts) > 1 else None


def _shape_words(body: str) -> tuple[str, list[str]]:
    """The references, and the words after them."""
    found = re.search(rf"\s({'|'.join((*_WORDS, 'chatter'))})(\s|$)", body)
    return (body, []) if found is None else (body[: found.start()], body[found.start() :].split())


def _numbers(words: list[str]) -> tuple[dict[str, int], bool]:
    """The number after each word; whether it chatters."""
    left = [word for word in words if word != "chatter"]
    numbers: dict[str, int] = {}
    for word, number in zip(left[::2], [*left[1::2], ""][: len(left[::2])], strict=True):
        percent = _PERCENT.fullmatch(number) if word == "chance" else None
        if word not in _WORDS or word in numbers or (percent is None and (word == "chance" or not number.isdecimal())):
            raise BadCommand(f"`{f'{word} {number}'.strip()}` is not understood; {_HOW}")
        numbers[word] = int(number) if percent is None else int(percent[1] + (percent[2] or "").ljust(4, "0"))
    return numbers, len(left) < len(words)


def _shape(numbers: dict[str, int], chatter: bool, unless: str | None) -> Shape:
    given = numbers.keys() - {"gap"}
    times, seed = numbers.get("times"), numbers.get("seed")
    if chatter and given <= {"times"}:
        shape = Shape("chatter", times=times)
    elif not chatter and given == {"for"}:
        shape = Shape("for", numbers["for"])
    elif not chatter and {"every"} <= given <= {"every", "on", "times", "seed"}:
        shape = Shape("intermittent", numbers.get("on", 1), numbers["every"], times, seed)
    elif not chatter and {"chance"} <= given <= {"chance", "on", "times", "seed"}:
        shape = Shape("chance", numbers.get("on", 1), times=times, seed=seed, per_million=numbers["chance"])
    elif not chatter and not given:
        shape = Shape()
    else:
        words = [*sorted(given), *(["chatter"] if chatter else [])]
        raise BadCommand(f"{' and '.join(words)} {'do' if len(words) > 1 else 'does'} not make a shape; {_HOW}")
    if unless is None:
        return shape
    if shape.kind != "for":
        raise BadCommand("`unless` goes with `for`: say after how many scans it goes by itself")
    return replace(shape, kind="unacknowledged", acknowledge=unless)


def _start(when: str | None) -> Start:
    if when is None:
        return Start()
    line = _LINE.fullmatch(when)
    return Start("condition", condition=when) if line is None else Start("line", file=line[1], line=int(line[2]))
