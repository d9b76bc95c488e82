"""VAR_GENERIC CONSTANT of vendors: a block with other constants for each `FB<20>`.

The block is made once for each combination of values that a declaration asks for, under the name `FB<20>`, with the values as its
constants. This happens before any name is looked up, on the trees alone; so a value is made of literals and constants by
arithmetic. The block as it is written is checked as well, with the start values, and nobody can have an instance of it.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace

from scanbench.check.context import Rejected, Report
from scanbench.check.declare.names import Space, qualified
from scanbench.check.dialect import Allowance, Dialect
from scanbench.check.dialect_rules import said
from scanbench.problems import Span
from scanbench.syntax import tree

KEYWORD = "VAR_GENERIC"
MOST = 1000
"""Blocks that are made of generic ones."""
MAX_DEPTH = 50
"""Constants that are made of each other, and blocks that ask for others with other values."""

OPERATIONS: Mapping[str, Callable[[int, int], int]] = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": lambda a, b: abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1),
    "mod": lambda a, b: a - b * (abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)),
}
Constants = dict[str, tree.Expression]
"""By name in upper case, `LIST.NAME` too."""


def specialised(files: list[tree.File], report: Report, dialect: Dialect) -> list[tree.File]:
    """The files with a block for each combination of constants that is asked for; the same files where there is no generic block."""
    generic = {qualified(pou.namespace, pou.name).upper(): pou for file in files for pou in file.pous if _generic(pou)}
    if not generic:
        return files
    every = {qualified(pou.namespace, pou.name).upper(): pou for file in files for pou in file.pous}
    return _Blocks(report, dialect, generic, every, _globals(files)).files(files)


def _generic(pou: tree.PouDeclaration) -> bool:
    return any(section.keyword == KEYWORD for section in pou.sections)


def _globals(files: list[tree.File]) -> Constants:
    found: Constants = {}
    for section in (section for file in files for section in file.globals if "CONSTANT" in section.qualifiers):
        for name, value in _constants(section).items():
            found.setdefault(name, value)
            found[f"{section.list_name.upper()}.{name}"] = value
    return found


def _constants(section: tree.VariableSection) -> Constants:
    plain = (
        each for each in section.variables if not isinstance(each.initial, tree.ArrayInit | tree.StructInit | None)
    )
    return {each.name.upper(): each.initial for each in plain if each.initial is not None}  # type: ignore[misc]


def _own(sections: Iterable[tree.VariableSection]) -> Constants:
    """The constants of these."""
    kept = (each for each in sections if "CONSTANT" in each.qualifiers)
    return {name: value for each in kept for name, value in _constants(each).items()}


def _without(constants: Constants, sections: Iterable[tree.VariableSection]) -> Constants:
    """Those that no variable of these hides."""
    hidden = {each.name.upper() for section in sections for each in section.variables}
    return {name: value for name, value in constants.items() if name not in hidden}


@dataclass(slots=True)
class _Blocks:
    """Makes them, and the trees that ask for them."""

    report: Report
    dialect: Dialect
    generic: dict[str, tree.PouDeclaration]
    every: dict[str, tree.PouDeclaration]
    globals: Constants
    made: dict[str, list[tree.PouDeclaration]] = field(default_factory=dict)
    """Of each generic block."""
    known: dict[str, Constants] = field(default_factory=dict)
    """What the bodies of those that were made, and of all that extend one of them, have as constants; by key."""
    space: Space = field(default_factory=Space)
    depth: int = 0
    """Blocks that are being made, one for the other."""

    def files(self, files: list[tree.File]) -> list[tree.File]:
        found = []
        for file in files:
            pous: list[tree.PouDeclaration] = []
            for pou in file.pous:
                pous.append(self.pou(pou, {}, ()))
            found.append(replace(file, pous=pous, globals=[self.section(each, self.globals) for each in file.globals],
                                 types=[self.type(each) for each in file.types]))  # fmt: skip
        for file in found:
            for pou in list(file.pous):
                file.pous += self.made.get(qualified(pou.namespace, pou.name).upper(), [])
        return found

    # ---- declarations -----------------------------------------------------------------------------------------

    def type(self, declaration: tree.TypeDeclaration) -> tree.TypeDeclaration:
        self.space = Space(declaration.namespace, declaration.using)
        return replace(declaration, type=self.spec(declaration.type, self.globals))

    def pou(self, pou: tree.PouDeclaration, given: Constants, values: tuple[int, ...]) -> tree.PouDeclaration:
        """With these values for its generic constants, or with their start values where none are given."""
        outer, self.space = self.space, Space(pou.namespace, pou.using)
        if _generic(pou) and not values:
            self._tell(pou)
        sections = [self._fixed(each, given) if each.keyword == KEYWORD else each for each in pou.sections]
        own = _own(sections)
        extends = tuple(self.named(each, _without(self.globals, sections) | own) for each in pou.extends)
        above = self._above(extends)
        name = f"{pou.name}<{', '.join(map(str, values))}>" if values else pou.name
        self.known[qualified(pou.namespace, name).upper()] = above | own
        everything = _without(self.globals | above, sections) | own
        made = replace(
            pou, name=name, extends=extends, sections=tuple(self.section(each, everything) for each in sections),
            methods=tuple(self._method(each, everything) for each in pou.methods), result=self._maybe(pou.result, everything),
            asked=tuple(self.named(each, everything) for each in pou.asked),
        )  # fmt: skip
        self.space = outer
        return made

    def _above(self, extends: tuple[tree.NamedType, ...]) -> Constants:
        """The constants of what it extends."""
        found: Constants = {}
        for each in extends:
            candidates = self.space.candidates(each.name.upper())
            key = next((key for key in candidates if key in self.every or key in self.known), "")
            if key and key not in self.known:
                base = self.every[key]
                self.known[key] = {}  # it may extend itself
                self.known[key] = self._above(base.extends) | _own(base.sections)
            found |= self.known.get(key, {})
        return found

    def _method(self, method: tree.PouDeclaration, constants: Constants) -> tree.PouDeclaration:
        constants = _without(constants, method.sections) | _own(method.sections)
        sections = tuple(self.section(each, constants) for each in method.sections)
        asked = tuple(self.named(each, constants) for each in method.asked)
        return replace(method, sections=sections, result=self._maybe(method.result, constants), asked=asked)

    def _maybe(self, spec: tree.TypeSpec | None, constants: Constants) -> tree.TypeSpec | None:
        return None if spec is None else self.spec(spec, constants)

    def _tell(self, pou: tree.PouDeclaration) -> None:
        section = next(each for each in pou.sections if each.keyword == KEYWORD)
        if Allowance.GENERIC_CONSTANTS not in self.dialect.allows:
            message = "VAR_GENERIC is not supported; use a constant, or ARRAY[*] for in-outs."
            self.report.error("X001", message, section.span)
        elif pou.kind != "function_block":
            self.report.error("D008", "VAR_GENERIC CONSTANT belongs to a FUNCTION_BLOCK.", section.span)
        else:
            used = f"`{pou.name}` has constants that come with its instances"
            self.report.warn("W006", said(self.dialect, Allowance.GENERIC_CONSTANTS, used), section.span)

    def _fixed(self, section: tree.VariableSection, given: Constants) -> tree.VariableSection:
        """The generic constants as constants."""
        one = tree.Literal("int", 1, None, section.span)
        variables = tuple(
            replace(each, initial=given.get(each.name.upper(), each.initial or one)) for each in section.variables
        )
        return replace(section, keyword="VAR", qualifiers=("CONSTANT",), variables=variables)

    def section(self, section: tree.VariableSection, constants: Constants) -> tree.VariableSection:
        variables = tuple(replace(each, type=self.spec(each.type, constants)) for each in section.variables)
        return section if variables == section.variables else replace(section, variables=variables)

    # ---- types ------------------------------------------------------------------------------------------------

    def spec(self, spec: tree.TypeSpec, constants: Constants) -> tree.TypeSpec:
        match spec:
            case tree.NamedType():
                return self.named(spec, constants)
            case tree.ArraySpec() | tree.OpenArraySpec():
                return replace(spec, element=self.spec(spec.element, constants))
            case tree.ReferenceSpec():
                return replace(spec, target=self.spec(spec.target, constants))
            case tree.StructSpec():
                members = tuple(replace(each, type=self.spec(each.type, constants)) for each in spec.members)
                return replace(spec, members=members)
        return spec

    def named(self, spec: tree.NamedType, constants: Constants) -> tree.NamedType:
        key = next((each for each in self.space.candidates(spec.name.upper()) if each in self.generic), None)
        if key is None:
            return spec
        pou = self.generic[key]
        names = [each.name for section in pou.sections if section.keyword == KEYWORD for each in section.variables]
        if len(names) != len(spec.values):
            values = ", ".join(names)
            self.report.error(
                "D002", f"`{spec.name}` has {len(names)} generic constants, not {len(spec.values)}: write `{spec.name}<{values}>` "
                "with a value for each.", spec.span,
            )  # fmt: skip
            return replace(spec, values=())
        try:
            values_of = tuple(self.number(each, constants, 0) for each in spec.values)
        except Rejected:
            return replace(spec, values=())
        name = f"{pou.name}<{', '.join(map(str, values_of))}>"
        full = qualified(pou.namespace, name)
        if full.upper() not in self.known:
            self._make(key, dict(zip(names, spec.values, strict=True)), values_of, spec.span)
        return replace(spec, name=full, values=())

    def _make(self, key: str, given: Mapping[str, tree.Expression], values: tuple[int, ...], span: Span) -> None:
        if self.depth >= MAX_DEPTH or sum(map(len, self.made.values())) >= MOST:
            message = "Too many blocks are made of generic ones; does one contain itself with other constants?"
            self.report.error("D003", message, span)
            return
        literals: Constants = {
            name.upper(): tree.Literal("int", value, None, node.span)
            for (name, node), value in zip(given.items(), values, strict=True)
        }
        self.depth += 1
        self.made.setdefault(key, []).append(self.pou(self.generic[key], literals, values))
        self.depth -= 1

    # ---- values -----------------------------------------------------------------------------------------------

    def number(self, node: tree.Expression, constants: Constants, depth: int) -> int:
        match node:
            case tree.Literal("int", int(value)):
                return value
            case tree.UnaryOp("neg" | "plus", inner):
                value = self.number(inner, constants, depth)
                return -value if node.op == "neg" else value
            case tree.BinaryOp(op, left, right) if op in OPERATIONS:
                first, second = (self.number(each, constants, depth) for each in (left, right))
                if second != 0 or op not in ("div", "mod"):
                    return OPERATIONS[op](first, second)
            case tree.Name(name) if name.upper() in constants and depth < MAX_DEPTH:
                return self.number(constants[name.upper()], constants, depth + 1)
            case tree.MemberOf(tree.Name(owner), name) if f"{owner}.{name}".upper() in constants and depth < MAX_DEPTH:
                return self.number(constants[f"{owner}.{name}".upper()], constants, depth + 1)
        raise self.report.reject(
            "D004",
            "The value of a generic constant is an integer, a CONSTANT, or an expression of these in parentheses.",
            node.span,
        )
