"""`python -m bench lsp`: the language server on 10,000 lines, asked by a client that is not ours, after an edit each time.

p50 and p95 in milliseconds over the streams; the edit is in a block of 66 lines, as most are. `problems`: from the edit to the list of
problems, without the moment that the server waits for more (`QUIET_S`).
"""

import argparse
import asyncio
import json
import sys
import tempfile
import time
from collections.abc import Awaitable, Callable
from pathlib import Path

from lsprotocol import types
from pytest_lsp import LanguageClient, make_test_lsp_client

from bench.large import large
from scanbench.web.lsp.language import QUIET_S

ROUNDS = 40


class Bench:
    """One server with one large file."""

    def __init__(self, client: LanguageClient, path: Path, text: str) -> None:
        self.client, self.text = client, text
        self.document = types.TextDocumentIdentifier(path.as_uri())
        self._line = next(number for number, line in enumerate(text.split("\n")) if "tmr(IN" in line)
        self._version = 1

    def position(self, what: str, after: int = 0) -> types.Position:
        at = self.text.index(what) + after
        return types.Position(self.text.count("\n", 0, at), at - self.text.rfind("\n", 0, at) - 1)

    async def edit(self) -> float:
        """Types a blank, and waits for the problems; how long that took."""
        begin = time.perf_counter()
        self._version += 1
        where = types.Position(self._line, 0)
        change = types.TextDocumentContentChangePartial(range=types.Range(where, where), text=" ")
        document = types.VersionedTextDocumentIdentifier(self._version, self.document.uri)
        self.client.text_document_did_change(types.DidChangeTextDocumentParams(document, [change]))
        await self.client.wait_for_notification(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        return time.perf_counter() - begin - QUIET_S

    async def measure(self, ask: Callable[[], Awaitable[object]] | None) -> tuple[float, float]:
        """p50 and p95 in ms of a question after an edit, or of the problems after it."""
        took = []
        for _ in range(ROUNDS):
            told = await self.edit()
            begin = time.perf_counter()
            if ask is not None:
                await ask()
            took.append(told if ask is None else time.perf_counter() - begin)
        took.sort()
        return 1000 * took[len(took) // 2], 1000 * took[int(0.95 * len(took))]


async def measured(folder: Path) -> dict[str, dict[str, float]]:
    """All figures, by what was asked."""
    text = large("big10k")
    path = folder / "big10k.st"
    path.write_text(text, "utf-8")
    client = make_test_lsp_client()
    await client.start_io(sys.executable, "-m", "scanbench", "lsp")
    begin = time.perf_counter()
    root = types.WorkspaceFolder(folder.as_uri(), folder.name)
    await client.initialize_session(
        types.InitializeParams(capabilities=types.ClientCapabilities(), workspace_folders=[root])
    )
    bench = Bench(client, path, text)
    client.text_document_did_open(
        types.DidOpenTextDocumentParams(types.TextDocumentItem(bench.document.uri, "st", 1, text))
    )
    await client.wait_for_notification(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
    first = 1000 * (time.perf_counter() - begin)
    doc, unit, member, cyc = (
        bench.document,
        bench.position("u5(", 1),
        bench.position("u5.", 3),
        bench.position("cyc :", 1),
    )
    screen = types.Range(types.Position(5000, 0), types.Position(5060, 0))
    asked: dict[str, Callable[[], Awaitable[object]] | None] = {
        "problems": None,
        "completion": lambda: client.text_document_completion_async(types.CompletionParams(doc, unit)),
        "completion of members": lambda: client.text_document_completion_async(types.CompletionParams(doc, member)),
        "hover": lambda: client.text_document_hover_async(types.HoverParams(doc, unit)),
        "definition": lambda: client.text_document_definition_async(types.DefinitionParams(doc, unit)),
        "references": lambda: client.text_document_references_async(
            types.ReferenceParams(types.ReferenceContext(True), doc, cyc)
        ),
        "rename": lambda: client.text_document_rename_async(types.RenameParams(doc, cyc, "cycles")),
        "rename to a known name": lambda: client.text_document_rename_async(types.RenameParams(doc, cyc, "cnt")),
        "hints of a screen": lambda: client.text_document_inlay_hint_async(types.InlayHintParams(doc, screen)),
        "kinds of names": lambda: client.text_document_semantic_tokens_range_async(
            types.SemanticTokensRangeParams(doc, screen)
        ),
        "numbers above a screen": lambda: numbers(client, doc, screen),
        "symbols of the file": lambda: client.text_document_document_symbol_async(types.DocumentSymbolParams(doc)),
        "formatting": lambda: client.text_document_formatting_async(
            types.DocumentFormattingParams(doc, types.FormattingOptions(2, True))
        ),
    }
    found: dict[str, dict[str, float]] = {"first problems": {"p50_ms": first, "p95_ms": first}}
    for name, ask in asked.items():
        p50, p95 = await bench.measure(ask)
        found[name] = {"p50_ms": p50, "p95_ms": p95}
    assert client._server is not None
    found["memory"] = {"mb": memory(client._server.pid)}
    await client.shutdown_session()
    await client.stop()  # type: ignore[no-untyped-call]  # pygls
    return found


async def numbers(client: LanguageClient, doc: types.TextDocumentIdentifier, screen: types.Range) -> None:
    """Lists the lenses of a document, and counts those that are on the screen, as an editor does."""
    found = await client.text_document_code_lens_async(types.CodeLensParams(doc)) or []
    seen = [each for each in found if screen.start.line <= each.range.start.line < screen.end.line]
    for each in seen:
        await client.code_lens_resolve_async(each)


def memory(pid: int) -> float:
    """What a process has in memory, in MB."""
    status = Path(f"/proc/{pid}/status").read_text("utf-8")
    return int(status.partition("VmRSS:")[2].split()[0]) / 1024


def main() -> None:
    """Prints the figures."""
    parser = argparse.ArgumentParser(prog="python -m bench lsp", description=__doc__)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        found = asyncio.run(measured(Path(folder)))
    print(json.dumps(found) if given.json else "\n".join(map(shown, found, found.values())))  # noqa: T201


def shown(name: str, figures: dict[str, float]) -> str:
    """One line."""
    if name == "memory":
        return f"{name:22} {figures['mb']:8.0f} MB"
    return f"{name:22} {figures['p50_ms']:8.1f} ms   p95 {figures['p95_ms']:8.1f} ms"


if __name__ == "__main__":
    main()
