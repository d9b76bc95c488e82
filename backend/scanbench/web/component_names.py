"""Names of the components of the OpenAPI document: each is called by its title, which a `Public` class gives itself."""

from typing import TypeVar, cast

T = TypeVar("T")
REFERENCE = "#/components/schemas/"


def by_title(schemas: dict[str, object], described: T) -> tuple[dict[str, object], T]:
    """The schemas by their titles, and what refers to them. Two that would have one name stay as they are called."""
    titles = {name: _title(name, schema) for name, schema in schemas.items()}
    names = {name: title for name, title in titles.items() if list(titles.values()).count(title) == 1}
    renamed = {names.get(name, name): _referring(schema, names) for name, schema in schemas.items()}
    return renamed, cast(T, _referring(described, names))


def _title(name: str, schema: object) -> str:
    title = schema.get("title") if isinstance(schema, dict) else None
    return title if isinstance(title, str) and title.isidentifier() else name


def _referring(schema: object, names: dict[str, str]) -> object:
    if isinstance(schema, dict):
        return {key: _referring(value, names) for key, value in schema.items()}
    if isinstance(schema, list):
        return [_referring(each, names) for each in schema]
    if isinstance(schema, str) and schema.startswith(REFERENCE):
        name = schema.removeprefix(REFERENCE)
        return REFERENCE + names.get(name, name)
    return schema
