"""Structured Text -> tree: types, POUs and configurations of one file."""

from scanbench.problems import Problem
from scanbench.syntax import tree
from scanbench.syntax.cursor import Unexpected
from scanbench.syntax.lexer import Lex, Token, span_of
from scanbench.syntax.parse_declaration import DeclarationParser
from scanbench.syntax.source import Source

UNSUPPORTED = ("CLASS", "INTERFACE", "METHOD", "NAMESPACE", "USING", "UNION")


def parse_st(source: Source) -> tuple[tree.File, list[Problem]]:
    """The tree of what could be read, and every problem on the way, in the order of the text."""
    parser = StParser(source)
    file = parser.file()
    parser.problems.sort(key=lambda problem: (problem.span.line, problem.span.column))
    return file, parser.problems


class StParser(DeclarationParser):
    def file(self) -> tree.File:
        result = tree.File(self.source.name)
        while self.token.kind is not Lex.END:
            before = self.at
            try:
                self._top(result)
            except Unexpected:
                self.depth = 0
                self._skip_top(before)
        return result

    def _top(self, result: tree.File) -> None:
        token = self.token
        if self.accept(";"):
            return
        if token.kind is Lex.KEYWORD:
            match token.text:
                case "PROGRAM" | "FUNCTION_BLOCK" | "FUNCTION":
                    result.pous.append(self._pou())
                    return
                case "TYPE":
                    self._types(result)
                    return
                case "VAR_GLOBAL":
                    result.globals.append(self.section())
                    return
                case "CONFIGURATION":
                    result.configurations.append(self._configuration())
                    return
            if token.text in UNSUPPORTED:
                self.report("X001", f"{token.text} is not supported yet.", self.here())
                raise Unexpected
        self.fail("PROGRAM, FUNCTION_BLOCK, FUNCTION, TYPE, VAR_GLOBAL or CONFIGURATION expected")

    def _skip_top(self, before: int) -> None:
        if self.at == before:
            self.take()
        tops = ("PROGRAM", "FUNCTION_BLOCK", "FUNCTION", "TYPE", "VAR_GLOBAL", "CONFIGURATION", *UNSUPPORTED)
        while self.token.kind is not Lex.END and not self.is_(*tops):
            self.take()

    def _pou(self) -> tree.PouDeclaration:
        start = self.take()
        kind = start.text
        name = self.name(f"the name of the {kind}")
        result = self.type_spec() if kind == "FUNCTION" and self.accept(":") else None
        if self.is_(";"):
            self.take()
        self._inheritance()
        sections = list(self.sections())
        body = list(self.statements())
        while self.is_("VAR_GLOBAL", "METHOD", *POU_BODY_STRAYS):
            if self.is_("METHOD"):
                self._method()
                body += self.statements()
                continue
            # what cannot stand here is reported, and the POU goes on
            if self.is_("VAR_GLOBAL") and not self._end_follows(kind):
                break
            if self.is_("VAR_GLOBAL"):
                sections.append(self.section())
                continue
            stray = self.take()
            self.report("S003", f"`{stray.text}` without its beginning.", span_of(self.source, stray))
            self.accept(";")
            body += self.statements()
        if not self.accept(f"END_{kind}"):
            self._wrong_end(kind, name)
        self.accept(";")
        return tree.PouDeclaration(
            kind.lower(), name.text, result, tuple(sections), tuple(body), span_of(self.source, name)
        )

    def _inheritance(self) -> None:
        """EXTENDS and IMPLEMENTS, with the names behind them."""
        while self.token.kind is Lex.NAME and self.token.text.upper() in ("EXTENDS", "IMPLEMENTS"):
            self.report("X001", f"{self.token.text.upper()} is not supported yet.", self.here())
            self.take()
            self.name("a name")
            while self.accept(","):
                self.name("a name")

    def _method(self) -> None:
        self.report("X001", "METHOD is not supported yet; write a FUNCTION or FUNCTION_BLOCK.", self.here())
        while self.token.kind is not Lex.END and not self.accept("END_METHOD"):
            self.take()
        self.accept(";")

    def _end_follows(self, kind: str) -> bool:
        """Whether this POU's end comes before the next POU begins."""
        for token in self.tokens[self.at :]:
            if token.kind is Lex.KEYWORD and token.text == f"END_{kind}":
                return True
            if token.kind is Lex.KEYWORD and token.text in ("PROGRAM", "FUNCTION", "FUNCTION_BLOCK"):
                return False
        return False

    def _wrong_end(self, kind: str, name: Token) -> None:
        message = f"`END_{kind}` expected to close {kind} {name.text}{self._found()}."
        self.report("S003", message, self.here())
        if self.is_("END_PROGRAM", "END_FUNCTION", "END_FUNCTION_BLOCK"):
            self.take()

    def _types(self, result: tree.File) -> None:
        start = self.take()
        while not self.is_("END_TYPE") and not self._declarations_end():
            try:
                name = self.name("the name of a type")
                self.expect(":", "behind the name of the type")
                spec = self.type_spec()
                initial = self.initial() if self.accept(":=") else None
                if not isinstance(spec, tree.StructSpec) or self.is_(";"):
                    self.close(";", f"behind the declaration of `{name.text}`")
                result.types.append(tree.TypeDeclaration(name.text, spec, initial, span_of(self.source, name)))
            except Unexpected:
                self._skip_declaration()
        self._end("END_TYPE", f"TYPE of line {span_of(self.source, start).line}")

    def _configuration(self) -> tree.Configuration:
        start = self.take()
        name = self.name("the name of the configuration")
        sections: list[tree.VariableSection] = []
        tasks: list[tree.TaskDeclaration] = []
        programs: list[tree.ProgramDeclaration] = []
        resource = False
        while not self.is_("END_CONFIGURATION") and self.token.kind is not Lex.END:
            if self.is_("VAR_GLOBAL"):
                sections.append(self.section())
            elif self.accept("RESOURCE"):
                if resource:
                    self.report("X001", "Several resources are not supported yet.", self.here())
                resource = True
                self.name("the name of the resource")
                if self.accept("ON"):
                    self.name("the type of the resource")
            elif self.is_("END_RESOURCE"):
                self.take()
                self.accept(";")
            elif self.is_("TASK"):
                tasks.append(self._task())
            elif self.is_("PROGRAM"):
                programs.append(self._program())
            else:
                self.fail("TASK, PROGRAM, VAR_GLOBAL or END_CONFIGURATION expected")
        self._end("END_CONFIGURATION", f"CONFIGURATION {name.text}")
        return tree.Configuration(
            name.text, tuple(sections), tuple(tasks), tuple(programs), self.source.span(start.start, name.end)
        )

    def _task(self) -> tree.TaskDeclaration:
        self.take()
        name = self.name("the name of the task")
        interval = priority = None
        self.expect("(", "behind the name of the task")
        while not self.is_(")"):
            key = self.name("INTERVAL, PRIORITY")
            self.expect(":=", f"behind {key.text}")
            value = self.expression()
            match key.text.upper():
                case "INTERVAL":
                    interval = value
                case "PRIORITY":
                    priority = value
                case other:
                    self.report("X001", f"{other} of a task is not supported yet.", span_of(self.source, key))
            if not self.accept(","):
                break
        self.expect(")", "to close the task")
        self.close(";", "behind the task")
        return tree.TaskDeclaration(name.text, interval, priority, span_of(self.source, name))

    def _program(self) -> tree.ProgramDeclaration:
        self.take()
        while self.is_("RETAIN", "NON_RETAIN"):
            self.take()
        name = self.name("the name of the program instance")
        task = self.name("the name of a task").text if self.accept("WITH") else None
        self.expect(":", "behind the program instance, then its type")
        type_name = self.name("the name of a PROGRAM")
        if self.is_("("):
            self.report("X001", "Connections of a program instance are not supported yet.", self.here())
            while not self.is_(";") and self.token.kind is not Lex.END:
                self.take()
        self.close(";", "behind the program instance")
        return tree.ProgramDeclaration(name.text, task, type_name.text, span_of(self.source, name))


POU_BODY_STRAYS = ("END_IF", "ELSIF", "ELSE", "END_CASE", "END_FOR", "END_WHILE", "UNTIL", "END_REPEAT")
