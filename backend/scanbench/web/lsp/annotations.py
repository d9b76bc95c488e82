"""What an editor shows in a text without being asked: names of parameters, and what kind of thing each name means."""

from collections.abc import Iterator
from typing import get_args

from lsprotocol import types

from scanbench.language.embedded import embedded
from scanbench.language.hints import hints
from scanbench.language.reading import Reading
from scanbench.language.tokens import Modifier, Token, TokenKind, tokens
from scanbench.web.lsp.language import Language
from scanbench.web.lsp.positions import Positions

KINDS: list[TokenKind] = list(get_args(TokenKind))
MODIFIERS: list[Modifier] = list(get_args(Modifier))
Stretch = tuple[Reading, Positions, str, int, int]
"""A state of the texts, and a stretch of a file in it."""


def register(language: Language) -> None:
    server = language.server

    @server.feature(types.TEXT_DOCUMENT_INLAY_HINT)
    def inlay_hint(params: types.InlayHintParams) -> list[types.InlayHint]:
        found = stretch(language, params.text_document.uri, params.range)
        if found is None:
            return []
        reading, positions, file, start, end = found
        names = [
            types.InlayHint(
                position=positions.theirs(file, each.position), label=f"{each.name}:",
                kind=types.InlayHintKind.Parameter, padding_right=True,
            )
            for each in hints(reading, file, start, end)
        ]  # fmt: skip
        checks = embedded(reading, file, start, end) if language.checks else []
        return names + [
            types.InlayHint(
                position=positions.theirs(file, each.position), label=each.label, tooltip=each.about, padding_left=True
            )
            for each in checks
        ]

    @server.feature(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_RANGE, types.SemanticTokensLegend(list(KINDS), list(MODIFIERS)))
    def semantic_tokens_range(params: types.SemanticTokensRangeParams) -> types.SemanticTokens | None:
        found = stretch(language, params.text_document.uri, params.range)
        if found is None:
            return None
        reading, positions, file, start, end = found
        return types.SemanticTokens(list(_numbers(positions, file, tokens(reading, file, start, end))))


def _numbers(positions: Positions, file: str, found: list[Token]) -> Iterator[int]:
    """Five of each token: lines after the one before, columns after it in the same line, length, kind, modifiers as bits."""
    before = types.Position(0, 0)
    for each in found:
        at, after = positions.theirs(file, each.start), positions.theirs(file, each.end)
        yield at.line - before.line
        yield at.character - (before.character if at.line == before.line else 0)
        yield after.character - at.character
        yield KINDS.index(each.kind)
        yield sum(1 << MODIFIERS.index(modifier) for modifier in each.modifiers)
        before = at


def stretch(language: Language, uri: str, range: types.Range) -> Stretch | None:
    """What a range of a document is, in our terms."""
    found = language.file(uri)
    if found is None:
        return None
    reading, file = found
    positions = language.positions(reading)
    return reading, positions, file, positions.ours(file, range.start), positions.ours(file, range.end)
