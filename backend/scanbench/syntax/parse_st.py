"""Structured Text and Instruction List -> tree: everything that one file declares."""

import re

from scanbench.problems import Problem
from scanbench.syntax import tree
from scanbench.syntax.cursor import NAME, Unexpected
from scanbench.syntax.lexer import Tokens
from scanbench.syntax.parse_configuration import ConfigurationParser
from scanbench.syntax.parse_pou import MEMBERS, with_member
from scanbench.syntax.source import Source

TOPS = frozenset(("PROGRAM", "FUNCTION_BLOCK", "FUNCTION", "TYPE", "VAR_GLOBAL", "CONFIGURATION"))
WORDS = frozenset(("CLASS", "INTERFACE", "NAMESPACE", "USING")) | MEMBERS
REFUSED = {
    "ORGANIZATION_BLOCK": "write a PROGRAM, and a TASK in a CONFIGURATION",
    "DATA_BLOCK": "write VAR_GLOBAL",
    "VAR_CONFIG": "write it inside of the CONFIGURATION",
    "VAR_ACCESS": "write it inside of the CONFIGURATION",
}
QUALIFIED_ONLY = re.compile(r"\{\s*attribute\s*(?::=)?\s*'qualified_only'", re.IGNORECASE)


def parse_st(source: Source) -> tuple[tree.File, list[Problem]]:
    """The tree of what could be read, and every problem on the way, in the order of the text."""
    return StParser(source).whole()


class StParser(ConfigurationParser):
    def __init__(self, source: Source, tokens: Tokens | None = None, list_name: str = "") -> None:
        super().__init__(source, tokens)
        self.list_name = list_name
        """Of the variables that a vendor keeps in a list of its own."""
        self.namespace = ""
        self.visible: tuple[str, ...] = ()
        """Namespaces that USING names, here."""

    def whole(self) -> tuple[tree.File, list[Problem]]:
        """Everything up to the end of the text, and the problems in their order."""
        result = tree.File(self.source.name)
        while not self.ended():
            self._next(result)
        self.check_pragmas()
        self.problems.sort(key=lambda problem: (problem.span.line, problem.span.column))
        return result, self.problems

    def _next(self, result: tree.File) -> None:
        before = self.at
        try:
            self._top(result)
        except Unexpected:
            self.depth = 0
            self._skip_top(before)

    def _top(self, result: tree.File) -> None:
        text, word = self.texts[self.at], self.word()
        if text == ";":
            self.take()
        elif text in ("PROGRAM", "FUNCTION_BLOCK", "FUNCTION") or word in ("CLASS", "INTERFACE"):
            result.pous.append(self.pou(self.namespace, self.visible))
        elif text == "TYPE":
            self._types(result)
        elif text == "VAR_GLOBAL":
            section = self.section(self.list_name, self.namespace)
            result.globals += [section] if section else []
        elif text == "CONFIGURATION":
            result.configurations.append(self.configuration())
        elif word == "NAMESPACE":
            self._namespace(result)
        elif word == "USING":
            self.visible += self.using()
        elif word in MEMBERS and result.pous:
            # exports of vendors write methods and actions behind the POU they belong to
            owner = result.pous[-1]
            result.pous[-1] = with_member(owner, self.member(owner.kind.upper()))
        elif (refused := word or text) in REFUSED:
            self.report("X001", f"{refused} is not supported here; {REFUSED[refused]}.", self.here())
            raise Unexpected
        else:
            raise self.fail(
                "PROGRAM, FUNCTION_BLOCK, FUNCTION, CLASS, INTERFACE, TYPE, VAR_GLOBAL or CONFIGURATION expected"
            )

    def _skip_top(self, before: int) -> None:
        if self.at == before:
            self.take()
        while not self.ended() and self.texts[self.at] not in TOPS and not self.is_("END_NAMESPACE"):
            if self.word() in WORDS and self.kinds[self.at + 1] is NAME:
                return
            self.take()

    def _namespace(self, result: tree.File) -> None:
        start = self.take()
        internal = self.word() == "INTERNAL" and self.kinds[self.at + 1] is NAME
        if internal:
            self.take()
        outer, visible = self.namespace, self.visible
        name = self.qualified("the name of the NAMESPACE")
        self.namespace = f"{outer}.{name}" if outer else name
        if internal:
            result.internal.append(self.namespace)
        self.enter()
        try:
            while not self.is_("END_NAMESPACE") and not self.ended():
                depth = self.depth
                self._next(result)
                self.depth = depth
        finally:
            self.leave()
            self.namespace, self.visible = outer, visible
        self.end("END_NAMESPACE", f"NAMESPACE of line {self.line_of(start)}")

    def _types(self, result: tree.File) -> None:
        start = self.take()
        qualified_only = self._qualified_only(start)
        access = "PUBLIC"
        if self.word() in ("PUBLIC", "INTERNAL") and self.kinds[self.at + 1] is NAME:
            access = self.word()
            self.take()
        while not self.is_("END_TYPE") and not self.ended() and self.texts[self.at] not in TOPS:
            depth = self.depth
            if self.accept(";"):
                continue
            try:
                result.types.append(self._type(qualified_only, access))
            except Unexpected:
                self.depth = depth
                self._skip_type()
        self.end("END_TYPE", f"TYPE of line {self.line_of(start)}")

    def _skip_type(self) -> None:
        """To behind the declaration; its structure may have members that end in `;`."""
        while not self.is_("END_TYPE") and not self.ended() and self.texts[self.at] not in TOPS:
            if self.texts[self.take()] == ";" or self.is_("END_VAR"):
                return

    def _type(self, qualified_only: bool, access: str) -> tree.TypeDeclaration:
        name = self.name("the name of a type")
        qualified_only = qualified_only or self._qualified_only(name)
        extends = None
        if self.word() == "EXTENDS":
            self.take()
            extends = self.qualified("the name of a structure")
        self.expect(":", "behind the name of the type")
        spec = self.structure(extends) if extends and self.is_("STRUCT") else self.type_spec(named=True)
        initial = self.initial() if self.accept(":=") else None
        if not isinstance(spec, tree.StructSpec) or self.is_(";"):
            self.close(";", f"behind the declaration of `{self.texts[name]}`")
        return tree.TypeDeclaration(
            self.texts[name], spec, initial, self.span_of(name), self.namespace, self.visible, access, qualified_only
        )

    def _qualified_only(self, token: int) -> bool:
        """Whether the vendor's attribute stands right before this token."""
        first = self._end_of(token - 1) if token else 0
        last = self.starts[token]
        return any(first <= at < last and QUALIFIED_ONLY.match(text) for at, text in self.pragmas)
