"""`python -m tests.api_page` writes `docs/api.md` from the OpenAPI document."""

from pathlib import Path
from typing import Any

from scanbench.web.openapi import document

PAGE = Path(__file__).parents[2] / "docs" / "api.md"
HEAD = """# The REST API and the sockets

Made by `python -m tests.api_page` (in `backend/`); do not edit.

The server describes itself at `GET /api/openapi.json` (OpenAPI 3.1), from which a client can be generated. The token comes as `Authorization: Bearer`, as
`?token=`, or by the cookie `scanbench_token_<port>`, which the server sets when the page is opened with `?token=`. The name of the user comes as
`?scanbench_user=` or as a cookie of that name. A refusal has a status of 4xx and a `Refusal`: a message, and similar names if there are any. [Scripts](scripts.md) has examples.

Names of operations and paths are stable: a removal is announced in the [changelog](../CHANGELOG.md) first. Fields may be added to an answer at any time.
"""
SOCKETS = """## Sockets

| address | what |
|---|---|
| `/api/instances/{instance}/socket` | `ClientMessage` in; `Hello`, then `ServerMessage` and binary frames of values out; `Alive` after 5 s of silence |
| `/api/instances/{instance}/dap` | the Debug Adapter Protocol, one message per text frame; each connection is a debug session ([docs](dap.md)) |
| `/api/projects/{project}/lsp` | the Language Server Protocol, one message per text frame; each connection has a language server of its own, which knows the saved files ([docs](lsp.md)) |
"""


def page() -> str:
    """The whole page."""
    api: dict[str, Any] = document()
    tags: dict[str, list[str]] = {}
    for path, operations in api["paths"].items():
        for method, operation in operations.items():
            row = f"| `{operation['operationId']}` | `{method.upper()} {path}` | {_takes(operation)} | {_gives(operation)} | {operation['summary']} |"
            tags.setdefault(operation.get("tags", ["server"])[0], []).append(row)
    tables = [
        f"## {tag[0].upper()}{tag[1:]}\n\n| operation | request | takes | gives | |\n|---|---|---|---|---|\n"
        + "\n".join(rows)
        + "\n"
        for tag, rows in tags.items()
    ]
    return "\n".join([HEAD, *tables, SOCKETS])


def _takes(operation: dict[str, Any]) -> str:
    names = [f"`{each['name']}`" for each in operation.get("parameters", []) if each["in"] == "query"]
    body = operation.get("requestBody", {}).get("content", {})
    return ", ".join([*([_shape(body)] if body else []), *names])


def _gives(operation: dict[str, Any]) -> str:
    code, answer = next((code, each) for code, each in operation["responses"].items() if code.startswith("2"))
    return _shape(answer["content"]) if "content" in answer else "a file" if code == "200" else code


def _shape(content: dict[str, Any]) -> str:
    kind, media = next(iter(content.items()))
    schema = media.get("schema", {})
    for each in [schema, *schema.get("anyOf", [])]:
        if "$ref" in each:
            return _name(each)
        if each.get("type") == "array":
            return f"{_name(each['items'])}[]"
    return f"`{kind}`"


def _name(schema: dict[str, Any]) -> str:
    return f"`{schema.get('$ref', schema.get('type', 'object')).rpartition('/')[2]}`"


if __name__ == "__main__":
    PAGE.write_text(page(), "utf-8")
