"""Warnings that a file has by the hundred: of each rule of the standard that a dialect does not have, the first uses are told."""

import re
from collections.abc import Sequence
from dataclasses import replace

from scanbench.problems import Problem

TOLD = 5
"""Uses of what a dialect allows that are told in a file, of each rule."""
CODE = "W006"
_STRICT = re.compile(r"in IEC 61131-3 (.*?)\. ")


def folded(problems: Sequence[Problem]) -> list[Problem]:
    """The problems, of which the last one told of a rule says how many more places the file has."""
    counts: dict[tuple[str, str], int] = {}
    for each in problems:
        if each.code == CODE:
            counts[_rule(each)] = counts.get(_rule(each), 0) + 1
    if all(count <= TOLD for count in counts.values()):
        return list(problems)
    told: dict[tuple[str, str], int] = {}
    made = []
    for each in problems:
        if each.code == CODE:
            rule = _rule(each)
            told[rule] = told.get(rule, 0) + 1
            more = counts[rule] - TOLD
            if told[rule] > TOLD:
                continue
            if told[rule] == TOLD and more > 0:
                places = "at 1 more place" if more == 1 else f"at {more} more places"
                rest = f" The same rule is not kept {places} in this file."
                each = replace(each, message=each.message + rest)
        made.append(each)
    return made


def _rule(problem: Problem) -> tuple[str, str]:
    """The file, and what the standard says: the rest of the message is about the place."""
    said = _STRICT.search(problem.message)
    return problem.span.file, said[1] if said else ""
