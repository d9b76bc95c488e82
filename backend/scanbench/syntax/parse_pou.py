"""POUs: programs, blocks, functions, classes, interfaces, and what stands in them."""

from collections.abc import Sequence
from dataclasses import replace

from scanbench.problems import Span
from scanbench.syntax import tree
from scanbench.syntax.cursor import NAME
from scanbench.syntax.parse_declaration import ACCESS, POU_STARTS
from scanbench.syntax.parse_il import IlParser
from scanbench.syntax.parse_statement import BLOCK_ENDS
from scanbench.syntax.pragmas import InOutPragma
from scanbench.syntax.source import Stretch

MODIFIERS = frozenset(("ABSTRACT", "FINAL", "OVERRIDE"))
ENDS = {
    "PROGRAM": "END_PROGRAM", "FUNCTION": "END_FUNCTION", "FUNCTION_BLOCK": "END_FUNCTION_BLOCK",
    "CLASS": "END_CLASS", "INTERFACE": "END_INTERFACE",
}  # fmt: skip
MEMBERS = frozenset(("METHOD", "PROPERTY", "PROPERTY_GET", "PROPERTY_SET", "ACTION"))
SETTINGS_OF_VENDORS = frozenset(("VERSION", "TITLE", "AUTHOR", "FAMILY"))

Body = tuple[tree.Statement, ...] | tree.IlBody


