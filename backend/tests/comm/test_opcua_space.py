"""The address space of OPC UA: nodes that were asked for come and go, and nobody's end breaks it."""

from typing import Any

import pytest
from asyncua import ua

from scanbench.comm.opcua import space as rooms
from scanbench.comm.opcua.ids import own, standard
from scanbench.comm.opcua.space import Space
from tests.runtime.bench import program

SOURCE = "PROGRAM Main VAR numbers : ARRAY[1..2000] OF INT; n : INT; END_VAR n := n + 1; END_PROGRAM"
OTHER = "PROGRAM Main VAR m : INT; END_VAR m := m + 1; END_PROGRAM"


async def _told(_handle: int, _value: Any) -> None:
    """A subscriber."""


def shown(text: str, space: Space) -> Space:
    space.take(program(text), own(2), own(3))
    return space


@pytest.fixture
def space() -> Space:
    made = Space()
    for id in (
        own(2),
        own(3),
        *map(
            standard,
            (
                ua.ObjectIds.Enumeration,
                *(ua.ObjectIds.BaseDataVariableType, ua.ObjectIds.FolderType, ua.ObjectIds.BaseObjectType),
            ),
        ),
    ):
        made.put(id, "folder", ua.NodeClass.Object, {})
    return shown(SOURCE, made)


def test_of_nodes_that_were_asked_for_those_with_a_subscriber_stay(
    space: Space, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(rooms, "_ASKED", 10)
    kept = own("Main.numbers[1]")
    _, handle = space.add_datachange_callback(kept, ua.AttributeIds.Value, _told)
    for number in range(2, 200):
        assert own(f"Main.numbers[{number}]") in space
    asked = [id for id in space.variables if "[" in str(id.Identifier)]
    assert kept in asked
    assert len(asked) <= 10
    space.delete_datachange_callback(handle)
    assert not space.variables[kept].watched


def test_a_subscription_ends_after_its_node(space: Space) -> None:
    id = own("Main.n")
    _, handle = space.add_datachange_callback(id, ua.AttributeIds.Value, _told)
    _, described = space.add_datachange_callback(id, ua.AttributeIds.Description, _told)
    shown(OTHER, space)
    assert id not in space.variables
    for each in (described, handle, handle):
        space.delete_datachange_callback(each)
    assert not shown(SOURCE, space).variables[id].watched
