"""Variables and types. A bad declaration is reported and skipped."""

from scanbench.problems import Span
from scanbench.syntax import tree
from scanbench.syntax.cursor import Unexpected
from scanbench.syntax.lexer import Lex, span_of
from scanbench.syntax.parse_statement import POU_ENDS, POU_STARTS, StatementParser

SECTIONS = ("VAR", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR_TEMP", "VAR_GLOBAL", "VAR_EXTERNAL")
UNSUPPORTED_SECTIONS = ("VAR_ACCESS", "VAR_CONFIG")
QUALIFIERS = ("CONSTANT", "RETAIN", "NON_RETAIN", "PERSISTENT")


class DeclarationParser(StatementParser):
    def sections(self) -> tuple[tree.VariableSection, ...]:
        found = []
        while self.is_(*SECTIONS, *UNSUPPORTED_SECTIONS):
            found.append(self.section())
        return tuple(found)

    def section(self) -> tree.VariableSection:
        start = self.take()
        span = span_of(self.source, start)
        if start.text in UNSUPPORTED_SECTIONS:
            self.report("X001", f"{start.text} is not supported yet.", span)
        qualifiers = []
        while self.is_(*QUALIFIERS):
            qualifiers.append(self.take().text)
        variables: list[tree.Variable] = []
        while not self.is_("END_VAR") and not self._declarations_end():
            try:
                variables += self._variables()
            except Unexpected:
                self._skip_declaration()
        self._end("END_VAR", f"{start.text} of line {span.line}")
        return tree.VariableSection(start.text, tuple(qualifiers), tuple(variables), span)

    def _declarations_end(self) -> bool:
        return self.token.kind is Lex.END or self.is_(*SECTIONS, *POU_ENDS, *POU_STARTS, "END_TYPE", "END_STRUCT")

    def _skip_declaration(self) -> None:
        while not self.is_("END_VAR", "END_STRUCT") and not self._declarations_end():
            if self.take().text == ";":
                return

    def _variables(self) -> list[tree.Variable]:
        """`a, b : type := value;` or `a AT address : type := value;`"""
        names = [self.name("the name of a variable")]
        while self.accept(","):
            names.append(self.name("the name of a variable"))
        address, address_span = self._address() if self.accept("AT") else (None, None)
        self.expect(":", f"behind `{names[-1].text}`, then its type")
        type_spec = self.type_spec()
        initial = self.initial() if self.accept(":=") else None
        self.close(";", f"behind the declaration of `{names[0].text}`")
        spans = [span_of(self.source, name) for name in names]
        return [
            tree.Variable(name.text, type_spec, initial, address, span, address_span)
            for name, span in zip(names, spans, strict=True)
        ]

    def _address(self) -> tuple[str, Span]:
        """What stands between AT and the colon, as written: each vendor has a notation of its own."""
        start = self.token
        while not self.is_(":", ";", "END_VAR") and self.token.kind is not Lex.END:
            self.take()
        span = self.span_from(start)
        end = max(self.tokens[self.at - 1].end, start.start)
        return self.source.text[start.start : end].strip(), span

    def type_spec(self) -> tree.TypeSpec:
        start = self.token
        if self.is_("ARRAY"):
            return self._array()
        if self.is_("STRUCT"):
            return self._struct()
        if self.is_("("):
            return self._enumeration()
        if self.is_("REF_TO", "POINTER"):
            self.report("X001", f"{start.text} is not supported yet.", self.here())
            self.take()
            if self.token.text.upper() == "TO":
                self.take()
            self.type_spec()
            return tree.UnsupportedSpec(self.span_from(start))
        name = self.name("a type")
        if name.text.upper() == "STRING":
            return self._string_type(name.start)
        while self.is_(".") and self.ahead(1).kind is Lex.NAME:
            self.take()
            self.take()
        if self.is_("("):
            self.report("X001", "Subranges are not supported yet; use the plain type.", self.here())
            self._skip_parentheses()
        return tree.NamedType(name.text, self.span_from(name))

    def _enumeration(self) -> tree.TypeSpec:
        start = self.token
        self.report("X001", "Enumerations are not supported yet; use INT and CONSTANTs.", self.here())
        names = self._skip_parentheses()
        return tree.UnsupportedSpec(self.span_from(start), names)

    def _skip_parentheses(self) -> tuple[str, ...]:
        """To behind the closing one; gives the names on the way."""
        names, depth = [], 0
        while self.token.kind is not Lex.END:
            token = self.take()
            depth += {"(": 1, ")": -1}.get(token.text, 0)
            if token.kind is Lex.NAME:
                names.append(token.text)
            if depth == 0:
                break
        return tuple(names)

    def _string_type(self, start: int) -> tree.TypeSpec:
        length = None
        for opening, closing in (("[", "]"), ("(", ")")):
            if self.accept(opening):
                length = self.expression()
                self.expect(closing, "to close the length of the STRING")
                break
        return tree.StringSpec(length, self.source.span(start, self.tokens[self.at - 1].end))

    def _array(self) -> tree.TypeSpec:
        start = self.take()
        self.expect("[", "behind ARRAY")
        variable = self.is_("*")
        ranges = [self._range()]
        while self.accept(","):
            ranges.append(self._range())
        self.expect("]", "to close the bounds of the array")
        self.expect("OF", "behind the bounds of the array")
        self.enter()
        element = self.type_spec()
        self.leave()
        span = self.span_from(start)
        return tree.UnsupportedSpec(span) if variable else tree.ArraySpec(tuple(ranges), element, span)

    def _range(self) -> tuple[tree.Expression, tree.Expression]:
        if self.is_("*"):
            star = self.take()
            self.report("X001", "ARRAY[*] is not supported yet; give the bounds.", span_of(self.source, star))
            nothing = tree.Literal("int", 0, None, span_of(self.source, star))
            return nothing, nothing
        low = self.expression()
        self.expect("..", "between the bounds of the array")
        return low, self.expression()

    def _struct(self) -> tree.TypeSpec:
        start = self.take()
        members: list[tree.Variable] = []
        while not self.is_("END_STRUCT", "END_VAR") and not self._declarations_end():
            try:
                members += self._variables()
            except Unexpected:
                self._skip_declaration()
        if not self.accept("END_STRUCT"):
            self.fail("`END_STRUCT` expected")
        return tree.StructSpec(tuple(members), self.span_from(start))

    def initial(self) -> tree.Initial:
        start = self.token
        self.enter()
        try:
            if self.accept("["):
                return self._array_initial(start.start)
            if self.is_("(") and self.ahead(1).kind is Lex.NAME and self.ahead(2).text == ":=":
                return self._struct_initial()
            return self.expression()
        finally:
            self.leave()

    def _array_initial(self, start: int) -> tree.Initial:
        items: list[tuple[tree.Expression | None, tree.Initial]] = []
        while not self.is_("]"):
            items.append(self._repeated())
            if not self.accept(","):
                break
        end = self.expect("]", "to close the initial values")
        return tree.ArrayInit(tuple(items), self.source.span(start, end.end))

    def _repeated(self) -> tuple[tree.Expression | None, tree.Initial]:
        """`3(0)` stands for `0, 0, 0`."""
        if self.token.kind is not Lex.INTEGER or self.ahead(1).text != "(":
            return None, self.initial()
        count = self._literal(None)
        if self.ahead(1).kind is Lex.NAME and self.ahead(2).text == ":=":
            return count, self._struct_initial()
        self.expect("(", "behind the count")
        value = self.initial()
        self.expect(")", "behind the repeated value")
        return count, value

    def _struct_initial(self) -> tree.StructInit:
        start = self.expect("(", "before the members")
        members = []
        while not self.is_(")"):
            name = self.name("the name of a member")
            self.expect(":=", "behind the name of the member")
            members.append((name.text, self.initial(), span_of(self.source, name)))
            if not self.accept(","):
                break
        self.expect(")", "to close the initial values")
        return tree.StructInit(tuple(members), self.span_from(start))
