"""The language server with a client that is not ours: each request once; what is answered is shown in `tests/language`."""

from pathlib import Path
from typing import Any

import pytest
from lsprotocol import types
from pygls.exceptions import JsonRpcException
from pytest_lsp import LanguageClient

from scanbench.web.lsp.server import make_server
from scanbench.web.lsp.stdio import folder_of
from tests.amounts import slow
from tests.lsp.client import conversation, opened

BLOCK = """\
(* Counts its calls. *)
FUNCTION_BLOCK Inc
VAR_INPUT by : INT; END_VAR
VAR_OUTPUT n : INT; END_VAR
n := n + by;
END_FUNCTION_BLOCK
"""
MAIN = """\
PROGRAM Main
VAR
  inc : Inc;
  名前, total : INT; // 数
END_VAR
inc(by := 2);
total := inc.n; (* 数 𝒳 *) total := total + 1;
IF total > 100 THEN
  total := 0;
END_IF;
END_PROGRAM
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "inc.st").write_text(BLOCK, "utf-8")
    (tmp_path / "main.st").write_text(MAIN, "utf-8")
    (tmp_path / "project.json").write_text('{"name": "Plant", "model": "CJ1M-CPU63"}', "utf-8")
    return tmp_path


def position(text: str, what: str, after: int = 0) -> types.Position:
    """In UTF-16 units, as clients count."""
    at = text.index(what) + after
    line = text.count("\n", 0, at)
    return types.Position(line, len(text[text.rfind("\n", 0, at) + 1 : at].encode("utf-16-le")) // 2)


def test_names_are_found_over_files_and_behind_wide_characters(folder: Path) -> None:
    async def talk(client: LanguageClient) -> None:
        doc = opened(client, folder / "main.st")
        found = await client.text_document_definition_async(types.DefinitionParams(doc, position(MAIN, "inc.n", 4)))
        assert isinstance(found, list | tuple)
        assert [(each.uri, each.range.start.line) for each in found if isinstance(each, types.Location)] == [
            ((folder / "inc.st").as_uri(), 3)
        ]
        wide = position(MAIN, "total := total")
        uses = await client.text_document_references_async(
            types.ReferenceParams(types.ReferenceContext(True), doc, wide)
        )
        assert uses is not None
        assert wide in [each.range.start for each in uses]
        assert len(uses) == 6
        marks = await client.text_document_document_highlight_async(types.DocumentHighlightParams(doc, wide))
        assert marks is not None
        assert sum(each.kind is types.DocumentHighlightKind.Write for each in marks) == 3
        hover = await client.text_document_hover_async(types.HoverParams(doc, position(MAIN, "Inc;")))
        assert hover is not None
        assert isinstance(hover.contents, types.MarkupContent)
        assert "Counts its calls." in hover.contents.value

    conversation(folder, talk)


def test_unsaved_text_counts_and_problems_go_when_they_are_mended(folder: Path) -> None:
    async def talk(client: LanguageClient) -> None:
        uri = (folder / "main.st").as_uri()
        doc = opened(client, folder / "main.st", MAIN.replace("inc.n", "inc.m"))
        await client.wait_for_notification(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        (problem,) = client.diagnostics[uri]
        assert (problem.code, problem.range.start) == ("T001", position(MAIN, "inc.n"))
        edit = types.TextDocumentContentChangePartial(
            range=types.Range(position(MAIN, "inc.n", 4), position(MAIN, "inc.n", 5)), text="n"
        )
        versioned = types.VersionedTextDocumentIdentifier(2, doc.uri)
        client.text_document_did_change(types.DidChangeTextDocumentParams(versioned, [edit]))
        await client.wait_for_notification(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        assert not client.diagnostics[uri]

    conversation(folder, talk)


def test_files_that_change_on_the_disk_count_and_those_outside_do_not(
    folder: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    watching = types.DidChangeWatchedFilesClientCapabilities(dynamic_registration=True)
    workspace = types.WorkspaceClientCapabilities(did_change_watched_files=watching)
    outside = tmp_path_factory.mktemp("outside") / "main.st"
    outside.write_text(MAIN, "utf-8")
    registered: list[types.Registration] = []

    def register(params: types.RegistrationParams) -> None:
        registered.extend(params.registrations)

    async def talk(client: LanguageClient) -> None:
        doc = opened(client, folder / "main.st")
        opened(client, outside)
        while doc.uri not in client.diagnostics:
            await client.wait_for_notification(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        assert not client.diagnostics[doc.uri]
        assert outside.as_uri() not in client.diagnostics
        where = types.TextDocumentIdentifier(outside.as_uri()), position(MAIN, "Inc;")
        assert await client.text_document_hover_async(types.HoverParams(*where)) is None
        assert [each.method for each in registered] == [types.WORKSPACE_DID_CHANGE_WATCHED_FILES]
        (folder / "inc.st").unlink()
        gone = types.FileEvent((folder / "inc.st").as_uri(), types.FileChangeType.Deleted)
        client.workspace_did_change_watched_files(types.DidChangeWatchedFilesParams([gone]))
        while not client.diagnostics[doc.uri]:
            await client.wait_for_notification(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        assert "Inc" in client.diagnostics[doc.uri][0].message

    conversation(folder, talk, types.ClientCapabilities(workspace=workspace), register)


def test_completion_signatures_symbols_and_folding(folder: Path) -> None:
    async def talk(client: LanguageClient) -> None:
        doc = opened(client, folder / "main.st")
        found = await client.text_document_completion_async(types.CompletionParams(doc, position(MAIN, "inc.n", 4)))
        assert isinstance(found, types.CompletionList)
        assert [each.label for each in found.items] == ["by", "n"]
        told = await client.completion_item_resolve_async(found.items[0])
        assert isinstance(told.documentation, types.MarkupContent)
        assert "VAR_INPUT by : INT" in told.documentation.value
        call = await client.text_document_signature_help_async(
            types.SignatureHelpParams(doc, position(MAIN, "by := 2"))
        )
        assert call is not None
        assert call.signatures[0].label == "inc(by : INT, n => INT)"
        outline = await client.text_document_document_symbol_async(types.DocumentSymbolParams(doc))
        assert outline is not None
        (main,) = outline
        assert isinstance(main, types.DocumentSymbol)
        (section,) = main.children or ()
        assert (section.name, [each.name for each in section.children or ()]) == ("VAR", ["inc", "名前", "total"])
        everywhere = await client.workspace_symbol_async(types.WorkspaceSymbolParams("in"))
        assert everywhere is not None
        assert [each.name for each in everywhere] == ["Inc", "Main"]
        folds = await client.text_document_folding_range_async(types.FoldingRangeParams(doc))
        assert folds is not None
        assert [(each.start_line, each.end_line) for each in folds] == [(0, 9), (1, 3), (7, 8)]

    conversation(folder, talk)


@slow
def test_a_client_may_want_statements_among_the_symbols(folder: Path) -> None:
    async def talk(client: LanguageClient) -> list[str]:
        doc = opened(client, folder / "main.st")
        outline = await client.text_document_document_symbol_async(types.DocumentSymbolParams(doc))
        assert outline is not None
        return [
            child.name for each in outline if isinstance(each, types.DocumentSymbol) for child in each.children or ()
        ]

    assert conversation(folder, talk) == ["VAR"]
    assert conversation(folder, talk, wanted={"statements": True}) == ["VAR", "IF total > 100"]


def test_a_name_is_renamed_in_all_files_or_the_reason_is_told(folder: Path) -> None:
    async def talk(client: LanguageClient) -> None:
        doc = opened(client, folder / "main.st")
        where = position(MAIN, "inc.n", 4)
        edit = await client.text_document_rename_async(types.RenameParams(doc, where, "count"))
        assert edit is not None
        assert edit.changes is not None
        assert {Path(uri).name: len(edits) for uri, edits in edit.changes.items()} == {"inc.st": 3, "main.st": 1}
        with pytest.raises(JsonRpcException, match="declared already"):
            await client.text_document_rename_async(types.RenameParams(doc, where, "by"))

    conversation(folder, talk)


def test_a_document_and_some_of_its_lines_are_formatted(folder: Path) -> None:
    async def talk(client: LanguageClient) -> None:
        doc = opened(client, folder / "main.st", "PROGRAM Main\nVAR n:INT; END_VAR\nn:=1;\nn:=2;\nEND_PROGRAM\n")
        options = types.FormattingOptions(tab_size=2, insert_spaces=True)
        edits = await client.text_document_formatting_async(types.DocumentFormattingParams(doc, options))
        assert edits is not None
        assert [each.new_text for each in edits] == ["VAR n : INT; END_VAR\n", "  n := 1;\n", "  n := 2;\n"]
        line = types.Range(types.Position(3, 0), types.Position(3, 0))
        some = await client.text_document_range_formatting_async(
            types.DocumentRangeFormattingParams(doc, line, options)
        )
        assert some is not None
        assert [each.new_text for each in some] == ["  n := 2;\n"]

    conversation(folder, talk)


@slow
def test_what_was_typed_is_formatted(folder: Path) -> None:
    async def talk(client: LanguageClient) -> None:
        doc = opened(client, folder / "main.st", "PROGRAM Main\nVAR 数:INT; END_VAR\nIF 数>1 THEN\n数:=1;\n  END_IF\n")
        options = types.FormattingOptions(tab_size=2, insert_spaces=True)

        async def after(ch: str, line: int, character: int) -> list[tuple[int, str]]:
            asked = types.DocumentOnTypeFormattingParams(doc, types.Position(line, character), ch, options)
            edits = await client.text_document_on_type_formatting_async(asked)
            return [(each.range.start.line, each.new_text) for each in edits or ()]

        assert await after("\n", 4, 0) == [(3, "    数 := ")]
        assert await after(";", 3, 5) == [(3, "    数 := ")]
        assert await after("F", 4, 8) == []
        assert await after("N", 0, 5) == []

    conversation(folder, talk)


def test_a_problem_can_be_mended(folder: Path) -> None:
    async def talk(client: LanguageClient) -> None:
        text = MAIN.replace("total := inc.n", "totl := inc.n")
        doc = opened(client, folder / "main.st", text)
        where = types.Range(position(text, "totl"), position(text, "totl"))
        context = types.CodeActionContext(diagnostics=[])
        found = await client.text_document_code_action_async(types.CodeActionParams(doc, where, context))
        assert found is not None
        assert [each.title for each in found] == ["Change to total", "Declare totl : INT"]

    conversation(folder, talk)


@slow
def test_arguments_show_their_parameters(folder: Path) -> None:
    async def talk(client: LanguageClient) -> None:
        text = MAIN.replace("total := 0;", "(* 𝒳 *) total := LIMIT(0, total, 9);")
        doc = opened(client, folder / "main.st", text)
        whole = types.Range(types.Position(0, 0), types.Position(99, 0))
        found = await client.text_document_inlay_hint_async(types.InlayHintParams(doc, whole))
        assert found is not None
        assert [(each.label, each.position) for each in found] == [
            ("MN:", position(text, "0, total")), ("IN:", position(text, "total, 9")), ("MX:", position(text, "9);")),
        ]  # fmt: skip

    conversation(folder, talk)


@slow
def test_checks_of_subranges_are_hints_where_a_client_wants_them(folder: Path) -> None:
    async def talk(client: LanguageClient) -> list[types.InlayHint]:
        text = MAIN.replace("total : INT", "total : INT(0..200)").replace("total > 100", "total > 200")
        doc = opened(client, folder / "main.st", text)
        whole = types.Range(types.Position(0, 0), types.Position(99, 0))
        return list(await client.text_document_inlay_hint_async(types.InlayHintParams(doc, whole)) or [])

    assert conversation(folder, talk) == []
    found = conversation(folder, talk, locale="ja", wanted={"embeddedChecks": True})
    assert [(each.label, each.position.line, each.tooltip) for each in found[:2]] == [
        ("⊂ 0..200", 6, "実行時に検査: `total` は 0..200"),
        ("✓ 0..200", 6, "`total` の検査は不要: 7 行でチェック付きで代入済み"),
    ]


def test_names_are_told_by_their_kind(folder: Path) -> None:
    async def talk(client: LanguageClient) -> None:
        text = MAIN.replace("total > 100", "total > LEN('𝒳')")
        doc = opened(client, folder / "main.st", text)
        lines = types.Range(types.Position(6, 0), types.Position(8, 0))
        found = await client.text_document_semantic_tokens_range_async(types.SemanticTokensRangeParams(doc, lines))
        assert found is not None
        variable, parameter, function, library = 0, 1, 3, 4
        assert [list(found.data[each : each + 5]) for each in range(0, len(found.data), 5)] == [
            [6, 0, 5, variable, 0], [0, 9, 3, variable, 0], [0, 4, 1, parameter, 0],
            [0, 14, 5, variable, 0], [0, 9, 5, variable, 0],
            [1, 3, 5, variable, 0], [0, 8, 3, function, library],
        ]  # fmt: skip

    conversation(folder, talk)


def test_callers_and_what_is_called(folder: Path) -> None:
    async def talk(client: LanguageClient) -> None:
        doc = opened(client, folder / "main.st")
        where = types.CallHierarchyPrepareParams(doc, position(MAIN, "inc(by"))
        found = await client.text_document_prepare_call_hierarchy_async(where)
        assert found is not None
        assert [(each.name, Path(each.uri).name, each.range.end.line) for each in found] == [("Inc", "inc.st", 5)]
        callers = await client.call_hierarchy_incoming_calls_async(types.CallHierarchyIncomingCallsParams(found[0]))
        assert callers is not None
        assert [(each.from_.name, each.from_ranges[0].start) for each in callers] == [
            ("Main", position(MAIN, "inc(by"))
        ]
        main = types.CallHierarchyOutgoingCallsParams(callers[0].from_)
        called = await client.call_hierarchy_outgoing_calls_async(main)
        assert called is not None
        assert [(each.to.name, each.from_ranges[0].start) for each in called] == [("Inc", position(MAIN, "inc(by"))]

    conversation(folder, talk)


@slow
def test_a_block_says_how_many_instances_it_has_and_how_often_it_is_named(folder: Path) -> None:
    async def talk(client: LanguageClient) -> list[types.Command]:
        doc = opened(client, folder / "inc.st")
        found = await client.text_document_code_lens_async(types.CodeLensParams(doc))
        assert found is not None
        assert [(each.range.start, each.command) for each in found] == [(position(BLOCK, "Inc"), None)] * 2
        told = [(await client.code_lens_resolve_async(each)).command for each in found]
        return [each for each in told if each is not None]

    assert [(each.title, each.command) for each in conversation(folder, talk)] == [
        ("1 instance", ""),
        ("1 reference", ""),
    ]
    where = ((folder / "inc.st").as_uri(), {"line": 1, "character": 15})
    lists = conversation(folder, talk, locale="ja", wanted={"lists": True})
    assert [(each.title, each.command, each.arguments) for each in lists] == [
        ("インスタンス 1 個", "scanbench.showInstances", where), ("参照 1 件", "scanbench.showReferences", where),
    ]  # fmt: skip

    async def listed(client: LanguageClient) -> list[tuple[str, int]]:
        place = {"textDocument": {"uri": (folder / "inc.st").as_uri()}, "position": where[1]}
        asked = client.protocol.send_request_async("scanbench/instances", place)  # type: ignore[no-untyped-call]  # pygls
        found = await asked
        return [(Path(each["uri"]).name, each["range"]["start"]["line"]) for each in found]

    assert conversation(folder, listed) == [("main.st", 2)]
    (folder / "main.st").write_text(MAIN.replace("inc(by := 2);", "inc(by := ;"), "utf-8")
    assert [each.title for each in conversation(folder, talk)] == ["instances not known", "at least 1 reference"]


def test_cross_references_and_what_nobody_reads_are_requests_of_our_own(folder: Path) -> None:
    async def talk(client: LanguageClient) -> None:
        async def ask(method: str, **params: Any) -> Any:
            return await client.protocol.send_request_async(f"scanbench/{method}", params)  # type: ignore[no-untyped-call]  # pygls

        doc = opened(client, folder / "main.st")
        at = position(MAIN, "total :=")
        where = {"line": at.line, "character": at.character}
        first, second, *_ = await ask("boxes", textDocument={"uri": doc.uri}, position=where)
        assert [first[key] for key in ("name", "type", "inputs", "outputs")] == ["inc", "Inc", ["by"], ["n"]]
        assert [second[key] for key in ("name", "kind", "comment")] == ["Inc", "block", "Counts its calls."]
        told = await ask("crossReferences", textDocument={"uri": doc.uri}, position=where)
        assert told.name == "total"
        assert told.complete
        assert [each.access for each in told.references] == [
            "declared",
            "written",
            "written",
            "read",
            "read",
            "written",
        ]
        assert told.references[1].pou == "Main"
        again = await ask("crossReferences", symbol=told.symbol)
        assert again == told
        by_path = await ask("crossReferences", path="Main.inc.n")
        assert [Path(each.uri).name for each in by_path.references] == ["inc.st", "inc.st", "inc.st", "main.st"]
        assert (await ask("crossReferences", path="Main.nothing")).symbol is None
        lonely = await ask("unused")
        assert lonely.complete
        assert [(each.name, each.written, each.pou) for each in lonely.unused] == [("名前", False, "Main")]
        opened(client, folder / "inc.st", BLOCK.replace("n + by", "n + bi"))
        broken = await ask("unused")
        assert (broken.complete, broken.unused) == (False, [])

    conversation(folder, talk)


class Closed:
    """The end of a client that is gone."""

    writes = 0

    def write(self, _: bytes) -> None:
        self.writes += 1
        raise ValueError("write to closed file")

    def close(self) -> None: ...


def test_what_cannot_be_sent_is_not_reported_by_sending() -> None:
    closed = Closed()
    server = make_server(folder_of)
    server.protocol.set_writer(closed)
    server.window_show_message(types.ShowMessageParams(types.MessageType.Info, "Is anybody there?"))
    assert closed.writes == 1
