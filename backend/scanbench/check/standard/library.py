"""The library's upper half: what the `.st` files in this folder declare, for every type that the standard names."""

import re
from collections.abc import Iterator
from functools import cache
from importlib.resources import files

from scanbench.check.dialect import Allowance, Dialect
from scanbench.program.origin import LIBRARY_FOLDER
from scanbench.syntax import tree
from scanbench.syntax.parse_st import parse_st
from scanbench.syntax.source import Source

FILES = ("timers", "counters", "bistable", "strings", "bits", "dates", "text_of_times", "clock", "charts")
COUNTED = {
    "INT": (-(1 << 15), (1 << 15) - 1),
    "DINT": (-(1 << 31), (1 << 31) - 1),
    "LINT": (-(1 << 63), (1 << 63) - 1),
    "UDINT": (0, (1 << 32) - 1),
    "ULINT": (0, (1 << 64) - 1),
}
"""Types of counters, and their bounds; `counters.st` has them for INT."""
WORD_COUNTERS = {
    "INT": "WORD",
    "-32768": "0",
    "32767": "16#FFFF",
    "CV + 1": "UINT_TO_WORD(WORD_TO_UINT(CV) + 1)",
    "CV - 1": "UINT_TO_WORD(WORD_TO_UINT(CV) - 1)",
}
"""What CTU, CTD and CTUD have instead in CODESYS and TwinCAT: https://content.helpme-codesys.com/en/libs/Standard/Current/Counter/CTUD.html,
https://infosys.beckhoff.com/content/1033/tcplclib_tc2_standard/74398987.html. The text is strict, as in every dialect."""
WHOLE_SECONDS = "ADD_DT_TIME(preset, TIME() - start)", "UDINT_TO_DT(DT_TO_UDINT(ADD_DT_TIME(preset, TIME() - start)))"
"""What RTC has there, and instead where a DT has no less."""
WORD = re.compile(r"-32768|CV [+-] 1\b|\w+(?:#\w+)?")


def library_of(dialect: Dialect) -> tuple[tree.File, ...]:
    """What the standard library has in a dialect."""
    return library(Allowance.WORD_COUNTERS in dialect.allows, Allowance.SHORT_TIMES in dialect.allows)


@cache
def library(words: bool = False, seconds: bool = False) -> tuple[tree.File, ...]:
    """The standard library's ST files, parsed; CTU, CTD and CTUD count in WORD, or in INT as the standard says; a DT has whole seconds."""
    return tuple(_parsed(path, text.replace(*WHOLE_SECONDS) if seconds else text) for path, text in _texts(words))


@cache
def _parsed(path: str, text: str) -> tree.File:
    file, problems = parse_st(Source(path, text))
    assert not problems, problems
    return file


def _texts(words: bool) -> Iterator[tuple[str, str]]:
    """Path and text of each file; a file written for several types comes once for each, with the same line numbers."""
    for name in FILES:
        path = f"{LIBRARY_FOLDER}{name}.st"
        text = files("scanbench.check").joinpath(f"standard/{name}.st").read_text("utf-8")
        yield path, _replaced(text, WORD_COUNTERS) if words and name == "counters" else text
        if name == "counters":
            for type, (low, high) in COUNTED.items():
                yield path, _replaced(text, _suffixed(type) | {"INT": type, "-32768": str(low), "32767": str(high)})
        if name == "timers":
            yield path, _replaced(text, {each: f"{each}_TIME" for each in ("TON", "TOF", "TP")})
            long = {"TIME": "LTIME", "T#0s": "LTIME#0s"}
            yield path, _replaced(text, long | {each: f"{each}_LTIME" for each in ("TON", "TOF", "TP")})
            yield path, _replaced(text, long | {each: f"L{each}" for each in ("TON", "TOF", "TP")})


def _suffixed(type: str) -> dict[str, str]:
    return {name: f"{name}_{type}" for name in ("CTU", "CTD", "CTUD")}


def _replaced(text: str, words: dict[str, str]) -> str:
    return WORD.sub(lambda match: words.get(match.group(), match.group()), text)
