"""Files, classes and functions are small, and files of a room do not import each other in circles. What is not so yet is
listed with a reason; the lists only get shorter."""

import ast
from collections.abc import Callable, Iterator, Mapping
from functools import cache, partial
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[2] / "scanbench"
FRONTEND = Path(__file__).parents[3] / "frontend" / "src"
LINES, FUNCTION, METHODS = 450, 50, 30

FILES = {
    "syntax/tree.py": (567, "the nodes of the tree: a list of small dataclasses, one subject"),
    "program/program.py": (472, "the nodes of the checked program: a list of small dataclasses, one subject"),
}
CLASSES: dict[str, tuple[int, str]] = {}
FUNCTIONS: dict[str, tuple[int, str]] = {}
PAGE = {"wire/messages.gen.ts": (1_000_000, "generated")}
ROOMS = ("check", "engines/native", "runtime")
_NATIVE = ("emit_body", "emit_memory", "emit_places", "emit_strings", "flavour")
CIRCLES = {
    frozenset(f"engines/native/{each}.py" for each in _NATIVE): "what a flavour emits is said in terms of Body, which holds one; for type checkers only",
    frozenset(("runtime/command.py", "runtime/journal.py")): "a view has the journal, whose entries have commands; for type checkers only",
}  # fmt: skip
"""Files that import each other, and why."""


@pytest.fixture(autouse=True, scope="module")
def _forgotten() -> Iterator[None]:
    """A million nodes: the garbage collector would go through them in all later tests."""
    yield
    sources.cache_clear()


@cache
def sources() -> dict[str, ast.Module]:
    """The tree of each file, by its path in the package."""
    return {str(each.relative_to(PACKAGE)): ast.parse(each.read_text("utf-8")) for each in PACKAGE.rglob("*.py")}


def lines_of(folder: Path, *kinds: str) -> dict[str, int]:
    """So many lines each file has."""
    found = (each for kind in kinds for each in folder.rglob(f"*.{kind}"))
    return {str(each.relative_to(folder)): len(each.read_text("utf-8").splitlines()) for each in found}


def functions() -> dict[str, int]:
    """So many lines each function has; of those of one name in a file the longest."""
    found: dict[str, int] = {}
    for path, tree in sources().items():
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                assert node.end_lineno is not None
                key = f"{path}::{node.name}"
                found[key] = max(found.get(key, 0), node.end_lineno - node.lineno + 1)
    return found


def classes() -> dict[str, int]:
    """So many methods each class has."""
    return {
        f"{path}::{node.name}": sum(isinstance(each, ast.FunctionDef | ast.AsyncFunctionDef) for each in node.body)
        for path, tree in sources().items()
        for node in ast.walk(tree)
        if isinstance(node, ast.ClassDef)
    }


@pytest.mark.parametrize(
    ("looked", "limit", "listed"),
    [
        pytest.param(partial(lines_of, PACKAGE, "py"), LINES, FILES, id="files"),
        pytest.param(classes, METHODS, CLASSES, id="classes"),
        pytest.param(functions, FUNCTION, FUNCTIONS, id="functions"),
        pytest.param(partial(lines_of, FRONTEND, "ts", "tsx"), LINES, PAGE, id="files of the page"),
    ],
)
def test_nothing_is_too_large(
    looked: Callable[[], Mapping[str, int]], limit: int, listed: Mapping[str, tuple[int, str]]
) -> None:
    sizes = looked()
    most = {name: each for name, (each, _) in listed.items()}
    large = {name: size for name, size in sizes.items() if size > most.get(name, limit)}
    assert not large, f"larger than {limit}, or than it was: cut it by what changes together"
    small = [name for name in listed if sizes.get(name, 0) <= limit]
    assert not small, "small enough, or gone: take it off the list"


def imports(path: str, tree: ast.Module) -> Iterator[str]:
    """Files of the package that a file imports, wherever in it."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module is not None and node.module.startswith("scanbench"):
            parts = node.module.split(".")[1:]
            yield from ("/".join([*parts, each.name]) + ".py" for each in node.names)
            yield "/".join(parts) + ".py"


def circles(room: str) -> set[frozenset[str]]:
    """Files of a room that reach each other."""
    edges = {path: {*imports(path, tree)} for path, tree in sources().items() if path.startswith(f"{room}/")}
    reached = {path: _reached(path, edges) for path in edges}
    together = (frozenset(other for other in reached[path] if path in reached[other]) for path in edges)
    return {each for each in together if len(each) > 1}


def _reached(path: str, edges: Mapping[str, set[str]]) -> set[str]:
    found, ahead = set[str](), [path]
    while ahead:
        for each in edges[ahead.pop()] & edges.keys() - found:
            found.add(each)
            ahead.append(each)
    return found


def test_files_of_a_room_do_not_import_each_other_in_circles() -> None:
    found = {each for room in ROOMS for each in circles(room)}
    assert found == set(CIRCLES), "a new circle, or one less"
