"""The REST API as its document tells it: names of operations, summaries, and how one says who one is.

A name comes from method and path, which are promises: `list_projects`, `create_instance_trace`, `save_project_file`.
"""

from typing import Any

from fastapi import FastAPI
from fastapi.routing import APIRoute

from scanbench.web.component_names import by_title

_OF_ITEMS = {"GET": "get", "PUT": "save", "PATCH": "change", "DELETE": "delete"}
_NAMES = {
    ("GET", ""): "get_server",
    ("GET", "instances/{instance}/complete"): "complete_symbol",
    ("GET", "instances/{instance}/instances-of"): "list_block_instances",
    ("POST", "instances/import"): "import_instance",
    ("POST", "instances/{instance}/commands"): "command_instance",
    ("POST", "instances/{instance}/write"): "write_value",
    ("POST", "instances/{instance}/force"): "force_value",
    ("POST", "instances/{instance}/release"): "release_forces",
    ("POST", "instances/{instance}/mode"): "set_instance_mode",
    ("POST", "instances/{instance}/new-run"): "begin_instance_run",
    ("POST", "instances/{instance}/roll-back"): "roll_back_instance",
    ("POST", "instances/{instance}/errors/log/clear"): "clear_instance_error_log",
    ("POST", "instances/{instance}/trace-check"): "check_trace_mapping",
    ("POST", "projects/{project}/git"): "begin_project_git",
    ("POST", "projects/{project}/libraries/{name}"): "add_project_library",
    ("POST", "projects/{project}/records"): "import_project_record",
    ("POST", "projects/{project}/traces"): "upload_project_trace",
    ("POST", "projects/{project}/trace-mappings"): "save_project_trace_mapping",
    ("POST", "sweeps/{sweep}/reaction"): "get_sweep_reaction",
    ("POST", "sweeps/{sweep}/open"): "open_sweep_case",
    ("POST", "sweeps/{sweep}/accept"): "accept_sweep_finding",
    ("POST", "sweeps/{sweep}/withdraw"): "withdraw_sweep_finding",
    ("GET", "sweeps/{before}/compare/{after}"): "compare_sweeps",
    ("PATCH", "verifications/{verification}"): "drive_verification",
    ("POST", "verifications/{verification}/cells"): "get_verification_cells",
    ("DELETE", "instances/{instance}/disturbances"): "delete_instance_disturbances",
}
"""Operations that the rule below would call something odd."""
SCHEMES = {
    "token": {"type": "http", "scheme": "bearer", "description": "The token that the server prints at its start."},
    "address": {"type": "apiKey", "in": "query", "name": "token", "description": "The same in the address."},
}
"""A browser has it in a cookie, which the server sets when the page is opened with `?token=`."""


class Api(FastAPI):
    """An application that describes itself for people and for generators of clients."""

    def openapi(self) -> dict[str, Any]:
        """As FastAPI makes it, with summaries from the docstrings, and the ways to give the token."""
        if self.openapi_schema is None:
            document = super().openapi()
            document["components"]["securitySchemes"] = SCHEMES
            document["security"] = [{name: []} for name in SCHEMES]
            for operations in document["paths"].values():
                for operation in operations.values():
                    said = " ".join(operation.get("description", "").split())
                    operation["summary"] = said.split(". ")[0].removesuffix(".")
            schemas, document = by_title(document["components"].pop("schemas"), document)
            document["components"]["schemas"] = schemas
            self.openapi_schema = document
        return super().openapi()


def operation_id(route: APIRoute) -> str:
    """What a client calls it: the method as a verb, then the nouns of the path; of an action the action is the verb."""
    method = min(route.methods or ())
    path = route.path_format.removeprefix("/api").strip("/").replace(":path}", "}")
    if (method, path) in _NAMES:
        return _NAMES[method, path]
    parts = path.split("/")
    nouns = [
        _singular(each) if after.startswith("{") else each for each, after in zip(parts, [*parts[1:], ""], strict=True)
    ]
    words = [each for each in nouns if not each.startswith("{")]
    if parts[-1].startswith("{"):
        verb = _OF_ITEMS[method]
    elif parts[-1] == "export" or (method == "POST" and not parts[-1].endswith("s")):
        verb = words.pop()
    elif method == "POST":
        verb, words[-1] = "create", _singular(words[-1])
    else:
        verb = "list" if _is_list(route) else _OF_ITEMS[method]
    return "_".join([verb, *words]).replace("-", "_").replace(".", "_")


def _singular(noun: str) -> str:
    return noun.removesuffix("s")


def _is_list(route: APIRoute) -> bool:
    return str(route.endpoint.__annotations__.get("return")).startswith(("list[", "tuple["))
