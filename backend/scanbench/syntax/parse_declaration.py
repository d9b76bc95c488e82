"""Variables, structures and their sections. A bad declaration is reported and skipped."""

from scanbench.problems import Span
from scanbench.syntax import tree
from scanbench.syntax.cursor import NAME, Unexpected
from scanbench.syntax.lexer import Tokens
from scanbench.syntax.parse_type import TypeParser
from scanbench.syntax.source import Source

SECTIONS = frozenset(
    "VAR VAR_INPUT VAR_OUTPUT VAR_IN_OUT VAR_TEMP VAR_GLOBAL VAR_EXTERNAL VAR_STAT VAR_INST VAR_GENERIC".split()
)
QUALIFIERS = frozenset(("CONSTANT", "RETAIN", "NON_RETAIN", "PERSISTENT"))
ACCESS = frozenset(("PUBLIC", "PROTECTED", "PRIVATE", "INTERNAL"))
POU_STARTS = frozenset(("PROGRAM", "FUNCTION", "FUNCTION_BLOCK", "TYPE", "CONFIGURATION"))
POU_ENDS = frozenset(
    "END_PROGRAM END_FUNCTION END_FUNCTION_BLOCK END_CLASS END_INTERFACE END_METHOD END_PROPERTY END_GET END_SET "
    "END_ACTION END_NAMESPACE END_TYPE END_CONFIGURATION END_RESOURCE".split()
)
DECLARATIONS_END = SECTIONS | POU_STARTS | POU_ENDS | {"END_VAR", "END_STRUCT", "END_UNION", "VAR_ACCESS", "VAR_CONFIG"}
NOT_A_NAME = frozenset((":", ",", ":=", "AT"))
"""What follows a variable's name, so that a word before it is no qualifier."""


class DeclarationParser(TypeParser):
    def __init__(self, source: Source, tokens: Tokens | None = None) -> None:
        super().__init__(source, tokens)
        self.kept: list[Span] = []
        """Sections VAR_STAT and VAR_INST."""

    def sections(self) -> tuple[tree.VariableSection, ...]:
        found = []
        while self.texts[self.at] in SECTIONS:
            section = self.section()
            if section is not None:
                found.append(section)
        return tuple(found)

    def section(self, list_name: str = "", namespace: str = "") -> tree.VariableSection | None:
        """One section of variables; nothing when it is one that is refused."""
        start = self.take()
        span = self.span_of(start)
        qualifiers, access = [], "PROTECTED"
        while (word := self.word()) and self.texts[self.at + 1] not in NOT_A_NAME:
            if word in QUALIFIERS:
                qualifiers.append(word)
            elif word in ACCESS:
                access = word
            else:
                break
            self.take()
        variables = self.variables()
        self.end("END_VAR", f"{self.texts[start]} of line {span.line}")
        keyword = self.texts[start]
        if keyword == "VAR_GENERIC":
            self.report("X001", "VAR_GENERIC is not supported; use a constant, or ARRAY[*] for in-outs.", span)
            return None
        if keyword in ("VAR_STAT", "VAR_INST"):
            # what a block keeps between calls has no word of its own in the standard
            keyword = "VAR"
            self.kept.append(span)
        return tree.VariableSection(keyword, tuple(qualifiers), variables, span, access, namespace, list_name)

    def variables(self) -> tuple[tree.Variable, ...]:
        """Declarations up to what closes them."""
        found: list[tree.Variable] = []
        while self.texts[self.at] not in DECLARATIONS_END and not self.ended():
            depth = self.depth
            if self.accept(";"):
                continue
            try:
                found += self._variables()
            except Unexpected:
                self.depth = depth
                self.skip_declaration()
        return tuple(found)

    def skip_declaration(self) -> None:
        while self.texts[self.at] not in DECLARATIONS_END and not self.ended():
            if self.texts[self.take()] == ";":
                return

    def end(self, keyword: str, of: str) -> None:
        """The closing keyword; the `;` behind it may be missing, as vendors allow."""
        if not self.accept(keyword):
            self.report("S003", f"`{keyword}` expected to close the {of}{self._found()}.", self.here())
        self.accept(";")

    def _variables(self) -> list[tree.Variable]:
        """`a, b : type := value;` or `a AT address : type := value;`"""
        if self.is_("AT"):
            return self._nameless()
        names = [self.name("the name of a variable")]
        address, address_span = self._address()
        while self.accept(","):
            names.append(self.name("the name of a variable"))
        if address is None:
            address, address_span = self._address()
        self.expect(":", f"behind `{self.texts[names[-1]]}`, then its type")
        spec = self.type_spec()
        edge = self.word()[0] if self.word() in ("R_EDGE", "F_EDGE") else ""
        if edge:
            self.take()
        if address is None:
            address, address_span = self._address()
        arguments: tuple[tree.Argument, ...] = ()
        if self.is_("(") and isinstance(spec, tree.NamedType):
            arguments = self.arguments("initial values")
        initial = self._initial_of(spec) if self.accept(":=") else None
        if self.word() == "REF" and self.texts[self.at + 1] == "=":
            self.at += 2
            where = self.at
            bound = self.expression()
            initial = tree.Call(
                tree.Name("REF", self.span_of(where)), (tree.Argument(None, False, bound, bound.span),), bound.span
            )
        self.close(";", f"behind the declaration of `{self.texts[names[0]]}`")
        return [
            tree.Variable(self.texts[name], spec, initial, address, self.span_of(name), address_span, arguments, edge)
            for name in names
        ]

    def _initial_of(self, spec: tree.TypeSpec) -> tree.Initial:
        if isinstance(spec, tree.ArraySpec) and not self.is_("[") and self.kinds[self.at] is not NAME:
            return self.bare_array_initial()
        return self.initial()

    def _nameless(self) -> list[tree.Variable]:
        """`AT %IX1.0 : BOOL;`: the address is used as it is, nothing is declared."""
        start = self.at
        self._address()
        self.expect(":", "behind the address, then its type")
        self.type_spec()
        if self.accept(":="):
            self.initial()
            self.report("X001", "An initial value needs a variable with a name before AT.", self.span_from(start))
        self.close(";", "behind the declaration")
        return []

    def _address(self) -> tuple[str | None, Span | None]:
        """What stands behind AT, as written: each vendor has a notation of its own."""
        if not self.accept("AT"):
            return None, None
        start = self.at
        while not self.is_(":", ";", ":=", "END_VAR") and not self.ended():
            self.take()
        if self.at == start:
            raise self.fail("an address expected behind AT")
        return self.source.text[self.starts[start] : self._end_of(self.at - 1)], self.span_from(start)

    def structure(self, extends: str | None = None) -> tree.StructSpec:
        start = self.take()
        union = self.texts[start] != "STRUCT"
        overlap = bool(self.word() == "OVERLAP" and self.texts[self.at + 1] not in NOT_A_NAME and self.take())
        if self.word() == "EXTENDS" and self.texts[self.at + 1] not in NOT_A_NAME:
            self.take()
            extends = self.qualified("the name of a structure")
        members = self.variables()
        keyword = "END_UNION" if union else "END_STRUCT"
        if not self.accept(keyword):
            raise self.fail(f"`{keyword}` expected")
        return tree.StructSpec(members, self.span_from(start), union, overlap, extends)
