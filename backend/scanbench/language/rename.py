"""A new name for a symbol, everywhere that it is named."""

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import zip_longest

from scanbench.check.body.forms import FORMS
from scanbench.check.standard.functions import FUNCTIONS
from scanbench.check.standard.library import library
from scanbench.check.uses import INLINE, Symbol
from scanbench.language.index import Occurrence, chunk_at
from scanbench.language.navigate import definitions, family, references, told_at
from scanbench.language.reading import Reading
from scanbench.problems import Problem, Severity
from scanbench.program.types import ELEMENTARY
from scanbench.syntax.chunks import Chunk
from scanbench.syntax.lexer import CONTEXTUAL, KEYWORDS, Lex, Tokens
from scanbench.syntax.parse_il import MNEMONICS

NAME = re.compile(r"[^\W\d]\w*")
DRAWN = (".tcpou",)
"""Files whose bodies may be drawn."""
DRAWING = re.compile(r"<(?:NWL|SFC|CFC)>.*?</(?:NWL|SFC|CFC)>", re.DOTALL)
Meaning = Symbol | int


@dataclass(frozen=True, slots=True)
class CannotRename:
    """Why a name stays as it is."""

    message: str


def places(reading: Reading, symbol: Symbol, name: str) -> list[Occurrence] | CannotRename:
    """Where the text changes; or why the name cannot be `name`, whatever it would mean."""
    refused = refusal(reading, symbol)
    if refused is not None:
        return refused
    if not NAME.fullmatch(name) or "__" in name or name.endswith("_"):
        return CannotRename(f"`{name}` is no name: letters, digits and single underscores, a letter first.")
    if name.upper() in KEYWORDS or name.upper() in ELEMENTARY:
        return CannotRename(f"`{name}` is a keyword of the language.")
    found = references(reading, symbol, declaration=True)
    old = symbol.name.rpartition(".")[2]
    return _drawn(reading, old) or _unknown(reading, old, found) or found


def changed_meaning(
    reading: Reading, found: list[Occurrence], name: str, read: Callable[[Mapping[str, str]], Reading]
) -> CannotRename | None:
    """Why these places cannot be called `name`: something would mean something else, or nothing. Where anything has this name
    already that could matter, the changed text is checked and compared; the reading must not be asked afterwards."""
    same = all(name.upper() == reading.written(each.span).upper() for each in found)
    if same or _is_new(reading, name.upper(), _scope(reading, found)):
        return None
    texts = {file: _replaced(reading, file, found, name) for file in reading.files}
    before, wrong = _meanings(reading), _wrong(reading)
    after = read(texts)
    for problem in after.checked.problems:
        if _is_error(problem) and _kind(problem) not in wrong:
            return CannotRename(f"With the name `{name}` {problem.span} would be wrong: {problem.message}")
    now = _meanings(after)
    if before[""] != now[""]:
        return CannotRename(f"With the name `{name}` a method would run in place of a different one.")
    for file in after.files:
        nothing = len(after.text(file)), frozenset[Meaning]()
        for (_, meant), (end, means) in zip_longest(before[file], now[file], fillvalue=nothing):
            if meant != means:
                line = after.place(file, end)[0]
                return CannotRename(f"With the name `{name}` something in {file}:{line} would mean something else.")
    return None


def _scope(reading: Reading, found: list[Occurrence]) -> list[Chunk]:
    """Where it matters whether something has the new name: of a part of a POU or structure where it is declared and named, as elsewhere
    names lead to it only through one of these places; else everywhere."""
    chunks = [chunk for file in reading.files.values() for chunk in file.chunks]
    if reading.checked.program is None or any(
        each.symbol.kind != "variable" or each.symbol.owner == "GLOBAL" for each in found
    ):
        return chunks
    places = ((each.span.file, reading.position(each.span.file, each.span.line, each.span.column)) for each in found)
    named = list({id(chunk): chunk for chunk in (chunk_at(reading.files[file], at) for file, at in places)}.values())
    own = {pou.name.upper() for chunk in named for pou in chunk.file.pous}
    for pou in (pou for chunk in chunks for pou in chunk.file.pous):
        bases = {base.name.upper().rpartition(".")[2] for base in (*pou.extends, *pou.implements)}
        if bases and (pou.name.upper() in own or not bases.isdisjoint(own)):
            return chunks  # what is inherited is declared without being named
    return named


def _is_new(reading: Reading, name: str, scope: list[Chunk]) -> bool:
    """Whether nothing there has this name yet, so that no use of it can come to mean this, nor a use of this something else."""
    checker, words = reading.project.checker, reading.project.words
    declared = (FUNCTIONS, FORMS, MNEMONICS, CONTEXTUAL, checker.pous.functions, checker.pous.blocks)
    standard = (pou.name.upper() for file in library() for pou in file.pous)
    return not (
        name.startswith("_")
        or any(name in each for each in (*declared, checker.declarations.symbols.members, checker.globals.members))
        or name in standard
        or any(name in words.of(chunk) for chunk in scope)
    )


