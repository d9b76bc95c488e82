"""Expressions of Structured Text."""

from scanbench.problems import Span
from scanbench.syntax import literals, tree
from scanbench.syntax.cursor import Cursor
from scanbench.syntax.lexer import Lex, span_of

BINARY: dict[str, tuple[int, str]] = {
    "OR": (0, "or"), "XOR": (1, "xor"), "AND": (2, "and"), "&": (2, "and"), "=": (3, "eq"), "<>": (3, "ne"),
    "<": (4, "lt"), ">": (4, "gt"), "<=": (4, "le"), ">=": (4, "ge"), "+": (5, "add"), "-": (5, "sub"),
    "*": (6, "mul"), "/": (6, "div"), "MOD": (6, "mod"), "**": (7, "pow"),
}  # fmt: skip
"""Strength of the operators, 0 the weakest (IEC 61131-3, table 71); all are left-associative."""

MAX_CHAIN = 1000


class ExpressionParser(Cursor):
    def expression(self) -> tree.Expression:
        self.enter()
        result = self._binary(0)
        self.leave()
        return result

    def _binary(self, weakest: int) -> tree.Expression:
        """Operands joined by operators that are no weaker than this."""
        left, count = self._unary(), 0
        while True:
            token = self.token
            if token.kind is not Lex.OPERATOR and token.kind is not Lex.KEYWORD:
                return left
            strength, op = BINARY.get(token.text, (-1, ""))
            if strength < weakest:
                return left
            self.take()
            right = self._binary(strength + 1)
            left = tree.BinaryOp(op, left, right, left.span.to(right.span))
            count += 1
            if count > MAX_CHAIN:
                self.fail(f"more than {MAX_CHAIN} operands in one expression; split it up")

    def _unary(self) -> tree.Expression:
        if not self.is_("-", "+", "NOT"):
            return self._primary()
        self.enter()
        start = self.take()
        operand = self._unary()
        self.leave()
        op = {"-": "neg", "+": "plus", "NOT": "not"}[start.text]
        return tree.UnaryOp(op, operand, self.span_from(start))

    def _primary(self) -> tree.Expression:
        token = self.token
        match token.kind:
            case Lex.INTEGER | Lex.REAL | Lex.TIME | Lex.STRING:
                return self._literal(None)
            case Lex.ADDRESS:
                self.take()
                return tree.DirectAddress(token.text, span_of(self.source, token))
            case Lex.NAME:
                self.take()
                return self._postfix(tree.Name(token.text, span_of(self.source, token)))
        if self.is_("TRUE", "FALSE"):
            self.take()
            return tree.Literal("bool", int(token.text == "TRUE"), None, span_of(self.source, token))
        if token.kind is Lex.OPERATOR and token.text.endswith("#") and len(token.text) > 1:
            return self._typed_literal()
        if self.accept("("):
            inner = self.expression()
            self.expect(")", "to close the parenthesis")
            return inner
        self.fail("an expression (a value, variable or call) expected")
        raise AssertionError

    def _typed_literal(self) -> tree.Expression:
        start = self.take()
        type_name = start.text[:-1]
        if self.token.kind in (Lex.INTEGER, Lex.REAL, Lex.STRING):
            return self._literal(type_name, start.start)
        if self.is_("-", "+") and self.ahead(1).kind in (Lex.INTEGER, Lex.REAL):
            negative = self.take().text == "-"
            literal = self._literal(type_name, start.start)
            if negative and not isinstance(literal.value, bytes):
                return tree.Literal(literal.kind, -literal.value, type_name, literal.span)
            return literal
        if self.is_("TRUE", "FALSE"):
            value = int(self.take().text == "TRUE")
            return tree.Literal("bool", value, type_name, self.span_from(start))
        if self.token.kind is Lex.NAME:
            self.take()
            self.report("X001", "Values of enumerations (`Type#Value`) are not supported yet.", self.span_from(start))
            return tree.Literal("int", 0, None, self.span_from(start))
        self.fail(f"a value expected behind `{start.text}`")
        raise AssertionError

    def _literal(self, type_name: str | None, begin: int | None = None) -> tree.Literal:
        token = self.take()
        span = self.source.span(token.start if begin is None else begin, token.end)
        text = token.text
        try:
            match token.kind:
                case Lex.INTEGER:
                    parts = text.split("#")
                    if len(parts) == 3 or (len(parts) == 2 and not parts[0].isdigit()):
                        type_name, text = parts[0], text.split("#", 1)[1]
                    return tree.Literal("int", literals.integer(text), type_name, span)
                case Lex.REAL:
                    return tree.Literal("real", literals.real(text), type_name, span)
                case Lex.TIME:
                    prefix, digits = text.split("#", 1)
                    if prefix.upper() in ("LTIME", "LT"):
                        self.report("X001", "LTIME is not supported yet; use TIME.", span)
                    return tree.Literal("time", literals.duration(digits), None, span)
        except ValueError as error:
            self.report("S004", f"`{token.text[:40]}` cannot be read: {error}.", span)
            return tree.Literal("time" if token.kind is Lex.TIME else "int", 0, type_name, span)
        return self._string(text, type_name, span)

    def _string(self, text: str, type_name: str | None, span: Span) -> tree.Literal:
        if text[0] == '"':
            self.report("X001", "WSTRING is not supported yet; write the string in single quotes.", span)
        try:
            return tree.Literal("string", literals.string(text[1:-1]), type_name, span)
        except ValueError as error:
            self.report("S004", f"This string cannot be read: {error}.", span)
            return tree.Literal("string", b"", type_name, span)

    def _postfix(self, base: tree.Expression) -> tree.Expression:
        while True:
            if self.accept("."):
                if self.token.kind is Lex.INTEGER:
                    self.report("X001", "Partial access (`.3`) is not supported yet.", self.here())
                    self.take()
                    continue
                name = self.name("the name of a member")
                base = tree.MemberOf(base, name.text, base.span.to(span_of(self.source, name)))
            elif self.accept("["):
                indices = [self.expression()]
                while self.accept(","):
                    indices.append(self.expression())
                end = self.expect("]", "to close the index")
                base = tree.IndexOf(base, tuple(indices), base.span.to(span_of(self.source, end)))
            elif self.accept("("):
                base = self._call(base)
            elif self.is_("^"):
                self.report("X001", "References (`^`) are not supported yet.", self.here())
                self.take()
            else:
                return base

    def _call(self, callee: tree.Expression) -> tree.Call:
        arguments: list[tree.Argument] = []
        while not self.is_(")"):
            arguments.append(self._argument())
            if not self.accept(","):
                break
        end = self.expect(")", "to close the call")
        return tree.Call(callee, tuple(arguments), callee.span.to(span_of(self.source, end)))

    def _argument(self) -> tree.Argument:
        start = self.token
        if start.kind is Lex.NAME and self.ahead(1).text in (":=", "=>"):
            name = self.take().text
            output = self.take().text == "=>"
            if output and self.is_(",", ")"):
                return tree.Argument(name, True, None, self.span_from(start))
            value = self.expression()
            return tree.Argument(name, output, value, self.span_from(start))
        if self.is_("NOT") and self.ahead(1).kind is Lex.NAME and self.ahead(2).text == "=>":
            self.fail("a negated output (`NOT name => variable`) is not supported; assign it after the call", start)
        value = self.expression()
        return tree.Argument(None, False, value, value.span)
