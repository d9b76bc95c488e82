"""`python -m tests.client_shapes` writes `scanbench/client/shapes`: what answers of the REST API are, from the OpenAPI document."""

import subprocess
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from scanbench.web.openapi import document

FOLDER = Path(__file__).parents[1] / "scanbench" / "client" / "shapes"
FILES = {
    "running": (
        "the PLC and its values",
        "AppInfo Instance ImportedInstance Value CommandResult ForceInfo Binding LogPage Watching Symbol",
    ),
    "errors": (
        "errors",
        "DeviceErrors ArmedFault ErrorHistoryRow FaultStart FaultShape PreviewedErrors HistoryVersion HistoryOfVersion",
    ),
    "sweeps": ("how programs react to errors", "Reaction ProgramState SweepSummary Sweep Accepted SweepComparison"),
    "past": (
        "the past of a run, what was reached, and what left its subrange",
        "LastWriter RunChanges Comparison Rerun WhatIf Diagnostics Coverage",
    ),
    "disturbances": ("disturbances, and campaigns of them", "DisturbanceInfo CampaignState WholeCampaign"),
    "verification": (
        "verifications",
        "VerificationInfo UploadedTrace TraceMapping VerifyRows SetCell VerificationRecord VerifyUse SavedMapping",
    ),
    "debugging": ("breakpoints", "BreakpointInfo"),
    "communication": (
        "the communication unit",
        "Communication PlantSettings CommunicationServerSettings MqttSettingsGiven CommunicationFault",
    ),
    "traces": ("traces", "TraceInfo TraceTrigger TraceRecordInfo Retrospective"),
}
"""What each file is about, and the components that are asked for; those that they hold come into the first file."""
_NAMES = {"integer": "int", "string": "str", "boolean": "bool", "number": "float", "null": "None"}
Schema = Mapping[str, Any]


def files() -> dict[str, str]:
    """Each file by its name."""
    schemas: Mapping[str, Schema] = document()["components"]["schemas"]  # type: ignore[index]
    sent = set(_sent(schemas))
    where: dict[str, str] = {}
    made = {}
    for file, (about, wanted) in FILES.items():
        new = [each for each in _reached(schemas, wanted.split()) if each not in where]
        where |= dict.fromkeys(new, file)
        held = {name for each in new for name in _references(schemas[each])} - set(new)
        texts = [_shape(each, schemas[each], each in sent) for each in new]
        imports = [
            f"from scanbench.client.shapes.{other} import {', '.join(sorted(each for each in held if where[each] == other))}"
            for other in sorted({where[each] for each in held})
        ]
        typing = [each for each in ("Literal", "NotRequired", "TypedDict") if any(each in text for text in texts)]
        head = f'"""Answers of the REST API: {about}. Made by `python -m tests.client_shapes`; do not edit."""'
        parts = [head, f"from typing import {', '.join(typing)}", "\n".join(imports), *texts]
        made[f"{file}.py"] = _formatted("\n\n".join(parts))
    return made


def _sent(schemas: Mapping[str, Schema]) -> list[str]:
    """What is sent to the server, too: there what has a default may be left out."""
    paths: Mapping[str, Mapping[str, Schema]] = document()["paths"]  # type: ignore[assignment]
    bodies = (op.get("requestBody", {}) for operations in paths.values() for op in operations.values())
    return _reached(schemas, [name for body in bodies for name in _references(body)])


def _reached(schemas: Mapping[str, Schema], roots: list[str]) -> list[str]:
    """These and all that they hold; what is held comes first."""
    found: list[str] = []
    entered: set[str] = set()

    def enter(name: str) -> None:
        if name not in entered:
            entered.add(name)
            for each in _references(schemas[name]):
                enter(each)
            found.append(name)

    for each in roots:
        enter(each)
    return found


def _references(schema: object) -> Iterator[str]:
    if isinstance(schema, dict):
        if "$ref" in schema:
            yield schema["$ref"].rpartition("/")[2]
        schema = [each for key, each in schema.items() if key != "discriminator"]
    if isinstance(schema, list):
        for each in schema:
            yield from _references(each)


def _shape(name: str, schema: Schema, sent: bool) -> str:
    if "properties" not in schema:
        return f"{name} = {_type(schema)}"
    required = schema.get("required", ()) if sent else schema["properties"]
    lines = [f"class {name}(TypedDict):", f'    """{_said(schema.get("description", name))}"""', ""]
    for field, each in schema["properties"].items():
        kind = _type(each)
        lines.append(f"    {field}: {kind if field in required else f'NotRequired[{kind}]'}")
        if "description" in each:
            lines.append(f'    """{_said(each["description"])}"""')
    return "\n".join(lines)


def _said(text: str) -> str:
    text = " ".join(text.split()).replace("\\", "\\\\").replace('"""', "'''")
    return text if text.endswith((".", "?", "!", "`")) else f"{text}."


def _type(schema: Schema) -> str:
    if "$ref" in schema:
        return next(_references(schema))
    if "enum" in schema:
        return f"Literal[{', '.join(map(repr, schema['enum']))}]"
    if "const" in schema:
        return f"Literal[{schema['const']!r}]"
    if "anyOf" in schema or "oneOf" in schema:
        return " | ".join(dict.fromkeys(map(_type, schema.get("anyOf", schema.get("oneOf")))))
    match schema.get("type"):
        case "array" if "prefixItems" in schema:
            return f"list[{' | '.join(dict.fromkeys(map(_type, schema['prefixItems'])))}]"
        case "array":
            return f"list[{_type(schema['items'])}]"
        case "object":
            held = schema.get("additionalProperties", True)
            return f"dict[str, {'object' if held is True else _type(held)}]"
        case None:
            return "object"
        case str(kind):
            return _NAMES[kind]
    raise AssertionError(schema)


def _formatted(text: str) -> str:
    ruff = [sys.executable, "-m", "ruff", "format", "--stdin-filename", str(FOLDER / "made.py"), "-"]
    return subprocess.run(ruff, input=text, capture_output=True, text=True, check=True).stdout


if __name__ == "__main__":
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name, text in files().items():
        (FOLDER / name).write_text(text, "utf-8")
