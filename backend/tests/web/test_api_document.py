"""The OpenAPI document: a client can be made of it and of nothing else."""

import json
import re
from collections.abc import Callable
from typing import Any

import httpx

from scanbench.web.openapi import document
from tests import client_shapes
from tests.amounts import slow
from tests.api_page import PAGE, page
from tests.web.server import PATIENCE_S, Server

Json = dict[str, Any]
TYPES: dict[str, type | tuple[type, ...]] = {
    "string": str, "integer": int, "number": (int, float), "boolean": bool, "array": list, "object": dict, "null": type(None),
}  # fmt: skip


class Client:
    """What a generator makes: a function an operation, by its name; answers are compared with their shapes."""

    def __init__(self, address: str, token: str) -> None:
        self.document: Json = json.loads(json.dumps(document()))  # as it comes over the wire
        schemes = self.document["components"]["securitySchemes"]
        assert {"bearer"} == {schemes[name].get("scheme") for each in self.document["security"] for name in each} - {
            None
        }
        self.http = httpx.Client(base_url=address, headers={"Authorization": f"Bearer {token}"}, timeout=PATIENCE_S)
        self.operations = {
            operation["operationId"]: (method, path, operation)
            for path, operations in self.document["paths"].items()
            for method, operation in operations.items()
        }

    def __getattr__(self, name: str) -> Callable[..., Any]:
        method, path, operation = self.operations[name]

        def call(body: object = None, **given: object) -> Any:
            query = {}
            for parameter in operation.get("parameters", []):
                if parameter["in"] == "query" and parameter["name"] in given:
                    query[parameter["name"]] = str(given.pop(parameter["name"]))
            reply = self.http.request(method, path.format(**given), params=query, json=body)
            shape = operation["responses"].get(str(reply.status_code))
            assert shape is not None, f"{name}: {reply.status_code} is not in the document: {reply.text}"
            if "content" not in shape:
                return None
            self.matches(reply.json(), shape["content"]["application/json"]["schema"], name)
            return reply.json()

        return call

    def matches(self, value: Any, schema: Json, where: str) -> None:
        """The value is of the schema's shape, and has nothing that it does not name."""
        if "$ref" in schema:
            return self.matches(value, self.document["components"]["schemas"][schema["$ref"].rpartition("/")[2]], where)
        if "anyOf" in schema:
            of = [each for each in schema["anyOf"] if (each.get("type") == "null") is (value is None)]
            of = [each for each in of if "$ref" in each or isinstance(value, TYPES[each["type"]])]
            assert of, f"{where}: {value!r}"
            return self.matches(value, of[0], where)
        if "type" not in schema:
            return None
        fits = isinstance(value, TYPES[schema["type"]])
        assert fits, f"{where}: {value!r} is no {schema['type']}"
        if schema["type"] == "array":
            for number, each in enumerate(value):
                self.matches(each, schema.get("items", {}), f"{where}[{number}]")
        if schema["type"] == "object" and "properties" in schema:
            assert set(schema.get("required", [])) <= set(value) <= set(schema["properties"]), where
            for key, each in value.items():
                self.matches(each, schema["properties"][key], f"{where}.{key}")
        return None


@slow
def test_a_client_made_of_the_document_works(server: Server) -> None:
    client = Client(str(server.http.base_url), server.token)
    with client.http:
        assert client.get_server()["version"] == client.document["info"]["version"]
        project = client.create_project({"name": "generated client", "model": "GENERIC-IEC"})["id"]
        text = "PROGRAM Main VAR n : INT := 7; END_VAR n := n; END_PROGRAM"
        client.save_project_file({"text": text, "version": 0}, project=project, path="main.st")
        assert client.get_project_file(project=project, path="main.st")["text"] == text
        assert client.build_project({}, project=project)["ok"]
        assert "generated client" in [each["name"] for each in client.list_projects()]
        assert "GENERIC-IEC" in [each["name"] for each in client.list_models()]
        instance = client.create_instance({"project": project, "name": "generated client"})["id"]
        server.made.append(instance)
        with server.browser(instance) as browser:
            browser.watch("Main.n")  # answered when it runs
            symbols = client.list_instance_symbols(instance=instance, path="Main")
            assert [each["path"] for each in symbols] == ["Main.n"]
            assert client.get_instance_value(instance=instance, path="Main.n")["value"] == "7"
            assert client.write_value({"path": "Main.n", "value": "8"}, instance=instance)["ok"]


def test_every_operation_has_a_readable_name_of_its_own() -> None:
    api: Json = document()
    operations = [each for methods in api["paths"].values() for each in methods.values()]
    names = [each["operationId"] for each in operations]
    assert len(set(names)) == len(names) > 100
    assert [each for each in names if not re.fullmatch(r"[a-z]+(_[a-z]+)+", each)] == []
    assert all(each["summary"] and not each["summary"].startswith("On ") for each in operations)


def test_the_shapes_of_the_client_are_up_to_date() -> None:
    kept = {each.name: each.read_text("utf-8") for each in client_shapes.FOLDER.glob("*.py") if each.stem != "__init__"}
    assert kept == client_shapes.files(), "scanbench/client/shapes is out of date: make features"


def test_the_page_of_routes_is_up_to_date() -> None:
    assert PAGE.read_text("utf-8") == page(), "docs/api.md is out of date: make features"
