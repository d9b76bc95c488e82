"""Who calls whom."""

from lsprotocol import types

from scanbench.check.uses import Symbol, SymbolKind
from scanbench.language.calls import Party, incoming, outgoing, party_at
from scanbench.language.reading import Reading
from scanbench.web.lsp.language import Language
from scanbench.web.lsp.outline import KINDS
from scanbench.web.lsp.positions import Positions


def register(language: Language) -> None:
    server = language.server

    @server.feature(types.TEXT_DOCUMENT_PREPARE_CALL_HIERARCHY)
    def prepare(params: types.CallHierarchyPrepareParams) -> list[types.CallHierarchyItem] | None:
        asked = language.asked(params.text_document.uri, params.position)
        found = None if asked is None else party_at(asked.reading, asked.file, asked.position)
        return None if asked is None or found is None else [_item(language, asked.positions, found)]

    @server.feature(types.CALL_HIERARCHY_INCOMING_CALLS)
    def callers(params: types.CallHierarchyIncomingCallsParams) -> list[types.CallHierarchyIncomingCall]:
        asked = _asked(language, params.item)
        if asked is None:
            return []
        reading, positions, symbol = asked
        return [
            types.CallHierarchyIncomingCall(
                _item(language, positions, each.party), [positions.span(name) for name in each.names]
            )
            for each in incoming(reading, symbol)
        ]

    @server.feature(types.CALL_HIERARCHY_OUTGOING_CALLS)
    def called(params: types.CallHierarchyOutgoingCallsParams) -> list[types.CallHierarchyOutgoingCall]:
        asked = _asked(language, params.item)
        if asked is None:
            return []
        reading, positions, symbol = asked
        return [
            types.CallHierarchyOutgoingCall(
                _item(language, positions, each.party), [positions.span(name) for name in each.names]
            )
            for each in outgoing(reading, symbol)
        ]


def _item(language: Language, positions: Positions, party: Party) -> types.CallHierarchyItem:
    entry = party.entry
    return types.CallHierarchyItem(
        name=entry.name, kind=KINDS[entry.kind], uri=language.uri(entry.span.file), detail=entry.detail or None,
        range=positions.between(entry.span.file, entry.start, entry.end), selection_range=positions.span(entry.span),
        data=list(party.symbol),
    )  # fmt: skip


def _asked(language: Language, item: types.CallHierarchyItem) -> tuple[Reading, Positions, Symbol] | None:
    """What an item that this server made is about, in the newest state of the texts."""
    symbol = symbol_in(item.data)
    if language.project is None or symbol is None:
        return None
    reading = language.project.reading
    return reading, language.positions(reading), symbol


def symbol_in(data: object) -> Symbol | None:
    """The symbol that an answer of this server carries, when a client sends it back."""
    kinds: dict[object, SymbolKind] = {"pou": "pou", "method": "method"}
    match data:
        case [str(kind), str(owner), str(name)] if kind in kinds:
            return Symbol(kinds[kind], owner, name)
    return None
