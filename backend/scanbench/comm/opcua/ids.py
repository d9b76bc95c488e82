"""Ids of nodes."""

from typing import cast

from asyncua import ua

INDEX = 2
"""Of the namespace of a PLC: 0 is OPC UA's own, 1 the application's."""


def standard(number: int) -> ua.NodeId:
    """A node of OPC UA's own."""
    return ua.NodeId(cast(ua.Int32, number))


def own(identifier: int | str, index: int = INDEX) -> ua.NodeId:
    """A node of the PLC: a number where it is always there, or the path of what the program has. With `index`, one of a namespace
    that somebody published."""
    return ua.NodeId(cast(ua.Int32, identifier), cast(ua.Int16, index))