class PouParser(IlParser):
    def pou(self, namespace: str = "", using: tuple[str, ...] = ()) -> tree.PouDeclaration:
        """From PROGRAM, FUNCTION_BLOCK, FUNCTION, CLASS or INTERFACE to its end."""
        first = self.take()
        kind = self.texts[first].upper()
        access, modifiers = self._modifiers()
        name = self.name(f"the name of the {kind}")
        header = self._header(kind, name)
        in_out = self._in_out(first) if kind == "FUNCTION_BLOCK" and self.pragmas else ""
        sections: list[tree.VariableSection] = []
        methods: list[tree.PouDeclaration] = []
        body: Body = ()
        while True:
            before = self.at
            if self.is_("VAR_GLOBAL") and not self._end_follows(ENDS[kind]):
                break
            sections += self.sections()
            if self.is_("VAR_ACCESS", "VAR_CONFIG"):
                self._skip_section(kind)
                continue
            self._vendor_lines()
            if self.word() in MEMBERS and self.kinds[self.at + 1] is NAME:
                methods += self.member(kind)
                continue
            body = _joined(body, self._whole_body())
            if self.at == before:
                break
        if body and kind in ("CLASS", "INTERFACE"):
            where = body.span if isinstance(body, tree.IlBody) else body[0].span
            self.report("S003", f"A {kind} has no statements of its own; put them into a METHOD.", where)
        self._pou_end(kind, name)
        self._check_kept(kind, sections)
        result, extends, implements, more = header
        return tree.PouDeclaration(
            kind.lower(), self.texts[name], result, tuple(sections), body, self.span_of(name), tuple(methods),
            extends, implements, modifiers, access, namespace, using + more, in_out,
        )  # fmt: skip

    def _in_out(self, first: int) -> str:
        """What a pragma between the token in front of `first` and the next one says of in-outs."""
        begin = self._end_of(first - 1) if first else 0
        mine = [each for each in self.in_out_pragmas if begin <= each.start < self.starts[self.at]]
        for each in mine:
            self.in_out_pragmas.remove(each)
            if not each.convention:
                self.report("S003", f"`'value'` or `'reference'` expected, found `{each.said}`.", self._span_of(each))
        for each in mine[1:]:
            self.report(
                "S003", "One pragma `in_out` is enough for a FUNCTION_BLOCK; remove this one.", self._span_of(each)
            )
        return mine[0].convention if mine else ""

    def check_pragmas(self) -> None:
        """Reports pragmas `in_out` that stand where they mean nothing."""
        for each in self.in_out_pragmas:
            message = "A pragma `in_out` stands in front of a FUNCTION_BLOCK or behind its name; move it there."
            self.report("S003", message, self._span_of(each))

    def _span_of(self, pragma: InOutPragma) -> Span:
        return Stretch(self.source, pragma.start, pragma.end)

    def _whole_body(self) -> Body:
        """A body; what closes a block that was never opened is reported, and the body goes on."""
        body = self.body()
        while self.texts[self.at] in BLOCK_ENDS:
            stray = self.take()
            self.report("S003", f"`{self.texts[stray]}` without its beginning.", self.span_of(stray))
            self.accept(";")
            body = _joined(body, self.body())
        return body

    def _modifiers(self) -> tuple[str, tuple[str, ...]]:
        """Access and modifiers before a name, in any order."""
        access, modifiers = "PUBLIC", []
        while self.word() in ACCESS | MODIFIERS and self.kinds[self.at + 1] is NAME:
            word = self.word()
            self.take()
            if word in ACCESS:
                access = word
            else:
                modifiers.append(word)
        return access, tuple(modifiers)

    def _header(
        self, kind: str, name: int
    ) -> tuple[tree.TypeSpec | None, tuple[str, ...], tuple[str, ...], tuple[str, ...]]:
        """What stands behind the name: result, bases, interfaces, namespaces used."""
        result: tree.TypeSpec | None = None
        extends: tuple[str, ...] = ()
        implements: tuple[str, ...] = ()
        using: tuple[str, ...] = ()
        while True:
            if self.is_(":") and kind in ("FUNCTION", "METHOD", "PROPERTY", "PROPERTY_GET", "PROPERTY_SET"):
                self.take()
                result = self.type_spec()
                if self._says("VOID", result):
                    result = None
            elif self.word() == "EXTENDS" and self.kinds[self.at + 1] is NAME:
                self.take()
                extends += self._names("the name of the base")
            elif self.word() == "IMPLEMENTS" and self.kinds[self.at + 1] is NAME:
                self.take()
                implements += self._names("the name of an interface")
            elif self.word() == "USING" and self.kinds[self.at + 1] is NAME:
                using += self.using()
            elif self.is_(";") and not using:
                self.take()
            else:
                break
        if len(extends) > 1 and kind != "INTERFACE":
            message = f"A {kind} extends one other only; implement INTERFACEs for more."
            self.report("S003", message, self.span_of(name))
            extends = extends[:1]
        return result, extends, implements, using

    def _says(self, name: str, spec: tree.TypeSpec) -> bool:
        return isinstance(spec, tree.NamedType) and spec.name.upper() == name

    def _names(self, what: str) -> tuple[str, ...]:
        found = [self.qualified(what)]
        while self.accept(","):
            found.append(self.qualified(what))
        return tuple(found)

    def using(self) -> tuple[str, ...]:
        """`USING A.B, C;`"""
        self.take()
        found = self._names("the name of a NAMESPACE")
        self.close(";", "behind USING")
        return found

    def _end_follows(self, end: str) -> bool:
        """Whether this POU's end comes before the next POU begins."""
        for at in range(self.at, len(self.texts)):
            text = self.texts[at]
            if text == end or text in POU_STARTS:
                return text == end
        return False

    def _skip_section(self, kind: str) -> None:
        start = self.take()
        message = f"{self.texts[start]} in a {kind} is not supported; write it inside of the CONFIGURATION."
        self.report("X001", message, self.span_of(start))
        while not self.ended() and not self.accept("END_VAR") and self.texts[self.at] not in POU_STARTS:
            self.take()
        self.accept(";")

    def _vendor_lines(self) -> None:
        """`VERSION : 0.1`, `TITLE = ...`, `BEGIN`, which one vendor's exports have before the statements."""
        while self.word() in SETTINGS_OF_VENDORS and self.texts[self.at + 1] in (":", "="):
            line = self.line_of(self.at)
            while not self.ended() and self.line_of(self.at) == line:
                self.take()
        if self.word() == "BEGIN" and self.texts[self.at + 1] not in (":=", "(", ".", "[", ";"):
            self.take()

    def _pou_end(self, kind: str, name: int) -> None:
        end = ENDS[kind]
        if not self.accept(end):
            message = f"`{end}` expected to close {kind} {self.texts[name]}{self._found()}."
            self.report("S003", message, self.here())
            if self.texts[self.at] in ENDS.values() or self.texts[self.at].startswith("END_"):
                self.take()
        self.accept(";")

    def _check_kept(self, kind: str, sections: Sequence[tree.VariableSection]) -> None:
        """A FUNCTION and a METHOD keep nothing between calls, so VAR_STAT and VAR_INST cannot be had there."""
        if kind not in ("FUNCTION", "METHOD"):
            return
        for section in sections:
            if section.span in self.kept and "CONSTANT" not in section.qualifiers:
                message = f"A {kind} keeps no variables; move them into the block or VAR_GLOBAL."
                self.report("X001", message, section.span)

    # ---- members --------------------------------------------------------------------------------------------------

    def member(self, owner: str) -> list[tree.PouDeclaration]:
        """A METHOD, ACTION or PROPERTY."""
        word = self.texts[self.take()].upper()
        if word == "ACTION":
            return [self._action()]
        access, modifiers = self._modifiers()
        name = self.name(f"the name of the {word}")
        result, _, _, _ = self._header(word, name)
        if word == "METHOD":
            return [self._method(owner, name, result, access, modifiers)]
        return self._property(owner, word, name, result, access, modifiers)

    def _method(
        self, owner: str, name: int, result: tree.TypeSpec | None, access: str, modifiers: tuple[str, ...]
    ) -> tree.PouDeclaration:
        sections = self.sections()
        body = self._whole_body()
        self._check_kept("METHOD", sections)
        # in an interface, and where a vendor's export says nothing more, the next declaration ends it
        if not self.accept("END_METHOD") and not (owner == "INTERFACE" and not body):
            self._missing("END_METHOD", f"METHOD {self.texts[name]}")
        self.accept(";")
        return self._declared("method", name, result, sections, body, access, modifiers)

    def _action(self) -> tree.PouDeclaration:
        """A method without variables of its own."""
        name = self.name("the name of the ACTION")
        self.accept(":")
        body = self._whole_body()
        if not self.accept("END_ACTION"):
            self._missing("END_ACTION", f"ACTION {self.texts[name]}")
        self.accept(";")
        return self._declared("method", name, None, (), body, "PUBLIC", ())

    def _property(
        self,
        owner: str,
        word: str,
        name: int,
        result: tree.TypeSpec | None,
        access: str,
        modifiers: tuple[str, ...],
    ) -> list[tree.PouDeclaration]:
        what = f"{word} {self.texts[name]}"
        if result is None:
            self.report("S003", f"{what} needs a type: `{word} {self.texts[name]} : INT`.", self.span_of(name))
        found: list[tree.PouDeclaration] = []
        if word != "PROPERTY":
            sections = self.sections()
            kind = "get" if word == "PROPERTY_GET" else "set"
            found.append(self._declared(kind, name, result, sections, self._whole_body(), access, modifiers))
        while word == "PROPERTY" and (part := self._part()):
            self.take()
            own_access, _ = self._modifiers()
            sections = self.sections()
            body = self._whole_body() if not self._part() else ()
            shown = own_access if own_access != "PUBLIC" else access
            found.append(self._declared(part.lower(), name, result, sections, body, shown, modifiers))
            if not self.accept(f"END_{part}") and owner != "INTERFACE" and not self.is_("END_PROPERTY"):
                self._missing(f"END_{part}", f"{part} of {what}")
            self.accept(";")
        if not found and owner == "INTERFACE":
            found = [self._declared(kind, name, result, (), (), access, modifiers) for kind in ("get", "set")]
        if not found:
            self.report("S003", f"{what} has neither GET nor SET.", self.span_of(name))
        if not self.accept("END_PROPERTY") and owner != "INTERFACE":
            self._missing("END_PROPERTY", what)
        self.accept(";")
        return found

    def _part(self) -> str:
        """GET or SET, when that begins a part of a property."""
        word = self.word()
        return word if word in ("GET", "SET") and self.texts[self.at + 1] not in (":=", "(", ".", "[") else ""

    def _missing(self, end: str, of: str) -> None:
        self.report("S003", f"`{end}` expected to close {of}{self._found()}.", self.here())

    def _declared(
        self,
        kind: str,
        name: int,
        result: tree.TypeSpec | None,
        sections: tuple[tree.VariableSection, ...],
        body: Body,
        access: str,
        modifiers: tuple[str, ...],
    ) -> tree.PouDeclaration:
        return tree.PouDeclaration(
            kind, self.texts[name], result, sections, body, self.span_of(name), modifiers=modifiers, access=access
        )


def _joined(first: Body, second: Body) -> Body:
    """A body goes on behind a method that stands in it."""
    if not first or not second:
        return first or second
    if isinstance(first, tree.IlBody) and isinstance(second, tree.IlBody):
        return replace(first, instructions=first.instructions + second.instructions)
    if isinstance(first, tuple) and isinstance(second, tuple):
        return first + second
    return first


def with_member(pou: tree.PouDeclaration, members: list[tree.PouDeclaration]) -> tree.PouDeclaration:
    """A POU with members that stand behind its end, as some exports write them."""
    return replace(pou, methods=(*pou.methods, *members))