def _replaced(reading: Reading, file: str, found: list[Occurrence], name: str) -> str:
    parts, at = [], 0
    text = reading.text(file)
    for each in found:
        if each.span.file == file:
            start = reading.position(file, each.span.line, each.span.column)
            parts += [text[at:start], name]
            at = reading.position(file, each.span.end_line, each.span.end_column)
    return "".join([*parts, text[at:]])


def _wrong(reading: Reading) -> set[tuple[str, str, int]]:
    return {_kind(problem) for problem in reading.checked.problems if _is_error(problem)}


def _is_error(problem: Problem) -> bool:
    return problem.severity is Severity.ERROR


def _kind(problem: Problem) -> tuple[str, str, int]:
    return problem.code, problem.span.file, problem.span.line


def _meanings(reading: Reading) -> dict[str, list[tuple[int, frozenset[Meaning]]]]:
    """By file the names in order, and what each means: a declaration of the project by its number, which no new name changes; else
    the symbol. Without a file: which methods run in place of each other."""
    numbers: dict[Symbol, int] = {}
    for number, each in enumerate(each for file in reading.files for each in reading.declared_in(file)):
        numbers.setdefault(each.symbol, number)
    methods = [
        (0, frozenset(numbers.get(each, each) for each in family(reading, symbol)))
        for symbol in numbers
        if symbol.kind == "method"
    ]
    return {"": methods} | {
        file: [
            (end, frozenset(numbers.get(symbol, symbol) for symbol in symbols))
            for end, symbols in reading.index.meanings(file)
        ]
        for file in reading.files
    }


def _unknown(reading: Reading, name: str, found: list[Occurrence]) -> CannotRename | None:
    """The same word somewhere where nothing was found that it means: it may mean this."""
    for file in reading.files:
        known = {(each.span.line, each.span.column) for each in found if each.span.file == file}
        for position in _words(reading, file, name):
            place = reading.place(file, position)
            if place not in known and told_at(reading, file, position) is None:
                return CannotRename(f"`{name}` in {file}:{place[0]} may mean this, too; rename it by hand first.")
    return None


def _drawn(reading: Reading, name: str) -> CannotRename | None:
    """A use in a drawing of a file, whose text is not all that was read: a new name would not get everywhere."""
    for file in reading.files:
        drawn = "".join(DRAWING.findall(reading.text(file))) if file.lower().endswith(DRAWN) else ""
        if re.search(rf"\b{re.escape(name)}\b", drawn, re.IGNORECASE):
            return CannotRename(f"`{name}` is drawn in {file}; rename it in TwinCAT.")
    return None


def _words(reading: Reading, file: str, name: str) -> Iterator[int]:
    """Where this word is in a file, but as what nobody renames: the formal parameter of a standard function, a word of a configuration."""
    for start, tokens in reading.tokens(file):
        for at, (kind, text) in enumerate(zip(tokens.kinds, tokens.texts, strict=True)):
            if kind is Lex.TYPED:  # `Color#RED`
                type, _, value = text.partition("#")
                if type.upper() == name:
                    yield start + tokens.starts[at]
                if value.upper() == name:
                    yield start + tokens.starts[at] + len(type) + 1
            if (
                kind is Lex.NAME
                and text.upper() == name
                and not (_is_standard_formal(tokens, at) or _is_of_configuration(tokens, at))
            ):
                yield start + tokens.starts[at]


def _is_standard_formal(tokens: Tokens, at: int) -> bool:
    """Whether it is the name before `:=` or `=>` in the parentheses of a standard function."""
    if tokens.texts[at + 1] not in (":=", "=>"):
        return False
    depth = 1
    while at > 0 and depth > 0:
        at -= 1
        depth += (tokens.texts[at] in (")", "]")) - (tokens.texts[at] in ("(", "["))
        if tokens.texts[at] == ";":
            return False
    return at > 0 and tokens.texts[at - 1].upper() in FUNCTIONS


def _is_of_configuration(tokens: Tokens, at: int) -> bool:
    """Whether it is the `ON` of `RESOURCE Cpu ON`, the `WITH` of `PROGRAM Main WITH`, or an input of `TASK Cyclic(`."""
    before = [text.upper() for text in tokens.texts[max(at - 2, 0) : at]]
    match tokens.texts[at].upper():
        case "ON":
            return before[:1] == ["RESOURCE"]
        case "WITH":
            return before[:1] == ["PROGRAM"]
        case "INTERVAL" | "PRIORITY" | "SINGLE":
            begin = max((each for each in range(at) if tokens.texts[each] in ("(", ";")), default=0)
            return begin > 1 and tokens.texts[begin] == "(" and tokens.texts[begin - 2].upper() == "TASK"
    return False


def refusal(reading: Reading, symbol: Symbol) -> CannotRename | None:
    """Why a symbol keeps its name, whatever the new one is."""
    found = definitions(reading, symbol)
    if not found:
        return CannotRename("This is not declared in the project: the library or the model has it.")
    if symbol.owner == INLINE and len(found) > 1:
        return CannotRename("Several structures without a name have a member of this name; give the type a name first.")
    wrong = [each for each in reading.checked.problems if _is_error(each) and each.code.startswith("S")]
    if wrong:
        return CannotRename(f"The text cannot be read as a whole, so a use may be missed: mend {wrong[0].span} first.")
    return None
