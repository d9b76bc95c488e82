"""Warnings that a file has by the hundred: of each rule of the standard that a dialect does not have, the first uses are told."""

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

from scanbench.problems import Problem

TOLD = 5
"""Uses of what a dialect allows that are told in a file, of each rule."""
CODE = "W006"
_STRICT = re.compile(r" allows this; in IEC 61131-3 (.*?)\. The")


def folded(problems: Sequence[Problem]) -> list[Problem]:
    """The problems; of a rule that a file has more often, the next place says how often."""
    rules = [_rule(each) for each in problems]
    counts, told = Counter(rules), Counter[tuple[str, str]]()
    made = []
    for each, rule in zip(problems, rules, strict=True):
        told[rule] += 1
        if not rule[1] or told[rule] <= TOLD:
            made.append(each)
        elif told[rule] == TOLD + 1:
            more = counts[rule] - TOLD
            places = "1 more place" if more == 1 else f"{more} more places"
            said = f"The same in {places} of this file, from here on: in IEC 61131-3 {rule[1]}."
            made.append(replace(each, message=said))
    return made


def _rule(problem: Problem) -> tuple[str, str]:
    """The file, and what the standard says; nothing of a problem that is of no such rule, and is always told."""
    said = _STRICT.search(problem.message) if problem.code == CODE else None
    return problem.span.file, said[1] if said else ""
