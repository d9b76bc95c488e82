"""New names."""

from lsprotocol import types
from pygls.exceptions import JsonRpcInvalidParams

from scanbench.language.rename import CannotRename, changed_meaning, places, refusal
from scanbench.web.lsp.language import Language


def register(language: Language) -> None:
    server = language.server

    @server.feature(types.TEXT_DOCUMENT_PREPARE_RENAME)
    def prepare_rename(params: types.PrepareRenameParams) -> types.PrepareRenamePlaceholder | None:
        asked = language.asked(params.text_document.uri, params.position)
        found = None if asked is None else asked.name
        if asked is None or found is None:
            return None
        why = refusal(asked.reading, found.symbol)
        if why is not None:
            raise JsonRpcInvalidParams(why.message)
        return types.PrepareRenamePlaceholder(asked.positions.occurrence(found), asked.reading.written(found.span))

    @server.feature(types.TEXT_DOCUMENT_RENAME, types.RenameOptions(prepare_provider=True))
    def rename(params: types.RenameParams) -> types.WorkspaceEdit | None:
        asked = language.asked(params.text_document.uri, params.position)
        found = None if asked is None else asked.name
        if asked is None or found is None:
            return None
        named = places(asked.reading, found.symbol, params.new_name)
        if isinstance(named, CannotRename):
            raise JsonRpcInvalidParams(named.message)
        changes: dict[str, list[types.TextEdit]] = {}
        for each in named:
            edit = types.TextEdit(asked.positions.occurrence(each), params.new_name)
            changes.setdefault(language.uri(each.span.file), []).append(edit)
        assert language.project is not None
        why = changed_meaning(asked.reading, named, params.new_name, language.project.tried)
        if why is not None:
            raise JsonRpcInvalidParams(why.message)
        return types.WorkspaceEdit(changes)
