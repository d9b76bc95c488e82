"""Variant of TIA Portal: a variable that is passed with its type. `TypeOf(v) = Int`, `VariantGet`, `CountOfElements` and the like.

It is the structure `Variant` of the library Siemens: the address, the number of the type, and of an array those of its elements.
From https://docs.tia.siemens.cloud, the data type VARIANT and the help on each instruction.
"""

from dataclasses import replace
from zlib import crc32

from scanbench.check.body import fold
from scanbench.check.body.allowed import may, used
from scanbench.check.body.coercion import as_type
from scanbench.check.body.context import Body
from scanbench.check.body.places import VARIABLES, inside
from scanbench.check.body.references import reference_type
from scanbench.check.body.referring import refer
from scanbench.check.body.targets import declared_target
from scanbench.check.dialect import Allowance
from scanbench.program.program import Assign, Base, Const, Expr, If, Load, Place, Sequence, Stmt
from scanbench.program.shown import shown
from scanbench.program.sites import TrapKind
from scanbench.program.types import BOOL, BYTE, UDINT, ArrayType, Record, StringType, Subrange, Type, base_of
from scanbench.program.untyped import settle
from scanbench.syntax import tree

VARIANT = "VARIANT"
ASKED = {"TYPEOF": "KIND", "TYPEOFELEMENTS": "ELEMENT", "IS_ARRAY": "COUNT", "COUNTOFELEMENTS": "COUNT"}
"""Instructions that ask for something, and the member that has it."""
COPIES = frozenset(("VARIANTGET", "VARIANTPUT"))


def is_variant(body: Body, type: Type) -> bool:
    """Whether an input has this type."""
    return isinstance(type, Record) and type.name.upper() == VARIANT and may(body, Allowance.VARIANTS)


def variant_of(body: Body, node: tree.Expression, type: Record, what: str) -> Expr:
    """What the input `what` is given for this variable; a Variant is passed on."""
    if not isinstance(node, VARIABLES):
        raise body.report.reject("T005", f"{what} is a Variant and needs a variable.", node.span)
    given = _seen(body, node).type
    if given == type:
        return as_type(body, node, type, what)
    made = body.temporary(type, node.span)
    used(body, Allowance.VARIANTS, node.span, f"{what} is given the address and the type of `{shown(node)}`")
    pointer = reference_type(BYTE, pointer=True)
    values: dict[str, Expr] = {
        "POINTER": fold.convert(pointer, refer(body, node, pointer=True, passing=True)),
        "KIND": Const(UDINT, number_of(given)),
        "ELEMENT": Const(UDINT, number_of(given.element) if isinstance(given, ArrayType) else 0),
        "COUNT": Const(UDINT, given.count if isinstance(given, ArrayType) else 0),
        "SIZE": Const(UDINT, given.element.size if isinstance(given, ArrayType) else given.size),
        "LETTERS": Const(UDINT, given.capacity if isinstance(given, StringType) else 0),
    }
    stores = [Assign(inside(made, type, type.members[key]), value, node.span) for key, value in values.items()]
    return Sequence(tuple(stores), Load(made))


def number_of(type: Type) -> int:
    """The number of a type, which is not 0; strings of any length are one type."""
    if isinstance(type, Subrange):
        type = base_of(type)
    name = ("STRING" if type.width == 1 else "WSTRING") if isinstance(type, StringType) else type.name.upper()
    return crc32(name.encode()) or 1


def asked(body: Body, node: tree.Call) -> Expr | None:
    """`TypeOf(v)` as the number of a type, `CountOfElements(v)`, `IS_ARRAY(v)`; None of other calls."""
    name = _name(body, node)
    if name in COPIES:
        raise body.report.reject("T010", f"`{shown(node.callee)}` is a statement and has no value.", node.span)
    if name not in ASKED:
        return None
    values = [each.value for each in node.arguments if each.value is not None]
    if len(values) != 1 or not isinstance(values[0], VARIABLES):
        raise body.report.reject("T004", f"`{shown(node.callee)}` takes one variable.", node.span)
    place, type = body.place(values[0])[0], _seen(body, values[0]).type
    if isinstance(type, Record) and is_variant(body, type):
        found: Expr = Load(inside(place, type, type.members[ASKED[name]]))
    elif name == "TYPEOF":
        found = Const(UDINT, number_of(type))
    elif name == "TYPEOFELEMENTS":
        found = Const(UDINT, number_of(type.element) if isinstance(type, ArrayType) else 0)
    else:
        found = Const(UDINT, type.count if isinstance(type, ArrayType) else 0)
    return fold.compare("ne", BOOL, found, Const(UDINT, 0)) if name == "IS_ARRAY" else found


