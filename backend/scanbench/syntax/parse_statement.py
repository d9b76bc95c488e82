"""Statements of Structured Text. A bad statement is reported and skipped; the next one is read as usual."""

from collections.abc import Callable

from scanbench.syntax import tree
from scanbench.syntax.cursor import NAME, Unexpected
from scanbench.syntax.lexer import Lex
from scanbench.syntax.parse_declaration import POU_ENDS, POU_STARTS, SECTIONS, DeclarationParser

BLOCK_ENDS = frozenset(("END_IF", "ELSIF", "ELSE", "END_CASE", "END_FOR", "END_WHILE", "UNTIL", "END_REPEAT"))
STOPS = BLOCK_ENDS | POU_ENDS | POU_STARTS | SECTIONS | {"VAR_ACCESS", "VAR_CONFIG", "END_VAR", ""}
"""What a statement cannot begin with, and where a list of them therefore ends."""
STARTS = frozenset(("IF", "CASE", "FOR", "WHILE", "REPEAT", "EXIT", "RETURN"))
DECLARATIONS = frozenset(
    ("METHOD", "PROPERTY", "PROPERTY_GET", "PROPERTY_SET", "ACTION", "CLASS", "INTERFACE", "NAMESPACE", "USING")
)
"""Words that begin a declaration when a name follows; no statement begins with two names."""
OPERATORS_WITH_NAME = ("S", "R", "REF")
CHART = "write the steps of the chart (SFC) as a CASE"
REFUSED = {
    "JMP": "use IF and loops",
    "GOTO": "use IF and loops",
    "__TRY": "check before you compute; a trap stops the PLC",
    "TRY": "check before you compute; a trap stops the PLC",
    "__CATCH": "check before you compute; a trap stops the PLC",
    "__FINALLY": "check before you compute; a trap stops the PLC",
    "__ENDTRY": "check before you compute; a trap stops the PLC",
    "REGION": "remove it, and its END_REGION",
    "END_REGION": "remove it, and its REGION",
    **dict.fromkeys(("INITIAL_STEP", "STEP", "END_STEP", "TRANSITION", "END_TRANSITION"), CHART),
    **dict.fromkeys(("_LD_BODY", "_FBD_BODY", "_CFC_BODY", "_SFC_BODY"), "convert the drawing to Structured Text"),
}
LABEL_KINDS = frozenset((NAME, Lex.INTEGER, Lex.TYPED, Lex.STRING, Lex.TIME))
LABEL_TEXTS = frozenset(", .. . - + * / ** & ( ) MOD AND OR XOR NOT TRUE FALSE".split())
"""What a constant expression is made of. Nothing else that begins a statement reaches a `:` by way of these."""
MAX_LABELS = 1000


