"""What the files of a project declare, by name, and the names that none of them has."""

import re
from collections.abc import Iterable, Sequence

from scanbench.check.declare.vendor_types import VENDOR_TYPES
from scanbench.check.placeholders.shapes import Member, Shape, Signature, Unknown, join, of_type, variables
from scanbench.check.standard.functions import FUNCTIONS
from scanbench.program.types import ELEMENTARY
from scanbench.syntax import tree

CONVERSION = re.compile(r"(?:(\w+?)_)?TO_(\w+)")
ENUMERATION = re.compile(r"(?:E|EN|ENUM)_\w+|[Ee][A-Z][a-z]\w*")
"""What an enumeration is called: its values are written with its name in front, as are variables of a list."""
LIST = re.compile(
    r"(?:G|GC|P|GP|T)?VL?_\w+|\w*GVL\w*|GC_\w+|Par(?:am)?_\w+|\w*(?:Constants?|Parameters?|ParameterList|Globals?)",
    re.IGNORECASE,
)
"""What a list of global variables is called."""
INTERFACE = re.compile(r"I_\w+|I[A-Z][a-z]\w*")
INSTRUCTIONS = {
    **dict.fromkeys(("TON", "TOF", "TP", "TONR"), "IEC_TIMER"),
    **dict.fromkeys(("CTU", "CTD", "CTUD"), "IEC_COUNTER"),
}
"""Instructions of the TIA Portal that are called of an instance, and the type of that."""
LABELS = 10001
"""The number of the first constant that is a label of CASE; the next has the next, as no two labels are the same."""
_OPERATORS = frozenset(
    "ADR BITADR SIZEOF XSIZEOF TRUNC TRUNC_INT REF THIS SUPER NULL TEST_AND_SET UPPER_BOUND LOWER_BOUND INDEXOF "
    "ANY ANY_NUM ANY_INT ANY_REAL ANY_BIT ANY_STRING ANY_DATE STRING WSTRING TIME LTIME EN ENO".split()
)


def values_in_place(spec: tree.TypeSpec) -> dict[str, tree.TypeSpec]:
    """By name in upper case, the values of an enumeration that is declared with a variable: of no type with a name, so of its numbers."""
    if not isinstance(spec, tree.EnumSpec):
        return {}
    return {name.upper(): spec.base or tree.NamedType("INT", span) for name, _, span in spec.values}


def declared_in(pou: tree.PouDeclaration) -> dict[str, tree.TypeSpec]:
    """The types of its variables, and those of the values of enumerations that are declared with them, by name in upper case."""
    values = {name: spec for _, each in variables(pou) for name, spec in values_in_place(each.type).items()}
    return values | {each.name.upper(): each.type for _, each in variables(pou)}


