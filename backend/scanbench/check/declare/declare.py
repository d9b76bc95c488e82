"""Declarations -> types and members with offsets."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field, replace

from scanbench.check.body.notes import make_note, may_have_note
from scanbench.check.context import Rejected, Report, did_you_mean
from scanbench.check.declare.initial_values import initial_image
from scanbench.check.declare.names import Names, Space, qualified
from scanbench.check.declare.specs import (
    EnumerationValues,
    enumeration,
    is_relative,
    place_bounds,
    place_edge,
    place_relative,
    reference,
    structure,
    subrange,
)
from scanbench.plcmodel.model import Model
from scanbench.problems import Span
from scanbench.program.origin import in_library
from scanbench.program.program import Const, Expr
from scanbench.program.types import (
    ABBREVIATIONS,
    ELEMENTARY,
    MAX_STRING,
    NULL,
    SLOT_BYTES,
    ArrayType,
    Elementary,
    Kind,
    Member,
    OpenArray,
    Record,
    Reference,
    Section,
    StringType,
    Type,
    actual_name,
    has_instance,
    initial_of,
)
from scanbench.syntax import tree

DEFAULT_STRING = 80
MAX_BYTES = 64 * 1024 * 1024
TYPE_NAMES = {**ELEMENTARY, **{name: ABBREVIATIONS[name] for name in ("TOD", "LTOD", "DT", "LDT")}}

CALLED = ("function", "method", "get", "set")
"""POUs whose variables all live in a frame."""

ConstantOf = Callable[[tree.Expression, Type | None], Const]
"""Evaluates a constant expression, or rejects."""
ReferenceOf = Callable[[Record, tree.Expression, Reference], Expr]
"""The reference that an expression gives among the variables of an owner, or rejects."""
Inherit = Callable[[Record, tree.PouDeclaration], None]
"""Gives the record of a block what it has from its base, before its own members."""


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
    """PROGRAM, FUNCTION_BLOCK, CLASS and INTERFACE declarations by upper-case name."""
    inherit: Inherit = field(default=lambda record, declaration: None)
    types: dict[str, Type] = field(default_factory=dict)
    defaults: dict[str, bytes] = field(default_factory=dict)
    """Start values of directly derived types that state one."""
    located: list[tuple[int, int, bytes]] = field(default_factory=list)
    """Start values of located variables in order of declaration: offset in the image, mask of each byte, bytes."""
    broken: set[tuple[str, str]] = field(default_factory=set)
    """(owner, name) in upper case of variables whose declaration is wrong: reported once, not at every use."""
    owners: list[Record] = field(default_factory=list)
    """What is being declared: constants declared above can stand in bounds and initial values."""
    looked_at: frozenset[str] = frozenset()
    """Names of variables that have a note, in upper case; see `notes`."""
    incomplete: bool = False
    """Whether any variable waits for its address."""
    start_references: list[tuple[Record, Member, tree.Expression]] = field(default_factory=list)
    """References that start with REF(variable): owner, variable, what it starts with."""
    reference_of: ReferenceOf = field(default=lambda owner, node, type: Const(NULL, 0))
    symbols: Record = field(default_factory=lambda: Record("", Kind.STRUCT))
    """Variables that the model gives to every program."""
    names: Names = field(init=False)
    values: EnumerationValues = field(init=False)
    shells: dict[str, Record] = field(default_factory=dict)
    """Structures and blocks that were asked for, complete or not: a reference may refer to what is still open."""
    _pending: list[str] = field(default_factory=list)
    """Keys of shells that wait to be completed."""
    _open: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.names = Names(self.report)
        self.values = EnumerationValues(self)

    # ---- types ------------------------------------------------------------------------------------------

    def type_of(self, spec: tree.TypeSpec) -> Type:
        match spec:
            case tree.NamedType(name, span):
                return self.named(name, span)
            case tree.StringSpec(length, span, wide):
                return self._string(length, span, 2 if wide else 1)
            case tree.ArraySpec():
                return self._array(spec)
            case tree.StructSpec():
                record = structure(self, f"STRUCT of line {spec.span.line}", spec)
                record.written_out = True
                return record
            case tree.OpenArraySpec(dimensions, element):
                return OpenArray(dimensions, self._element(element))
            case tree.EnumSpec():
                made = enumeration(self, spec, "")
                self.values.add_inline(self.owners[-1].name if self.owners else "GLOBAL", made)
                return made
            case tree.SubrangeSpec():
                return subrange(self, spec, "")
            case tree.ReferenceSpec():
                return reference(self, spec)

    def named(self, name: str, span: Span) -> Type:
        key = name.upper()
        if key in TYPE_NAMES:
            return TYPE_NAMES[key]
        key = self.find_type(name, span) or key
        if key in self.types:
            return self.types[key]
        if key in self._open:
            path = " -> ".join([*self._open[self._open.index(key) :], key])
            raise self.report.reject("D003", f"`{name}` contains itself ({path}), so it has no size.", span)
        declaration, block = self.type_trees.get(key), self.block_trees.get(key)
        if declaration is None and block is None:
            hint = did_you_mean(name, [*TYPE_NAMES, *self.type_trees, *self.block_trees])
            raise self.report.reject("D002", f"There is no type `{name}`.{hint}", span)
        origin = declaration or block
        assert origin is not None
        self._open.append(key)
        try:
            with self.names.within(Space(origin.namespace, origin.using)):
                made = self._declared(declaration) if declaration else self._block_type(block) if block else None
        finally:
            self._open.pop()
        assert made is not None
        self.types[key] = made
        self._complete()
        return made

    def _complete(self) -> None:
        """Makes what references referred to while it could not be made."""
        while self._pending and not self._open:
            key = self._pending.pop()
            origin = self.type_trees.get(key) or self.block_trees.get(key)
            if origin is not None and key not in self.types:
                with suppress(Rejected):
                    self.named(key, origin.span)

    def declare_types(self) -> None:
        """Makes the types that nothing used, for what is wrong in them."""
        for key, declaration in self.type_trees.items():
            if key not in self.types:
                with suppress(Rejected):
                    self.named(key, declaration.span)

    def referred(self, spec: tree.TypeSpec) -> Type:
        """A type that something refers to: while types are open, one that need not be complete."""
        if not isinstance(spec, tree.NamedType) or not self._open:
            return self.type_of(spec)
        key = self.find_type(spec.name, spec.span) or spec.name.upper()
        declaration, block = self.type_trees.get(key), self.block_trees.get(key)
        if key in self.types or (block is not None and block.kind == "interface"):
            return self.named(spec.name, spec.span)
        if declaration is not None and isinstance(declaration.type, tree.StructSpec):
            kind, name = Kind.UNION if declaration.type.union else Kind.STRUCT, declaration.name
        elif block is not None:
            kind, name = Kind.BLOCK, block.name
        else:
            return self.named(spec.name, spec.span)
        self._pending.append(key)
        origin = declaration or block
        assert origin is not None
        return self.shells.get(key) or self.record(qualified(origin.namespace, name), kind)

    def record(self, name: str, kind: Kind) -> Record:
        """The record of this name, which may be known to references before its members are."""
        made = self.shells.get(name.upper())
        if made is None or made.members or name.startswith("STRUCT of "):
            made = self.shells[name.upper()] = Record(name, kind)
        return made

    def find_type(self, name: str, span: Span) -> str | None:
        """The key of the type or block that this name means here."""
        return self.names.find(name, span, self.type_trees, self.block_trees)

    def _declared(self, declaration: tree.TypeDeclaration) -> Type:
        name = qualified(declaration.namespace, declaration.name)
        match declaration.type:
            case tree.StructSpec() as spec:
                made: Type = structure(self, name, spec)
            case tree.EnumSpec() as spec:
                made = enumeration(self, spec, name)
            case tree.SubrangeSpec() as spec:
                made = subrange(self, spec, name)
            case spec:
                made = self.type_of(spec)
        if declaration.initial is not None:
            self.defaults[name.upper()] = self.initial(declaration.initial, made)
        else:
            default = self._default(declaration.type, made)
            if default != initial_of(made):
                self.defaults[name.upper()] = default
        return made

    def _string(self, length: tree.Expression | None, span: Span, width: int) -> Type:
        if length is None:
            return StringType(DEFAULT_STRING, width)
        value = self.constant_of(length, None).value
        if not isinstance(value, int) or not 1 <= value <= MAX_STRING:
            raise self.report.reject("D006", f"A STRING holds 1 to {MAX_STRING} characters, not {value!r}.", span)
        return StringType(value, width)

    def _element(self, spec: tree.TypeSpec) -> Type:
        """The type of an array's elements."""
        made = self.type_of(spec)
        if isinstance(made, OpenArray):
            raise self.report.reject("D008", "ARRAY[*] cannot be the element of an array; add dimensions.", spec.span)
        return made

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
        made = ArrayType(tuple(bounds), self._element(spec.element))
        if made.size > MAX_BYTES:
            raise self.report.reject("D012", f"This array takes {made.size} bytes; at most {MAX_BYTES}.", spec.span)
        if made.count > MAX_BYTES:  # of what takes no room
            raise self.report.reject("D012", f"This array has {made.count} elements; at most {MAX_BYTES}.", spec.span)
        return made

    def _block_type(self, declaration: tree.PouDeclaration) -> Type:
        record = self.block(declaration)
        if record.kind is Kind.INTERFACE:
            return Reference(record.name, Kind.REF, SLOT_BYTES, record)
        return record

    def block(self, declaration: tree.PouDeclaration) -> Record:
        """The variables of an instance of a FUNCTION_BLOCK or PROGRAM; temporaries are in its frame."""
        role = Kind.INTERFACE if declaration.kind == "interface" else Kind.BLOCK
        record = self.record(qualified(declaration.namespace, declaration.name), role)
        self.inherit(record, declaration)
        copied = self._copies(declaration)
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
                by_value = copied and kind is Section.IN_OUT and not self._keeps_state(variable.type)
                member = self.declare(record, variable, kind, "CONSTANT" in section.qualifiers, by_value)
                if member is not None:
                    member.access = section.access if kind is Section.VAR else "PUBLIC"
                    member.retain = bool({"RETAIN", "PERSISTENT"} & set(section.qualifiers))
                    member.non_retain = "NON_RETAIN" in section.qualifiers
        record.close()
        return record

    def _copies(self, declaration: tree.PouDeclaration) -> bool:
        """Whether a block takes its in-outs by value."""
        if declaration.kind != "function_block" or in_library(declaration.span):
            return False
        return (declaration.in_out or self.model.in_out) == "value"

    def _keeps_state(self, spec: tree.TypeSpec, around: tuple[str, ...] = ()) -> bool:
        """Whether instances of blocks are in it, or its size comes with each call: such an in-out is always a reference."""
        match spec:
            case tree.OpenArraySpec():
                return True
            case tree.ArraySpec(element=element):
                return self._keeps_state(element, around)
            case tree.StructSpec():
                return bool(spec.extends) or any(self._keeps_state(each.type, around) for each in spec.members)
            case tree.NamedType(name, span):
                key = name.upper() if name.upper() in TYPE_NAMES else self.find_type(name, span) or name.upper()
                if key in self.block_trees or key in around:
                    return True
                declared = self.type_trees.get(key)
                return declared is not None and self._keeps_state(declared.type, (*around, key))
            case _:
                return False

    def frame(self, declaration: tree.PouDeclaration, instance: Record, this: Record | None = None) -> Record:
        """Temporaries of a block; all variables of a FUNCTION, with the result under the function's name.

        A method begins with the in-out THIS; its variables may hide those of the instance.
        """
        self.owners.append(this or instance)
        try:
            return self._frame(declaration, instance, this)
        finally:
            self.owners.pop()

    def _frame(self, declaration: tree.PouDeclaration, instance: Record, this: Record | None) -> Record:
        function = declaration.kind in CALLED
        if this is None:
            record = Record(qualified(declaration.namespace, declaration.name), Kind.STRUCT)
        else:
            part = f".{declaration.kind}" if declaration.kind in ("get", "set") else ""
            record = Record(f"{this.name}.{declaration.name}{part}", Kind.STRUCT)
            record.place(Member("THIS", this, Section.IN_OUT, declaration.span, hidden=True))
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
                    function and declaration.kind != "set" and variable.name.upper() == declaration.name.upper()
                ):
                    self.report.error("D001", f"`{variable.name}` is declared already; rename one.", variable.span)
                    continue
                constant = "CONSTANT" in section.qualifiers
                if function and kind is Section.INPUT and isinstance(variable.type, tree.OpenArraySpec):
                    self.declare(record, variable, Section.IN_OUT, constant=True)  # referred to, and only read
                    continue
                member = self.declare(record, variable, kind, constant)
                if member and kind is not Section.IN_OUT and has_instance(member.type):
                    what = "FUNCTION" if function else "VAR_TEMP"
                    self.report.error(
                        "D008", f"An instance of {member.type.name} must keep its state; not in a {what}.", member.span
                    )
        if function and declaration.kind != "set" and declaration.result is not None:
            try:
                result = Member(declaration.name, self.type_of(declaration.result), Section.RESULT, declaration.span)
                result.initial = self._default(declaration.result, result.type)
                record.place(result)
            except Rejected:
                record.open = True
                self.broken.add((record.name.upper(), declaration.name.upper()))
        record.close()
        return record

    # ---- variables --------------------------------------------------------------------------------------

    def declare(
        self, owner: Record, variable: tree.Variable, section: Section, constant: bool, copied: bool = False
    ) -> Member | None:
        """Adds the variable to its owner, unless its declaration is wrong; `copied` as in `Member`."""
        if variable.arguments and variable.initial is None:
            variable = _with_arguments(variable)
        self.owners.append(owner)
        try:
            return self._declare(owner, variable, section, constant, copied)
        finally:
            self.owners.pop()

    def _declare(
        self, owner: Record, variable: tree.Variable, section: Section, constant: bool, copied: bool
    ) -> Member | None:
        key = variable.name.upper()
        if key in owner.members:
            first = owner.members[key].span
            self.report.error(
                "D001", f"`{variable.name}` is declared already in line {first.line}; rename one.", variable.span
            )
            return None
        try:
            bound = section is Section.IN_OUT and not copied
            made = self.referred(variable.type) if bound else self.type_of(variable.type)
            if isinstance(made, OpenArray) and section is not Section.IN_OUT:
                raise self.report.reject(
                    "D008",
                    "ARRAY[*] is for VAR_IN_OUT, and for VAR_INPUT of a FUNCTION or METHOD; state the bounds here.",
                    variable.span,
                )
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
        if variable.address is not None and variable.address.endswith("*"):
            return self._incomplete(owner, variable, section, made)
        member = Member(variable.name, made, section, variable.span, constant=constant, copied=copied)
        try:
            if section is Section.IN_OUT:
                member.initial = self._default(variable.type, made) if copied else b""
                if variable.initial is not None:
                    self.report.error("D004", "An in-out has no initial value; it is bound at each call.", member.span)
            elif isinstance(made, Reference) and isinstance(variable.initial, tree.Call):
                self._start_reference(owner, member, variable.initial)
            elif variable.initial is not None:
                member.initial = self.initial(variable.initial, made)
            else:
                member.initial = self._default(variable.type, made)
            if variable.address is not None and not (section is Section.MEMBER and is_relative(variable.address)):
                self._locate(member, variable)
        except Rejected:
            pass
        self._place(owner, member, variable)
        if owner.size > MAX_BYTES:
            self.report.error("D012", f"`{owner.name}` takes more than {MAX_BYTES} bytes.", variable.span)
            owner.members.pop(key)
        return member

    def _incomplete(self, owner: Record, variable: tree.Variable, section: Section, made: Type) -> Member | None:
        """`AT %I*`: a reference that VAR_CONFIG fills for each instance, and memory for when it does not."""
        span = variable.address_span or variable.span
        if section not in (Section.VAR, Section.GLOBAL) or has_instance(made) or isinstance(made, OpenArray):
            self.report.error("D005", "`AT %I*` is for elementary data in VAR and VAR_GLOBAL.", span)
            return None
        if variable.initial is not None:
            self.report.error("D004", "Give this its initial value in VAR_CONFIG, with its address.", span)
        type = Reference(f"REFERENCE TO {made.name}", Kind.REF, SLOT_BYTES, made, automatic=True)
        member = Member(variable.name, type, section, variable.span, incomplete=(variable.address or "").upper())
        self.incomplete = True
        owner.place(member)
        owner.place(
            Member(own_memory(variable.name), made, Section.VAR, variable.span, initial=initial_of(made), hidden=True)
        )
        return member

    def _start_reference(self, owner: Record, member: Member, node: tree.Expression) -> None:
        if owner.kind is not Kind.BLOCK and member.section is not Section.GLOBAL:
            raise self.report.reject("D004", "This starts with NULL; assign the reference in the body.", node.span)
        self.start_references.append((owner, member, node))

    def _place(self, owner: Record, member: Member, variable: tree.Variable) -> None:
        if variable.address is not None and member.section is Section.MEMBER and is_relative(variable.address):
            try:
                place_relative(self, owner, member, variable.address, variable.address_span or variable.span)
            except Rejected:
                owner.place(member)
            return
        owner.place(member)
        if member.copied:
            owner.place(Member(actual_name(member.name), member.type, Section.IN_OUT, member.span, hidden=True))
        if isinstance(member.type, OpenArray):
            place_bounds(owner, member)
        if member.name.upper().rpartition(".")[2] in self.looked_at and may_have_note(member):
            make_note(owner, member, initial_of(member.type) if member.bound else member.initial)
        if variable.edge:
            if member.section is not Section.INPUT or member.type != ELEMENTARY["BOOL"]:
                self.report.error("D008", f"{variable.edge}_EDGE is for BOOL in VAR_INPUT.", variable.span)
            else:
                place_edge(owner, member, variable.edge)

    def _is_program(self, record: Record) -> bool:
        declaration = self.block_trees.get(record.name.upper())
        return record.kind is Kind.BLOCK and declaration is not None and declaration.kind == "program"

    def _default(self, spec: tree.TypeSpec, made: Type) -> bytes:
        if isinstance(spec, tree.NamedType) and self.defaults:
            key = self.find_type(spec.name, spec.span)
            if key in self.defaults:
                return self.defaults[key]
        if isinstance(spec, tree.ArraySpec) and isinstance(made, ArrayType) and self.defaults:
            return self._default(spec.element, made.element) * made.count
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
            raise self.report.reject(
                "D005", "A whole address is needed here; only VAR and VAR_GLOBAL wait for one.", span
            )
        location = self.model.locate(address)
        if location is None:
            raise self.report.reject("D005", f"{self.model.why_not(address)}.", span)
        bool_type = isinstance(type, Elementary) and type.kind is Kind.BOOL
        if bool_type != (location.bits == 1):
            area, byte = location.area, location.byte
            if bool_type:
                need = f"it needs a bit, e.g. `{self.model.format(area, byte, 0, 1)}`"
            else:  # D40000 is a bit where there is no such word
                is_bit, word = (
                    self.model.format(area, byte, location.bit, 1),
                    self.model.format(area, byte & ~1, None, 16),
                )
                need = f"it is the bit {is_bit}; a whole word is written like `{word}`"
            raise self.report.reject("D005", f"`{address}` does not fit {type}: {need}.", span)
        if _has_bool(type) and not bool_type:
            raise self.report.reject(
                "D005", f"{type} has BOOL members, which take bytes; locate them one by one.", span
            )
        if location.byte + type.size > location.area.size:
            raise self.report.reject(
                "D005", f"{type} takes {type.size} bytes and goes beyond the end of area {location.area.name}.", span
            )
        return self.areas[location.area.name] + location.byte, location.bit

    def initial(self, value: tree.Initial, type: Type) -> bytes:
        """The image of an initial value."""
        return initial_image(self, value, type)


def _with_arguments(variable: tree.Variable) -> tree.Variable:
    """`inst : FB(a := 1)` means `inst : FB := (a := 1)`."""
    members = tuple((each.name or "", each.value, each.span) for each in variable.arguments if each.value is not None)
    return replace(variable, initial=tree.StructInit(members, variable.span))


def own_memory(name: str) -> str:
    """The hidden variable beside an `AT %I*` that is used as long as no address is given."""
    return f"{name}$memory"


def _has_bool(type: Type) -> bool:
    if isinstance(type, ArrayType):
        return _has_bool(type.element)
    if isinstance(type, Record):
        return any(_has_bool(member.type) for member in type.members.values())
    return type.kind is Kind.BOOL
