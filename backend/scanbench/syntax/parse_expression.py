"""Expressions of Structured Text."""

from scanbench.problems import Span
from scanbench.syntax import tree
from scanbench.syntax.cursor import NAME, Unexpected
from scanbench.syntax.lexer import Lex
from scanbench.syntax.parse_literal import LiteralParser
from scanbench.syntax.source import Stretch

BINARY: dict[str, tuple[int, str]] = {
    "OR": (0, "or"), "OR_ELSE": (0, "or_else"), "XOR": (1, "xor"), "AND": (2, "and"), "&": (2, "and"),
    "AND_THEN": (2, "and_then"), "=": (3, "eq"), "<>": (3, "ne"), "<": (4, "lt"), ">": (4, "gt"), "<=": (4, "le"),
    ">=": (4, "ge"), "+": (5, "add"), "-": (5, "sub"), "*": (6, "mul"), "/": (6, "div"), "MOD": (6, "mod"),
    "**": (7, "pow"),
}  # fmt: skip
"""Strength of the operators, 0 the weakest (IEC 61131-3, table 71); all are left-associative, and `-x` is stronger than all."""

UNARY = {"-": "neg", "+": "plus", "NOT": "not"}
POSTFIX = frozenset((".", "[", "(", "^"))
QUOTED_NAME = POSTFIX | {":="}
FUNCTION_FORMS = ("AND", "OR", "XOR", "MOD")
"""Operators that are also functions: `AND(a, b)`."""
LITERALS = frozenset((Lex.INTEGER, Lex.REAL, Lex.TIME, Lex.STRING, Lex.TYPED))
REFUSED = {
    "__CATCH": "check before you compute; a trap stops the PLC",
    "__NEW": "memory that is allocated while the program runs",
    "__DELETE": "memory that is allocated while the program runs",
    "__QUERYINTERFACE": "use `?=`",
    "__QUERYPOINTER": "use `?=`",
    "__VARINFO": "there is no information about variables at run time",
    "__CURRENTTASK": "there is no information about tasks at run time",
    "__POUNAME": "there is no information about POUs at run time",
    "__POSITION": "there is no information about positions at run time",
}
FOREIGN = {
    "==": "write `=`",
    "&&": "write AND",
    ">>": "write SHR(value, count)",
    "<<": "write SHL(value, count)",
    **{f"{operator}=": f"write `x := x {operator} ...`" for operator in "+-*/"},
}
"""Operators of other languages that are read as two of ours."""
MAX_CHAIN = 1000


