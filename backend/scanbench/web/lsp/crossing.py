"""What LSP has no word for: cross references with who reads and who writes, and variables that nobody reads."""

from typing import Protocol, get_args

from lsprotocol import types

from scanbench.check.uses import Symbol, SymbolKind
from scanbench.language.cross import complete, cross_references, symbol_of_path, unused
from scanbench.language.index import Occurrence
from scanbench.web.lsp.language import Language
from scanbench.web.lsp.positions import Positions

CROSS_REFERENCES = "scanbench/crossReferences"
"""`{textDocument, position}`, `{path}` or `{symbol}`: `{name, symbol, complete, references: [{uri, range, access, pou, text}]}`. `symbol` asks for
the same again when the text has changed; it is null where nothing is meant. Not `complete`: the program has errors, so names in some
statements are not known."""
UNUSED = "scanbench/unused"
"""`{}`: `{complete, unused: [{name, uri, range, written, pou}]}`; nothing is listed while the program has errors."""


_KINDS: dict[str, SymbolKind] = {kind: kind for kind in get_args(SymbolKind)}


class _Named(Protocol):
    """A position in a document, or an instance path of the program."""


def register(language: Language) -> None:
    server = language.server

    @server.feature(CROSS_REFERENCES)
    def crossing(params: _Named) -> dict[str, object] | None:
        if language.project is None:
            return None
        reading, symbol = language.project.reading, _meant(language, params)
        positions = language.positions(reading)
        found = [] if symbol is None else cross_references(reading, symbol)
        named = next((each for each in found if each.access == "declared"), found[0] if found else None)
        return {
            "name": "" if named is None else reading.written(named.place.span),
            "symbol": None if symbol is None else list(symbol),
            "complete": complete(reading),
            "references": [
                {**_place(language, positions, each.place), "access": each.access, "pou": each.pou, "text": each.text}
                for each in found
            ],
        }

    @server.feature(UNUSED)
    def never_read(_: _Named) -> dict[str, object] | None:
        if language.project is None:
            return None
        reading = language.project.reading
        positions = language.positions(reading)
        known = complete(reading)
        return {
            "complete": known,
            "unused": [
                {
                    **_place(language, positions, Occurrence(each.declared.span, each.declared.symbol)),
                    "name": each.declared.name, "written": each.written, "pou": each.pou,
                }
                for each in (unused(reading) if known else ())
            ],
        }  # fmt: skip


def _meant(language: Language, params: _Named) -> Symbol | None:
    assert language.project is not None
    path: str | None = getattr(params, "path", None)
    again: list[str] | None = getattr(params, "symbol", None)
    if again is not None:
        kind, owner, name = again
        return Symbol(_KINDS[kind], owner, name) if kind in _KINDS else None
    if path is not None:
        return symbol_of_path(language.project.reading, path)
    where, at = params.textDocument, params.position  # type: ignore[attr-defined]  # as the client sent it
    asked = language.asked(where.uri, types.Position(at.line, at.character))
    named = None if asked is None else asked.name
    return None if named is None else named.symbol


def _place(language: Language, positions: Positions, place: Occurrence) -> dict[str, object]:
    range = positions.occurrence(place)
    return {
        "uri": language.uri(place.span.file),
        "range": {
            end: {"line": at.line, "character": at.character}
            for end, at in (("start", range.start), ("end", range.end))
        },
    }  # fmt: skip
