"""From a name to its declaration, to what it is made of, and to everywhere that it is used."""

from scanbench.check.declare.classes import Class
from scanbench.check.uses import Symbol, variable_symbol
from scanbench.language.complete import OWNER, WORD, type_of
from scanbench.language.declared import PARAMETERS, Declared, member_of
from scanbench.language.index import Occurrence
from scanbench.language.reading import Reading
from scanbench.problems import Span
from scanbench.program.types import ArrayType, Enumeration, OpenArray, Record, Reference, Subrange, Type


def named_at(reading: Reading, file: str, position: int) -> Occurrence | None:
    """The name at a position; in a statement that was refused what it would mean by itself."""
    return told_at(reading, file, position) or _alone(reading, file, position)


def _alone(reading: Reading, file: str, position: int) -> Occurrence | None:
    text, around = reading.text(file), reading.around(file, position)
    body = None if around is None else reading.body(around)
    while position < len(text) and (text[position].isalnum() or text[position] == "_"):
        position += 1
    line = text[text.rfind("\n", 0, position) + 1 : position]
    word = WORD.search(line)
    if body is None or around is None or word is None or not reading.is_code(file, position):
        return None
    name, owner = word.group(), OWNER.search(line)
    if owner is not None:
        type = type_of(reading, body, around, owner.group(1))
        record = type.target if isinstance(type, Reference) else type
        member = record.members.get(name.upper()) if isinstance(record, Record) else None
        symbol = variable_symbol(member, record) if member is not None and isinstance(record, Record) else None
    else:
        found = body.scope.find(name)
        symbol = None if found is None or found[0].hidden else variable_symbol(found[0], found[2])
    line_number, column = reading.place(file, position)
    span = Span(file, line_number, column - len(name), line_number, column)
    return None if symbol is None else Occurrence(span, symbol)


def told_at(reading: Reading, file: str, position: int) -> Occurrence | None:
    """The name at a position, in a use that the checks found or in its declaration."""
    used = reading.index.at(file, position)
    if used is not None:
        return used
    for each in reading.declared_near(file, position):
        start = reading.position(file, each.span.line, each.span.column)
        if start <= position <= start + len(each.name):
            return Occurrence(each.span, each.symbol)
    return None


def definitions(reading: Reading, symbol: Symbol) -> list[Declared]:
    """Where it is declared, in files of the project; of a library's or the model's there is no place."""
    found = [each for member in family(reading, symbol) for each in reading.declared(member)]
    own = [each for each in found if each.symbol == symbol]
    return [each for each in own or found if each.span.file in reading.files]


def type_definitions(reading: Reading, symbol: Symbol) -> list[Declared]:
    """Where the type of a variable is declared."""
    member = member_of(reading.project.checker, symbol)
    name = None if member is None else _named(member.type)
    if name is None:
        return []
    kinds = (Symbol("pou", "", name), Symbol("type", "", name))
    return [each for kind in kinds for each in definitions(reading, kind)]


def _named(type: Type) -> str | None:
    """The name of the type that a declaration may have, in upper case."""
    match type:
        case ArrayType(element=element) | OpenArray(element=element):
            return _named(element)
        case Reference(target=target) if target is not None:
            return _named(target)
        case Record() | Enumeration() | Subrange():
            return type.name.upper()
        case _:
            return None


def implementations(reading: Reading, symbol: Symbol) -> list[Declared]:
    """Of a method all that override or implement it; of an interface or class those that are made from it."""
    classes = reading.project.checker.pous.classes.by_key
    owner = classes.get(symbol.owner if symbol.kind == "method" else symbol.name)
    if owner is None:
        return []
    heirs = owner.family()[1:] if symbol.kind == "method" else [each for each in owner.family() if each is not owner]
    symbols = [
        Symbol("method", each.name.upper(), symbol.name)
        if symbol.kind == "method"
        else Symbol("pou", "", each.name.upper())
        for each in heirs
    ]
    return [each for made in symbols for each in reading.declared(made)]


def references(reading: Reading, symbol: Symbol, declaration: bool) -> list[Occurrence]:
    """Everywhere that it is named; with the declarations, or without them."""
    symbols = family(reading, symbol)
    found = [each for each in reading.index.of(symbols) if each.span.file in reading.files]
    own = {_key(each.span) for symbol in symbols for each in reading.declared(symbol)}
    found = [each for each in found if _key(each.span) not in own]
    if declaration:
        found += [
            Occurrence(each.span, each.symbol)
            for symbol in symbols
            for each in reading.declared(symbol)
            if each.span.file in reading.files
        ]
    once = {_key(each.span): each for each in found}  # the halves of a property are declared at one place
    return [once[key] for key in sorted(once)]


def _key(span: Span) -> tuple[str, int, int]:
    return span.file, span.line, span.column


def family(reading: Reading, symbol: Symbol) -> list[Symbol]:
    """It, and what has to have the same name: a method of a class, and those that it overrides or that override it; their parameters."""
    if symbol.kind == "variable":
        return _parameter_family(reading, symbol)
    if symbol.kind != "method":
        return [symbol]
    classes = reading.project.checker.pous.classes.by_key
    start = classes.get(symbol.owner)
    if start is None:
        return [symbol]
    keys = {symbol.name, f"{symbol.name}.GET", f"{symbol.name}.SET"}
    seen: set[Class] = set()
    open_ = [start]
    while open_:
        each = open_.pop()
        if each in seen:
            continue
        seen.add(each)
        open_ += [near for near in (*each.ancestors(), *each.family()) if near.methods.keys() & keys]
    return [Symbol("method", each.name.upper(), symbol.name) for each in seen if each.methods.keys() & keys] or [symbol]


def _parameter_family(reading: Reading, symbol: Symbol) -> list[Symbol]:
    """A variable; of a parameter of a method that of every method of its family."""
    half = next((each for each in (".GET", ".SET") if symbol.owner.endswith(each)), "")
    around, _, name = symbol.owner.removesuffix(half).rpartition(".")
    if around not in reading.project.checker.pous.classes.by_key:
        return [symbol]
    member = member_of(reading.project.checker, symbol)
    if member is None or member.section not in PARAMETERS:
        return [symbol]
    methods = family(reading, Symbol("method", around, name))
    same = [Symbol("variable", f"{each.owner}.{each.name}{half}", symbol.name) for each in methods]
    return [each for each in same if each == symbol or reading.declared(each)]
