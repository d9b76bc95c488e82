"""A test that compares more by night is marked, so that `make nightly` runs it."""

import ast
from collections.abc import Iterator
from pathlib import Path

TESTS = Path(__file__).parents[1]
NIGHT = {"nightly", "slow", "given", "settings"}
"""Marks; what hypothesis makes marks itself."""
MORE = {"amount", "some"}


def names_in(*nodes: ast.AST) -> set[str]:
    """All names and attributes below."""
    found: set[str] = set()
    for each in (each for node in nodes for each in ast.walk(node)):
        if isinstance(each, ast.Name):
            found.add(each.id)
        elif isinstance(each, ast.Attribute):
            found.add(each.attr)
    return found


def unmarked(tree: ast.Module) -> Iterator[str]:
    """Tests of a file that compare more by night, themselves or by what they use of the file, and have no mark."""
    used: dict[str, set[str]] = {}
    marked, more = set[str](), set[str]()
    for node in tree.body:
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            used[node.name] = names_in(*node.body, node.args, *node.decorator_list)
            if names_in(*node.decorator_list) & NIGHT:
                marked.add(node.name)
        elif isinstance(node, ast.ClassDef):
            used[node.name] = names_in(node)
        elif isinstance(node, ast.Assign):
            used |= {name: names_in(node.value) for name in names_in(*node.targets)}
        elif isinstance(node, ast.ImportFrom) and node.module == "tests.amounts":
            more |= MORE & {each.name for each in node.names}
    if used.get("pytestmark", set()) & NIGHT:
        return
    while added := {name for name, uses in used.items() if uses & more} - more:
        more |= added
    parameters = {name for name, uses in used.items() if uses & NIGHT}
    yield from sorted(
        name for name in more - marked if name.startswith("test_") and not used[name] & parameters - marked
    )


def test_what_compares_more_by_night_runs_by_night() -> None:
    left = []
    for path in sorted(TESTS.rglob("test_*.py")):
        text = path.read_text("utf-8")
        if path != Path(__file__) and "tests.amounts" in text:
            left += [f"{path.relative_to(TESTS)}::{name}" for name in unmarked(ast.parse(text))]
    assert left == [], "mark these with `nightly` of tests/amounts.py"


def test_a_test_without_a_mark_is_found() -> None:
    text = "from tests.amounts import amount\nN = amount(9, 1)\ndef each(): return N\ndef test_it(): each()\n"
    assert list(unmarked(ast.parse(text))) == ["test_it"]
    assert not list(unmarked(ast.parse(text.replace("def test_it", "@nightly\ndef test_it"))))
