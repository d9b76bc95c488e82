"""What LSP has no word for: the functions and blocks that a drawing can put in, with their pins."""

from dataclasses import asdict
from typing import Protocol

from lsprotocol import types

from scanbench.language.boxes import boxes
from scanbench.translation.inside import paragraphs
from scanbench.web.lsp.language import Language

BOXES = "scanbench/boxes"
"""`{textDocument, position}`: `[{name, kind, type, inputs, outputs, types, by_position, more, comment}]`, with the instances that are visible there."""


class _Placed(Protocol):
    textDocument: types.TextDocumentIdentifier  # noqa: N815  # as the client sent it
    position: types.Position


def register(language: Language) -> None:
    @language.server.feature(BOXES)
    def found(params: _Placed) -> list[dict[str, object]]:
        at = types.Position(params.position.line, params.position.character)
        asked = language.asked(params.textDocument.uri, at)
        if asked is None:
            return []
        return [
            {**asdict(each), "comment": " ".join(paragraphs(each.comment, language.tongue).split("\n"))}
            for each in boxes(asked.reading, asked.file, asked.position)
        ]
