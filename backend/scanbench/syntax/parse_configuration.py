"""Configurations: resources, tasks, program instances, VAR_CONFIG and VAR_ACCESS."""

from dataclasses import dataclass, field

from scanbench.problems import Span
from scanbench.syntax import tree
from scanbench.syntax.cursor import NAME, Unexpected
from scanbench.syntax.lexer import Lex
from scanbench.syntax.parse_pou import PouParser

WORDS = ("RESOURCE", "TASK")
PARTS = frozenset(("VAR_GLOBAL", "VAR_ACCESS", "VAR_CONFIG", "PROGRAM", "END_RESOURCE", "END_CONFIGURATION"))


@dataclass(slots=True)
class _Parts:
    """What a CONFIGURATION or a RESOURCE is made of."""

    globals: list[tree.VariableSection] = field(default_factory=list)
    tasks: list[tree.TaskDeclaration] = field(default_factory=list)
    programs: list[tree.ProgramDeclaration] = field(default_factory=list)
    resources: list[tree.ResourceDeclaration] = field(default_factory=list)
    settings: list[tree.Variable] = field(default_factory=list)
    accesses: list[tree.AccessDeclaration] = field(default_factory=list)


class ConfigurationParser(PouParser):
    def configuration(self) -> tree.Configuration:
        start = self.take()
        name = self.name("the name of the configuration")
        span = self.span_from(start)
        parts = self._parts("END_CONFIGURATION")
        self.end("END_CONFIGURATION", f"CONFIGURATION {self.texts[name]}")
        return tree.Configuration(
            self.texts[name], tuple(parts.globals), tuple(parts.tasks), tuple(parts.programs), span,
            tuple(parts.resources), tuple(parts.settings), tuple(parts.accesses),
        )  # fmt: skip

    def _parts(self, end: str) -> _Parts:
        parts = _Parts()
        while not self.is_(end) and not self.ended():
            before, depth = self.at, self.depth
            try:
                if not self._part_of(parts, end):
                    break
            except Unexpected:
                self.depth = depth
                self._skip_part(before)
        return parts

    def _part_of(self, parts: _Parts, end: str) -> bool:
        """Reads one part; false where something else begins."""
        text, word = self.texts[self.at], self.word()
        if text == ";":
            self.take()
        elif text == "VAR_GLOBAL":
            section = self.section()
            parts.globals += [section] if section else []
        elif text == "VAR_CONFIG":
            parts.settings += self._settings()
        elif text == "VAR_ACCESS":
            parts.accesses += self._accesses()
        elif text == "PROGRAM":
            parts.programs.append(self._program())
        elif word == "TASK":
            parts.tasks.append(self._task())
        elif word == "RESOURCE" and end != "END_RESOURCE":
            parts.resources.append(self._resource())
        elif text.startswith("END_") or text in ("FUNCTION", "FUNCTION_BLOCK", "TYPE", "CONFIGURATION"):
            return False
        else:
            raise self.fail(f"RESOURCE, TASK, PROGRAM, VAR_GLOBAL or {end} expected")
        return True

    def _skip_part(self, before: int) -> None:
        if self.at == before:
            self.take()
        while not self.ended() and self.texts[self.at] not in PARTS and self.word() not in WORDS:
            if self.texts[self.take()] == ";":
                return

    def _resource(self) -> tree.ResourceDeclaration:
        self.take()
        name = self.name("the name of the resource")
        if self.accept_word("ON"):
            self.name("the type of the resource")
        parts = self._parts("END_RESOURCE")
        for where in [each.span for each in parts.settings] + [each.span for each in parts.accesses]:
            self.report("S003", "VAR_CONFIG and VAR_ACCESS stand outside of a RESOURCE.", where)
        self.end("END_RESOURCE", f"RESOURCE {self.texts[name]}")
        return tree.ResourceDeclaration(
            self.texts[name], tuple(parts.globals), tuple(parts.tasks), tuple(parts.programs), self.span_of(name)
        )

    def _task(self) -> tree.TaskDeclaration:
        self.take()
        name = self.name("the name of the task")
        known: dict[str, tree.Expression | None] = {"INTERVAL": None, "PRIORITY": None, "SINGLE": None}
        self.expect("(", "behind the name of the task")
        while not self.is_(")"):
            key = self.name("INTERVAL, SINGLE or PRIORITY")
            self.expect(":=", f"behind {self.texts[key]}")
            value = self.expression()
            word = self.texts[key].upper()
            if word not in known:
                self.report("X001", f"{word} of a task is not supported.", self.span_of(key))
            elif known[word] is not None:
                self.report("D001", f"{word} of this task is given twice.", self.span_of(key))
            known[word] = value
            if not self.accept(","):
                break
        self.expect(")", "to close the task")
        self.close(";", "behind the task")
        return tree.TaskDeclaration(
            self.texts[name], known["INTERVAL"], known["PRIORITY"], self.span_of(name), known["SINGLE"]
        )

    def _program(self) -> tree.ProgramDeclaration:
        self.take()
        retain = self.word() == "RETAIN" and self.kinds[self.at + 1] is NAME
        if self.word() in ("RETAIN", "NON_RETAIN") and self.kinds[self.at + 1] is NAME:
            self.take()
        name = self.name("the name of the program instance")
        task = self.texts[self.name("the name of a task")] if self.accept_word("WITH") else None
        self.expect(":", "behind the program instance, then its type")
        type_name = self.qualified("the name of a PROGRAM")
        connections: list[tree.Argument] = []
        blocks: list[tuple[str, str, Span]] = []
        if self.accept("("):
            while not self.is_(")"):
                self._connection(connections, blocks)
                if not self.accept(","):
                    break
            self.expect(")", "to close the connections of the program")
        self.close(";", "behind the program instance")
        span = self.span_of(name)
        return tree.ProgramDeclaration(
            self.texts[name], task, type_name, span, tuple(connections), tuple(blocks), retain
        )

    def _connection(self, connections: list[tree.Argument], blocks: list[tuple[str, str, Span]]) -> None:
        """`input := x`, `output => y`, or `instance WITH task`."""
        start = self.at
        if self.kinds[start] is NAME and self.word(1) == "WITH":
            self.at += 2
            task = self.name("the name of a task")
            blocks.append((self.texts[start], self.texts[task], self.span_from(start)))
            return
        argument = self._argument()
        if argument.name is None:
            raise self.fail("`input := value`, `output => variable` or `instance WITH task` expected", start)
        connections.append(argument)

    # ---- VAR_CONFIG and VAR_ACCESS ------------------------------------------------------------------------------

    def _settings(self) -> list[tree.Variable]:
        """`resource.program.instance.variable AT %IX1.0 : BOOL := TRUE;`"""
        found = []
        start = self.take()
        while not self.is_("END_VAR") and self.kinds[self.at] is NAME:
            try:
                first = self.at
                path = self._instance_path()
                span = self.span_from(first)
                address, address_span = self._address()
                self.expect(":", "behind the path, then its type")
                spec = self.type_spec()
                arguments = self.arguments("initial values") if self.is_("(") else ()
                initial = self.initial() if self.accept(":=") else None
                self.close(";", f"behind the setting of `{path}`")
                found.append(tree.Variable(path, spec, initial, address, span, address_span, arguments))
            except Unexpected:
                self.skip_declaration()
        self.end("END_VAR", f"VAR_CONFIG of line {self.line_of(start)}")
        return found

    def _accesses(self) -> list[tree.AccessDeclaration]:
        """`name : resource.program.variable : type READ_WRITE;`"""
        found = []
        start = self.take()
        while not self.is_("END_VAR") and self.kinds[self.at] is NAME:
            try:
                name = self.take()
                self.expect(":", "behind the name, then the path of the variable")
                path = self._instance_path()
                self.expect(":", "behind the path, then the type of the variable")
                spec = self.type_spec()
                writable = self.word() == "READ_WRITE"
                if self.word() in ("READ_WRITE", "READ_ONLY"):
                    self.take()
                self.close(";", f"behind the access path `{self.texts[name]}`")
                found.append(tree.AccessDeclaration(self.texts[name], path, spec, writable, self.span_of(name)))
            except Unexpected:
                self.skip_declaration()
        self.end("END_VAR", f"VAR_ACCESS of line {self.line_of(start)}")
        return found

    def _instance_path(self) -> str:
        """Names, indices and an address joined by dots, as written but for blanks."""
        start = self.at
        while self.kinds[self.at] in (NAME, Lex.ADDRESS, Lex.INTEGER) or self.is_(".", "[", "]", ","):
            self.take()
        if self.at == start:
            raise self.fail("the path of a variable expected")
        return "".join(self.texts[start : self.at])
