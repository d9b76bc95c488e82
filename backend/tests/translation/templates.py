"""The sentences of the source: every string and every f-string that people could be told, as a template with `{0}`, `{1}` for what is put into it."""

import ast
import re
from collections.abc import Iterator
from itertools import count
from pathlib import Path

import scanbench

ROOT = Path(scanbench.__file__).parent
NOT_READ = (
    "translation", "engines", "cli", "reports", "client.py", "testing", "history/scenario.py", "history/scenario_steps.py", "symbols/whole.py", "syntax/plcopen/chart.py", "syntax/plcopen/declarations.py", "syntax/plcopen/diagram.py",
    "syntax/plcopen/ladder.py", "syntax/plcopen/project.py", "syntax/l5x/declarations.py", "syntax/l5x/ladder.py", "syntax/l5x/project.py", "syntax/l5x/stubs.py", "server/twincat_tasks.py", "store/migrations", "store/__main__.py", "store/claim.py", "check/system/instruction_text.py",
    "check/system/system_text.py", "check/standard/functions.py", "check/placeholders/placeholders.py", "check/placeholders/texts.py", "host/forking.py", "host/zygote.py", "host/host.py", "web/pages.py", "web/serve.py", "web/operations.py", "web/openapi.py", "web/built_files.py",
    "web/headers.py", "web/claim.py", "web/public_url.py", "jobs/checker.py", "plcmodel/write_catalogue.py",
)  # fmt: skip
"""What says nothing to a reader of the page or of an editor: code, printed reports, the command line, what is told before there is a server."""
_SENTENCE = re.compile(
    r"[A-Za-z]{2,}[,;:.]? (?:[a-z]{2,}|`|\{)|(?:`|\}|\)) [a-z]{2,}|^ ?[a-z]{2,} \{|^[;,] |^[a-z]{3,} $|^ [a-z]{3,}$"
)
_LOGS = {"debug", "info", "warning", "error", "exception", "critical"}
_CODE = re.compile(r"\bSELECT\b|PRAGMA|END_VAR|filename=|\(\.\*\)|\\w|Callable\[|text/(?:csv|html)|tuple\[")


def template(node: ast.expr) -> str | None:
    """The text of a string or an f-string."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return _braces(node.value)
    if not isinstance(node, ast.JoinedStr):
        return None
    said, number = "", 0
    for part in node.values:
        if isinstance(part, ast.Constant):
            said += _braces(str(part.value))
        else:
            said += f"{{{number}}}"
            number += 1
    return said


def _braces(text: str) -> str:
    return text.replace("{", "{{").replace("}", "}}")


def sentences() -> dict[str, str]:
    """Template without the spaces around it -> where it is: file and line."""
    found: dict[str, str] = {}
    for path in sorted(ROOT.rglob("*.py")):
        name = path.relative_to(ROOT).as_posix()
        if name.startswith(NOT_READ):
            continue
        tree = ast.parse(path.read_text("utf-8"))
        left_out = set(_left_out(tree))
        for node in ast.walk(tree):
            if isinstance(node, ast.expr) and id(node) not in left_out:
                said = template(node)
                if said and _SENTENCE.search(said) and not _CODE.search(said):
                    for line in said.strip().split("\n"):
                        found.setdefault(_renumbered(line.strip()), f"{name}:{node.lineno}")
    return found


def _renumbered(line: str) -> str:
    """A line of a template as a template of its own."""
    numbers = count()
    return re.sub(r"(?<!\{)\{\d+\}(?!\})", lambda _: f"{{{next(numbers)}}}", line)


def _left_out(tree: ast.Module) -> Iterator[int]:
    """Nodes that are no sentences: docstrings, annotations, descriptions of fields, the log of the server, parts of an f-string."""
    for node in ast.walk(tree):
        parts: list[ast.AST] = []
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            parts = [node.value]
        elif isinstance(node, ast.JoinedStr):
            yield from (id(part) for part in node.values if isinstance(part, ast.Constant))
        elif isinstance(node, ast.keyword) and node.arg in ("description", "title", "pattern"):
            parts = list(ast.walk(node.value))
        elif isinstance(node, ast.Assert) and node.msg is not None:
            parts = list(ast.walk(node.msg))
        elif isinstance(node, ast.Call) and _is_silent(node):
            parts = [each for arg in node.args for each in ast.walk(arg)]
        elif isinstance(node, ast.AnnAssign | ast.arg) and node.annotation is not None:
            parts = list(ast.walk(node.annotation))
        yield from map(id, parts)


def _is_silent(call: ast.Call) -> bool:
    function = call.func
    if isinstance(function, ast.Name):
        return function.id in ("AssertionError", "cast", "TypeVar", "NewType")
    return (
        isinstance(function, ast.Attribute)
        and isinstance(function.value, ast.Name)
        and (
            (function.attr in _LOGS and function.value.id.lower().strip("_") in ("log", "logger", "logging"))
            or function.value.id == "re"
        )
    )
