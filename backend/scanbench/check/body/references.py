"""References and pointers: REF, ADR, SIZEOF, NULL, comparison, arithmetic in bytes."""

from dataclasses import replace

from scanbench.check.body import fold
from scanbench.check.body.places import PlaceChecker
from scanbench.problems import Span
from scanbench.program.program import Base, Const, Expr, Load, Place, RefOf
from scanbench.program.shown import shown
from scanbench.program.types import (
    BOOL,
    LINT,
    NULL,
    SLOT_BYTES,
    UDINT,
    ULINT,
    ArrayType,
    Elementary,
    Kind,
    OpenArray,
    Record,
    Reference,
    StringType,
    Type,
    is_derived,
)
from scanbench.program.untyped import ANY_INT, settle
from scanbench.syntax import tree

COUNTED = (Kind.INT, Kind.UINT)


class ReferenceChecker(PlaceChecker):
    def reference_to(self, node: tree.Call, name: str) -> Expr:
        """`REF(variable)`, or `ADR(variable)`, which gives a pointer."""
        values = [argument.value for argument in node.arguments if argument.value is not None and not argument.output]
        if len(values) != 1 or len(node.arguments) != 1:
            raise self.report.reject("T004", f"`{name}` takes one variable.", node.span)
        return self.refer(values[0], name == "ADR")

    def refer(self, node: tree.Expression, pointer: bool = False) -> RefOf:
        """A reference to the variable; not to one that is gone after the call."""
        if not isinstance(node, VARIABLES):
            raise self.report.reject("T013", "Only a variable can be referred to.", node.span)
        place, member = self.place(node)
        if member is not None and member.constant:
            raise self.report.reject("T013", f"`{member.name}` is a CONSTANT and cannot be referred to.", node.span)
        if place.base is Base.FRAME and place.slot is None and place.reference is None:
            raise self.report.reject(
                "T013",
                f"`{shown(node)}` is temporary, gone when this call ends; declare it in VAR of a block.",
                node.span,
            )
        if isinstance(place.type, OpenArray):
            raise self.report.reject("T013", "An ARRAY[*] cannot be referred to; refer to an element.", node.span)
        self.writable(place, node.span)
        return RefOf(place, reference_type(place.type, pointer))

    def size_of(self, node: tree.Call) -> Expr:
        """`SIZEOF(variable or type)`, in bytes."""
        values = [argument.value for argument in node.arguments if argument.value is not None]
        if len(values) != 1 or len(node.arguments) != 1:
            raise self.report.reject("T004", "`SIZEOF` takes one variable or type.", node.span)
        value = values[0]
        if isinstance(value, tree.Name) and self.scope.find(value.name) is None:
            return Const(ANY_INT, self.declarations.named(value.name, value.span).size)
        place, _ = self.place(value)
        if not isinstance(place.type, OpenArray):
            return Const(ANY_INT, place.type.size)
        size: Expr = Const(LINT, place.type.element.size)
        for low, high in self.array_bounds(place):
            count = fold.binary("add", LINT, fold.binary("sub", LINT, high, low), Const(LINT, 1))
            size = fold.binary("mul", LINT, size, count)
        return fold.convert(UDINT, size)

    def is_bound(self, node: tree.Call) -> Expr:
        """`__ISVALIDREF(reference)` of vendors: whether it refers to something."""
        values = [argument.value for argument in node.arguments if argument.value is not None]
        if len(values) != 1 or not isinstance(values[0], VARIABLES):
            raise self.report.reject("T004", "`__ISVALIDREF` takes one reference.", node.span)
        place, _ = self.raw_place(values[0])
        if not isinstance(place.type, Reference):
            raise self.report.reject("T002", f"`__ISVALIDREF` takes a reference, not {place.type}.", node.span)
        return fold.compare("ne", BOOL, Load(place), Const(NULL, 0))

    # ---- values -----------------------------------------------------------------------------------------

    def fits_reference(self, source: Reference, target: Reference) -> bool:
        """Whether a reference may be assigned; a pointer takes any address, as vendors have it."""
        if source.target is None or target.pointer or source.target == target.target:
            return True
        a, b = source.target, target.target
        if isinstance(a, ArrayType) and a == b:
            return True
        return isinstance(a, Record) and isinstance(b, Record) and is_derived(a, b)

    def as_reference(self, expr: Expr, type: Reference, span: Span) -> Expr | None:
        """The value as a reference of this type, or None."""
        if isinstance(expr, Const) and expr.type == ANY_INT and expr.value == 0:
            return Const(NULL, 0)
        if isinstance(expr.type, Reference) and self.fits_reference(expr.type, type):
            source = expr.type.target
            if isinstance(source, StringType) and type.target is not None and not isinstance(type.target, StringType):
                self.report.warn(
                    "W004",
                    f"A {source} begins with its length, in two bytes; its characters follow. In other tools the first byte "
                    "behind this pointer is the first character.",
                    span,
                )
            return expr
        return self.as_interface(expr, type, span)

    def compare_references(self, op: str, left: Expr, right: Expr, span: Span) -> Expr:
        sides = []
        for one, other in ((left, right), (right, left)):
            assert isinstance(left.type, Reference) or isinstance(right.type, Reference)
            wanted = other.type if isinstance(other.type, Reference) else NULL
            made = one if isinstance(one.type, Reference) else self.as_reference(one, wanted, span)
            if made is None and isinstance(other, Const) and other.type == NULL:
                raise self.report.reject(
                    "T002",
                    f"Only references can be NULL, not {settle(one).type}. Whether a REFERENCE TO is bound, "
                    "`__ISVALIDREF` says.",
                    span,
                )
            if made is None:
                raise self.report.reject(
                    "T002", f"A reference cannot be compared with {settle(one).type}; dereference it with `^`.", span
                )
            sides.append(made)
        pointers = all(isinstance(side.type, Reference) and side.type.pointer for side in sides)
        if op not in ("eq", "ne") and not pointers:
            raise self.report.reject("T002", "References are equal or not; they have no order.", span)
        return fold.compare(op, BOOL, sides[0], sides[1])

    def moved(self, op: str, pointer: Expr, by: Expr, span: Span, of_target: bool = False) -> Expr:
        """`pointer + bytes`, `pointer - bytes`; with `of_target`, in elements of what it points to."""
        by = settle(by)
        type = pointer.type
        assert isinstance(type, Reference)
        if not isinstance(by.type, Elementary) or by.type.kind not in COUNTED:
            raise self.report.reject("T002", f"A pointer moves by a number of bytes, not by {by.type}.", span)
        distance = fold.convert(LINT, by)
        if of_target and type.target is not None:
            distance = fold.binary("mul", LINT, distance, Const(LINT, type.target.size))
        number = fold.binary(op, ULINT, fold.convert(ULINT, pointer), fold.convert(ULINT, distance))
        return fold.convert(type, number)

    def pointer_arithmetic(self, op: str, left: Expr, right: Expr, span: Span) -> Expr:
        a, b = left.type, right.type
        if isinstance(a, Reference) and a.pointer and op in ("add", "sub") and not isinstance(b, Reference):
            return self.moved(op, left, right, span)
        if isinstance(b, Reference) and b.pointer and op == "add" and not isinstance(a, Reference):
            return self.moved(op, right, left, span)
        if isinstance(a, Reference) and isinstance(b, Reference) and a.pointer and b.pointer and op == "sub":
            return fold.binary("sub", LINT, fold.convert(LINT, left), fold.convert(LINT, right))
        raise self.report.reject(
            "T002",
            "Only a POINTER TO can be computed with: plus or minus a number of bytes, or the difference of two.",
            span,
        )

    # ---- pieces of statements ---------------------------------------------------------------------------

    def bind(self, target: tree.Expression, value: tree.Expression, span: Span) -> tuple[Place, Expr]:
        """`target REF= value`: the reference variable, and what it is to hold."""
        place, member = self.raw_place(target)
        type = place.type
        if not isinstance(type, Reference):
            raise self.report.reject("T002", f"`REF=` binds a reference; `{shown(target)}` is {type}.", target.span)
        self.assignable(place, member, target.span)
        null = isinstance(value, tree.Name) and value.name.upper() == "NULL"
        if null or isinstance(value, tree.Literal | tree.Call):
            return place, self.coerce(self.expr(value), replace(type, automatic=False), span, shown(target))
        source, _ = self.raw_place(value) if isinstance(value, VARIABLES) else (None, None)
        if source is not None and isinstance(source.type, Reference) and source.type.automatic:
            reference: Expr = Load(source)
        else:
            reference = self.refer(value)
        return place, self.coerce(reference, type, span, f"`{shown(target)}`")


VARIABLES = tree.Name | tree.MemberOf | tree.IndexOf | tree.DirectAddress | tree.Dereference | tree.PartialAccess


def reference_type(target: Type, pointer: bool = False) -> Reference:
    """REF_TO (or POINTER TO) a type."""
    return Reference(
        f"{'POINTER' if pointer else 'REF_TO'}{' TO' if pointer else ''} {target.name}",
        Kind.REF,
        SLOT_BYTES,
        target,
        pointer,
    )