class ExpressionParser(LiteralParser):
    def expression(self, weakest: int = 0) -> tree.Expression:
        """Operands joined by operators that are no weaker than this."""
        left, count = self._operand(), 0
        texts = self.texts
        while (found := BINARY.get(texts[self.at])) is not None and found[0] >= weakest:
            self.at += 1
            right = self.expression(found[0] + 1)
            left = tree.BinaryOp(found[1], left, right, left.span.to(right.span))
            count += 1
            if count > MAX_CHAIN:
                raise self.fail(f"more than {MAX_CHAIN} operands in one expression; split it up")
        return left

    def _operand(self) -> tree.Expression:
        at = self.at
        kind = self.kinds[at]
        if kind is NAME:
            text = self.texts[at]
            self.at = at + 1
            start = self.starts[at]
            name = tree.Name(text, Stretch(self.source, start, start + len(text)))
            return self._postfix(name) if self.texts[at + 1] in POSTFIX else name
        if kind in LITERALS:
            self.at = at + 1
            if kind is Lex.STRING and self.texts[at][0] == '"' and self.texts[at + 1] in QUOTED_NAME:
                raise self.quoted(at)
            return self.literal(at)
        if kind is Lex.ADDRESS:
            self.at = at + 1
            return tree.DirectAddress(self.texts[at], self.span_of(at))
        return self._marked(at, self.texts[at])

    def _marked(self, at: int, text: str) -> tree.Expression:
        """An operand that begins with an operator or keyword."""
        if text == "(":
            self.take()
            self.enter()
            inner = self.expression()
            self.leave()
            self.expect(")", "to close the parenthesis")
            return self._postfix(inner) if self.is_("^", ".", "[") else inner
        if text in ("TRUE", "FALSE"):
            self.take()
            return tree.Literal("bool", int(text == "TRUE"), None, self.span_of(at))
        formal_not = text == "NOT" and self.texts[at + 1] == "(" and self.texts[at + 3] == ":="
        if (text in FUNCTION_FORMS or formal_not) and self.texts[at + 1] == "(":
            self.take()
            return self._postfix(tree.Name(text, self.span_of(at)))
        if text in UNARY:
            self.take()
            self.enter()
            operand = self._operand()
            self.leave()
            return tree.UnaryOp(UNARY[text], operand, self.span_from(at))
        if text == "#" and self.kinds[at + 1] is NAME:
            self.take()  # `#local`, as one vendor writes its local variables
            return self._operand()
        foreign = FOREIGN.get(self.texts[at - 1] + text)
        if foreign and self.starts[at - 1] + len(self.texts[at - 1]) == self.starts[at]:
            self.report(
                "S003", f"`{self.texts[at - 1]}{text}` is of another language; {foreign}.", self.span_from(at - 1)
            )
            raise Unexpected
        raise self.fail("an expression (a value, variable or call) expected")

    def _postfix(self, base: tree.Expression, calls: bool = True) -> tree.Expression:
        """What follows a variable: `.member`, `[index]`, `(arguments)`, `^`, `.3`."""
        count = 0
        while (text := self.texts[self.at]) in POSTFIX:
            if text == ".":
                self.at += 1
                base = self._member(base)
            elif text == "[":
                self.at += 1
                self.enter()
                indices = self._list()
                self.leave()
                end = self.expect("]", "to close the index")
                base = tree.IndexOf(base, indices, base.span.to(self.span_of(end)))
            elif text == "^":
                base = tree.Dereference(base, base.span.to(self.here()))
                self.at += 1
            elif calls:
                base = self._call(base)
            else:
                break
            count += 1
            if count > MAX_CHAIN:
                raise self.fail(f"more than {MAX_CHAIN} members, indices and calls in a row")
        return base

    def _list(self) -> tuple[tree.Expression, ...]:
        found = [self.expression()]
        while self.accept(","):
            found.append(self.expression())
        return tuple(found)

    def _member(self, base: tree.Expression) -> tree.Expression:
        at = self.at
        text, kind = self.texts[at], self.kinds[at]
        if kind is NAME:
            self.at = at + 1
            return tree.MemberOf(base, text, base.span.to(self.span_of(at)))
        if kind is Lex.INTEGER and text.isdigit() and len(text) < 4:
            self.at = at + 1
            return tree.PartialAccess(base, "X", int(text), base.span.to(self.span_of(at)))
        if kind is Lex.ADDRESS:
            size, (number, *bit) = text[1:2].upper(), text[2:].split(".")
            if size in "XBWDL" and all(each.isdigit() and len(each) < 4 for each in (number, *bit)) and len(bit) < 2:
                self.at = at + 1
                span = base.span.to(self.span_of(at))
                part = tree.PartialAccess(base, size, int(number), span)
                return tree.PartialAccess(part, "X", int(bit[0]), span) if bit else part
            raise self.fail("a part of a variable is written like x.%X3, x.%B1, x.%W0, x.%D0 or x.%B1.3")
        if kind is Lex.TYPED and (owner := _path(base)):
            self.at = at + 1
            return self.literal(at, owner + ".")
        if kind is Lex.KEYWORD and text not in ("AND", "OR", "XOR", "MOD", "NOT"):
            raise self.fail(f"the name of a member expected; `{text}` is a keyword and cannot be a name")
        raise self.fail("the name of a member expected")

    def _call(self, callee: tree.Expression) -> tree.Call:
        self._refuse(callee)
        return tree.Call(callee, self.arguments("call"), self._through(callee))

    def _through(self, first: tree.Expression) -> Span:
        """From an expression to the last token taken."""
        return first.span.to(self.span_of(self.at - 1))

    def _refuse(self, callee: tree.Expression) -> None:
        if isinstance(callee, tree.Name) and callee.name.upper() in REFUSED:
            why = REFUSED[callee.name.upper()]
            self.report("X001", f"`{callee.name}` is not supported: {why}.", callee.span)
            raise Unexpected

    def arguments(self, of: str) -> tuple[tree.Argument, ...]:
        """`(a, name := b, name => c)`."""
        self.expect("(", f"to open the {of}")
        self.enter()
        found: list[tree.Argument] = []
        while self.texts[self.at] != ")":
            if (
                self.kinds[self.at] is NAME
                and self.texts[self.at + 1] == ":="
                and self.texts[self.at + 2] in (",", ")")
            ):
                self.at += 2  # `name := ,` of vendors: the input keeps its value
            else:
                found.append(self._argument())
            if not self.accept(","):
                break
        self.leave()
        self.expect(")", f"to close the {of}")
        return tuple(found)

    def _argument(self) -> tree.Argument:
        at = self.at
        if self.kinds[at] is NAME and self.texts[at + 1] in (":=", "=>"):
            self.at = at + 2
            output = self.texts[at + 1] == "=>"
            if output and self.texts[self.at] in (",", ")"):
                return tree.Argument(self.texts[at], output, None, self.span_from(at))
            value = self.expression()
            return tree.Argument(self.texts[at], output, value, self.span_from(at))
        if self.texts[at] == "NOT" and self.kinds[at + 1] is NAME and self.texts[at + 2] == "=>":
            self.at = at + 3
            value = self.expression()
            return tree.Argument(self.texts[at + 1], True, value, self.span_from(at), negated=True)
        value = self.expression()
        return tree.Argument(None, False, value, value.span)


def _path(expression: tree.Expression) -> str:
    """`A.B` of names joined by dots, else nothing."""
    parts: list[str] = []
    while isinstance(expression, tree.MemberOf):
        parts.append(expression.name)
        expression = expression.owner
    return ".".join([expression.name, *reversed(parts)]) if isinstance(expression, tree.Name) else ""
