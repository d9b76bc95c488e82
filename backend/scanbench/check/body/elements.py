"""Elements of arrays, characters of strings, and what a pointer with an index points to."""

from dataclasses import replace

from scanbench.check.body import fold
from scanbench.check.body.allowed import may, used
from scanbench.check.body.context import Body, Found
from scanbench.check.body.harmless import harmless
from scanbench.check.body.lenient import index as lenient_index
from scanbench.check.body.references import moved, target_of
from scanbench.check.declare.open_references import SLOT
from scanbench.check.dialect import Allowance
from scanbench.program.program import Const, Expr, Index, Intrinsic, Load, Place
from scanbench.program.shown import shown
from scanbench.program.sites import TrapKind
from scanbench.program.types import (
    BYTE,
    CHAR,
    LINT,
    SLOT_BYTES,
    WCHAR,
    ArrayType,
    Elementary,
    Kind,
    Member,
    OpenArray,
    Reference,
    StringType,
)
from scanbench.program.untyped import settle
from scanbench.syntax import tree


def element(body: Body, place: Place, member: Member | None, node: tree.IndexOf) -> Found:
    """The element of an array, or what a pointer with an index points to."""
    type, indices = place.type, list(node.indices)
    if isinstance(type, Reference) and type.pointer and len(indices) == 1:
        address = moved(body, "add", Load(place), body.expression(indices[0]), node.span, of_target=True)
        return target_of(body, address, node.span, shown(node.array)), None
    while indices:
        if isinstance(type, StringType) and len(indices) == 1:
            if type.zero:
                return byte_of(body, replace(place, type=type), type, indices[0]), member
            return _character_place(body, replace(place, type=type), type, indices[0]), member
        if not isinstance(type, ArrayType | OpenArray):
            raise body.report.reject("T010", f"{type} is not an array and has no index.", node.span)
        count = len(type.bounds) if isinstance(type, ArrayType) else type.dimensions
        if len(indices) < count:
            raise body.report.reject("T010", f"{type} needs {count} indices, not {len(indices)}.", node.span)
        for dimension, index in enumerate(indices[:count]):
            if isinstance(type, ArrayType):
                place = _index(body, place, type, dimension, index)
            else:
                place = _open_index(body, place, type, dimension, index)
        type, indices = type.element, indices[count:]
    return replace(place, type=type), member


def byte_of(body: Body, place: Place, type: StringType, node: tree.Expression, read: bool = False) -> Place:
    """A byte of a string that ends at its first 0, counted from 0; the 0 may be written, too, and whatever is after it read."""
    index = fold.convert(LINT, index_value(body, node))
    if isinstance(index, Const) and not 0 <= int(index.value) <= type.capacity:
        why = f"A {type} has the bytes 0..{type.capacity}, the last one for the 16#00 at its end; not {index.value!r}."
        raise body.report.reject("T012", why, node.span)
    if read:
        used(body, Allowance.STRING_FROM_ZERO, node.span, f"`{shown(node)}` counts from 0", f"`{shown(node)} + 1`")
    else:
        used(body, Allowance.STRING_BYTES, node.span, f"`{shown(node)}` is the index of a byte of this string")
    trap = body.trap(TrapKind.BOUNDS, node.span, f"the string has the bytes 0..{type.capacity}")
    one = Index(index, 0, type.capacity, 1, trap)
    return replace(place, type=BYTE, indices=(*place.indices, one))


def character_index(body: Body, node: tree.Expression, type: StringType) -> Expr:
    """The position of a character, which counts from 1."""
    index = fold.convert(LINT, index_value(body, node))
    if may(body, Allowance.STRING_FROM_ZERO):
        index = fold.binary("add", LINT, index, Const(LINT, 1))
        used(body, Allowance.STRING_FROM_ZERO, node.span, f"`{shown(node)}` counts from 0", f"`{shown(node)} + 1`")
    if isinstance(index, Const):
        number = int(index.value)
        if number == 0:
            body.report.warn(
                "W005",
                "The first character is number 1; this traps. Tools that count from 0 mean the first character here.",
                node.span,
            )
        elif not 1 <= number <= type.capacity:
            raise body.report.reject("T012", f"A {type} has no character {number}, only 1..{type.capacity}.", node.span)
    return index


