"""Dataclasses that browsers and scripts see as they are: as JSON on the WebSocket and by REST, described in OpenAPI.

`web` hands them to pydantic, which finds what it needs here by name; nothing of it is imported. `Hex` and `Moment` say how bytes
and times are written.
This module imports nothing of ours: every room may use it.
"""

import ast
import sys
from collections.abc import Callable
from datetime import UTC, datetime
from functools import cache
from inspect import cleandoc, getsource
from itertools import pairwise
from typing import Annotated, ClassVar, Generic, TypeVar

T = TypeVar("T")


def iso(moment: datetime) -> str:
    """ISO 8601 in UTC with milliseconds."""
    return moment.astimezone(UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")


class _Text(Generic[T]):
    """How a value is written in JSON."""

    def __init__(self, write: Callable[[T], str]) -> None:
        self._write = write

    def __get_pydantic_core_schema__(
        self, source: object, handler: Callable[[object], dict[str, object]]
    ) -> dict[str, object]:
        written = {
            "type": "function-plain",
            "function": self._write,
            "return_schema": {"type": "str"},
            "when_used": "json",
        }
        return {**handler(source), "serialization": written}

    def __get_pydantic_json_schema__(self, _schema: object, _handler: object) -> dict[str, object]:
        return {"type": "string"}


Moment = Annotated[datetime, _Text(iso)]
"""A time of day, in JSON as `iso` writes it."""
Hex = Annotated[bytes, _Text(bytes.hex)]
"""A value as it lies in the image; in JSON `5802` is INT 600."""


def _describe(schema: dict[str, object], cls: type) -> None:
    """Every field is there, also one that has a default here; what is always the same tells messages apart. Clients may leave
    out what has a default where they are the ones who give it."""
    schema["title"] = getattr(cls, "PUBLIC", cls.__name__)
    schema["description"] = cleandoc(cls.__doc__ or "")
    fields = schema["properties"]
    assert isinstance(fields, dict)
    for name, text in _field_docstrings(cls.__module__).get(cls.__name__, {}).items():
        fields[name]["description"] = text
    if getattr(cls, "GIVEN", False):
        return
    named = {name: field for name, field in fields.items() if "const" not in field}
    for field in named.values():
        field.pop("default", None)
    schema["required"] = list(named)


@cache
def _field_docstrings(module: str) -> dict[str, dict[str, str]]:
    """By class and field. Read when somebody asks for the description, not at each start as pydantic does: parsing the sources
    takes longer than all the rest of it."""
    tree = ast.parse(getsource(sys.modules[module]))
    return {
        each.name: {
            field.target.id: cleandoc(text.value.value)
            for field, text in pairwise(each.body)
            if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name)
            if isinstance(text, ast.Expr) and isinstance(text.value, ast.Constant) and isinstance(text.value.value, str)
        }
        for each in tree.body
        if isinstance(each, ast.ClassDef)
    }


class Public:
    """Base of such a dataclass. Its docstring and those of its fields are the descriptions in OpenAPI."""

    __slots__ = ()
    GIVEN: ClassVar = False
    """Whether clients give it, too."""
    __pydantic_config__: ClassVar[dict[str, object]] = {"extra": "forbid", "json_schema_extra": _describe}
