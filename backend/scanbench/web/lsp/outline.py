"""What a document and the project declare, and what can be folded."""

from lsprotocol import types

from scanbench.language.entry import Entry, EntryKind
from scanbench.language.symbols import entries, find
from scanbench.web.lsp.language import Language
from scanbench.web.lsp.positions import Positions

KINDS: dict[EntryKind, types.SymbolKind] = {
    "program": types.SymbolKind.Module, "function": types.SymbolKind.Function, "block": types.SymbolKind.Class,
    "class": types.SymbolKind.Class, "interface": types.SymbolKind.Interface, "method": types.SymbolKind.Method,
    "property": types.SymbolKind.Property, "variable": types.SymbolKind.Variable, "constant": types.SymbolKind.Constant,
    "type": types.SymbolKind.Struct, "enumeration": types.SymbolKind.Enum, "value": types.SymbolKind.EnumMember,
    "member": types.SymbolKind.Field, "configuration": types.SymbolKind.Namespace, "task": types.SymbolKind.Event,
    "instance": types.SymbolKind.Object, "section": types.SymbolKind.Package, "statement": types.SymbolKind.Operator,
}  # fmt: skip


def register(language: Language) -> None:
    server = language.server

    @server.feature(types.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    def document_symbol(params: types.DocumentSymbolParams) -> list[types.DocumentSymbol]:
        found = language.file(params.text_document.uri)
        if found is None:
            return []
        reading, file = found
        positions = language.positions(reading)
        return [_symbol(positions, file, each) for each in entries(reading, file, language.statements)]

    @server.feature(types.WORKSPACE_SYMBOL)
    def workspace_symbol(params: types.WorkspaceSymbolParams) -> list[types.WorkspaceSymbol]:
        if language.project is None:
            return []
        reading = language.project.reading
        positions = language.positions(reading)
        return [
            types.WorkspaceSymbol(
                name=each.name, kind=KINDS[each.kind], container_name=around or each.span.file,
                location=types.Location(language.uri(each.span.file), positions.span(each.span)),
            )
            for each, around in find(reading, params.query)
        ]  # fmt: skip

    @server.feature(types.TEXT_DOCUMENT_FOLDING_RANGE)
    def folding_range(params: types.FoldingRangeParams) -> list[types.FoldingRange]:
        found = language.file(params.text_document.uri)
        if found is None:
            return []
        reading, file = found
        made = []
        for start, block in reading.blocks(file):
            for each in block.walk():
                first = reading.place(file, start + each.start)[0] - 1
                last = reading.place(file, start + each.end)[0] - 1
                if last - each.closed > first:
                    made.append(types.FoldingRange(first, last - each.closed))
        return made


def _symbol(positions: Positions, file: str, entry: Entry) -> types.DocumentSymbol:
    return types.DocumentSymbol(
        name=entry.name, kind=KINDS[entry.kind], detail=entry.detail or None,
        range=positions.between(file, entry.start, entry.end), selection_range=positions.span(entry.span),
        children=[_symbol(positions, file, each) for each in entry.inner] or None,
    )  # fmt: skip