class StatementParser(DeclarationParser):
    def statements(self, labels: bool = False) -> tuple[tree.Statement, ...]:
        """Statements up to something that ends a block; with `labels` also up to the next label of a CASE."""
        found: list[tree.Statement] = []
        depth = self.depth
        while (text := self.texts[self.at]) not in STOPS:
            if text == ";":
                self.at += 1
                continue
            name = self.kinds[self.at] is NAME
            if name and self.kinds[self.at + 1] is NAME and self.declaration_follows():
                break
            if labels and self._at_label():
                break
            before = self.at
            try:
                keyword = KEYWORDS.get(text)
                if keyword is None:
                    found.append(self._simple(name))
                else:
                    self.enter()
                    found.append(keyword(self))
                    self.depth = depth
            except Unexpected:
                self.depth = depth
                self._skip(before)
        return tuple(found)

    def declaration_follows(self) -> bool:
        """METHOD and the like, with a name behind."""
        return self.word() in DECLARATIONS and (
            self.word(1) not in OPERATORS_WITH_NAME or self.texts[self.at + 2] != "="
        )

    def _skip(self, before: int) -> None:
        """To the beginning of what may be the next statement; always at least one token on."""
        if self.at == before:
            self.take()
        line = self.line_of(self.at - 1)
        while (text := self.texts[self.at]) not in STOPS and text not in STARTS:
            if self.kinds[self.at] is NAME and self.line_of(self.at) > line:
                if self.texts[self.at + 1] in (":=", "(", ".", "[") or self.declaration_follows():
                    return
            self.take()
            if text == ";":
                return

    def _simple(self, name: bool) -> tree.Statement:
        """An assignment, a call, or a word that is a statement only where it stands alone."""
        start = self.at
        if name and self.texts[start + 1] not in (":=", "(", ".", "["):
            word = self.word()
            if word == "CONTINUE" and (self.texts[start + 1] == ";" or self.texts[start + 1] in STOPS):
                self.take()
                self.close(";", "behind CONTINUE")
                return tree.ContinueStatement(self.span_of(start))
            self._refused(word)
        target = self.expression()
        if self.accept(":="):
            value = self.expression()
            span = self.span_from(start)
            if self.is_(":="):
                self.report(
                    "X001", "Several assignments in one (`a := b := c`) are not supported; write one for each.", span
                )
                raise Unexpected
            self.close(";", "at the end of the assignment")
            return tree.Assignment(target, value, span)
        return self._other(start, target)

    def _other(self, start: int, target: tree.Expression) -> tree.Statement:
        word = self.word()
        if word in OPERATORS_WITH_NAME and self.texts[self.at + 1] == "=":
            self.at += 2
            return self._assigned(start, target, word + "=")
        if self.accept("?="):
            return self._assigned(start, target, "?=")
        if isinstance(target, tree.BinaryOp) and target.op == "eq":
            self.report("S003", "An assignment is written `:=`; `=` compares.", target.span)
            self.close(";", "at the end of the statement")
            return tree.Assignment(target.left, target.right, target.span)
        span = self.span_from(start)
        if not isinstance(target, tree.Call) and not self.is_(";"):
            raise self.fail("`:=` or `;` expected")
        self.close(";", "at the end of the call" if isinstance(target, tree.Call) else "at the end of the statement")
        return tree.ExpressionStatement(target, span)

    def _assigned(self, start: int, target: tree.Expression, operator: str) -> tree.Statement:
        value = self.expression()
        span = self.span_from(start)
        self.close(";", "at the end of the assignment")
        return tree.Assignment(target, value, span, operator)

    def _refused(self, word: str) -> None:
        latched = self.word(1) in OPERATORS_WITH_NAME and self.texts[self.at + 2] == "="
        if word in REFUSED and (
            word[0] == "_" or (self.texts[self.at + 1] not in (";", "?=", "=", "^") and not latched)
        ):
            self.report("X001", f"{word} is not supported; {REFUSED[word]}.", self.here())
            raise Unexpected
        if self.texts[self.at + 1] == ":":
            message = f"`{self.texts[self.at]}:` is a label to jump to, which is not supported; use IF and loops."
            self.report("X001", message, self.span_of(self.at))
            self.at += 2
            raise Unexpected

    def _exit(self) -> tree.Statement:
        start = self.take()
        self.close(";", f"behind {self.texts[start]}")
        span = self.span_of(start)
        return tree.ExitStatement(span) if self.texts[start] == "EXIT" else tree.ReturnStatement(span)

    def _condition(self, keyword: str) -> tree.Expression:
        start, depth = self.at, self.depth
        try:
            condition = self.expression()
        except Unexpected:
            self.depth = depth
            if not self._reach(keyword):
                raise
            return tree.Literal("bool", 0, None, self.span_of(start))
        if not self.accept(keyword):
            self.close(keyword, "behind the selector" if keyword == "OF" else "behind the condition")
        return condition

    def _reach(self, keyword: str) -> bool:
        """Goes behind the keyword, if it comes before the statement ends."""
        at = self.at
        while (
            self.texts[at] not in STOPS and self.texts[at] not in STARTS and self.texts[at] not in (";", ":=", keyword)
        ):
            at += 1
        if self.texts[at] != keyword or keyword == "OF":
            return False
        self.at = at + 1
        return True

    def _if(self) -> tree.Statement:
        start = self.take()
        branches = [(self._condition("THEN"), self.statements())]
        orelse: tuple[tree.Statement, ...] = ()
        while self.accept("ELSIF"):
            branches.append((self._condition("THEN"), self.statements()))
        if self.accept("ELSE"):
            orelse = self.statements()
        span = self.span_from(start)
        self._close_block("END_IF", start)
        return tree.IfStatement(tuple(branches), orelse, span)

    def _close_block(self, keyword: str, start: int) -> None:
        if not self.accept(keyword):
            of = f"{self.texts[start]} of line {self.line_of(start)}"
            self.report("S003", f"`{keyword}` expected to close the {of}{self._found()}.", self.here())
        self.accept(";")

    def _case(self) -> tree.Statement:
        start = self.take()
        selector = self._condition("OF")
        span = self.span_from(start)
        branches = []
        orelse: tuple[tree.Statement, ...] = ()
        while self.texts[self.at] not in STOPS:
            if self.accept(";"):
                continue
            before = self.at
            labels = self._labels()
            branches.append((labels, self.statements(labels=True)))
            if self.at == before:
                break
        if self.accept("ELSE"):
            self.accept(":")
            orelse = self.statements()
        self._close_block("END_CASE", start)
        return tree.CaseStatement(selector, tuple(branches), orelse, span)

    def _labels(self) -> tuple[tuple[tree.Expression, tree.Expression | None], ...]:
        labels = []
        depth = self.depth
        try:
            while True:
                first = self.expression()
                labels.append((first, self.expression() if self.accept("..") else None))
                if not self.accept(","):
                    break
            self.expect(":", "behind the label of the CASE")
        except Unexpected:
            self.depth = depth
            self._skip(self.at)
        return tuple(labels)

    def _at_label(self) -> bool:
        """Looks for `value [.. value] {, ...} :` from here."""
        at = self.at
        kinds, texts = self.kinds, self.texts
        last = min(at + MAX_LABELS, len(texts) - 1)
        while at < last and (kinds[at] in LABEL_KINDS or texts[at] in LABEL_TEXTS):
            at += 1
        return at > self.at and texts[at] == ":"

    def _for(self) -> tree.Statement:
        start = self.take()
        variable = self.expression()
        self.expect(":=", "behind the control variable of the FOR")
        first = self.expression()
        self.expect("TO", "behind the start value of the FOR")
        last = self.expression()
        step = self.expression() if self.accept_word("BY") else None
        self.close("DO", "behind the bounds of the FOR")
        span = self.span_from(start)
        body = self.statements()
        self._close_block("END_FOR", start)
        return tree.ForStatement(variable, first, last, step, body, span)

    def _while(self) -> tree.Statement:
        start = self.take()
        condition = self._condition("DO")
        span = self.span_from(start)
        body = self.statements()
        self._close_block("END_WHILE", start)
        return tree.WhileStatement(condition, body, span)

    def _repeat(self) -> tree.Statement:
        start = self.take()
        span = self.span_from(start)
        body = self.statements()
        self.expect("UNTIL", f"to close the REPEAT of line {self.line_of(start)}")
        until = self.expression()
        self.accept(";")
        self._close_block("END_REPEAT", start)
        return tree.RepeatStatement(body, until, span)


KEYWORDS: dict[str, Callable[[StatementParser], tree.Statement]] = {
    "IF": StatementParser._if,
    "CASE": StatementParser._case,
    "FOR": StatementParser._for,
    "WHILE": StatementParser._while,
    "REPEAT": StatementParser._repeat,
    "EXIT": StatementParser._exit,
    "RETURN": StatementParser._exit,
}
