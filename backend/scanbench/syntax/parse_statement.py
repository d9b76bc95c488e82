"""Statements of Structured Text. A bad statement is reported and skipped; the next one is read as usual."""

from scanbench.syntax import tree
from scanbench.syntax.cursor import Unexpected
from scanbench.syntax.lexer import Lex
from scanbench.syntax.parse_expression import ExpressionParser

POU_ENDS = ("END_PROGRAM", "END_FUNCTION", "END_FUNCTION_BLOCK")
POU_STARTS = ("PROGRAM", "FUNCTION", "FUNCTION_BLOCK", "TYPE", "CONFIGURATION", "VAR_GLOBAL")
BLOCK_ENDS = ("END_IF", "ELSIF", "ELSE", "END_CASE", "END_FOR", "END_WHILE", "UNTIL", "END_REPEAT")
STARTS = ("IF", "CASE", "FOR", "WHILE", "REPEAT", "EXIT", "CONTINUE", "RETURN")


class StatementParser(ExpressionParser):
    def statements(self, labels: bool = False) -> tuple[tree.Statement, ...]:
        """Statements up to something that ends a block; with `labels` also up to the next label of a CASE."""
        found: list[tree.Statement] = []
        depth = self.depth
        while not self._at_end():
            if self.accept(";"):
                continue
            if labels and self._at_label():
                break
            before = self.at
            try:
                self.enter()
                statement = self._statement()
                self.leave()
                if statement is not None:
                    found.append(statement)
            except Unexpected:
                self.depth = depth
                self._skip(before)
        return tuple(found)

    def _at_end(self) -> bool:
        return self.token.kind is Lex.END or self.is_(*BLOCK_ENDS, *POU_ENDS, *POU_STARTS, "METHOD")

    def _skip(self, before: int) -> None:
        """To the beginning of what may be the next statement; always at least one token on."""
        if self.at == before:
            self.take()
        line = self.source.span(self.tokens[self.at - 1].start, self.tokens[self.at - 1].end).line
        while not self._at_end() and not self.is_(*STARTS):
            token = self.token
            if self._begins_line(line) and self._at_assignment():
                return
            self.take()
            if token.text == ";":
                return

    def _begins_line(self, line: int) -> bool:
        return self.source.span(self.token.start, self.token.end).line > line

    def _at_assignment(self) -> bool:
        """A name, and `:=` or a call before the line ends: most likely a statement."""
        return self.token.kind is Lex.NAME and self.ahead(1).text in (":=", "(", ".", "[")

    def _statement(self) -> tree.Statement | None:
        start = self.token
        if start.kind is Lex.KEYWORD:
            match start.text:
                case "IF":
                    return self._if()
                case "CASE":
                    return self._case()
                case "FOR":
                    return self._for()
                case "WHILE":
                    return self._while()
                case "REPEAT":
                    return self._repeat()
                case "EXIT" | "RETURN":
                    self.take()
                    self.close(";", f"behind {start.text}")
                    span = self.span_from(start)
                    return tree.ExitStatement(span) if start.text == "EXIT" else tree.ReturnStatement(span)
                case "CONTINUE":
                    self.report(
                        "X001", "CONTINUE is not supported yet; put the rest of the loop in an IF.", self.here()
                    )
                    self.take()
                    self.close(";", "behind CONTINUE")
                    return None
                case "TRUE" | "FALSE" | "NOT":
                    pass
                case _:
                    self.fail("a statement expected")
        return self._assignment()

    def _assignment(self) -> tree.Statement:
        start = self.token
        target = self.expression()
        if self.accept(":="):
            value = self.expression()
            span = self.span_from(start)
            self.close(";", "at the end of the assignment")
            return tree.Assignment(target, value, span)
        if isinstance(target, tree.BinaryOp) and target.op == "eq":
            self.report("S003", "An assignment is written `:=`; `=` compares.", target.span)
            self.close(";", "at the end of the statement")
            return tree.Assignment(target.left, target.right, target.span)
        span = self.span_from(start)
        if not isinstance(target, tree.Call) and not self.is_(";"):
            self.fail("`:=` or `;` expected")
        self.close(";", "at the end of the call" if isinstance(target, tree.Call) else "at the end of the statement")
        return tree.ExpressionStatement(target, span)

    def _end(self, keyword: str, of: str) -> None:
        """The closing keyword; the `;` behind it may be missing, as vendors allow."""
        if not self.accept(keyword):
            self.report("S003", f"`{keyword}` expected to close the {of}{self._found()}.", self.here())
        self.accept(";")

    def _condition(self, keyword: str) -> tree.Expression:
        condition = self.expression()
        if not self.accept(keyword):
            where = "behind the condition" if keyword in ("THEN", "DO") else "behind the selector"
            self.close(keyword, where)
        return condition

    def _if(self) -> tree.Statement:
        start = self.take()
        branches = [(self._condition("THEN"), self.statements())]
        orelse: tuple[tree.Statement, ...] = ()
        while self.accept("ELSIF"):
            branches.append((self._condition("THEN"), self.statements()))
        if self.accept("ELSE"):
            orelse = self.statements()
        span = self.span_from(start)
        self._end("END_IF", f"IF of line {span.line}")
        return tree.IfStatement(tuple(branches), orelse, span)

    def _case(self) -> tree.Statement:
        start = self.take()
        selector = self._condition("OF")
        span = self.span_from(start)
        branches = []
        orelse: tuple[tree.Statement, ...] = ()
        while not self._at_end():
            labels = self._labels()
            branches.append((labels, self.statements(labels=True)))
        if self.accept("ELSE"):
            self.accept(":")
            orelse = self.statements()
        self._end("END_CASE", f"CASE of line {span.line}")
        return tree.CaseStatement(selector, tuple(branches), orelse, span)

    def _labels(self) -> tuple[tuple[tree.Expression, tree.Expression | None], ...]:
        labels = []
        try:
            while True:
                first = self.expression()
                labels.append((first, self.expression() if self.accept("..") else None))
                if not self.accept(","):
                    break
            self.expect(":", "behind the label of the CASE")
        except Unexpected:
            self._skip(self.at)
        return tuple(labels)

    def _at_label(self) -> bool:
        """Looks for `value [.. value] {, ...} :` from here."""
        ahead = 0
        while True:
            token = self.ahead(ahead)
            if (
                token.kind in (Lex.INTEGER, Lex.NAME)
                or token.text in (",", "..", ".", "-", "+")
                or (token.kind is Lex.OPERATOR and token.text.endswith("#"))
            ):
                ahead += 1
            else:
                return ahead > 0 and token.kind is Lex.OPERATOR and token.text == ":"

    def _for(self) -> tree.Statement:
        start = self.take()
        variable = self.expression()
        self.expect(":=", "behind the control variable of the FOR")
        first = self.expression()
        self.expect("TO", "behind the start value of the FOR")
        last = self.expression()
        step = self.expression() if self.accept("BY") else None
        self.close("DO", "behind the bounds of the FOR")
        span = self.span_from(start)
        body = self.statements()
        self._end("END_FOR", f"FOR of line {span.line}")
        return tree.ForStatement(variable, first, last, step, body, span)

    def _while(self) -> tree.Statement:
        start = self.take()
        condition = self._condition("DO")
        span = self.span_from(start)
        body = self.statements()
        self._end("END_WHILE", f"WHILE of line {span.line}")
        return tree.WhileStatement(condition, body, span)

    def _repeat(self) -> tree.Statement:
        start = self.take()
        span = self.span_from(start)
        body = self.statements()
        self.expect("UNTIL", f"to close the REPEAT of line {span.line}")
        until = self.expression()
        self.accept(";")
        self._end("END_REPEAT", f"REPEAT of line {span.line}")
        return tree.RepeatStatement(body, until, span)
