"""Where something is declared, used, implemented; what is said of it."""

from collections.abc import Callable

from lsprotocol import types

from scanbench.check.uses import Symbol
from scanbench.language.declared import Declared
from scanbench.language.describe import Description, describe
from scanbench.language.index import Occurrence
from scanbench.language.matching import keywords_at
from scanbench.language.navigate import definitions, implementations, references, type_definitions
from scanbench.language.reading import Reading
from scanbench.translation.inside import paragraphs
from scanbench.web.lsp.language import Asked, Language

LANGUAGE = "st"
Look = Callable[[Reading, Symbol], list[Declared]]


def register(language: Language) -> None:
    server = language.server

    @server.feature(types.TEXT_DOCUMENT_DEFINITION)
    def definition(params: types.DefinitionParams) -> list[types.Location]:
        return declarations(language, params, definitions)

    @server.feature(types.TEXT_DOCUMENT_DECLARATION)
    def declaration(params: types.DeclarationParams) -> list[types.Location]:
        return declarations(language, params, definitions)

    @server.feature(types.TEXT_DOCUMENT_TYPE_DEFINITION)
    def type_definition(params: types.TypeDefinitionParams) -> list[types.Location]:
        return declarations(language, params, type_definitions)

    @server.feature(types.TEXT_DOCUMENT_IMPLEMENTATION)
    def implementation(params: types.ImplementationParams) -> list[types.Location]:
        return declarations(language, params, implementations)

    @server.feature(types.TEXT_DOCUMENT_REFERENCES)
    def referring(params: types.ReferenceParams) -> list[types.Location]:
        asked, found = _named(language, params)
        if asked is None or found is None:
            return []
        uses = references(asked.reading, found.symbol, params.context.include_declaration)
        return [language.location(asked.positions, each) for each in uses]

    @server.feature(types.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT)
    def highlight(params: types.DocumentHighlightParams) -> list[types.DocumentHighlight]:
        return highlights(language, params)

    @server.feature(types.TEXT_DOCUMENT_HOVER)
    def hover(params: types.HoverParams) -> types.Hover | None:
        asked, found = _named(language, params)
        told = None if asked is None or found is None else describe(asked.reading, found.symbol)
        if asked is None or found is None or told is None:
            return None
        return types.Hover(markdown(told, language.tongue), asked.positions.occurrence(found))


Where = (
    types.DefinitionParams | types.DeclarationParams | types.TypeDefinitionParams | types.ImplementationParams
    | types.ReferenceParams | types.DocumentHighlightParams | types.HoverParams
)  # fmt: skip


def _named(language: Language, params: Where) -> tuple[Asked | None, Occurrence | None]:
    asked = language.asked(params.text_document.uri, params.position)
    return asked, None if asked is None else asked.name


def declarations(language: Language, params: Where, look: Look) -> list[types.Location]:
    """Where the declarations are that `look` finds for the name at a position."""
    asked, found = _named(language, params)
    if asked is None or found is None:
        return []
    return [
        types.Location(language.uri(each.span.file), asked.positions.span(each.span))
        for each in look(asked.reading, found.symbol)
        if each.span.file in asked.reading.files
    ]


def highlights(language: Language, params: types.DocumentHighlightParams) -> list[types.DocumentHighlight]:
    """All uses of a name in the file, or the keywords of the block of which one is there."""
    asked, found = _named(language, params)
    if asked is None:
        return []
    if found is None:
        return [
            types.DocumentHighlight(asked.positions.between(asked.file, start, end), types.DocumentHighlightKind.Text)
            for start, end in keywords_at(asked.reading, asked.file, asked.position)
        ]
    return [
        types.DocumentHighlight(
            asked.positions.occurrence(each),
            types.DocumentHighlightKind.Write if each.written else types.DocumentHighlightKind.Read,
        )
        for each in references(asked.reading, found.symbol, declaration=True)
        if each.span.file == asked.file
    ]


def markdown(told: Description, tongue: str) -> types.MarkupContent:
    """A description, the code in a block of its own; comments of authors are in their own language."""
    comment = told.comment if told.by_author else paragraphs(told.comment, tongue)
    parts = [f"```{LANGUAGE}\n{told.code}\n```", comment, *(paragraphs(note, tongue) for note in told.notes)]
    return types.MarkupContent(types.MarkupKind.Markdown, "\n\n".join(filter(None, parts)))
