"""DATA_BLOCK of SCL: a global variable of a structure, a block or a type, with its start values."""

from abc import abstractmethod

from scanbench.syntax.lexer import Lex
from scanbench.syntax.scl_words import Words, name_of

_SETTINGS = frozenset(("AUTHOR", "FAMILY", "KNOW_HOW_PROTECT", "NAME", "NON_RETAIN", "TITLE", "VERSION"))
_OF_DATA = frozenset(("VAR", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT"))
"""What the sections of a data block begin with."""


class DataBlocks(Words):
    """Writes data blocks."""

    @abstractmethod
    def _copy(self) -> None:
        """Writes one token as it is in the standard."""

    def _data_block(self, start: int) -> None:
        """A global variable: of a structure that is written there, or of a block or type; with its start values."""
        named = self._at
        self._at += 1
        self._skip_settings()
        sections = self._sections_of_data()
        parts = {self._word(each + 1 - self._at) == "RETAIN" for each in sections}
        kind = name_of(self._in.texts[named].strip('"')) + "_DB" if len(parts) > 1 else ""
        if kind:
            self._block_of_data(kind, start)
        self._put(Lex.KEYWORD, "VAR_GLOBAL", start)
        if parts == {True}:
            self._put(Lex.NAME, "RETAIN", self._in.starts[self._at])
        after, self._at = self._at, named
        self._copy()
        self._at = after
        self._put(Lex.OPERATOR, ":", self._in.starts[self._at])
        if kind:
            self._put(Lex.NAME, kind, start)
        elif sections:
            self._put(Lex.KEYWORD, "STRUCT", self._in.starts[self._at])
            while self._word() in _OF_DATA:
                self._at += 2 if self._word(1) in ("RETAIN", "NON_RETAIN") else 1
                self._variables_of_data()
            self._put(Lex.KEYWORD, "END_STRUCT", self._in.starts[self._at])
        elif self._word() == "STRUCT":
            self._structure()
        else:
            self._copy()
        while self._word() == ";":
            self._at += 1
        if self._word() == "BEGIN":
            self._at += 1
            self._start_values()
        end = self._in.starts[self._at]
        self._put(Lex.OPERATOR, ";", end)
        self._put(Lex.KEYWORD, "END_VAR", end)
        if self._word() == "END_DATA_BLOCK":
            self._at += 1

    def _sections_of_data(self) -> list[int]:
        """Where the sections of variables begin that are read next."""
        found, at = [], self._at
        while self._in.texts[at].upper() in _OF_DATA:
            found.append(at)
            while self._in.kinds[at] is not Lex.END and self._in.texts[at].upper() != "END_VAR":
                at += 1
            at += 0 if self._in.kinds[at] is Lex.END else 1
            while self._in.texts[at] == ";":
                at += 1
        return found

    def _variables_of_data(self) -> None:
        while not self._ended() and self._word() != "END_VAR":
            self._copy()
        self._at += 0 if self._ended() else 1
        while self._word() == ";":
            self._at += 1

    def _block_of_data(self, kind: str, start: int) -> None:
        """A block of the variables of a data block of which only some are kept: a structure would be kept as a whole."""
        self._put(Lex.KEYWORD, "FUNCTION_BLOCK", start)
        self._put(Lex.NAME, kind, start)
        while self._word() in _OF_DATA:
            at = self._in.starts[self._at]
            self._put(Lex.KEYWORD, "VAR", at)
            self._put(Lex.NAME, "PUBLIC", at)
            self._at += 1
            if self._word() in ("RETAIN", "NON_RETAIN"):
                self._put(Lex.NAME, self._word(), at)
                self._at += 1
            self._variables_of_data()
            self._put(Lex.KEYWORD, "END_VAR", self._in.starts[self._at - 1])
        self._put(Lex.KEYWORD, "END_FUNCTION_BLOCK", self._in.starts[self._at])

    def _structure(self) -> None:
        depth = 0
        while not self._ended():
            depth += {"STRUCT": 1, "END_STRUCT": -1}.get(self._word(), 0)
            self._copy()
            if depth == 0:
                return

    def _start_values(self) -> None:
        """`x := 5; y[2].z := 6;` and so on, as the start value of the whole."""
        first = True
        while not self._ended() and self._word() != "END_DATA_BLOCK":
            if self._word() == ";":
                self._at += 1
                continue
            at = self._in.starts[self._at]
            if first:
                self._put(Lex.OPERATOR, ":=", at)
            self._put(Lex.OPERATOR, "(" if first else ",", at)
            first = False
            self._starts = True
            while not self._ended() and self._word() not in (";", "END_DATA_BLOCK"):
                self._copy()
            self._starts = False
        if not first:
            self._put(Lex.OPERATOR, ")", self._in.starts[self._at])

    def _skip_settings(self) -> None:
        """What is said of a block before its declarations; a version, and what is of one word, may have more in their line."""
        while (word := self._word()) in _SETTINGS:
            if word in ("KNOW_HOW_PROTECT", "NON_RETAIN"):
                self._at += 1
            elif self._word(1) not in (":", "="):
                return
            elif word == "TITLE" or (word != "VERSION" and self._begins_line()):
                self._skip_line()
            else:
                self._at += 3
                while self._in.kinds[self._at] in (Lex.INTEGER, Lex.REAL) or self._word() == ".":
                    self._at += 1
