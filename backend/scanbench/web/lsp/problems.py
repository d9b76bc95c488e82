"""Problems of the checks as diagnostics."""

from lsprotocol import types

from scanbench.language.reading import Reading
from scanbench.problems import Problem, Severity
from scanbench.web.lsp.positions import Positions

SOURCE = "scanbench"


def diagnostics(reading: Reading, positions: Positions) -> dict[str, list[types.Diagnostic]]:
    """By file of the project."""
    found: dict[str, list[types.Diagnostic]] = {}
    for problem in reading.checked.problems:
        if problem.span.file in reading.files:
            found.setdefault(problem.span.file, []).append(_diagnostic(problem, positions))
    return found


def _diagnostic(problem: Problem, positions: Positions) -> types.Diagnostic:
    error = problem.severity is Severity.ERROR
    return types.Diagnostic(
        range=positions.span(problem.span),
        message=problem.message,
        severity=types.DiagnosticSeverity.Error if error else types.DiagnosticSeverity.Warning,
        code=problem.code,
        source=SOURCE,
        tags=[types.DiagnosticTag.Unnecessary] if problem.code in ("W001", "W007") else None,
    )
