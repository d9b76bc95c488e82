"""What pydantic finds wrong is told in words of ours, whatever it is."""

from typing import Annotated, Literal

import pytest
from pydantic import BaseModel, Field, ValidationError, field_validator

from scanbench.web.invalid import said


class Inner(BaseModel):
    id: int


class Asked(BaseModel, extra="forbid"):
    count: int = Field(default=1, ge=1, le=10)
    part: float = Field(default=0, allow_inf_nan=False)
    name: str = Field(default="x", min_length=1, max_length=3)
    on: bool = False
    kind: Literal["a", "b", "c"] = "a"
    many: Annotated[list[Inner], Field(min_length=1, max_length=2)] = [Inner(id=1)]
    own: str = ""

    @field_validator("own")
    @classmethod
    def _none(cls, value: str) -> str:
        if value:
            raise ValueError("the name contains a NUL character")
        return value


@pytest.mark.parametrize(
    ("body", "sentence"),
    [
        ('{"count": 0}', "count: at least 1"),
        ('{"count": 1e9}', "count: at most 10"),
        ('{"count": ""}', "count has to be a whole number"),
        ('{"count": 1.5}', "count has to be a whole number"),
        ('{"count": null}', "count has to be a whole number"),
        ('{"part": "x"}', "part has to be a number"),
        ('{"part": 1e999}', "part has to be a number"),
        ('{"name": ""}', "name: at least 1 characters"),
        ('{"name": "four"}', "name: at most 3 characters"),
        ('{"name": 7}', "name has to be a text"),
        ('{"on": 7}', "on has to be true or false"),
        ('{"kind": "d"}', "kind has to be one of these: a, b, c"),
        ('{"many": []}', "many: at least 1 entries"),
        ('{"many": [{"id": 1}, {"id": 2}, {"id": 3}]}', "many: at most 2 entries"),
        ('{"many": 7}', "many has to be a list"),
        ('{"many": [7]}', "many.0 has to be an object with names and values"),
        ('{"many": [{}]}', "many.0.id is missing"),
        ('{"other": 7}', "other is unknown"),
        ('{"own": "x"}', "own: the name contains a NUL character"),
        ("7", "this has to be an object with names and values"),
        ("{", "this is not JSON that can be read: EOF while parsing an object at line 1 column 1"),
    ],
)
def test_each_flaw_has_a_sentence(body: str, sentence: str) -> None:
    with pytest.raises(ValidationError) as found:
        Asked.model_validate_json(body)
    (flaw,) = found.value.errors()
    assert said(flaw, ".".join(map(str, flaw["loc"]))) == sentence