class World:
    """The declarations of all files, and what was found of names that none has."""

    def __init__(
        self,
        files: Iterable[tree.File],
        prefixes: frozenset[str],
        missing: Iterable[str],
        only: frozenset[str] | None = None,
        standard: Iterable[tree.File] = (),
    ) -> None:
        """`standard` is the standard library of the dialect."""
        self.only = only
        """The names that may be missing, in upper case; None where any may, and where names say what they are of."""
        self.types: dict[str, tree.TypeDeclaration | tree.PouDeclaration] = {}
        self.functions: dict[str, tree.PouDeclaration] = {}
        self.globals: dict[str, tree.TypeSpec] = {}
        self.lists: set[str] = set()
        self.values: dict[str, tree.TypeSpec] = {}
        self.prefixes = {*prefixes, *(each.upper() for each in missing)}
        self.unknown: dict[str, Unknown] = {}
        self.unknown_functions: dict[str, tuple[str, Signature]] = {}
        self.unknown_globals: dict[str, Member] = {}
        self.unknown_lists: dict[str, str] = {}
        """Names that are written before global variables."""
        self.counted: dict[str, int] = {}
        """The numbers of such names that the arguments of an array of instances tell."""
        self.fixed: set[str] = set()
        """Names that would have to be a number before anything runs, as a bound of an array: use says nothing of it."""
        for file in (*files, *standard):
            self._take(file)

    def _take(self, file: tree.File) -> None:
        for each in file.types:
            self.types[each.name.upper()] = each
            if isinstance(each.type, tree.EnumSpec):
                for name, _, span in each.type.values:
                    self.values.setdefault(name.upper(), tree.NamedType(each.name, span))
            if isinstance(each.type, tree.StructSpec):
                for member in each.type.members:
                    self.values |= values_in_place(member.type)
        for pou in file.pous:
            table = self.functions if pou.kind == "function" else self.types
            table[pou.name.upper()] = pou
            self.prefixes |= {pou.namespace.upper()} if pou.namespace else set()
        for section in file.globals:
            self.lists |= {section.list_name.upper()} if section.list_name else set()
            for variable in section.variables:
                self.values |= values_in_place(variable.type)
                self.globals.setdefault(variable.name.upper(), variable.type)
                if section.list_name:
                    self.globals[f"{section.list_name}.{variable.name}".upper()] = variable.type

    def has_type(self, name: str) -> bool:
        """Whether something declares the type."""
        return name in self.types or name in ELEMENTARY or name in VENDOR_TYPES or name in _OPERATORS

    def has_function(self, name: str) -> bool:
        """Whether it is a function, a conversion or an operator that exists."""
        known = name in self.functions or name in FUNCTIONS or name in _OPERATORS or name.startswith("__")
        found = CONVERSION.fullmatch(name)
        if self.only is not None and name in self.only:
            return known
        return (
            known
            or name.partition("_")[0] in FUNCTIONS
            or (found is not None and found[2] in (*ELEMENTARY, "STRING", "WSTRING"))
        )

    def is_list(self, name: str) -> bool:
        """Whether it is called like a list of global variables, and is nothing else."""
        if self.only is not None:
            return False
        key = name.upper()
        known = key in self.globals or key in self.types or self.has_function(key) or key in self.unknown
        return key in self.unknown_lists or (not known and LIST.fullmatch(name) is not None)

    def listed(self, owner: str, name: str) -> Member:
        """The variable of this name in a list."""
        self.unknown_lists.setdefault(owner.upper(), owner)
        return self.unknown_globals.setdefault(name.upper(), Member(name, Shape()))

    def bare(self, name: str) -> str:
        """A name without those of libraries and lists before it."""
        first, point, rest = name.partition(".")
        return self.bare(rest) if point and first.upper() in self.prefixes else name

    def resolved(self, spec: tree.TypeSpec | None) -> tree.TypeSpec | tree.PouDeclaration | Unknown | None:
        """What a type is, past its names."""
        for _ in range(20):
            if not isinstance(spec, tree.NamedType):
                return spec
            name = self.bare(spec.name)
            key = name.upper()
            declared = self.types.get(key)
            if declared is None:
                return spec if self.has_type(key) or "." in name else self.unknown.setdefault(key, self._of(name))
            if isinstance(declared, tree.PouDeclaration):
                return declared
            if isinstance(declared.type, tree.EnumSpec | tree.SubrangeSpec):
                return spec
            spec = declared.type
        return None

    def _of(self, name: str) -> Unknown:
        return Unknown(name, interface=self.only is None and INTERFACE.fullmatch(name) is not None)

    def settle(self) -> None:
        """Makes one of what is called like a function, and has parts or is written like a variable: the data block of an instance.
        Drops what may not be missing."""
        if self.only is None:
            return
        for table in (self.unknown, self.unknown_functions, self.unknown_globals):
            for key in [each for each in table if each not in self.only]:
                del table[key]
        for key in self.unknown_functions.keys() & self.unknown_globals.keys():
            root = self.unknown_globals[key].shape.root
            called = self.unknown_functions.pop(key)[1]
            root.calls = root.calls or Signature()
            for name, member in (*called.inputs.items(), *called.outputs.items()):
                if name in root.members:
                    join(root.members[name].shape, member.shape)
                else:
                    root.members[name] = member

    def bases(self, pou: tree.PouDeclaration) -> Sequence[tree.PouDeclaration | Unknown]:
        """What a block or interface extends, and what these do."""
        made: list[tree.PouDeclaration | Unknown] = []
        open_ = [pou]
        while open_:
            for each in (base for one in [open_.pop()] for base in one.extends):
                found = self.resolved(each)
                if isinstance(found, Unknown):
                    made.append(found)
                elif isinstance(found, tree.PouDeclaration) and found not in made:
                    made.append(found)
                    open_.append(found)
        return made

    def unknown_base(self, pou: tree.PouDeclaration) -> Unknown | None:
        """The type without a declaration that a block comes from."""
        return next((each for each in self.bases(pou) if isinstance(each, Unknown)), None)

    def member(self, shape: Shape, name: str) -> Member | None:
        """`shape.name`, where nothing declares it."""
        spec = shape.known
        if spec is None:
            return shape.root.members.setdefault(name.upper(), Member(name, Shape()))
        found = self.resolved(spec)
        if isinstance(found, tree.ReferenceSpec):
            return self.member(of_type(found.target), name)
        if isinstance(found, tree.PouDeclaration):
            base = self.unknown_base(found)
            return base.members.get(name.upper()) if base is not None else None
        return found.member(name) if isinstance(found, Unknown) else None

    def part(self, shape: Shape, name: str) -> Shape:
        """`shape.name`."""
        found = self.resolved(shape.known)
        if isinstance(found, tree.ReferenceSpec):
            return self.part(of_type(found.target), name)
        if shape.known is None or isinstance(found, Unknown):
            member = self.member(shape, name)
            return Shape() if member is None else member.shape
        if isinstance(found, tree.StructSpec):
            own = next((each.type for each in found.members if each.name.upper() == name.upper()), None)
            if own is None and found.extends is not None:
                return self.part(of_type(found.extends), name)
            return of_type(own)
        return self._of_block(found, name) if isinstance(found, tree.PouDeclaration) else Shape()

    def _of_block(self, block: tree.PouDeclaration, name: str) -> Shape:
        key = name.upper()
        for each in (block, *self.bases(block)):
            if isinstance(each, Unknown):
                return each.member(name).shape
            own = next((it.type for _, it in variables(each) if it.name.upper() == key), None)
            getter = next((it.result for it in each.methods if it.name.upper() == key and it.kind != "method"), None)
            if own is not None or getter is not None:
                return of_type(own or getter)
        return Shape()

    def method(self, owner: Shape, name: str) -> Signature | tree.PouDeclaration | None:
        """`owner.name(...)`."""
        found = self.resolved(owner.known)
        if isinstance(found, tree.ReferenceSpec):
            return self.method(of_type(found.target), name)
        if isinstance(found, Unknown):
            found.block = True
            return found.method(name)
        if not isinstance(found, tree.PouDeclaration):
            return None
        for each in (found, *self.bases(found)):
            if isinstance(each, Unknown):
                return each.method(name)
            own = next((it for it in each.methods if it.name.upper() == name.upper()), None)
            if own is not None:
                return own
        return None
