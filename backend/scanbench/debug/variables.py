"""One variable as it is shown: its value as text, what it refers to, what is below."""

from dataclasses import dataclass, replace

from scanbench.debug.scene import Scene
from scanbench.debug.shown import VariableInfo
from scanbench.program.types import (
    SLOT_BYTES,
    ArrayType,
    Elementary,
    OpenArray,
    Record,
    Reference,
    Section,
    StringType,
    Type,
)
from scanbench.symbols.names import names_of
from scanbench.symbols.references import NOTHING, refers_to
from scanbench.symbols.symbols import Symbol, target_of
from scanbench.symbols.values import format_value

UNBOUND = "not connected"
MANY = 10_000_000
"""Elements beyond which the bounds of an ARRAY[*] are not believed."""


@dataclass(frozen=True, slots=True)
class Shown:
    """A variable, and how it is named in the scope of its frame."""

    expression: str
    symbol: Symbol
    """Where it lives, as the program sees it: of an in-out by value the copy."""
    path: str
    """By which tools watch and write it; empty for temporaries."""
    actual: Symbol | None = None
    """Of an in-out by value: what was passed."""


def info(scene: Scene, shown: Shown, name: str = "") -> VariableInfo:
    """All that is shown of it in one line."""
    symbol = shown.symbol
    alias = _alias(scene, shown)
    symbol = _through(scene, symbol)
    type = symbol.type
    spot = symbol.locate(scene.memory)
    value, children = (UNBOUND, 0) if spot is None else _value(scene, symbol, *spot)
    address = symbol.address or ("" if spot is None else names_of(scene.program).address(*spot, type))
    return VariableInfo(
        name=name or shown.symbol.name,
        expression=shown.expression,
        value=value,
        type=shown.symbol.type.name,
        path=shown.path,
        alias=alias,
        address=address,
        children=children,
        indexed=isinstance(type, ArrayType),
        writable=spot is not None and not scene.past and _writable(scene, symbol, spot[0]),
    )


def _through(scene: Scene, symbol: Symbol) -> Symbol:
    """What a use of the variable means: for a REFERENCE TO its target; for an ARRAY[*] the array with its actual bounds."""
    type = symbol.type
    if isinstance(type, Reference) and type.automatic and type.target is not None:
        return replace(target_of(symbol), path=symbol.path, name=symbol.name)
    if isinstance(type, OpenArray):
        return with_bounds(scene, symbol)
    return symbol


def with_bounds(scene: Scene, symbol: Symbol) -> Symbol:
    """An ARRAY[*] as the array that was passed: its bounds follow the slot in memory."""
    type = symbol.type
    if not isinstance(type, OpenArray) or not symbol.slots:
        return symbol
    slot = replace(symbol, slots=symbol.slots[:-1], offset=symbol.slots[-1]).locate(scene.memory)
    if slot is None:
        return symbol
    numbers = [
        int.from_bytes(scene.memory[at : at + 8], "little", signed=True)
        for at in range(slot[0] + SLOT_BYTES, slot[0] + SLOT_BYTES * (1 + 2 * type.dimensions), SLOT_BYTES)
    ]
    bounds = tuple(zip(numbers[::2], numbers[1::2], strict=True))
    if any(low > high for low, high in bounds):
        return symbol
    made = ArrayType(bounds, type.element)
    return replace(symbol, type=made) if made.count < MANY else symbol


def _value(scene: Scene, symbol: Symbol, offset: int, bit: int | None) -> tuple[str, int]:
    """The value as text, and the number of its parts."""
    type = symbol.type
    if isinstance(type, Reference):
        text = refers_to(scene.program, scene.memory, symbol)
        return text, int(text != NOTHING)
    if isinstance(type, Elementary | StringType):
        if bit is not None:
            return ("TRUE" if scene.memory[offset] >> bit & 1 else "FALSE"), 0
        return format_value(type, bytes(scene.memory[offset : offset + type.size])), 0
    count = _below(type)
    what = "element" if isinstance(type, ArrayType | OpenArray) else "member"
    return f"({count} {what}{'s' if count != 1 else ''})", count


def _below(type: Type) -> int:
    if isinstance(type, ArrayType):
        return type.count
    if isinstance(type, Record):
        return sum(not member.hidden for member in type.members.values())
    return 0


def _alias(scene: Scene, shown: Shown) -> str:
    """`-> Main.tank[3].level (D120)`: of an in-out or REFERENCE TO, what it is bound to."""
    symbol = shown.actual or shown.symbol
    if isinstance(symbol.type, Reference) and symbol.type.automatic:
        text = refers_to(scene.program, scene.memory, symbol)
        return text if text != NOTHING else ""
    if symbol.section != Section.IN_OUT.value or symbol.name == "^" or not symbol.slots:
        return ""
    symbol = with_bounds(scene, symbol)
    spot = symbol.locate(scene.memory)
    if spot is None:
        return ""
    real = scene.program.layout.copies.actual(scene.memory, *spot) or spot
    return f"-> {names_of(scene.program).text(*real, symbol.type)}"


def _writable(scene: Scene, symbol: Symbol, offset: int) -> bool:
    if not isinstance(symbol.type, Elementary | StringType) or symbol.constant:
        return False
    found = scene.program.layout.area_at(offset)
    return found is None or found[0].protected(found[1], symbol.type.size, "tool") is None


def tool_path(scene: Scene, symbol: Symbol, given: str) -> str:
    """`given`, or the path of what lives there."""
    if given:
        return given
    spot = symbol.locate(scene.memory)
    if spot is None:
        return ""
    found = names_of(scene.program).variable(spot, symbol.type)
    return "" if found is None else found.path
