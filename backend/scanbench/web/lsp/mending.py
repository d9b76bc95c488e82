"""Quick fixes, and the layout of a document."""

from lsprotocol import types

from scanbench.language.fixes import fixes
from scanbench.language.format import edits, formatted
from scanbench.language.on_type import TRIGGERS, may_finish, typed
from scanbench.web.lsp.language import Language


def register(language: Language) -> None:
    server = language.server

    @server.feature(
        types.TEXT_DOCUMENT_CODE_ACTION, types.CodeActionOptions(code_action_kinds=[types.CodeActionKind.QuickFix])
    )
    def code_action(params: types.CodeActionParams) -> list[types.CodeAction]:
        uri = params.text_document.uri
        asked = language.asked(uri, params.range.start)
        if asked is None:
            return []
        end = asked.positions.ours(asked.file, params.range.end)
        found = fixes(asked.reading, asked.file, asked.position, end)
        return [
            types.CodeAction(
                title=each.title, kind=types.CodeActionKind.QuickFix, is_preferred=len(found) == 1,
                edit=types.WorkspaceEdit(
                    {uri: [types.TextEdit(asked.positions.between(asked.file, each.start, each.end), each.text)]}
                ),
            )
            for each in found
        ]  # fmt: skip

    @server.feature(types.TEXT_DOCUMENT_FORMATTING)
    def formatting(params: types.DocumentFormattingParams) -> list[types.TextEdit] | None:
        return layout(language, params.text_document.uri, None)

    @server.feature(types.TEXT_DOCUMENT_RANGE_FORMATTING)
    def range_formatting(params: types.DocumentRangeFormattingParams) -> list[types.TextEdit] | None:
        return layout(language, params.text_document.uri, params.range)

    @server.feature(
        types.TEXT_DOCUMENT_ON_TYPE_FORMATTING,
        types.DocumentOnTypeFormattingOptions(TRIGGERS[0], more_trigger_character=list(TRIGGERS[1:])),
    )
    def on_type_formatting(params: types.DocumentOnTypeFormattingParams) -> list[types.TextEdit] | None:
        uri, where = params.text_document.uri, params.position
        lines = server.workspace.get_text_document(uri).lines
        # asked after every letter that an END_ may end with, so the text is not checked for that
        if not may_finish(lines[where.line][: where.character] if where.line < len(lines) else "", params.ch):
            return None
        asked = language.asked(uri, where)
        if asked is None:
            return None
        return [
            types.TextEdit(asked.positions.between(asked.file, each.start, each.end), each.text)
            for each in typed(asked.reading, asked.file, asked.position, params.ch)
        ]


def layout(language: Language, uri: str, lines: types.Range | None) -> list[types.TextEdit] | None:
    """The edits that format a document, or some lines of it; None for one that cannot be read."""
    found = language.file(uri)
    if found is None:
        return None
    reading, file = found
    text = reading.text(file)
    made = formatted(file, text)
    if made is None:
        return None
    first, last = (0, None) if lines is None else (lines.start.line, lines.end.line)
    return [
        types.TextEdit(
            types.Range(types.Position(each.first, 0), types.Position(each.after, 0)),
            "".join(f"{line}\n" for line in each.lines),
        )
        for each in edits(text, made, first, last)
    ]