def _character_place(body: Body, place: Place, type: StringType, node: tree.Expression) -> Place:
    """A character that is there: what is beyond the current length cannot be written or referred to."""
    if may(body, Allowance.STRING_FROM_ZERO):
        title = body.dialect.title
        raise body.report.reject(
            "T003",
            f"In {title} a string ends at its first 16#00, which can be written by index; here a WSTRING has a length. Make the "
            "text with LEFT, MID, REPLACE and CONCAT."
            if type.width == 2
            else f"In {title} a string ends at its first 16#00, which can be written by index; in this project it has a length. Write "
            '`"version": 3` into language.json, or make the text with LEFT, MID, REPLACE and CONCAT.',
            node.span,
        )
    index = character_index(body, node, type)
    if not harmless(Load(place)):
        raise body.report.reject(
            "T003", "Only a string without calls in its own index has characters here; assign the index first.",
            node.span,
        )  # fmt: skip
    trap = body.trap(
        TrapKind.BOUNDS, node.span, "the string has no character there: it is shorter, or the index below 1"
    )
    low, length = Const(LINT, 1), Intrinsic("LEN", LINT, (Load(place),))
    one = Index(index, low, length, Const(LINT, type.width), trap)
    return replace(place, type=character_of(type), offset=place.offset + 2, indices=(*place.indices, one))


def index_value(body: Body, node: tree.Expression) -> Expr:
    """An index as an integer."""
    index = settle(body.expression(node))
    index = lenient_index(body, index, node.span, "An index") or index
    if not isinstance(index.type, Elementary) or index.type.kind not in (Kind.INT, Kind.UINT):
        raise body.report.reject("T002", f"An index is an integer, not {index.type}.", node.span)
    return index


def _index(body: Body, place: Place, type: ArrayType, dimension: int, node: tree.Expression) -> Place:
    low, high = type.bounds[dimension]
    stride = type.stride(dimension)
    index = index_value(body, node)
    if isinstance(index, Const):
        number = int(index.value)
        if not low <= number <= high:
            raise body.report.reject("T012", f"Index {number} is outside of {low}..{high}.", node.span)
        return replace(place, offset=place.offset + (number - low) * stride)
    trap = body.trap(TrapKind.BOUNDS, node.span, f"index outside of {low}..{high}")
    if _may_be_shorter(body, place):
        limits = Const(LINT, low), Const(LINT, high), Const(LINT, stride)
        return replace(place, indices=(*place.indices, Index(index, *limits, trap)))
    return replace(place, indices=(*place.indices, Index(index, low, high, stride, trap)))


def _may_be_shorter(body: Body, place: Place) -> bool:
    """Whether a pointer leads to the array: `POINTER TO ARRAY[0..32000] OF REAL` is how vendors' programs take arrays of any size,
    so the element has to be there, and not the whole array."""
    type = None if place.reference is None else place.reference.type
    return isinstance(type, Reference) and type.pointer and may(body, Allowance.POINTER_NUMBERS)


def _open_index(body: Body, place: Place, type: OpenArray, dimension: int, node: tree.Expression) -> Place:
    limits = array_bounds(place)
    stride: Expr = Const(LINT, type.element.size)
    for low, high in limits[dimension + 1 :]:
        count = fold.binary("add", LINT, fold.binary("sub", LINT, high, low), Const(LINT, 1))
        stride = fold.binary("mul", LINT, stride, count)
    trap = body.trap(TrapKind.BOUNDS, node.span, "index outside of the bounds of this ARRAY[*]")
    index = Index(index_value(body, node), *limits[dimension], stride, trap)
    return replace(place, indices=(*place.indices, index))


def array_bounds(place: Place) -> list[tuple[Expr, Expr]]:
    """Lower and upper bound of each dimension of an array: for ARRAY[*], what came with the call or is kept with a reference."""
    type = place.type
    if isinstance(type, ArrayType):
        return [(Const(LINT, low), Const(LINT, high)) for low, high in type.bounds]
    assert isinstance(type, OpenArray)
    slot = place.reference.place if isinstance(place.reference, Load) else place.slot
    assert slot is not None
    owner = slot.variable.removesuffix(SLOT)
    made: list[tuple[Expr, Expr]] = []
    for dimension in range(type.dimensions):
        low, high = (
            replace(
                slot, type=LINT, offset=slot.offset + SLOT_BYTES * (1 + 2 * dimension + upper),
                variable=f"{owner}${'HIGH' if upper else 'LOW'}{dimension + 1}" if owner else "",
            )
            for upper in (0, 1)
        )  # fmt: skip
        made.append((Load(low), Load(high)))
    return made


def character_of(type: StringType) -> Elementary:
    """The type of a character of such a string."""
    return CHAR if type.width == 1 else WCHAR
