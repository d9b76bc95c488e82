"""A client that is not ours (pytest-lsp) at `scanbench lsp`, on a folder with some files."""

import asyncio
import sys
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from pathlib import Path
from typing import TypeVar

from lsprotocol import types
from pytest_lsp import LanguageClient, make_test_lsp_client

A = TypeVar("A")


@asynccontextmanager
async def connected(
    folder: Path,
    capabilities: types.ClientCapabilities,
    on_register: Callable[[types.RegistrationParams], None],
    locale: str | None,
    wanted: types.LSPAny = None,
) -> AsyncIterator[LanguageClient]:
    """Initialised; the server has ended afterwards."""
    client = make_test_lsp_client()
    client.feature(types.CLIENT_REGISTER_CAPABILITY)(on_register)
    await client.start_io(sys.executable, "-m", "scanbench", "lsp")
    root = types.WorkspaceFolder(folder.as_uri(), folder.name)
    await client.initialize_session(
        types.InitializeParams(
            capabilities=capabilities, workspace_folders=[root], locale=locale, initialization_options=wanted
        )
    )
    try:
        yield client
    finally:
        await client.shutdown_session()
        await client.stop()  # type: ignore[no-untyped-call]  # pygls


def conversation(
    folder: Path,
    talk: Callable[[LanguageClient], Awaitable[A]],
    capabilities: types.ClientCapabilities | None = None,
    on_register: Callable[[types.RegistrationParams], None] = lambda _: None,
    locale: str | None = None,
    wanted: types.LSPAny = None,
) -> A:
    """What is said to a server of a folder, in a loop of its own; `wanted` are its options."""

    async def whole() -> A:
        async with connected(folder, capabilities or types.ClientCapabilities(), on_register, locale, wanted) as client:
            return await talk(client)

    return asyncio.run(whole())


def opened(client: LanguageClient, path: Path, text: str | None = None) -> types.TextDocumentIdentifier:
    """Opens a file in the editor, perhaps with a text that is not saved."""
    uri = path.as_uri()
    said = path.read_text("utf-8") if text is None else text
    client.text_document_did_open(types.DidOpenTextDocumentParams(types.TextDocumentItem(uri, "st", 1, said)))
    return types.TextDocumentIdentifier(uri)
