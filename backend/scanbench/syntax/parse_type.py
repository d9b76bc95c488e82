"""Types and initial values."""

from abc import ABC, abstractmethod

from scanbench.syntax import tree
from scanbench.syntax.cursor import NAME, Unexpected
from scanbench.syntax.lexer import Lex
from scanbench.syntax.parse_expression import ExpressionParser

INTEGERS = frozenset("SINT INT DINT LINT USINT UINT UDINT ULINT BYTE WORD DWORD LWORD".split())


class TypeParser(ExpressionParser, ABC):
    def type_spec(self, named: bool = False) -> tree.TypeSpec:
        """A type; `named` in a TYPE declaration, where `Base (A, B)` can only be an enumeration."""
        start = self.at
        self.enter()
        spec = self._type_spec(start, named)
        self.leave()
        return spec

    def _type_spec(self, start: int, named: bool) -> tree.TypeSpec:
        match self.texts[start]:
            case "ARRAY":
                return self._array()
            case "STRUCT":
                return self.structure()
            case "(":
                return self._enumeration(None, start)
        word = self.word()
        if word == "UNION" and self.kinds[start + 1] is not Lex.OPERATOR:
            return self.structure()
        if word == "REF_TO" or (word in ("POINTER", "REFERENCE") and self.texts[start + 1] == "TO"):
            return self._reference(word)
        if word in ("STRING", "WSTRING"):
            return self._string_type(word == "WSTRING")
        base = tree.NamedType(self.qualified("a type"), self.span_from(start))
        if self.is_("("):
            return self._restricted(base, start, named)
        return base

    def _reference(self, word: str) -> tree.ReferenceSpec:
        start = self.take()
        if word != "REF_TO":
            self.take()
        target = self.type_spec()
        return tree.ReferenceSpec(target, word == "POINTER", self.span_from(start), word == "REFERENCE")

    def _restricted(self, base: tree.NamedType, start: int, named: bool) -> tree.TypeSpec:
        """`INT (1..5)`, `INT (A, B)`; what belongs to an instance (`FB(a := 1)`) is left to the caller."""
        begin = self.at
        if self._range_follows():
            self.take()
            low = self.expression()
            self.expect("..", "between the bounds of the subrange")
            high = self.expression()
            self.expect(")", "to close the subrange")
            return tree.SubrangeSpec(base, low, high, self.span_from(start))
        self.at = begin
        if named or base.name.upper() in INTEGERS:
            return self._enumeration(base, start)
        return base

    def _range_follows(self) -> bool:
        """Whether `..` comes before the parenthesis closes."""
        depth, at = 0, self.at
        while self.kinds[at] is not Lex.END:
            text = self.texts[at]
            if text == "(":
                depth += 1
            elif text == ")":
                depth -= 1
                if depth == 0:
                    return False
            elif text == ".." and depth == 1:
                return True
            elif text in (";", ":", ":="):
                return False
            at += 1
        return False

    def _enumeration(self, base: tree.NamedType | None, start: int) -> tree.EnumSpec:
        self.expect("(", "before the values")
        values = []
        while not self.is_(")"):
            name = self.name("the name of a value")
            number = self.expression() if self.accept(":=") else None
            values.append((self.texts[name], number, self.span_of(name)))
            if not self.accept(","):
                break
        self.expect(")", "to close the enumeration")
        if not values:
            self.report("S003", "An enumeration needs at least one value.", self.span_from(start))
            raise Unexpected
        if base is None and self.kinds[self.at] is NAME and self.word() in INTEGERS:
            base = tree.NamedType(self.texts[self.at], self.here())
            self.take()
        return tree.EnumSpec(tuple(values), base, self.span_from(start))

    def _string_type(self, wide: bool) -> tree.StringSpec:
        start, length = self.take(), None
        for opening, closing in (("[", "]"), ("(", ")")):
            if self.accept(opening):
                length = self.expression()
                self.expect(closing, "to close the length of the STRING")
                break
        return tree.StringSpec(length, self.span_from(start), wide)

    def _array(self) -> tree.TypeSpec:
        start = self.take()
        self.expect("[", "behind ARRAY")
        ranges: list[tuple[tree.Expression, tree.Expression]] = []
        stars = 0
        while True:
            if self.accept("*"):
                stars += 1
            else:
                low = self.expression()
                self.expect("..", "between the bounds of the array")
                ranges.append((low, self.expression()))
            if not self.accept(","):
                break
        self.expect("]", "to close the bounds of the array")
        self.expect("OF", "behind the bounds of the array")
        element = self.type_spec()
        span = self.span_from(start)
        if stars and ranges:
            self.report("S003", "The bounds of an array are all given, or all `*`.", span)
            raise Unexpected
        return tree.OpenArraySpec(stars, element, span) if stars else tree.ArraySpec(tuple(ranges), element, span)

    @abstractmethod
    def structure(self, extends: str | None = None) -> tree.StructSpec:
        """STRUCT or UNION: it is made of variables, which `DeclarationParser` knows."""

    # ---- initial values -----------------------------------------------------------------------------------------

    def initial(self) -> tree.Initial:
        start = self.at
        self.enter()
        try:
            if self.accept("["):
                return self._array_initial(start)
            if self.is_("(") and self.kinds[start + 1] is NAME and self.texts[start + 2] == ":=":
                return self._struct_initial()
            return self.expression()
        finally:
            self.leave()

    def bare_array_initial(self) -> tree.Initial:
        """`1, 2, 3(0)`: an array's values without brackets, as vendors write them."""
        start = self.at
        items = [self._repeated()]
        while self.accept(","):
            items.append(self._repeated())
        return tree.ArrayInit(tuple(items), self.span_from(start))

    def _array_initial(self, start: int) -> tree.Initial:
        items: list[tuple[tree.Expression | None, tree.Initial]] = []
        while not self.is_("]"):
            items.append(self._repeated())
            if not self.accept(","):
                break
        self.expect("]", "to close the initial values")
        return tree.ArrayInit(tuple(items), self.span_from(start))

    def _repeated(self) -> tuple[tree.Expression | None, tree.Initial]:
        """`3(0)` stands for `0, 0, 0`, and `3()` for three default values."""
        at = self.at
        if self.texts[at + 1] != "(" or self.kinds[at] not in (Lex.INTEGER, NAME):
            return None, self.initial()
        if self.kinds[at] is NAME and not self._count_follows():
            return None, self.initial()
        self.take()
        count = self.literal(at) if self.kinds[at] is Lex.INTEGER else tree.Name(self.texts[at], self.span_of(at))
        if self.kinds[at + 2] is NAME and self.texts[at + 3] == ":=":
            return count, self._struct_initial()
        self.expect("(", "behind the count")
        value = self.initial()
        self.expect(")", "behind the repeated value")
        return count, value

    def _count_follows(self) -> bool:
        """Whether `Name(` repeats a value: only a structure or an array behind it cannot be a call."""
        at = self.at
        return self.texts[at + 2] in ("[", "(")

    def _struct_initial(self) -> tree.StructInit:
        start = self.expect("(", "before the members")
        members = []
        while not self.is_(")"):
            name = self.name("the name of a member")
            self.expect(":=", "behind the name of the member")
            members.append((self.texts[name], self.initial(), self.span_of(name)))
            if not self.accept(","):
                break
        self.expect(")", "to close the initial values")
        return tree.StructInit(tuple(members), self.span_from(start))
