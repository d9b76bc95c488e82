"""One word for one thing: what the glossary does not want is written nowhere that people read."""

import ast
import io
import re
import tokenize
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest
import typer.main
from typer.core import TyperCommand, TyperGroup

from scanbench.cli.commands import app
from scanbench.problems import TABLE

ROOT = Path(__file__).parents[3]
GLOSSARY = ROOT / "docs" / "glossary.md"
GENERATED = ("features.md", "standard-library.md")
PAGES = [
    path for path in (*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")) if path.name not in (*GENERATED, GLOSSARY.name)
]
ROOMS = sorted(
    path.parent for path in (ROOT / "backend" / "scanbench").glob("*/__init__.py") if path.parent.name != "engines"
)
"""Whose messages are read. The texts of `engines` are those of LLVM, with comments."""
TEXTS = sorted((ROOT / "frontend" / "src" / "text" / "en").glob("*.ts"))
CALQUES = ("in front of", "anew", "mended", "some times slower")
"""Of other languages; each has a plain English word."""
HERE = ROOT / "backend"
SOURCES = sorted(path for folder in ("scanbench", "tests", "bench") for path in (HERE / folder).rglob("*.py"))
NOTES = sorted(
    path
    for pattern in ("*.md", "scanbench/**/*.md", "decisions/*.md", "scanbench/check/standard/*.st", "tests/**/*.case")
    for path in HERE.glob(pattern)
)
CALQUE = re.compile(
    r"\b(?:behind|in\s+front\s+of|stands?|standing|anew|another\s+than|(?:is|are|was|were)\s+another(?=[.,:;]|\s+one))\b(?!-)",
    re.IGNORECASE,
)
"""Calques of prepositions and verbs: *after*, *before*, *is*, *again*, *different* are meant."""
MEANT = re.compile(r"\blags?\s+behind\b|\bbehind\s+a\s+proxy\b|\bstands?\s+for\b", re.IGNORECASE)
"""Where these words are right."""
CODE = re.compile(r"`[^`\n]*`")
OF_PYTHON = ("frozen", "fork", "snapshot")
"""Words of the glossary's last column that mean something else in code: dataclasses, processes, frames of values."""
FENCE = re.compile(r"```.*?```|`[^`\n]*`|^    [^\n]*$", re.DOTALL | re.MULTILINE)


@cache
def unwanted() -> dict[str, str]:
    """What is not to be written, and the term to write."""
    found: dict[str, str] = {}
    for line in GLOSSARY.read_text("utf-8").splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if len(cells) == 3:
            found |= dict.fromkeys(re.findall(r"`([^`]+)`", cells[2]), cells[0])
    return found


@cache
def any_of(words: tuple[str, ...]) -> re.Pattern[str]:
    """Finds whether there is one at all: few texts have one."""
    return re.compile(rf"\b(?:{'|'.join(map(re.escape, words))})(?:e?s)?\b", re.IGNORECASE)


def said(words: tuple[str, ...], text: str) -> list[str]:
    """Which of the words the text has, one or several, at any place of a sentence."""
    if not words or any_of(words).search(text) is None:
        return []
    return [word for word in words if re.search(rf"\b{re.escape(word)}(e?s)?\b", text, re.IGNORECASE)]


def helps(command: object, name: str) -> Iterator[tuple[str, str]]:
    """The help of a command and of all below it."""
    assert isinstance(command, TyperCommand | TyperGroup)
    yield name, command.help or ""
    for each in command.params:
        yield f"{name} {each.name}", str(getattr(each, "help", "") or "")
    if isinstance(command, TyperGroup):
        for key, below in command.commands.items():
            yield from helps(below, f"{name} {key}")


def test_the_glossary_names_what_it_does_not_want() -> None:
    assert len(unwanted()) > 40


@pytest.mark.parametrize("page", PAGES, ids=lambda path: str(path.relative_to(ROOT)))
def test_pages(page: Path) -> None:
    text = FENCE.sub("", page.read_text("utf-8"))
    assert [*said((*unwanted(), *CALQUES), text), *calques(text)] == []


def test_the_help_of_the_command_line() -> None:
    found = {place: words for place, text in helps(typer.main.get_command(app), "scanbench")
             if (words := said((*unwanted(), *CALQUES), text))}  # fmt: skip
    assert found == {}


def messages(path: Path) -> Iterator[str]:
    """Texts of a module that are no docstrings: messages, descriptions of fields, parts of both."""
    tree = ast.parse(path.read_text("utf-8"))
    blocks = [each for node in ast.walk(tree) if isinstance(each := getattr(node, "body", None), list)]
    docs = {id(each.value) for block in blocks for each in block if isinstance(each, ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docs:
            yield node.value


@pytest.mark.parametrize("room", ROOMS, ids=lambda path: path.name)
def test_messages(room: Path) -> None:
    found = [
        (path.name, text, words)
        for path in room.rglob("*.py")
        for text in messages(path)
        if (words := said((*CALQUES, "behind"), text))
    ]
    assert found == []


def test_problems() -> None:
    assert {code: words for code, title in TABLE.items() if (words := said((*unwanted(), *CALQUES), title))} == {}


@pytest.mark.parametrize("path", TEXTS, ids=lambda path: path.name)
def test_texts_of_the_page(path: Path) -> None:
    assert said(tuple(unwanted()), path.read_text("utf-8")) == []


def test_the_texts_of_the_page_are_where_they_are_looked_for() -> None:
    assert TEXTS


def calques(text: str) -> list[str]:
    """The calques in a text, outside of `code`."""
    return [found.group() for found in CALQUE.finditer(MEANT.sub("", CODE.sub("", text)))]


def comments(text: str) -> Iterator[str]:
    """Docstrings and comments of a module; comments on successive lines are one text."""
    parts: list[str] = []
    before = 0
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.STRING and token.string.startswith('"""'):
            yield token.string
        elif token.type == tokenize.COMMENT:
            if token.start[0] != before + 1:
                yield " ".join(parts)
                parts = []
            parts.append(token.string.lstrip("# "))
            before = token.start[0]
    yield " ".join(parts)


def test_docstrings_and_comments() -> None:
    """Few files have such a word at all, so only these are read token by token."""
    terms = tuple(word.lower() for word in (*unwanted(), *CALQUES) if word not in OF_PYTHON)
    parts = (*terms, "behind", "front", "stand", "another")
    found: dict[str, list[str]] = {}
    for path in SOURCES:
        text = path.read_text("utf-8")
        lower = text.lower()
        if any(part in lower for part in parts):
            named = tuple(word for word in terms if word in lower)
            if named or CALQUE.search(text):
                words = [word for each in comments(text) for word in (*calques(each), *said(named, CODE.sub("", each)))]
                found |= {str(path.relative_to(HERE)): words} if words else {}
    assert found == {}


def test_notes_and_cases() -> None:
    found = {str(path.relative_to(HERE)): words for path in NOTES if (words := calques(path.read_text("utf-8")))}
    assert found == {}


def test_a_calque_is_found_where_it_is_written() -> None:
    module = '"""The value behind it."""\nbehind = 1  # it stands\n# in front\n# of all\nx = "anew"\n'
    assert [word for each in comments(module) for word in calques(each)] == ["behind", "stands", "in front of"]
    assert calques("a browser lags behind; `standing` stands for it, behind a proxy; a stand-alone file") == []