def with_types(body: Body, node: tree.BinaryOp) -> tree.BinaryOp:
    """`TypeOf(v) = Int` with the number of the type in place of its name; a Variant that is compared with NULL by its type."""
    if not may(body, Allowance.VARIANTS):
        return node
    sides = (node.left, node.right)
    if any(_asks_type(body, each) for each in sides):
        return replace(node, left=_numbered(body, node.left), right=_numbered(body, node.right))
    null = next((each for each in sides if isinstance(each, tree.Name) and each.name.upper() == "NULL"), None)
    other = next((each for each in sides if each is not null and isinstance(each, VARIABLES)), None)
    if null is None or other is None or not is_variant(body, _seen(body, other).type):
        return node
    kind = tree.MemberOf(other, "Kind", other.span)
    return replace(node, left=kind, right=tree.Literal("int", 0, None, null.span))


def with_type_labels(body: Body, node: tree.CaseStatement) -> tree.CaseStatement:
    """`CASE TypeOf(v) OF Int:` with the numbers of the types as labels."""
    if not may(body, Allowance.VARIANTS) or not _asks_type(body, node.selector):
        return node
    branches = tuple(
        (tuple((_numbered(body, first), last) for first, last in labels), inner) for labels, inner in node.branches
    )
    return replace(node, branches=branches)


def variant_copy(body: Body, node: tree.Call) -> Stmt | None:
    """VariantGet and VariantPut: they copy where the types are the same, else do nothing; None of other calls."""
    name = _name(body, node)
    if name not in COPIES:
        return None
    given = {(each.name or ("SRC", "DST")[min(at, 1)]).upper(): each.value for at, each in enumerate(node.arguments)}
    source, target = given.get("SRC"), given.get("DST")
    if source is None or target is None or len(given) != 2:
        raise body.report.reject("T004", f"`{shown(node.callee)}` takes SRC and DST.", node.span)
    variant, plain = (source, target) if name == "VARIANTGET" else (target, source)
    seen = _seen(body, variant) if isinstance(variant, VARIABLES) else None
    if seen is None or not isinstance(seen.type, Record) or not is_variant(body, seen.type):
        formal = "SRC" if name == "VARIANTGET" else "DST"
        raise body.report.reject("T002", f"{formal} of `{shown(node.callee)}` is a Variant.", variant.span)
    used(body, Allowance.VARIANTS, node.span, f"`{shown(node.callee)}` copies where the types are the same")
    record, place = seen.type, body.place(variant)[0]
    if name == "VARIANTGET":
        goal = declared_target(body, plain)[0]
        there = _target(body, place, record, goal.type, node)
        copy = Assign(goal, Load(there), node.span)
    else:
        value = settle(body.expression(plain))
        assert value.type is not None
        there = _target(body, place, record, value.type, node)
        copy = Assign(there, value, node.span)
    return If(((_same(place, record, there.type), (copy,)),), (), node.span)


def _same(place: Place, record: Record, type: Type) -> Expr:
    """Whether what the Variant leads to has this type; strings also the same length."""
    kind = fold.compare("eq", BOOL, Load(inside(place, record, record.members["KIND"])), Const(UDINT, number_of(type)))
    if not isinstance(type, StringType):
        return kind
    size = fold.compare("eq", BOOL, Load(inside(place, record, record.members["SIZE"])), Const(UDINT, type.size))
    return fold.binary("and", BOOL, kind, size)


def _target(body: Body, place: Place, record: Record, type: Type, node: tree.Call) -> Place:
    """What the Variant leads to, as a variable of this type."""
    pointer = Load(inside(place, record, record.members["POINTER"]))
    trap = body.trap(TrapKind.NULL, node.span, "the Variant leads to nothing")
    return Place(type, Base.IMAGE, 0, null_trap=trap, reference=fold.convert(reference_type(type, True), pointer))


def _seen(body: Body, node: tree.Expression) -> Place:
    """The variable, only to see its type."""
    mark = body.report.mark()
    found = body.place(node)[0]
    body.report.undo(mark)
    return found


def _name(body: Body, node: tree.Expression) -> str:
    """The name that is called, in upper case, where the dialect has the instruction and the program no function of that name."""
    if not isinstance(node, tree.Call) or not isinstance(node.callee, tree.Name) or not may(body, Allowance.VARIANTS):
        return ""
    name = node.callee.name.upper()
    return "" if name in body.pous.functions or body.scope.find(name) is not None else name


def _asks_type(body: Body, node: tree.Expression) -> bool:
    return _name(body, node) in ("TYPEOF", "TYPEOFELEMENTS")


def _numbered(body: Body, node: tree.Expression) -> tree.Expression:
    """The name of a type as its number; another TypeOf as it is."""
    if not isinstance(node, tree.Name) or body.scope.find(node.name) is not None:
        return node
    text = StringType(1, 1 if node.name.upper() == "STRING" else 2)
    type = text if node.name.upper() in ("STRING", "WSTRING") else body.declarations.named(node.name, node.span)
    return tree.Literal("int", number_of(type), None, node.span)
