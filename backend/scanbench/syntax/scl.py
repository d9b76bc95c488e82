"""Siemens SCL as text (.scl, .udt, .db): its tokens are made into those of the standard, with places in the text as it is.

Names lose their quotes and `#`; a DATA_BLOCK becomes a global variable, an ORGANIZATION_BLOCK a PROGRAM; TITLE, AUTHOR and the
like, REGION, BEGIN and VOID say nothing to the compiler. From the Programming Guide for S7-1200/S7-1500 and the description of
external sources in the TIA Portal's help.
"""

import re
from dataclasses import replace

from scanbench.problems import Problem, Severity
from scanbench.syntax import tree
from scanbench.syntax.cursor import Cursor
from scanbench.syntax.lexer import AHEAD, GLOBAL_MARK, Lex, Tokens, tokenize
from scanbench.syntax.parse_st import whole
from scanbench.syntax.scl_data import DataBlocks
from scanbench.syntax.scl_overlays import with_overlays
from scanbench.syntax.scl_words import SYSTEM_TAGS, name_of, typed
from scanbench.syntax.source import Source

ENDINGS = (".scl", ".udt", ".db")
STARTUP = "STARTUP"
"""The modifier of a program that comes before the others where no task says anything else."""
_OPENS = frozenset(("FUNCTION", "FUNCTION_BLOCK", "ORGANIZATION_BLOCK", "DATA_BLOCK", "TYPE"))
_BLOCKS = {"ORGANIZATION_BLOCK": "PROGRAM", "END_ORGANIZATION_BLOCK": "END_PROGRAM"}
_EVENT_BLOCKS = {"ORGANIZATION_BLOCK": "FUNCTION_BLOCK", "END_ORGANIZATION_BLOCK": "END_FUNCTION_BLOCK"}
"""What the organization block of an event is, which nothing starts here."""
_SECTIONS = {
    ("VAR_IN_OUT", "VARIANT"): "VAR_INPUT",
    ("VAR_INPUT", "TIMER"): "VAR_IN_OUT",
    ("VAR_INPUT", "COUNTER"): "VAR_IN_OUT",
}
"""The section that a variable of a type is declared in, instead of the one that it is written in: a Variant leads to its variable
itself, and a timer is the one that is passed."""
_JOINED = frozenset("+-*/")
"""Operators of combined assignments, `+=` and the like."""
_OF_SECTIONS = frozenset(("DB_SPECIFIC", "NON_RETAIN"))
"""Words after VAR that say nothing here."""
_RESTART = ("Startup", "COMPLETE RESTART", "OB100", "OB 100")
"""What the name or TITLE of the organization block is that runs once, at a start, before the first cycle."""
_CYCLIC = re.compile(r"MAIN|\bOB_?1\b", re.IGNORECASE)
"""Names of the organization block that runs in every cycle; its TITLE says the same."""
_CYCLE = "(Cycle)"
_DONE = "Done_since_start"
"""The variable that tells that the organization block of a start has run."""


def is_scl(name: str) -> bool:
    """Whether a file of this name is SCL."""
    return name.lower().endswith(ENDINGS)


def parse_scl(source: Source) -> tuple[tree.File, list[Problem]]:
    """The tree, and what could not be read."""
    tokens, problems = tokenize(source)
    writer = _Writer(source, tokens)
    cursor = Cursor(source, writer.write())
    cursor.problems += [*problems, *writer.problems]
    cursor.parts = True
    file, told = whole(cursor)
    for at, pou in enumerate(file.pous):
        if pou.name in writer.restarts:
            file.pous[at] = replace(pou, modifiers=(*pou.modifiers, STARTUP))
        file.pous[at] = with_overlays(file.pous[at])
    return file, told


