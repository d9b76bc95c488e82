"""What LSP has no word for: cross references with who reads and who writes, and variables that nobody reads."""

from typing import Protocol, get_args

from lsprotocol import types

from scanbench.check.uses import Symbol, SymbolKind
from scanbench.language.cross import complete, cross_references, symbol_of_path, unused
from scanbench.language.index import Occurrence
from scanbench.web.lsp.language import Language
from scanbench.web.lsp.positions import Positions

CROSS_REFERENCES = "scanbench/crossReferences"
"""`{textDocument, position}`, `{path}` or `{symbol}`: `{name, symbol, complete, references: [{uri, range, access, pou, text}]}`, null where nothing is meant. `symbol` asks for
the same again when the text has changed.
Not `complete`: the program has errors, so names in some statements are not known."""
UNUSED = "scanbench/unused"
"""`{}`: `[{name, uri, range, written, pou}]`; null while the program has errors."""


_KINDS: dict[str, SymbolKind] = {kind: kind for kind in get_args(SymbolKind)}


class _Named(Protocol):
    """A position in a document, or an instance path of the program."""


def register(language: Language) -> None:
    server = language.server

    @server.feature(CROSS_REFERENCES)
    def crossing(params: _Named) -> dict[str, object] | None:
        if language.project is None:
            return None
        path: str | None = getattr(params, "path", None)
        again: list[str] | None = getattr(params, "symbol", None)
        if again is not None and len(again) == len(Symbol._fields):
            kind, owner, name = again
            reading, symbol = language.project.reading, Symbol(_KINDS[kind], owner, name) if kind in _KINDS else None
        elif path is not None:
            reading = language.project.reading
            symbol = symbol_of_path(reading, path)
        else:
            where, at = params.textDocument, params.position  # type: ignore[attr-defined]  # as the client sent it
            asked = language.asked(where.uri, types.Position(at.line, at.character))
            if asked is None or asked.name is None:
                return None
            reading, symbol = asked.reading, asked.name.symbol
        if symbol is None:
            return None
        positions = language.positions(reading)
        found = cross_references(reading, symbol)
        named = next((each for each in found if each.access == "declared"), found[0] if found else None)
        return {
            "name": symbol.name if named is None else reading.written(named.place.span),
            "symbol": list(symbol),
            "complete": complete(reading),
            "references": [
                {**_place(language, positions, each.place), "access": each.access, "pou": each.pou, "text": each.text}
                for each in found
            ],
        }

    @server.feature(UNUSED)
    def never_read(_: _Named) -> list[dict[str, object]] | None:
        if language.project is None or not complete(language.project.reading):
            return None
        reading = language.project.reading
        positions = language.positions(reading)
        return [
            {
                **_place(language, positions, Occurrence(each.declared.span, each.declared.symbol)),
                "name": each.declared.name, "written": each.written, "pou": each.pou,
            }
            for each in unused(reading)
        ]  # fmt: skip


def _place(language: Language, positions: Positions, place: Occurrence) -> dict[str, object]:
    range = positions.occurrence(place)
    return {
        "uri": language.uri(place.span.file),
        "range": {
            end: {"line": at.line, "character": at.character}
            for end, at in (("start", range.start), ("end", range.end))
        },
    }  # fmt: skip
