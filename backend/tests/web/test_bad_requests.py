"""Whatever is sent, the server answers with words, and the PLC goes on: odd values for every route of the API, by day for a third of them."""

import json
from collections import Counter
from collections.abc import Iterator
from random import Random
from typing import cast
from urllib.parse import quote

import pytest

from scanbench.web.openapi import document
from tests.amounts import amount, nightly, some
from tests.web.server import Server
from tests.web.test_simulator import MODEL, PROGRAM
from tests.web.test_sweeps import finished

Json = dict[str, object]
JSON = {"Content-Type": "application/json"}
EACH = amount(8, 1)
"""Bodies of one route, chosen from all that there are; as many are taken of those that are odd for every route, and of the addresses."""
IDS = ("0", "-1", str(2**31), str(2**63), str(10**20), "nobody", "%00")
NUMBERS = (-1, 0, 1.5, 2**31, 2**53, 2**63, 2**64, 10**400, True, "7")
TEXTS = (
    "",
    " ",
    "\0",
    "a\0b",
    "\n",
    "日本\u202e\ufffe",
    "x" * 70_000,
    "9" * 5000,
    "T#" + "9" * 400 + "d",
    "../../x",
    7,
)
OTHERS: tuple[object, ...] = (None, [], {}, "x", 10**400)
BODIES = (
    b"", b"{", b"\xff\xfe", b"null", b"[]", b"7", b"NaN", b'{"\\ud800": "\\udfff"}', b'{"a\\u0000b": 1}', b"[" * 50_000,
    b'{"x": ' * 50_000, b"9" * 5000,
)  # fmt: skip
KNOWN: Json = {
    "model": MODEL, "path": "Main.n", "value": "1", "id": "battery-error", "error": "plc-setup-error", "state": "Now",
    "errors": ["battery-error"], "ids": ["battery-error"], "language": "en", "window": 1, "files": {"main.st": PROGRAM},
}  # fmt: skip
"""What a body says in the places that are right."""
CELL: Json = {"error": "plc-setup-error", "state": "Now"}


