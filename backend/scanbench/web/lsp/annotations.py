"""What an editor shows in a text without being asked: names of parameters, what kind of thing each name means, and
how often each POU is named."""

from collections.abc import Iterator
from typing import get_args

from lsprotocol import types

from scanbench.language.hints import hints
from scanbench.language.navigate import references
from scanbench.language.reading import Reading
from scanbench.language.tokens import Modifier, Token, TokenKind, tokens
from scanbench.web.lsp.calls import symbol_in
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
        return [
            types.InlayHint(
                position=positions.theirs(file, each.position), label=f"{each.name}:",
                kind=types.InlayHintKind.Parameter, padding_right=True,
            )
            for each in hints(reading, file, start, end)
        ]  # fmt: skip

    @server.feature(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_RANGE, types.SemanticTokensLegend(list(KINDS), list(MODIFIERS)))
    def semantic_tokens_range(params: types.SemanticTokensRangeParams) -> types.SemanticTokens | None:
        found = stretch(language, params.text_document.uri, params.range)
        if found is None:
            return None
        reading, positions, file, start, end = found
        return types.SemanticTokens(list(_numbers(positions, file, tokens(reading, file, start, end))))

    @server.feature(types.TEXT_DOCUMENT_CODE_LENS, types.CodeLensOptions(resolve_provider=True))
    def code_lens(params: types.CodeLensParams) -> list[types.CodeLens]:
        found = language.file(params.text_document.uri)
        if found is None:
            return []
        reading, file = found
        positions = language.positions(reading)
        return [
            types.CodeLens(positions.span(each.span), data=list(each.symbol))
            for each in reading.declared_in(file)
            if each.symbol.kind == "pou"
        ]

    @server.feature(types.CODE_LENS_RESOLVE)
    def resolve(lens: types.CodeLens) -> types.CodeLens:
        symbol = symbol_in(lens.data)
        if language.project is not None and symbol is not None:
            count = len(references(language.project.reading, symbol, declaration=False))
            # An empty command only shows its title, which every client can.
            lens.command = types.Command(f"{count} reference{'' if count == 1 else 's'}", "")
        return lens


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
