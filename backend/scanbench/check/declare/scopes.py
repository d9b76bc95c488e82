"""What a name means inside a POU."""

import struct
from dataclasses import dataclass, field, replace

from scanbench.check.declare.classes import Classes
from scanbench.check.declare.later import Later
from scanbench.check.declare.names import Space
from scanbench.check.life.code import Code
from scanbench.plcmodel.model import Who
from scanbench.program.own_variables import SYSTEM
from scanbench.program.program import Base, Const, Place, Pou, Stmt
from scanbench.program.strings import characters
from scanbench.program.types import (
    SLOT_BYTES,
    ULINT,
    Elementary,
    Kind,
    Member,
    Record,
    StringType,
    Subrange,
    Type,
    base_of,
)
from scanbench.syntax import tree
from scanbench.syntax.lexer import GLOBAL_MARK


@dataclass(slots=True)
class Scope:
    """Names visible in one POU, the nearest first: temporaries, instance variables, externals, globals."""

    pou: str
    globals: Record
    instance: Record | None = None
    frame: Record | None = None
    externals: dict[str, Member] = field(default_factory=dict)
    constants: tuple[Record, ...] = ()
    """Records under declaration, for constant expressions."""
    later: Later | None = None
    """What of these, and of the global variables, is still to be declared."""
    this: Place | None = None
    """Slot of THIS, in a method: through it the body reaches the variables of the instance."""
    space: Space = field(default_factory=Space)
    """The namespaces whose global variables are visible."""
    system: tuple[Record, ...] = ()
    """Variables that every program has: the nearest of all to be hidden."""
    kept: dict[str, tuple[Member, Base, Record]] = field(default_factory=dict)
    """VAR_INST and VAR_STAT: what is found under their names."""
    who: Who = "program"
    """With whose rights it writes to areas of the model."""
    policy: str = ""
    """What becomes of values outside of a subrange here, where their variables say nothing."""
    wires: dict[str, str] = field(default_factory=dict)
    """Of the network that is being checked: its wires and links, `#LOW`, and the hidden variables that they are, in upper case."""

    def find(self, name: str) -> tuple[Member, Base, Record] | None:
        """The member, what its offset counts from, and who owns it."""
        if name.startswith(GLOBAL_MARK):  # what the POU declares is not meant
            outside = replace(self, frame=None, kept={}, instance=None, externals={}, constants=())
            return outside.find(name.removeprefix(GLOBAL_MARK))
        key = name.upper()
        key = self.wires.get(key, key)
        for owner in self.constants:
            if self.later is not None:
                self.later.ask(owner, key)
            if key in owner.members:
                return owner.members[key], Base.SELF, owner
        if self.frame is not None and key in self.frame.members:
            return self.frame.members[key], Base.FRAME, self.frame
        if key in self.kept:
            return self.kept[key]
        if self.instance is not None and key in self.instance.members:
            return self.instance.members[key], Base.SELF, self.instance
        if key in self.externals:
            return self.externals[key], Base.IMAGE, self.globals
        for full in self.space.candidates(key):
            if self.later is not None:
                self.later.ask(self.globals, full)
            if full in self.globals.members:
                return self.globals.members[full], Base.IMAGE, self.globals
        for owner in (*(() if self.constants else (SYSTEM,)), *self.system):
            if key in owner.members:
                return owner.members[key], Base.IMAGE, owner
        return None

    def names(self) -> list[str]:
        """Everything that `find` would find, for near matches."""
        owners = [owner for owner in (self.frame, self.instance, self.globals, *self.system) if owner is not None]
        return [member.name for owner in owners for member in owner.members.values() if not member.hidden]


def place_of(member: Member, base: Base, owner: Record, null_trap: int) -> Place:
    """Where a variable lives; an in-out lives where its slot refers to."""
    if member.located:
        return Place(member.type, Base.IMAGE, member.offset, bit=member.bit, variable="@")
    if owner.name == SYSTEM.name:
        return Place(member.type, base, member.offset)  # the engine writes it too, not only the program
    prefix = "frame " if base is Base.FRAME else ""
    variable = f"{prefix}{member.home or owner.name}.{member.name}".upper()
    if member.bound:
        slot = Place(ULINT, base, member.offset, variable=variable)
        assert ULINT.size == SLOT_BYTES
        return Place(member.type, base, 0, slot=slot, null_trap=null_trap)
    return Place(member.type, base, member.offset, bit=member.bit, variable=variable)


def decode(type: Type, data: bytes) -> Const | None:
    """A constant from its bytes in the image; None for arrays and structures."""
    if isinstance(type, StringType):
        return Const(type, characters(type, data))
    if not isinstance(type, Elementary):
        return None
    if type.kind is Kind.REAL:
        return Const(type, struct.unpack("<f" if type.size == 4 else "<d", data)[0])
    plain = base_of(type) if isinstance(type, Subrange) else type
    return Const(plain, int.from_bytes(data, "little", signed=type.signed))


@dataclass(frozen=True, slots=True)
class Instance:
    """A generic FUNCTION for certain types; its body is checked when all others are."""

    pou: Pou
    declaration: tree.PouDeclaration


@dataclass(slots=True)
class Pous:
    """The POUs that can be called, by upper-case name, and who calls whom."""

    blocks: dict[str, Pou] = field(default_factory=dict)
    functions: dict[str, Pou] = field(default_factory=dict)
    classes: Classes = field(default_factory=Classes)
    generic: dict[str, tree.PouDeclaration] = field(default_factory=dict)
    """FUNCTIONs with parameters of ANY_NUM and its like."""
    variadic: set[str] = field(default_factory=set)
    """FUNCTIONs that may be called with more arguments than they name."""
    overloads: dict[str, list[str]] = field(default_factory=dict)
    """Of a FUNCTION whose name others have as well, the keys of those."""
    instances: dict[str, Instance] = field(default_factory=dict)
    """Those that are called, for each combination of types."""
    dispatchers: dict[str, Pou] = field(default_factory=dict)
    """Generated POUs that go on to the method or body of an instance's class, by name."""
    plain: dict[Pou, tuple[Stmt, ...]] = field(default_factory=dict)
    """What those of them are without counting that `recursion.py` makes count."""
    ambiguous: dict[str, list[str]] = field(default_factory=dict)
    """Global variables that several lists have, with the full names to choose from."""
    broken: set[str] = field(default_factory=set)
    """Functions whose declaration is wrong: reported once, not at every call."""
    this_traps: dict[str, int] = field(default_factory=dict)
    """Trap site of an unbound THIS, by method."""
    aliases: dict[str, str] = field(default_factory=dict)
    """`LIST.X` to the name that the global variable of a list is kept under."""
    life: Code | None = None
    """What initialises instances of blocks, where the dialect has that."""
    uses: dict[Pou, dict[Pou, int]] = field(default_factory=dict)
    """Who calls whom, from how many places."""

    def use(self, caller: Pou | None, callee: Pou) -> None:
        if caller is not None:
            called = self.uses.setdefault(caller, {})
            called[callee] = called.get(callee, 0) + 1