class Api:
    """The OpenAPI document, and what can be sent by it."""

    def __init__(self, named: Json) -> None:
        self._document = document()
        self._schemas = cast(Json, cast(Json, self._document["components"])["schemas"])
        self._named = named
        self._random = Random(5)
        self._count = 0

    def requests(self) -> Iterator[tuple[str, str, bytes]]:
        """Method, address and body; what is right in them does as little as possible."""
        for path, operations in some([*cast(dict[str, dict[str, Json]], self._document["paths"]).items()], 3):
            for method, operation in operations.items():
                parameters = cast(list[Json], operation.get("parameters", []))
                body = cast(Json | None, operation.get("requestBody"))
                good = b"" if body is None else json.dumps(self._good("", self._schema_of(body))).encode()
                for address in self._addresses(path, parameters, deleting=method == "delete"):
                    yield method, address, good
                if method in ("post", "put", "patch"):
                    address = self._address(path, parameters, {})
                    for odd in self._bodies(body):
                        yield method, address, odd

    def _addresses(self, path: str, parameters: list[Json], deleting: bool) -> Iterator[str]:
        for parameter in parameters:
            name, schema = str(parameter["name"]), cast(Json, parameter["schema"])
            odd = IDS if self._kind(schema) == "integer" else tuple(quote(str(text)[:9000], safe="") for text in TEXTS)
            for value in self._random.sample(odd, min(len(odd), 2 * EACH)):
                yield self._address(path, parameters, {name: value})
        if not deleting:
            yield self._address(path, parameters, {})

    def _address(self, path: str, parameters: list[Json], odd: dict[str, str]) -> str:
        query = []
        for parameter in parameters:
            name = str(parameter["name"])
            value = odd.get(name, quote(str(self._named.get(name, "x"))))
            if parameter["in"] == "path":
                path = path.replace(f"{{{name}}}", value)
            elif parameter.get("required") or name in odd:
                query.append(f"{name}={value}")
        return f"{path}?{'&'.join(query)}" if query else path

    def _bodies(self, body: Json | None) -> list[bytes]:
        odd = list(BODIES)
        if body is not None:
            told = [json.dumps(each).encode() for each in self._odd("", self._schema_of(body))]
            odd = self._random.sample(odd, min(4, EACH)) + self._random.sample(told, min(EACH, len(told)))
        return odd

    # ---- by schema ------------------------------------------------------------------------------------------------

    def _schema_of(self, body: Json) -> Json:
        return cast(Json, cast(Json, cast(Json, body["content"])["application/json"])["schema"])

    def _resolved(self, schema: Json) -> Json:
        if "$ref" in schema:
            return self._resolved(cast(Json, self._schemas[str(schema["$ref"]).rpartition("/")[2]]))
        if "anyOf" in schema:
            return self._resolved(cast(list[Json], schema["anyOf"])[0])
        return schema

    def _kind(self, schema: Json) -> object:
        return self._resolved(schema).get("type")

    def _good(self, name: str, schema: Json) -> object:
        """A value that the schema allows."""
        resolved = self._resolved(schema)
        if "oneOf" in resolved:
            return self._good(name, cast(list[Json], resolved["oneOf"])[0])
        kind = resolved.get("type")
        if kind == "object":
            properties = cast(dict[str, Json], resolved.get("properties", {}))
            required = cast(list[str], resolved.get("required", []))
            required = [*required, *(each for each in properties if "const" in properties[each])]
            return {each: self._good(each, properties[each]) for each in required} or KNOWN.get(name, {})
        if kind == "array" and self._kind(cast(Json, resolved["items"])) == "object":
            return [self._good("", cast(Json, resolved["items"]))]
        if name == "name":
            self._count += 1
            return f"made {self._count}"
        choices = cast(list[object], resolved.get("enum", [""]))
        plain: Json = {"integer": 1, "number": 1.0, "boolean": False, "array": [], "string": choices[0] or "x"}
        return self._named.get(name, KNOWN.get(name, resolved.get("const", plain[str(kind)])))

    def _odd(self, name: str, schema: Json) -> Iterator[object]:
        """Values with one thing in them that is odd."""
        resolved = self._resolved(schema)
        kind = resolved.get("type")
        if "oneOf" in resolved:
            for one in cast(list[Json], resolved["oneOf"]):
                yield from self._odd(name, one)
        elif kind == "object" and "properties" in resolved:
            good = cast(Json, self._good(name, schema))
            for each, inner in cast(dict[str, Json], resolved["properties"]).items():
                yield from ({**good, each: odd} for odd in self._odd(each, inner))
            yield {**good, "unknown\0": 1}
        elif kind == "object":
            yield from ({text: "x"} for text in TEXTS)
            yield from ({"main.st": text, "rack": text} for text in TEXTS)
        elif kind == "array":
            yield from ([odd] for odd in self._odd(name, cast(Json, resolved["items"])))
        elif kind in ("integer", "number"):
            yield from NUMBERS
        elif kind == "string":
            yield from TEXTS
        yield from OTHERS


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    """A server of its own: here things are made and thrown away."""
    with Server(tmp_path_factory.mktemp("bad")) as server:
        yield server


@pytest.fixture(scope="module")
def named(alone: Server) -> Json:
    """The numbers of a PLC, its project, and one of everything else that there can be."""
    instance = alone.instance("victim", MODEL, main=PROGRAM)
    project = alone.http.get(f"/api/instances/{instance}").json()["project"]["id"]
    base = f"/api/instances/{instance}"
    with alone.browser(instance) as browser:
        sweep = alone.http.post(f"{base}/sweeps", json={"errors": ["plc-setup-error"], "window": 1}).json()["id"]
        finished(browser, sweep)
    state = alone.http.post(f"{base}/states", json={"name": "kept"}).json()["id"]
    xml = alone.http.get(f"{base}/record", params={"format": "xml"}).content
    record = alone.http.post(f"/api/projects/{project}/records", content=xml).json()["id"]
    return {
        "instance": instance, "project": project, "sweep": sweep, "before": sweep, "after": sweep, "state": state,
        "record": record,
    }  # fmt: skip


