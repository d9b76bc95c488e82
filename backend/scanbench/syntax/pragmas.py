"""Pragmas that mean something; all others are comments.

`{in_out 'value'}` before a FUNCTION_BLOCK or in its head; `{subrange 'trap'}` before the declaration of a variable, a type or a POU; `{stub}` in a POU; `{external}` or `@EXTERNAL` before one; `{attribute 'call_after_init'}` before a METHOD.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, get_args

CONVENTIONS = ("reference", "value")
_IN_OUT = re.compile(r"\{\s*in_out\b\s*(?::=|=)?\s*(.*?)\s*\}", re.IGNORECASE | re.DOTALL)
PolicyName = Literal["limit", "hold", "trap", "report", "off"]
POLICIES: tuple[PolicyName, ...] = get_args(PolicyName)
_SUBRANGE = re.compile(r"\{\s*subrange\b\s*(?::=|=)?\s*(.*?)\s*\}", re.IGNORECASE | re.DOTALL)
_STUB = re.compile(r"\{\s*stub\s*\}", re.IGNORECASE)

_EXTERNAL = re.compile(r"\{\s*external\s*\}|@external", re.IGNORECASE)
_AFTER_INIT = re.compile(r"\{\s*attribute\s+'call_after_init'\s*\}", re.IGNORECASE)
CALL_AFTER_INIT = "CALL_AFTER_INIT"
"""Modifier of a method that runs when its instance is initialised."""


@dataclass(frozen=True, slots=True)
class InOutPragma:
    """How a block takes its in-outs, as it was written."""

    start: int
    end: int
    said: str

    @property
    def convention(self) -> str:
        """`reference` or `value`; empty when it says neither."""
        text = self.said.strip("'\"").lower()
        return text if text in CONVENTIONS and self.said[:1] in "'\"" else ""


@dataclass(frozen=True, slots=True)
class SubrangePragma:
    """What becomes of a value outside of its subrange, as it was written."""

    start: int
    end: int
    said: str

    @property
    def policy(self) -> str:
        """One of `POLICIES`; empty when it says none."""
        text = self.said.strip("'\"").lower()
        return text if text in POLICIES and self.said[:1] in "'\"" else ""


def in_out_pragmas(pragmas: Iterable[tuple[int, str]]) -> list[InOutPragma]:
    """Those of a text that are about in-outs."""
    found = ((at, text, _IN_OUT.fullmatch(text)) for at, text in pragmas)
    return [InOutPragma(at, at + len(text), match.group(1)) for at, text, match in found if match]


def subrange_policies(pragmas: Iterable[tuple[int, str]]) -> list[SubrangePragma]:
    """Those of a text that say what becomes of a value outside of its subrange."""
    found = ((at, text, _SUBRANGE.fullmatch(text)) for at, text in pragmas)
    return [SubrangePragma(at, at + len(text), match.group(1)) for at, text, match in found if match]


def has_stub_pragma(pragmas: Iterable[tuple[int, str]], start: int, end: int) -> bool:
    """Whether the POU between these positions is a stub."""
    return any(start <= at < end and _STUB.fullmatch(text) for at, text in pragmas)


def is_external(pragmas: Iterable[tuple[int, str]], start: int, end: int) -> bool:
    """Whether one between these positions says that a body is in another language."""
    return any(start <= at < end and _EXTERNAL.fullmatch(text) for at, text in pragmas)


def after_init(pragmas: Iterable[tuple[int, str]], start: int, end: int) -> bool:
    """Whether one between these positions says that a method runs when its instance is initialised."""
    return any(start <= at < end and _AFTER_INIT.fullmatch(text) for at, text in pragmas)
