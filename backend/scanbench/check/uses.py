"""Uses of names: which piece of a text means which declaration. The checks note them while they find out, so that an editor
answers without a second idea of what names mean.

A use tells the declaration by name and not by object: bodies that hold are kept while what they name is declared again.
"""

from dataclasses import replace
from typing import Literal, NamedTuple

from scanbench.problems import Span
from scanbench.program.types import Enumeration, Member, Record, Section
from scanbench.syntax.source import Stretch

SymbolKind = Literal["variable", "pou", "method", "type", "value", "function"]
INLINE = "STRUCT"
"""The owner of members of structures without a name: several may have a member of the same name."""


class Symbol(NamedTuple):
    """Something that is declared. `function` is a standard function, which no text declares; a property is a `method`."""

    kind: SymbolKind
    owner: str
    """In upper case: of a variable its POU, method, structure or `GLOBAL`; of a method its class; of a value its enumeration."""
    name: str
    """In upper case and in full, with its namespace."""


class Use(NamedTuple):
    """One name in a text."""

    span: Span
    """Of an expression that ends in the name."""
    length: int
    """Of the name."""
    symbol: Symbol

    @property
    def place(self) -> Span:
        """Of the name alone."""
        return self.span.last(self.length)


def variable_symbol(member: Member, owner: Record) -> Symbol:
    """A variable. The result of a FUNCTION or method, and what a SET is given, are named by their POU."""
    home = (member.home or owner.name).upper().partition("<")[0]  # of a generic FUNCTION, whatever it was made for
    name = member.name.upper()
    if owner.written_out:
        return Symbol("variable", INLINE, name)
    if member.section is Section.RESULT or home.endswith(f"{name}.SET"):
        full = home.removesuffix(".GET").removesuffix(".SET")
        if home == full and "THIS" not in owner.members:
            return Symbol("pou", "", full)
        around, _, own = full.rpartition(".")
        return Symbol("method", around, own)
    return Symbol("variable", home, name)


def prefix_of(literal: Span, type_name: str) -> Span:
    """The name of the type in `Color#RED` or `Level#5`."""
    if isinstance(literal, Stretch):
        return literal.source.span(literal.start, literal.start + len(type_name))
    return replace(literal, end_line=literal.line, end_column=literal.column + len(type_name))


def value_symbol(type: Enumeration, name: str) -> Symbol:
    """A value of an enumeration."""
    return Symbol("value", type.name.upper(), name.upper())
