"""What is said of a name: its declaration, the comment that belongs to it, its address, the value that it has."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from scanbench.check.declare.names import qualified
from scanbench.check.standard.library import library_of
from scanbench.check.uses import Symbol
from scanbench.language.comments import Comment, comments
from scanbench.language.declared import Declared, member_of
from scanbench.language.reading import Reading
from scanbench.language.standard import parameter, row_of, says, text_of
from scanbench.problems import Span
from scanbench.program.types import Enumeration, Member, Section
from scanbench.syntax import tree
from scanbench.syntax.lexer import tokenize
from scanbench.syntax.source import Stretch

_SECTIONS = {Section.MEMBER: "", Section.RESULT: "", Section.TEMP: "VAR_TEMP "}


@dataclass(frozen=True, slots=True)
class Description:
    code: str
    """As a declaration in ST."""
    comment: str = ""
    """What its author wrote beside or above it."""
    notes: tuple[str, ...] = ()
    """What the declaration does not show."""
    by_author: bool = False
    """Whether the comment is of the program's author, not of the standard library."""


def describe(reading: Reading, symbol: Symbol) -> Description | None:
    """What is said of a symbol; None where nothing is known."""
    if symbol.kind == "function":
        return _standard(symbol.name)
    declared = reading.declared(symbol)
    made = _of(reading, symbol, declared or library_declared(reading, symbol))
    return made and replace(made, by_author=bool(declared))


def _of(reading: Reading, symbol: Symbol, found: Sequence[Declared]) -> Description | None:
    comment = comment_of(reading, found[0]) if found else _of_parameter(reading, symbol)
    member = member_of(reading.project.checker, symbol)
    if member is not None:
        return Description(variable(member), comment, _notes(member))
    match found[0].node if found else None:
        case tree.PouDeclaration() as pou:
            return Description(signature(pou, symbol), comment)
        case tree.TypeDeclaration() as type:
            return _type(reading, found[0], type, symbol, comment)
        case tree.Variable() as declared:  # the checks refused it, or it lists the value
            return Description(
                found[0].name if symbol.kind == "value" else f"{declared.name} : {written(declared.type)}", comment
            )
    return None


def variable(member: Member) -> str:
    """`VAR_INPUT speed : INT (0..100)`."""
    section = _SECTIONS.get(member.section, f"{member.section.value} ")
    constant = "CONSTANT " if member.constant and member.section is not Section.IN_OUT else ""
    at = f" AT {member.address}" if member.address else ""
    return f"{section}{constant}{member.name.rpartition('.')[2]}{at} : {member.type}"


def _notes(member: Member) -> tuple[str, ...]:
    notes = []
    if member.section is Section.IN_OUT:
        notes.append(
            "in-out by value: a copy, which goes back after the call" if member.copied else "in-out by reference"
        )
    if member.retain:
        notes.append("retained over every restart" if member.persistent else "retained over a warm restart")
    return tuple(notes)


def signature(pou: tree.PouDeclaration, symbol: Symbol) -> str:
    """The head of a POU with its parameters, one a line."""
    kind = {"get": "PROPERTY", "set": "PROPERTY"}.get(pou.kind, pou.kind.upper())
    name = pou.name if symbol.kind == "method" else qualified(pou.namespace, pou.name)
    head = f"{kind} {name}"
    if pou.extends:
        head += f" EXTENDS {', '.join(each.name for each in pou.extends)}"
    if pou.implements:
        head += f" IMPLEMENTS {', '.join(each.name for each in pou.implements)}"
    if pou.result is not None:
        head += f" : {written(pou.result)}"
    lines = [head]
    for section in pou.sections:
        if section.keyword in ("VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT"):
            lines += [f"  {section.keyword} {each.name} : {written(each.type)}" for each in section.variables]
    return "\n".join(lines)


def written(spec: tree.TypeSpec) -> str:
    """A type as it was written, on one line."""
    span = spec.span
    if isinstance(span, Stretch):
        return " ".join(span.source.text[span.start : span.end].split())
    return spec.name if isinstance(spec, tree.NamedType) else ""


def _type(reading: Reading, found: Declared, type: tree.TypeDeclaration, symbol: Symbol, comment: str) -> Description:
    name = qualified(type.namespace, type.name)
    if symbol.kind == "value":
        made = reading.project.checker.declarations.types.get(name.upper())
        number = made.number(symbol.name) if isinstance(made, Enumeration) else None
        return Description(f"{name}#{found.name}" + ("" if number is None else f" = {number}"), comment)
    span = type.type.span
    text = span.source.text[span.start : span.end] if isinstance(span, Stretch) else ""
    lines = text.splitlines()
    shown = "\n".join(lines[:16] + (["  ..."] if len(lines) > 16 else []))
    return Description(f"TYPE {name} : {shown}", comment)


def _standard(name: str) -> Description:
    row, text = row_of(name), text_of(name)
    if row is None:
        return Description(name, text or "standard function")
    more = ", ..." if row.variadic else ""
    return Description(f"{name}({', '.join(row.formals)}{more})", text, (says(row),))


def library_declared(reading: Reading, symbol: Symbol) -> list[Declared]:
    """A function or block of the standard library, as the dialect of the project has it."""
    if symbol.kind != "pou":
        return []
    name = symbol.name.rpartition(".")[2]
    files = library_of(reading.project.checker.declarations.dialect)
    return [
        Declared(symbol, pou.name, pou.span, pou) for file in files for pou in file.pous if pou.name.upper() == name
    ][:1]


def _of_parameter(reading: Reading, symbol: Symbol) -> str:
    """What the library says of a parameter, beside what the block is."""
    owner = library_declared(reading, Symbol("pou", "", symbol.owner)) if symbol.kind == "variable" else []
    return parameter(said_in_library(owner[0].span), symbol.name) if owner else ""


def comment_of(reading: Reading, found: Declared) -> str:
    """The comment beside a declaration, else those directly above it."""
    span = found.span
    if span.file not in reading.files:
        return said_in_library(span)
    start = reading.position(span.file, span.line, span.column)
    known = [(first + each.start, first + each.end, each) for first, each in reading.comments(span.file)]
    return _said(reading.text(span.file), start, known)


def said_in_library(span: Span) -> str:
    """The comment that belongs to the POU of the library whose name is here."""
    if not isinstance(span, Stretch):
        return ""
    text = span.source.text
    return _said(text, span.start, [(each.start, each.end, each) for each in comments(text, tokenize(span.source)[0])])


def _said(text: str, start: int, known: list[tuple[int, int, Comment]]) -> str:
    """`known`: the comments of the text, and from where to where they go."""
    said = [(first, after, each.said) for first, after, each in known if each.said]
    beside = next((each for each in said if each[0] >= start), None)
    if beside is not None and "\n" not in text[start : beside[0]]:
        return beside[2]
    return _above(text, text.rfind("\n", 0, start) + 1, said)


def _above(text: str, line: int, said: list[tuple[int, int, str]]) -> str:
    """The comments that end directly above the line that begins here, one a line."""
    above: list[str] = []
    for first, after, each in reversed(said):
        if after > line:
            continue
        begin = text.rfind("\n", 0, first) + 1
        if text[after:line].strip() or text.count("\n", after, line) != 1 or text[begin:first].strip():
            break
        above.insert(0, each)
        line = begin
    return "\n".join(above)
