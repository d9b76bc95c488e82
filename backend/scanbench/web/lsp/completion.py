"""What may be written, and what a call expects."""

from lsprotocol import types

from scanbench.check.uses import Symbol
from scanbench.language.complete import Item, ItemKind, complete
from scanbench.language.describe import describe
from scanbench.language.signature import signature_at
from scanbench.translation.inside import paragraphs
from scanbench.web.lsp.language import Language
from scanbench.web.lsp.navigation import markdown

KINDS: dict[ItemKind, types.CompletionItemKind] = {
    "variable": types.CompletionItemKind.Variable, "constant": types.CompletionItemKind.Constant,
    "member": types.CompletionItemKind.Field, "method": types.CompletionItemKind.Method,
    "property": types.CompletionItemKind.Property, "function": types.CompletionItemKind.Function,
    "block": types.CompletionItemKind.Class, "class": types.CompletionItemKind.Class,
    "interface": types.CompletionItemKind.Interface, "program": types.CompletionItemKind.Module,
    "type": types.CompletionItemKind.Struct, "value": types.CompletionItemKind.EnumMember,
    "argument": types.CompletionItemKind.Field, "keyword": types.CompletionItemKind.Keyword,
    "snippet": types.CompletionItemKind.Snippet,
}  # fmt: skip


def register(language: Language) -> None:
    server = language.server

    @server.feature(
        types.TEXT_DOCUMENT_COMPLETION, types.CompletionOptions(trigger_characters=[".", "#"], resolve_provider=True)
    )
    def completion(params: types.CompletionParams) -> types.CompletionList:
        asked = language.asked(params.text_document.uri, params.position)
        found = [] if asked is None else complete(asked.reading, asked.file, asked.position)
        seen: dict[str, Item] = {}
        for each in sorted(found, key=lambda item: item.rank):
            seen.setdefault(f"{each.label.upper()} {each.kind == 'snippet'}", each)
        return types.CompletionList(is_incomplete=False, items=[_item(each) for each in seen.values()])

    @server.feature(types.COMPLETION_ITEM_RESOLVE)
    def resolve(item: types.CompletionItem) -> types.CompletionItem:
        if language.project is not None and isinstance(item.data, list):
            kind, owner, name = item.data
            told = describe(language.project.reading, Symbol(kind, owner, name))
            if told is not None:
                item.documentation = markdown(told, language.tongue)
        return item

    @server.feature(
        types.TEXT_DOCUMENT_SIGNATURE_HELP,
        types.SignatureHelpOptions(trigger_characters=["(", ","], retrigger_characters=[","]),
    )
    def signature_help(params: types.SignatureHelpParams) -> types.SignatureHelp | None:
        asked = language.asked(params.text_document.uri, params.position)
        found = None if asked is None else signature_at(asked.reading, asked.file, asked.position)
        if found is None:
            return None
        parameters = [types.ParameterInformation(each) for each in found.parameters]
        comment = paragraphs(found.comment, language.tongue)  # only standard functions have one
        made = types.SignatureInformation(found.label, comment or None, parameters, found.active)
        return types.SignatureHelp([made], 0, found.active)


def _item(item: Item) -> types.CompletionItem:
    return types.CompletionItem(
        label=item.label,
        kind=KINDS[item.kind],
        label_details=types.CompletionItemLabelDetails(description=item.detail) if item.detail else None,
        detail=item.detail or None,
        insert_text=item.insert or None,
        insert_text_format=types.InsertTextFormat.Snippet if item.insert else None,
        sort_text=f"{item.rank}{item.label.upper()}",
        data=list(item.symbol) if item.symbol is not None else None,
    )
