"""What may be written at a position: members after a point, types after a colon, arguments in a call, else whatever is visible."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from scanbench.check.body.context import Body
from scanbench.check.body.objects import is_open, own_class
from scanbench.check.context import Rejected
from scanbench.check.declare.classes import Class
from scanbench.check.declare.declarations import TYPE_NAMES
from scanbench.check.declare.names import Space, qualified
from scanbench.check.standard.functions import FUNCTIONS
from scanbench.check.standard.library import library
from scanbench.check.typed.looking import NOWHERE
from scanbench.check.uses import Symbol, variable_symbol
from scanbench.language.declared import PARAMETERS
from scanbench.language.reading import Around, Reading
from scanbench.program.program import Pou
from scanbench.program.types import Enumeration, Member, Record, Reference, Section, Type
from scanbench.syntax import tree
from scanbench.syntax.cursor import Cursor, Unexpected
from scanbench.syntax.lexer import KEYWORDS, tokenize
from scanbench.syntax.parse_expression import expression
from scanbench.syntax.parse_file import XML_ENDINGS
from scanbench.syntax.parse_pou import ENDS
from scanbench.syntax.source import Source

ItemKind = Literal[
    "variable", "constant", "member", "method", "property", "function", "block", "class", "interface", "program",
    "type", "value", "argument", "keyword", "snippet",
]  # fmt: skip
OWNER = re.compile(r"([^\W\d]\w*(?:\s*\[[^\[\]]*\]|\s*\^|\.[^\W\d]\w*|\.%\w+)*)\s*\.\s*\w*$")
VALUE_OF = re.compile(r"([^\W\d]\w*(?:\.[^\W\d]\w*)*)#\w*$")
WORD = re.compile(r"[^\W\d]\w*$")
CALLED = re.compile(r"([^\W\d]\w*(?:\[[^\[\]]*\]|\^|\.[^\W\d]\w*)*)\s*$")
STATEMENTS = {
    "IF": "IF ${1:condition} THEN\n\t$0\nEND_IF;",
    "CASE": "CASE ${1:selector} OF\n\t${2:1}: $0\nEND_CASE;",
    "FOR": "FOR ${1:i} := ${2:0} TO ${3:9} DO\n\t$0\nEND_FOR;",
    "WHILE": "WHILE ${1:condition} DO\n\t$0\nEND_WHILE;",
    "REPEAT": "REPEAT\n\t$0\nUNTIL ${1:condition}\nEND_REPEAT;",
}
BLOCKS = {
    "PROGRAM": "PROGRAM ${1:Name}\nVAR\n\t$0\nEND_VAR\n\nEND_PROGRAM",
    "FUNCTION_BLOCK": "FUNCTION_BLOCK ${1:Name}\nVAR_INPUT\n\t$0\nEND_VAR\nVAR_OUTPUT\nEND_VAR\nVAR\nEND_VAR\n\nEND_FUNCTION_BLOCK",
    "FUNCTION": "FUNCTION ${1:Name} : ${2:INT}\nVAR_INPUT\n\t$0\nEND_VAR\n\nEND_FUNCTION",
    "TYPE": "TYPE\n\t${1:Name} : STRUCT\n\t\t$0\n\tEND_STRUCT;\nEND_TYPE",
}
POU_KINDS: dict[str, ItemKind] = {
    "function": "function", "function_block": "block", "class": "class", "interface": "interface", "program": "program",
}  # fmt: skip
CLOSING = (*ENDS.values(), "END_METHOD", "END_PROPERTY", "END_ACTION")
"""Words that a file of TwinCAT says by its XML."""
NEAREST, NEAR, VISIBLE, FAR, WORDS = range(5)


@dataclass(frozen=True, slots=True)
class Item:
    label: str
    kind: ItemKind
    detail: str = ""
    """Its type or signature."""
    symbol: Symbol | None = None
    """Of which there is more to say."""
    insert: str = ""
    """A snippet; empty: the label."""
    rank: int = VISIBLE
    """The smallest first."""


def complete(reading: Reading, file: str, position: int) -> list[Item]:
    """Everything that fits; whoever shows it filters by the word that is begun. Nothing in comments and strings."""
    text = reading.text(file)
    if not reading.is_code(file, position):
        return []
    around = reading.around(file, position)
    line = text[text.rfind("\n", 0, position) + 1 : position]
    owner = OWNER.search(line)
    if owner is not None:
        return list(_after_point(reading, around, owner.group(1)))
    typed = VALUE_OF.search(line)
    if typed is not None:
        return list(_values_after(reading, around, typed.group(1)))
    holding = reading.holding(file, position)
    keyword = holding[-1] if holding else ""
    if keyword.startswith("VAR") or keyword in ("STRUCT", "TYPE", "UNION"):
        return list(_types(reading)) if ":" in line and ":=" not in line else list(_declaring(line, reading))
    if around is None:
        blocks = [] if file.lower().endswith(XML_ENDINGS) else BLOCKS.items()
        return [*(Item(word, "snippet", insert=text, rank=NEAREST) for word, text in blocks), *_keywords(file)]
    body = reading.body(around)
    start = position - len(match.group()) if (match := WORD.search(line)) else position
    items = list(arguments(reading, body, around, text, start)) if body is not None else []
    return [*items, *_visible(reading, body, file)]


# ---- after a point --------------------------------------------------------------------------------------------------


def _after_point(reading: Reading, around: Around | None, owner: str) -> Iterator[Item]:
    body = None if around is None else reading.body(around)
    type = None if body is None or around is None else type_of(reading, body, around, owner)
    if type is not None:
        yield from _members(reading, body, type)
        return
    key = owner.upper()
    types = reading.project.checker.declarations.types
    if isinstance(types.get(key), Enumeration):
        yield from _values(key, types[key])
    prefix = f"{key}."
    members = reading.project.checker.globals.members
    for alias in reading.project.checker.pous.aliases:
        if alias.startswith(prefix):
            member = members.get(reading.project.checker.pous.aliases[alias].upper())
            if member is None:  # its declaration is wrong
                continue
            yield Item(
                member.name.rpartition(".")[2],
                "variable",
                str(member.type),
                Symbol("variable", "GLOBAL", member.name.upper()),
            )
    for full, declaration in _pous(reading):
        if full.startswith(prefix) and "." not in full.removeprefix(prefix):
            yield Item(declaration.name, POU_KINDS[declaration.kind], symbol=Symbol("pou", "", full))


def type_of(reading: Reading, body: Body, around: Around, text: str) -> Type | None:
    """The type of a variable that is named as it would be in this POU; None where it names none."""
    if "(" in text:
        return None
    node = parsed(text)
    if node is None:
        return None
    space = Space(around.pou.namespace, around.pou.using)
    with reading.project.checker.declarations.names.within(space):
        try:
            return body.place(node)[0].type
        except Rejected:
            return None


def parsed(text: str) -> tree.Expression | None:
    """An expression by itself."""
    source = Source("typed", text)
    cursor = Cursor(source, tokenize(source)[0])
    try:
        node = expression(cursor)
    except Unexpected:
        return None
    return node if cursor.ended() else None


def _members(reading: Reading, body: Body | None, type: Type) -> Iterator[Item]:
    if isinstance(type, Reference) and isinstance(type.target, Record):
        type = type.target
    if not isinstance(type, Record):
        return
    owner = reading.project.checker.pous.classes.of(type)
    for member in type.members.values():
        open_ = owner is None or member.section in (Section.INPUT, Section.OUTPUT, Section.MEMBER)
        if not member.hidden and (open_ or (body is not None and body.lookup.may_use(body, type, member))):
            yield _member(member, type)
    if owner is not None and body is not None:
        yield from _methods(owner, body, NEAREST)


def _methods(owner: Class, body: Body, rank: int) -> Iterator[Item]:
    """The methods and properties of a class that can be used here, each once: those it inherits, too."""
    seen: set[str] = set()
    user = own_class(body)
    for home in (owner, *owner.ancestors()):
        for method in home.methods.values():
            declaration = method.declaration
            if declaration.name.upper() not in seen and is_open(body, declaration.access, user, home):
                seen.add(declaration.name.upper())
                kind: ItemKind = "method" if declaration.kind == "method" else "property"
                yield Item(declaration.name, kind, symbol=method.symbol, rank=rank)


def _member(member: Member, owner: Record) -> Item:
    return Item(member.name, "member", str(member.type), variable_symbol(member, owner), rank=NEAREST)


def _values_after(reading: Reading, around: Around | None, name: str) -> Iterator[Item]:
    """The values of an enumeration after `Mode#`; of numbers, durations and dates nobody can list any."""
    declarations = reading.project.checker.declarations
    space = Space() if around is None else Space(around.pou.namespace, around.pou.using)
    with declarations.names.within(space):
        try:
            key = declarations.names.find(name, NOWHERE, declarations.types)
        except Rejected:
            key = None
    if key is not None:
        yield from _values(key, declarations.types[key])


def _values(key: str, type: Type) -> Iterator[Item]:
    if isinstance(type, Enumeration):
        for name, number in type.values:
            yield Item(name, "value", f"{type.name} = {number}", Symbol("value", key, name.upper()), rank=NEAREST)


# ---- in declarations ------------------------------------------------------------------------------------------------


def _types(reading: Reading) -> Iterator[Item]:
    for name in TYPE_NAMES:
        yield Item(name, "keyword", rank=NEAR)
    for word in ("STRING", "WSTRING", "ARRAY", "REF_TO", "REFERENCE TO", "POINTER TO", "STRUCT"):
        yield Item(word, "keyword", rank=NEAR)
    for key, declaration in reading.project.checker.declarations.type_trees.items():
        yield Item(
            qualified(declaration.namespace, declaration.name), "type", symbol=Symbol("type", "", key), rank=NEAREST
        )
    for full, pou in _pous(reading):
        if pou.kind in ("function_block", "class", "interface"):
            yield Item(
                qualified(pou.namespace, pou.name), POU_KINDS[pou.kind], symbol=Symbol("pou", "", full), rank=NEAREST
            )
    for pou in _library("function_block"):
        yield Item(pou.name, "block", "standard", Symbol("pou", "", pou.name.upper()), rank=FAR)


def _declaring(line: str, reading: Reading) -> Iterator[Item]:
    """In a section: its end; in an initial value constants."""
    if ":=" in line:
        yield from _constants(reading)
        return
    for word in (
        "END_VAR",
        "VAR",
        "VAR_INPUT",
        "VAR_OUTPUT",
        "VAR_IN_OUT",
        "VAR_TEMP",
        "CONSTANT",
        "RETAIN",
        "AT",
        "END_STRUCT",
    ):
        yield Item(word, "keyword", rank=WORDS)


def _constants(reading: Reading) -> Iterator[Item]:
    for word in ("TRUE", "FALSE"):
        yield Item(word, "keyword", rank=NEAR)
    for member in reading.project.checker.globals.members.values():
        if member.constant:
            yield Item(member.name, "constant", str(member.type), Symbol("variable", "GLOBAL", member.name.upper()))
    for key, type in reading.project.checker.declarations.types.items():
        yield from _values(key, type)


# ---- in statements --------------------------------------------------------------------------------------------------


def arguments(reading: Reading, body: Body, around: Around, text: str, position: int) -> Iterator[Item]:
    """Named arguments of the call whose parentheses a position is in, but those that are given."""
    call = call_around(text, position)
    if call is None:
        return
    callee, opened = call
    given = set(re.findall(r"([^\W\d]\w*)\s*(?::=|=>)", text[opened:position].upper()))
    for member, owner in formals(reading, body, around, callee):
        if member.name.upper() not in given:
            arrow = "=>" if member.section is Section.OUTPUT else ":="
            yield Item(
                f"{member.name} {arrow}", "argument", str(member.type), variable_symbol(member, owner),
                f"{member.name} {arrow} $0", NEAREST,
            )  # fmt: skip


def call_around(text: str, position: int) -> tuple[str, int] | None:
    """What is called where a position is, and where its parenthesis opens; None outside of calls."""
    depth = 0
    at = position - 1
    first = max(0, position - 4000)
    while at >= first:
        char = text[at]
        if char in ")]":
            depth += 1
        elif char in "([":
            if depth == 0:
                if char == "[":
                    return None
                found = CALLED.search(text, max(first, at - 200), at)
                return None if found is None or found.group(1).upper() in KEYWORDS else (found.group(1), at + 1)
            depth -= 1
        elif char == ";":
            return None
        at -= 1
    return None


def formals(reading: Reading, body: Body, around: Around, callee: str) -> list[tuple[Member, Record]]:
    """The parameters of what is called that a program may name, in order, each with its owner."""
    type = type_of(reading, body, around, callee)
    if isinstance(type, Reference):
        type = type.target
    if isinstance(type, Record):
        found = [(each, type) for each in type.members.values()]
    else:
        pou = _function(reading, around, callee) or _method(reading, body, around, callee)
        if pou is None:
            return []
        found = [(pou.frame.members[key], pou.frame) for key in pou.parameters]
    return [
        (member, owner)
        for member, owner in found
        if member.section in PARAMETERS and not member.hidden and not member.name.startswith("__")
    ]


def _function(reading: Reading, around: Around, callee: str) -> Pou | None:
    """The FUNCTION that a name means here."""
    functions, names = reading.project.checker.pous.functions, reading.project.checker.declarations.names
    with names.within(Space(around.pou.namespace, around.pou.using)):
        try:
            key = names.find(callee, around.pou.span, functions)
        except Rejected:
            return None
    return None if key is None else functions[key]


def _method(reading: Reading, body: Body, around: Around, callee: str) -> Pou | None:
    owner, _, name = callee.rpartition(".")
    classes = reading.project.checker.pous.classes
    record = body.scope.instance if not owner else type_of(reading, body, around, owner)
    if isinstance(record, Reference):
        record = record.target
    home = classes.of(record)
    found = None if home is None else home.find(name.upper())
    return None if found is None else found.pou


def _visible(reading: Reading, body: Body | None, file: str) -> Iterator[Item]:
    checker = reading.project.checker
    if body is not None:
        scope = body.scope
        for rank, owner in ((NEAREST, scope.frame), (NEAREST, scope.instance), (NEAR, scope.globals)):
            if owner is None:
                continue
            for member in owner.members.values():
                if not member.hidden:
                    kind: ItemKind = "constant" if member.constant else "variable"
                    yield Item(member.name, kind, str(member.type), variable_symbol(member, owner), rank=rank)
        for owner in scope.system:
            for member in owner.members.values():
                yield Item(member.name, "variable", str(member.type), variable_symbol(member, owner), rank=FAR)
        home = checker.pous.classes.of(scope.instance)
        if home is not None:
            yield from _methods(home, body, NEAR)
    for full, pou in _pous(reading):
        if pou.kind == "function":
            name = qualified(pou.namespace, pou.name)
            yield Item(name, "function", symbol=Symbol("pou", "", full), insert=f"{name}($0)", rank=VISIBLE)
    for key, type in checker.declarations.types.items():
        yield from _values(key, type)
    for name in FUNCTIONS:
        yield Item(name, "function", "standard", Symbol("function", "", name), f"{name}($0)", FAR)
    for pou in _library("function"):
        yield Item(pou.name, "function", "standard", Symbol("pou", "", pou.name.upper()), f"{pou.name}($0)", FAR)
    for word, snippet in STATEMENTS.items():
        yield Item(word, "snippet", insert=snippet, rank=WORDS)
    yield from _keywords(file)


def _keywords(file: str) -> Iterator[Item]:
    closing = CLOSING if file.lower().endswith(XML_ENDINGS) else ()
    for word in sorted(KEYWORDS.difference(closing)):
        yield Item(word, "keyword", rank=WORDS)


def _pous(reading: Reading) -> Iterator[tuple[str, tree.PouDeclaration]]:
    """The POUs of the project by their full names in upper case."""
    for pou in reading.project.checker.names.user:
        yield qualified(pou.namespace, pou.name).upper(), pou


def _library(kind: str) -> Iterator[tree.PouDeclaration]:
    for file in library():
        for pou in file.pous:
            if pou.kind == kind and not pou.name.startswith("__"):
                yield pou
