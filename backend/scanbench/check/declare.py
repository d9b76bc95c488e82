"""Declarations -> types and members with offsets."""

import struct
from collections.abc import Callable
from dataclasses import dataclass, field

from scanbench.check import fold
from scanbench.check.context import Rejected, Report, did_you_mean
from scanbench.check.program import Const, Expr
from scanbench.check.types import (
    ELEMENTARY,
    MAX_STRING,
    ArrayType,
    Elementary,
    Kind,
    Member,
    Record,
    Section,
    StringType,
    Type,
    has_instance,
    initial_of,
)
from scanbench.plcmodel.model import Model
from scanbench.problems import Span
from scanbench.syntax import tree

DEFAULT_STRING = 80
MAX_BYTES = 64 * 1024 * 1024
UNSUPPORTED_TYPES = frozenset(
    "LTIME DATE LDATE TIME_OF_DAY TOD LTOD DATE_AND_TIME DT LDT CHAR WCHAR WSTRING ANY".split()
)

ConstantOf = Callable[[tree.Expression, Type | None], Const]
"""Evaluates a constant expression, or rejects."""


@dataclass(slots=True)
class Declarations:
    """All types, blocks and located memory of a program; types are made when first asked for."""

    report: Report
    model: Model
    areas: dict[str, int]
    """Offset of each area in the image."""
    constant_of: ConstantOf
    type_trees: dict[str, tree.TypeDeclaration] = field(default_factory=dict)
    block_trees: dict[str, tree.PouDeclaration] = field(default_factory=dict)
    """PROGRAM and FUNCTION_BLOCK declarations by upper-case name."""
    types: dict[str, Type] = field(default_factory=dict)
    defaults: dict[str, bytes] = field(default_factory=dict)
    """Start values of directly derived types that state one."""
    located: list[tuple[int, int, bytes]] = field(default_factory=list)
    """Start values of located variables in order of declaration: offset in the image, mask of each byte, bytes."""
    broken: set[tuple[str, str]] = field(default_factory=set)
    """(owner, name) in upper case of variables whose declaration is wrong: reported once, not at every use."""
    owners: list[Record] = field(default_factory=list)
    """What is being declared: constants declared above can stand in bounds and initial values."""
    _open: list[str] = field(default_factory=list)

    # ---- types ------------------------------------------------------------------------------------------

    def type_of(self, spec: tree.TypeSpec) -> Type:
        match spec:
            case tree.NamedType(name, span):
                return self.named(name, span)
            case tree.StringSpec(length, span):
                return self._string(length, span)
            case tree.ArraySpec():
                return self._array(spec)
            case tree.UnsupportedSpec():
                raise Rejected  # reported by the parser
            case tree.StructSpec():
                return self.struct(f"STRUCT of line {spec.span.line}", spec)

    def named(self, name: str, span: Span) -> Type:
        key = name.upper()
        if key in ELEMENTARY:
            return ELEMENTARY[key]
        if key in self.types:
            return self.types[key]
        if key in self._open:
            path = " -> ".join([*self._open[self._open.index(key) :], key])
            raise self.report.reject("D003", f"`{name}` contains itself ({path}), so it has no size.", span)
        if key in UNSUPPORTED_TYPES:
            raise self.report.reject("X001", f"The type {key} is not supported yet.", span)
        declaration, block = self.type_trees.get(key), self.block_trees.get(key)
        if declaration is None and block is None:
            hint = did_you_mean(name, [*ELEMENTARY, *self.type_trees, *self.block_trees])
            raise self.report.reject("D002", f"There is no type `{name}`.{hint}", span)
        self._open.append(key)
        try:
            made = self._declared(declaration) if declaration else self.block(block) if block else None
        finally:
            self._open.pop()
        assert made is not None
        self.types[key] = made
        return made

    def _declared(self, declaration: tree.TypeDeclaration) -> Type:
        if isinstance(declaration.type, tree.StructSpec):
            made: Type = self.struct(declaration.name, declaration.type)
        else:
            made = self.type_of(declaration.type)
        if declaration.initial is not None:
            self.defaults[declaration.name.upper()] = self.initial(declaration.initial, made)
        return made

    def _string(self, length: tree.Expression | None, span: Span) -> Type:
        if length is None:
            return StringType(DEFAULT_STRING)
        value = self.constant_of(length, None).value
        if not isinstance(value, int) or not 1 <= value <= MAX_STRING:
            raise self.report.reject("D006", f"A STRING holds 1 to {MAX_STRING} characters, not {value!r}.", span)
        return StringType(value)

    def _array(self, spec: tree.ArraySpec) -> Type:
        bounds = []
        for low_tree, high_tree in spec.ranges:
            low, high = self.constant_of(low_tree, None).value, self.constant_of(high_tree, None).value
            if not isinstance(low, int) or not isinstance(high, int):
                raise self.report.reject("D006", "The bounds of an array are integers.", low_tree.span)
            if not -(1 << 63) <= low <= high < 1 << 63 and low <= high:
                raise self.report.reject("D006", "The bounds of an array fit LINT.", low_tree.span)
            if low > high:
                raise self.report.reject(
                    "D006", f"The lower bound {low} is above the upper bound {high}.", low_tree.span
                )
            bounds.append((low, high))
        made = ArrayType(tuple(bounds), self.type_of(spec.element))
        if made.size > MAX_BYTES:
            raise self.report.reject("D012", f"This array takes {made.size} bytes; at most {MAX_BYTES}.", spec.span)
        return made

    def struct(self, name: str, spec: tree.StructSpec) -> Record:
        record = Record(name, Kind.STRUCT)
        for variable in spec.members:
            self.declare(record, variable, Section.MEMBER, constant=False)
        record.close()
        return record

    def block(self, declaration: tree.PouDeclaration) -> Record:
        """The variables of an instance of a FUNCTION_BLOCK or PROGRAM; temporaries are in its frame."""
        record = Record(declaration.name, Kind.BLOCK)
        for section in declaration.sections:
            kind = Section(section.keyword)
            if kind in (Section.TEMP, Section.EXTERNAL):
                continue
            if kind is Section.GLOBAL:
                self.report.error("D008", "VAR_GLOBAL stands outside of POUs.", section.span)
                continue
            if declaration.kind == "program" and kind is Section.IN_OUT:
                self.report.error("D008", "A PROGRAM has no VAR_IN_OUT here; use VAR_EXTERNAL.", section.span)
                continue
            for variable in section.variables:
                self.declare(record, variable, kind, "CONSTANT" in section.qualifiers)
        record.close()
        return record

    def frame(self, declaration: tree.PouDeclaration, instance: Record) -> Record:
        """Temporaries of a block; all variables of a FUNCTION, with the result under the function's name."""
        self.owners.append(instance)
        try:
            return self._frame(declaration, instance)
        finally:
            self.owners.pop()

    def _frame(self, declaration: tree.PouDeclaration, instance: Record) -> Record:
        record = Record(declaration.name, Kind.STRUCT)
        function = declaration.kind == "function"
        for section in declaration.sections:
            kind = Section(section.keyword)
            if kind is Section.EXTERNAL or (not function and kind is not Section.TEMP):
                continue
            if kind is Section.GLOBAL:
                self.report.error("D008", "VAR_GLOBAL stands outside of POUs.", section.span)
                continue
            for variable in section.variables:
                if variable.address is not None:
                    self.report.error("D008", "A temporary variable has no address.", variable.span)
                    continue
                if variable.name.upper() in instance.members or (
                    function and variable.name.upper() == declaration.name.upper()
                ):
                    self.report.error("D001", f"`{variable.name}` is declared already; rename one.", variable.span)
                    continue
                member = self.declare(record, variable, kind, "CONSTANT" in section.qualifiers)
                if member and kind is not Section.IN_OUT and has_instance(member.type):
                    what = "FUNCTION" if function else "VAR_TEMP"
                    self.report.error(
                        "D008", f"An instance of {member.type.name} must keep its state; not in a {what}.", member.span
                    )
        if function and declaration.result is not None:
            try:
                result = Member(declaration.name, self.type_of(declaration.result), Section.RESULT, declaration.span)
                result.initial = self._default(declaration.result, result.type)
                record.place(result)
            except Rejected:
                pass
        record.close()
        return record

    # ---- variables --------------------------------------------------------------------------------------

    def declare(self, owner: Record, variable: tree.Variable, section: Section, constant: bool) -> Member | None:
        """Adds the variable to its owner, unless its declaration is wrong."""
        self.owners.append(owner)
        try:
            return self._declare(owner, variable, section, constant)
        finally:
            self.owners.pop()

    def _declare(self, owner: Record, variable: tree.Variable, section: Section, constant: bool) -> Member | None:
        key = variable.name.upper()
        if key in owner.members:
            first = owner.members[key].span
            self.report.error(
                "D001", f"`{variable.name}` is declared already in line {first.line}; rename one.", variable.span
            )
            return None
        try:
            made = self.type_of(variable.type)
        except Rejected:
            self.broken.add((owner.name.upper(), key))
            return None
        if section is not Section.IN_OUT and isinstance(made, Record) and made.name.upper() == owner.name.upper():
            self.report.error("D003", f"`{owner.name}` contains itself, so it has no size.", variable.span)
            return None
        if isinstance(made, Record) and self._is_program(made):
            self.report.error(
                "D002", f"`{made.name}` is a PROGRAM; only FUNCTION_BLOCKs have instances.", variable.span
            )
            return None
        member = Member(variable.name, made, section, variable.span, constant=constant)
        try:
            if section is Section.IN_OUT:
                if variable.initial is not None:
                    self.report.error("D004", "An in-out has no initial value; it is bound at each call.", member.span)
            elif variable.initial is not None:
                member.initial = self.initial(variable.initial, made)
            else:
                member.initial = self._default(variable.type, made)
            if variable.address is not None:
                self._locate(member, variable)
        except Rejected:
            pass
        owner.place(member)
        if owner.size > MAX_BYTES:
            self.report.error("D012", f"`{owner.name}` takes more than {MAX_BYTES} bytes.", variable.span)
            owner.members.pop(key)
        return member

    def _is_program(self, record: Record) -> bool:
        declaration = self.block_trees.get(record.name.upper())
        return record.kind is Kind.BLOCK and declaration is not None and declaration.kind == "program"

    def _default(self, spec: tree.TypeSpec, made: Type) -> bytes:
        if isinstance(spec, tree.NamedType) and spec.name.upper() in self.defaults:
            return self.defaults[spec.name.upper()]
        return initial_of(made)

    def _locate(self, member: Member, variable: tree.Variable) -> None:
        address, span = variable.address or "", variable.address_span or variable.span
        member.offset, member.bit = self.place_of(address, member.type, span)
        member.address = address
        if variable.initial is None:
            return
        if member.bit is None:
            self.located.append((member.offset, 0xFF, member.initial))
        else:
            self.located.append((member.offset, 1 << member.bit, bytes([member.initial[0] << member.bit])))

    def place_of(self, address: str, type: Type, span: Span) -> tuple[int, int | None]:
        """Offset in the image, and bit, of an address of the model for a variable of this type."""
        if address.endswith("*"):
            raise self.report.reject("X001", "Incomplete addresses (`AT %I*`) are not supported yet.", span)
        location = self.model.locate(address)
        if location is None:
            why = self.model.why_not(address)
            raise self.report.reject("D005", f"`{address}` is not an address of the {self.model.name}: {why}", span)
        bool_type = isinstance(type, Elementary) and type.kind is Kind.BOOL
        if bool_type != (location.bits == 1):
            need = "a bit, e.g. `.00`" if bool_type else "a whole word, not a bit"
            raise self.report.reject("D005", f"`{address}` does not fit {type}: it needs {need}.", span)
        if _has_bool(type) and not bool_type:
            raise self.report.reject(
                "D005", f"{type} has BOOL members, which take bytes; locate them one by one.", span
            )
        if location.byte + type.size > location.area.size:
            raise self.report.reject(
                "D005", f"{type} takes {type.size} bytes and goes beyond the end of area {location.area.name}.", span
            )
        return self.areas[location.area.name] + location.byte, location.bit

    # ---- initial values ---------------------------------------------------------------------------------

    def initial(self, value: tree.Initial, type: Type) -> bytes:
        """The image of an initial value."""
        match value:
            case tree.ArrayInit():
                return self._array_initial(value, type)
            case tree.StructInit():
                return self._record_initial(value, type)
        if not isinstance(type, Elementary | StringType):
            example = "[1, 2, 3(0)]" if isinstance(type, ArrayType) else "(member := value)"
            raise self.report.reject("D004", f"An initial value of {type} is written like {example}.", value.span)
        return encode(type, self.constant_of(value, type))

    def _array_initial(self, value: tree.ArrayInit, type: Type) -> bytes:
        if not isinstance(type, ArrayType):
            raise self.report.reject("D004", f"A list of values initialises an array, not {type}.", value.span)
        element = type.element
        if len(type.bounds) > 1 and any(isinstance(item, tree.ArrayInit) for _, item in value.items):
            element = ArrayType(type.bounds[1:], type.element)
        parts: list[bytes] = []
        for count_tree, item in value.items:
            count = 1 if count_tree is None else self.constant_of(count_tree, None).value
            if not isinstance(count, int) or count < 0 or count > type.count:
                raise self.report.reject("D004", f"{count!r} values do not fit {type}.", value.span)
            parts += [self.initial(item, element)] * count
        total = type.size // element.size
        if len(parts) > total:
            raise self.report.reject("D004", f"{len(parts)} values do not fit {type}; at most {total}.", value.span)
        parts += [initial_of(element)] * (total - len(parts))
        return b"".join(parts)

    def _record_initial(self, value: tree.StructInit, type: Type) -> bytes:
        if not isinstance(type, Record):
            raise self.report.reject("D004", f"Values by member initialise a structure, not {type}.", value.span)
        image = bytearray(type.initial())
        for name, item, span in value.members:
            member = type.members.get(name.upper())
            if member is None or member.section in (Section.IN_OUT, Section.OUTPUT) or member.located:
                hint = did_you_mean(name, [each.name for each in type.members.values()])
                raise self.report.reject("D004", f"`{type.name}` has no `{name}` to initialise.{hint}", span)
            data = self.initial(item, member.type)
            image[member.offset : member.offset + len(data)] = data
        return bytes(image)


def _has_bool(type: Type) -> bool:
    if isinstance(type, ArrayType):
        return _has_bool(type.element)
    if isinstance(type, Record):
        return any(_has_bool(member.type) for member in type.members.values())
    return type.kind is Kind.BOOL


def encode(type: Elementary | StringType, constant: Expr) -> bytes:
    """The bytes of a constant in the image."""
    assert isinstance(constant, Const)
    value = constant.value
    if isinstance(type, StringType):
        assert isinstance(value, bytes)
        text = value[: type.capacity]
        return (len(text).to_bytes(2, "little") + text).ljust(type.size, b"\0")
    if type.kind is Kind.REAL:
        return struct.pack("<f" if type.size == 4 else "<d", fold.round_real(float(value), type))
    return int(value).to_bytes(type.size, "little", signed=type.signed)