@nightly
def test_no_request_makes_the_server_fail(alone: Server, named: Json) -> None:
    statuses: Counter[int] = Counter()
    for method, address, body in Api({**named, "error": "battery-error"}).requests():
        reply = alone.http.request(method, address, content=body, headers=JSON)
        statuses[reply.status_code] += 1
        told = f"{method} {address[:200]} {body[:300]!r}: {reply.status_code} {reply.text[:300]}"
        assert reply.status_code < 500, told
        if reply.status_code >= 400:
            assert reply.json()["message"], told
    assert statuses[200] > amount(50, 10), f"nearly everything was refused, nothing was tried: {statuses}"
    now = alone.state(cast(int, named["instance"]))
    assert now["restarts"] == 0, now
    assert now["state"] not in ("failed", "restarting", "silent", "no_space"), (
        now
    )  # it may have been asked to pause or stop


@pytest.mark.parametrize(
    ("method", "path", "body", "says"),
    [
        ("post", "/api/instances/{instance}/states", {"name": "a\0b"}, "the name contains a NUL character"),
        ("post", "/api/instances/{instance}/errors/clear", {"what": 10**400}, "4294967295"),
        ("get", "/api/sweeps/99999999999999999999", None, "less than 2147483648"),
        ("delete", "/api/states/9999999999999999999999", None, "less than 2147483648"),
        ("post", "/api/instances/{instance}/sweeps", {"states": [2**63]}, "states.0: "),
        ("post", "/api/sweeps/{sweep}/accept", {**CELL, "reason": "a\0b"}, "the reason contains a NUL character"),
        ("post", "/api/sweeps/{sweep}/open", {**CELL, "name": "a\0b"}, "the name contains a NUL character"),
        ("post", "/api/projects", {"name": "x\0", "model": MODEL}, "the name contains a NUL character"),
    ],
)
def test_what_cannot_be_is_refused_with_words(
    alone: Server, named: Json, method: str, path: str, body: Json | None, says: str
) -> None:
    content = b"" if body is None else json.dumps(body).encode()
    reply = alone.http.request(method, path.format(**named), content=content, headers=JSON)
    assert reply.status_code == 422, reply.text
    assert says in reply.json()["message"]


def test_no_message_ends_the_connection(alone: Server) -> None:
    instance = alone.instance("spoken to", MODEL, main=PROGRAM)
    battery = [{"id": "battery-error", "details": {}}]
    digits = "9" * 5000
    with alone.browser(instance) as browser:
        for message in (
            {"type": "disarm", "ids": [10**30]},
            {"type": "arm", "errors": battery, "start": {"kind": "line", "file": "main.st", "line": 10**30}},
            {"type": "arm", "errors": battery, "start": {"kind": "line", "file": "a\0", "line": 2**31 - 1}},
            {
                "type": "arm",
                "errors": battery,
                "start": {"kind": "condition", "condition": f"Main.n > {digits[:1900]}"},
            },
            {"type": "arm", "errors": battery, "start": {"kind": "scan", "scan": 2**63}},
            {"type": "generate", "errors": [{"id": "memory-error", "details": {"location": digits, "\0": "\0"}}]},
            {"type": "generate", "errors": [{"id": "fal", "details": {"number": digits}}]},
            {"type": "recover", "ids": ["\0", digits]},
            {"type": "write", "path": "Main.n", "value": digits},
            {"type": "force", "path": "Main.n\0", "value": "\0"},
            {"type": "run", "action": "continue", "until": f"Main.n = {digits}"},
            {"type": "run", "action": "speed", "speed": 1e308},
            {"type": "travel", "scan": 2**63 - 1},
            {"type": "watch", "paths": ["\0", digits, ""]},
        ):
            answer = browser.ask("watching" if message["type"] == "watch" else "done", **message)
            assert message["type"] == "watch" or not answer["ok"], message
        assert browser.ask(type="write", path="Main.n", value="1")["ok"]
    now = alone.state(instance)
    assert (now["state"], now["restarts"]) == ("running", 0), now