class _Writer(DataBlocks):
    """Reads the tokens from the first to the last, and writes those of the standard."""

    def __init__(self, source: Source, tokens: Tokens) -> None:
        super().__init__(source, tokens)
        self._globals: list[tuple[str, int]] = []
        """Names in quotes in its statements, and which token that was written each is."""
        self._block_name = ""
        """Its name, in upper case: a FUNCTION has its result under it."""
        self._combining = False
        """In the value of `x += value`."""
        self._section = ""
        """The word that the declarations begin with, VAR_IN_OUT for one."""
        self._constant = False
        """In VAR CONSTANT, where a constant need not have a type."""
        self._back = ""
        """The section to go on with after a declaration that is put into another one."""
        self._event = False
        """In the organization block of an event."""
        self._restart = False
        """In the organization block of a start."""
        self.restarts: set[str] = set()
        """The names of such blocks."""

    def write(self) -> Tokens:
        """All of them, closed."""
        while not self._ended():
            self._one()
        self._tell_apart()
        for _ in range(AHEAD):
            self._put(Lex.END, "", self._in.starts[self._at])
        return self._out

    def _one(self) -> None:
        word = self._word()
        if word in _OPENS:
            self._tell_apart()
            self._block(word)
        elif word in _BLOCKS:
            self._end_of_organization(word)
        elif self._old_declarations(word):
            pass
        elif word == "(" and self._word(1) == ")" and self._is_comment():
            self._at += 2
        elif word in ("REGION", "END_REGION") and self._begins_line():
            self._skip_line()
        elif word == "BEGIN" and self._word(1) not in (":=", ".", "[", "("):
            if self._restart:
                self._once(self._in.starts[self._at])
            self._at += 1
        elif word == "GOTO":
            self._put(Lex.NAME, "JMP", self._in.starts[self._at])
            self._at += 1
        elif word in _OF_SECTIONS and self._word(-1).startswith("VAR"):
            self._at += 1
        elif word in _JOINED and self._word(1) == "=" and self._touches():
            self._combined(word)
        elif word == ";":
            self._close()
            self._copy()
            if self._back:
                self._turn(self._back)
                self._back = ""
        else:
            self._copy()

    def _old_declarations(self, word: str) -> bool:
        """LABEL ... END_LABEL and constants without a type."""
        if word == "LABEL" and self._word(2) in (";", ",") and self._begins_line():
            while not self._ended() and self._word() != "END_LABEL":
                self._at += 1
            self._at += 0 if self._ended() else 1
        elif word == "CONST" and self._word(2) == ":=" and self._begins_line():
            self._untyped_constants()
        elif self._constant and self._word(1) == ":=" and self._word(-1) in ("CONSTANT", ";"):
            self._untyped_constant()
        else:
            return False
        return True

    def _end_of_organization(self, word: str) -> None:
        if self._restart:
            self._put(Lex.KEYWORD, "END_IF", self._in.starts[self._at])
            self._put(Lex.OPERATOR, ";", self._in.starts[self._at])
            self._restart = False
        self._put(Lex.KEYWORD, (_EVENT_BLOCKS if self._event else _BLOCKS)[word], self._in.starts[self._at])
        self._event = False
        self._at += 1

    def _touches(self) -> bool:
        return self._in.starts[self._at] + 1 == self._in.starts[self._at + 1]

    def _combined(self, operator: str) -> None:
        """`a += b` is `a := a + (b)`."""
        at, first = self._in.starts[self._at], self._target()
        if self._combining:
            self._refuse("Several combined assignments in one are not read. Write one assignment for each.", at)
            while not self._ended() and self._word() != ";":
                self._at += 1
            return
        self._at += 2
        tokens = zip(self._out.kinds[first:], self._out.texts[first:], self._out.starts[first:], strict=True)
        target = list(tokens)
        self._put(Lex.OPERATOR, ":=", at)
        further = len(self._out.kinds) - first
        self._globals += [(name, index + further) for name, index in self._globals if index >= first]
        for each in target:
            self._put(*each)
        self._put(Lex.OPERATOR, operator, at)
        self._put(Lex.OPERATOR, "(", at)
        self._combining = True

    def _target(self) -> int:
        """Where in what was written the variable begins that ends there: names with points, indices and `^`."""
        texts = self._out.texts
        at, depth = len(texts) - 1, 0
        while at > 0:
            depth += {"]": 1, "[": -1}.get(texts[at], 0)
            if depth == 0 and texts[at] not in ("[", "^", "."):
                if texts[at - 1] != ".":
                    break
                at -= 1
            at -= 1
        return max(at, 0)

    def _close(self) -> None:
        """The parenthesis after what is assigned by a combined assignment."""
        if self._combining:
            self._put(Lex.OPERATOR, ")", self._in.starts[self._at])
            self._combining = False

    def _block(self, word: str) -> None:
        """The head of a block or type, up to its declarations."""
        start = self._in.starts[self._at]
        self._at += 1
        if word == "DATA_BLOCK":
            self._data_block(start)
            return
        name, at = self._in.texts[self._at].strip('"'), self._in.starts[self._at]
        opening = len(self._out.kinds)
        self._put(Lex.KEYWORD, _BLOCKS.get(word, word), start)
        self._copy()
        self._globals.clear()
        self._block_name = name_of(name).upper()
        self._constants = {}
        self._restart = word == "ORGANIZATION_BLOCK" and self._is_titled(name, _RESTART)
        if self._restart:
            self.restarts.add(self._out.texts[-1])
        elif word == "ORGANIZATION_BLOCK" and not _CYCLIC.search(name) and not self._is_titled("", (_CYCLE,)):
            self._out.texts[opening], self._event = _EVENT_BLOCKS[word], True
            message = (
                f"`{name}` is started by an event (interrupt, time, error), and nothing here starts it. It is read as a FUNCTION_BLOCK: "
                "call an instance of it from Main, where its event is to be. Only the organization blocks of the cycle run by themselves, "
                "Main or one with the TITLE `... (Cycle)`, and of a start, Startup."
            )
            self.problems.append(Problem("W007", message, self._source.span(at, at + 1), Severity.WARNING))
        if word == "FUNCTION" and self._word() == ":" and self._word(1) == "VOID":
            self._at += 2
        elif word == "FUNCTION" and self._word() == ":":
            self._copy()
            self._copy()
        self._skip_settings()
        if word == "TYPE" and self._word() == "STRUCT":
            self._put(Lex.OPERATOR, ":", self._in.starts[self._at])

    # ---- one token ----------------------------------------------------------------------------------------------

    def _copy(self) -> None:
        if self._word(1) == ":" and (other := _SECTIONS.get((self._section, self._word(2)))):
            self._back = self._section
            self._turn(other)
        if self._worded():
            return
        kind, text, at = self._in.kinds[self._at], self._in.texts[self._at], self._in.starts[self._at]
        self._at += 1
        if text == "#":
            self._locals.add(name_of(self._in.texts[self._at].strip('"')).upper())
            if self._in.kinds[self._at] is Lex.KEYWORD:
                self._put(Lex.NAME, self._in.texts[self._at], self._in.starts[self._at])
                self._at += 1
            return
        if kind is Lex.KEYWORD and text.startswith(("VAR", "END_VAR")):
            self._declares = text != "END_VAR"
            self._constant = self._word() == "CONSTANT"
            self._section = text
        elif self._declares and self._word() == ":":
            self._locals.add(name_of(text.strip('"')).upper())
        if kind is Lex.STRING and text.startswith('"'):
            name = name_of(text[1:-1])
            tag = SYSTEM_TAGS.get(name.upper())
            if (
                tag is not None
                and not self._declares
                and self._in.texts[self._at - 2] != "#"
                and self._word() not in (":=", ".")
            ):
                self._several(tag, at)
                return
            argument = self._depth and self._word() in (":=", "=>")
            if not self._declares and not argument and self._in.texts[self._at - 2] != "#":
                self._globals.append((name, len(self._out.kinds)))
            self._put(Lex.NAME, name, at + 1)
        elif kind is Lex.TYPED:
            self._put(kind, typed(text), at)
        else:
            self._depth += {"(": 1, ")": -1}.get(text, 0)
            self._put(kind, text, at)

    def _turn(self, section: str) -> None:
        """Goes on with the declarations in another section."""
        self._put(Lex.KEYWORD, "END_VAR", self._in.starts[self._at])
        self._put(Lex.KEYWORD, section, self._in.starts[self._at])

    def _tell_apart(self) -> None:
        """Marks what is global and has the name of something in the block: the quotes and `#` alone tell them apart."""
        for name, index in self._globals:
            if name.upper() in self._locals - {self._block_name}:
                self._out.texts[index] = GLOBAL_MARK + name
                self._out.starts[index] -= 1
        self._globals, self._locals, self._declares = [], set(), False

    def _is_titled(self, name: str, words: tuple[str, ...]) -> bool:
        """Whether the name, or the TITLE in the head of this organization block, has one of these words."""
        end = self._in.starts[min(self._at + 8, len(self._in.starts) - 1)]
        head = self._source.text[self._in.starts[self._at - 1] : end]
        title = re.search(r"\bTITLE\s*=\s*([^\n]*)", head, re.IGNORECASE)
        found = f"{name} {title.group(1) if title else ''}".upper()
        return any(word.upper() in found for word in words)

    def _once(self, at: int) -> None:
        """At the beginning of the statements of a start: what lets them run once."""
        tokens = f"VAR {_DONE} : BOOL ; END_VAR IF NOT {_DONE} THEN {_DONE} := TRUE ;"
        for text in tokens.split():
            kind = Lex.NAME if text in (_DONE, "BOOL") else Lex.OPERATOR if text in (":", ";", ":=") else Lex.KEYWORD
            self._put(kind, text, at)
