"""How many instances and references a declaration has, above it."""

from typing import Protocol

from lsprotocol import types

from scanbench.check.uses import Symbol, SymbolKind
from scanbench.language.cross import complete
from scanbench.language.lenses import Counted, Lens, count, instances_at, lenses
from scanbench.web.lsp.language import Language
from scanbench.web.lsp.positions import Positions

INSTANCES = "scanbench/instances"
"""`{textDocument, position}`: the places of the variables that are instances of the block or class named there."""
COMMANDS: dict[Counted, str] = {"instances": "scanbench.showInstances", "references": "scanbench.showReferences"}
"""What a client does that lists them, with the document and the position as arguments."""
_KINDS: dict[object, SymbolKind] = {"pou": "pou", "method": "method", "type": "type"}
_COUNTED: dict[object, Counted] = {each: each for each in COMMANDS}


class _Place(Protocol):
    """A document and a position in it."""


def register(language: Language) -> None:
    server = language.server

    @server.feature(types.TEXT_DOCUMENT_CODE_LENS, types.CodeLensOptions(resolve_provider=True))
    def code_lens(params: types.CodeLensParams) -> list[types.CodeLens]:
        found = language.file(params.text_document.uri)
        if found is None:
            return []
        reading, file = found
        positions = language.positions(reading)
        return [_lens(positions, params.text_document.uri, each) for each in lenses(reading, file)]

    @server.feature(types.CODE_LENS_RESOLVE)
    def resolve(lens: types.CodeLens) -> types.CodeLens:
        lens.command = _command(language, lens)
        return lens

    @server.feature(INSTANCES)
    def instances(params: _Place) -> list[types.Location]:
        where, at = params.textDocument, params.position  # type: ignore[attr-defined]  # as the client sent it
        asked = language.asked(where.uri, types.Position(at.line, at.character))
        return [] if asked is None else [
            types.Location(language.uri(each.span.file), asked.positions.span(each.span))
            for each in instances_at(asked.reading, asked.file, asked.position)
        ]  # fmt: skip


def _lens(positions: Positions, uri: str, lens: Lens) -> types.CodeLens:
    return types.CodeLens(positions.span(lens.declared.span), data=[lens.counted, uri, *lens.declared.symbol])


def _command(language: Language, lens: types.CodeLens) -> types.Command:
    """The number. An empty command only shows its title, which every client can."""
    match lens.data:
        case [counted, str(uri), kind, str(owner), str(name)] if counted in _COUNTED and kind in _KINDS:
            wanted = _COUNTED[counted]
            title, listed = _title(language, Symbol(_KINDS[kind], owner, name), wanted)
            if language.lists and listed:
                return types.Command(title, COMMANDS[wanted], arguments=[uri, lens.range.start])
            return types.Command(title, "")
    return types.Command("", "")


def _title(language: Language, symbol: Symbol, counted: Counted) -> tuple[str, bool]:
    """And whether there is something to list."""
    if language.project is None:
        return "", False
    reading = language.project.reading
    number = count(reading, symbol, counted)
    if number is None:
        return "instances not known", False
    if counted == "instances":
        return "1 instance" if number == 1 else f"{number} instances", number > 0
    if not complete(reading):  # what statements with errors name is not known
        return "at least 1 reference" if number == 1 else f"at least {number} references", number > 0
    return "1 reference" if number == 1 else f"{number} references", number > 0
