"""Operators and types that do not go together: the conversion that the message names is enough."""

import re

from scanbench.check.build import check_sources
from tests.caseformat import MODELS

TYPES = "BOOL SINT INT DINT LINT USINT UINT UDINT ULINT BYTE WORD DWORD LWORD REAL LREAL TIME STRING".split()
OPERATORS = ["+", "*", "MOD", "AND", ">", "="]


def _refused(statements: list[str]) -> dict[int, str]:
    """The messages of expressions that are refused, by their number."""
    variables = "".join(f"v{name} : {name};\n" for name in TYPES)
    head = f"PROGRAM Main\nVAR\n{variables}n : ULINT; END_VAR\n"
    body = "".join(f"IF {each} = {each} THEN n := 1; END_IF\n" for each in statements)
    problems = check_sources({"a.st": f"{head}{body}END_PROGRAM\n"}, MODELS["GENERIC-IEC"]).problems
    first = head.count("\n") + 1
    return {each.span.line - first: each.message for each in problems if each.code == "T002"}


def test_what_a_message_advises_compiles() -> None:
    pairs = [(op, a, b) for op in OPERATORS for a in TYPES for b in TYPES]
    refused = _refused([f"(v{a} {op} v{b})" for op, a, b in pairs])
    followed = []
    for number, message in refused.items():
        op, a, b = pairs[number]
        advice = re.search(r"Convert it with (\w+?)_TO_(\w+)\.", message)
        if advice is None or "cannot join" not in message:
            continue
        source, call = advice[1], advice[0].removeprefix("Convert it with ").rstrip(".")
        assert source in (a, b)
        left, right = (f"v{a}", f"{call}(v{b})") if source == b else (f"{call}(v{a})", f"v{b}")
        followed.append(f"({left} {op} {right})")
    assert len(followed) > 100
    again = _refused(followed)
    assert not [(followed[number], message) for number, message in again.items()]
