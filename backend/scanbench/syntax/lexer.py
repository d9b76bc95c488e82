"""Text -> tokens. Comments and pragmas are dropped; what cannot be read is reported and skipped.

Built for throughput: one regular expression cuts the whole text into pieces that leave no gap, so positions are sums of
lengths; each *distinct* piece is looked at once in Python, everything else runs over lists in C.
"""

import re
from dataclasses import dataclass
from enum import IntEnum
from itertools import accumulate, compress

from scanbench.problems import Problem
from scanbench.syntax.source import Source


class Lex(IntEnum):
    BLANK = 0
    """Spaces, comments and pragmas: never among the tokens."""
    NAME = 1
    KEYWORD = 2
    OPERATOR = 3
    INTEGER = 4
    REAL = 5
    TIME = 6
    """A duration, date or time of day."""
    STRING = 7
    TYPED = 8
    """`Type#value`."""
    ADDRESS = 9
    END = 10
    UNREADABLE = 11
    OPEN = 12
    """The beginning of a comment or pragma that nests or never ends."""


KEYWORDS = frozenset(
    """
    PROGRAM END_PROGRAM FUNCTION END_FUNCTION FUNCTION_BLOCK END_FUNCTION_BLOCK TYPE END_TYPE
    STRUCT END_STRUCT END_UNION ARRAY OF AT
    VAR VAR_INPUT VAR_OUTPUT VAR_IN_OUT VAR_TEMP VAR_GLOBAL VAR_EXTERNAL VAR_ACCESS VAR_CONFIG VAR_STAT VAR_INST
    VAR_GENERIC END_VAR
    IF THEN ELSIF ELSE END_IF CASE END_CASE FOR TO DO END_FOR WHILE END_WHILE REPEAT UNTIL END_REPEAT
    __TRY __CATCH __FINALLY __ENDTRY EXIT RETURN AND OR XOR NOT MOD AND_THEN OR_ELSE TRUE FALSE
    CONFIGURATION END_CONFIGURATION END_RESOURCE
    END_CLASS END_INTERFACE END_METHOD END_PROPERTY END_GET END_SET END_ACTION END_NAMESPACE
    """.split()
)
"""Words that are never names. Others (METHOD, CLASS, BY, LD, ...) are keywords only where the grammar expects them, because
older programs use them as names."""

CONTEXTUAL = frozenset(
    """
    ABSTRACT ACTION ACTIONS AUTHOR BEGIN BY CLASS CONSTANT CONTINUE DATA_BLOCK END_ACTIONS END_NETWORK END_REGION END_RUNG END_STEP END_TRANSITION EN ENO EXTENDS FAMILY
    FINAL FROM F_EDGE GET GOTO IMPLEMENTS INITIAL_STEP INTERFACE INTERNAL INTERVAL METHOD NAMESPACE NETWORK NON_RETAIN ON ORGANIZATION_BLOCK
    OVERLAP OVERRIDE PERSISTENT POINTER PRIORITY PRIVATE PROPERTY PROPERTY_GET PROPERTY_SET PROTECTED PUBLIC READ_ONLY READ_WRITE
    REF REFERENCE REF_TO REGION RESOURCE RETAIN RUNG R_EDGE SET SINGLE STEP STRING SUPER TASK THIS TITLE TRANSITION TRY UNION USING
    VERSION VOID WITH WSTRING
    """.split()
)
"""Words with a meaning in some places, besides the operators of IL; elsewhere they are names."""

TIME_TYPES = {
    "T": "TIME", "TIME": "TIME", "LT": "LTIME", "LTIME": "LTIME", "D": "DATE", "DATE": "DATE", "LD": "LDATE",
    "LDATE": "LDATE", "TOD": "TIME_OF_DAY", "TIME_OF_DAY": "TIME_OF_DAY", "LTOD": "LTIME_OF_DAY",
    "LTIME_OF_DAY": "LTIME_OF_DAY", "DT": "DATE_AND_TIME", "DATE_AND_TIME": "DATE_AND_TIME",
    "LDT": "LDATE_AND_TIME", "LDATE_AND_TIME": "LDATE_AND_TIME",
}  # fmt: skip
"""The prefix before the `#` of a duration or date, and its type."""

PIECE = re.compile(
    r"""
    [^\W\d]\w*+(?!\#)
  | [\s\ufeff]+
  | :=|[;:,)\[\]+]|\((?!\*)
  | \d[\d_]*(?:\#\w+|\.\d[\d_]*(?:[Ee][+-]?\d+)?|[Ee][+-]?\d+)?
  | (?i:L?T|L?TIME)\#[+-]?\d\w*(?:\.\d\w*)*
  | (?i:L?D|L?DATE|L?TOD|L?TIME_OF_DAY|L?DT|L?DATE_AND_TIME)\#\d[\d_]*(?:[-:]\d[\d_]*)*(?:\.\d[\d_]*)?
  | [^\W\d]\w*(?:\#(?:[+-]?\d[\d_]*(?:\#\w+|(?:\.\d[\d_]*)?(?:[Ee][+-]?\d+)?)
                     |[^\W\d]\w*|'(?:\$.|[^$'\n])*'|"(?:\$.|[^$"\n])*"))?
  | =>|<=|>=|<>|\*\*|\.\.|\?=|\?\?\?|[-=<>&.^\#]
  | //[^\n]*
  | \(\*[^*(]*+(?:(?:\*(?!\))|\((?!\*))[^*(]*+)*+\*\)
  | /\*[^*/]*+(?:(?:\*(?!/)|/(?!\*))[^*/]*+)*+\*/
  | \{[^{}]*\}|@(?i:EXTERNAL)\b
  | %[A-Za-z]+\*|%[A-Za-z]*\d[\d.]*(?<!\.)|%[A-Za-z]+
  | '(?:\$.|[^$'\n])*' | "(?:\$.|[^$"\n])*"
  | \(\* | /\* | .
    """,
    re.VERBOSE | re.DOTALL,
)
"""All there is, the most frequent first, so that the pieces leave no gap."""
LONG_PIECE = re.compile(PIECE.pattern.replace(r"[^$'\n]", "[^$']").replace(r'[^$"\n]', '[^$"]'), PIECE.flags)
"""The same with strings that go on in the next line."""
QUOTES = frozenset("'\"")
"""As a piece: the beginning of a string that never ends."""
OPERATORS = frozenset(":= => <= >= <> ** .. ?= - + = < > & ( ) [ ] , ; : . ^ # * / | ~".split())
DRAWN = {"|": "write OR", "~": "write NOT"}
"""Marks of ladder diagrams, and what people mean who write them elsewhere."""


@dataclass(slots=True)
class Tokens:
    """The tokens of a text as columns, closed by a few that say END so that looking ahead needs no care."""

    kinds: list[Lex]
    texts: list[str]
    """As written; keywords in upper case."""
    starts: list[int]
    pragmas: list[tuple[int, str]]
    """Position and text."""


MAX_UNREADABLE = 100
"""Characters without a meaning that are reported: a text with more is no program."""
AHEAD = 4
"""How many END tokens close the text: as far as the parser looks without counting."""


def tokenize(
    source: Source, start: int = 0, end: int | None = None, long_texts: bool = False
) -> tuple[Tokens, list[Problem]]:
    """All tokens of a text, or of a part of it, and what could not be read. `long_texts`: a string may go on in the next line, where
    without that one would never end."""
    problems: list[Problem] = []
    text, end = source.text, len(source.text) if end is None else end
    pieces = PIECE.findall(text, start, end)
    if long_texts and not QUOTES.isdisjoint(pieces) and QUOTES.isdisjoint(long := LONG_PIECE.findall(text, start, end)):
        pieces = long
    known = {piece: _kind(piece) for piece in set(pieces)}
    found = set(known.values())
    if Lex.OPEN in found:
        text = _without_nested(source, start, end, problems)
        pieces = PIECE.findall(text, start, end)
        known = {piece: _kind(piece) for piece in set(pieces)}
    if Lex.UNREADABLE in found and ("'" in known or '"' in known):
        text = _with_closed_strings(source, text, pieces, start, problems)
        pieces = PIECE.findall(text, start, end)
        known = {piece: _kind(piece) for piece in set(pieces)}
        found = set(known.values())
    all_starts = list(accumulate(map(len, pieces), initial=start))
    if Lex.UNREADABLE in found:
        for piece, at in zip(pieces, all_starts, strict=False):
            if known[piece] is Lex.UNREADABLE:
                problems.append(_unreadable(source, at, piece))
                if len(problems) >= MAX_UNREADABLE:
                    break
        known = {piece: _readable(piece, kind) for piece, kind in known.items()}
    pragmas = []
    if "{" in text or "@" in text:
        pragmas = [(at, piece) for piece, at in zip(pieces, all_starts, strict=False) if piece[0] in "{@"]
    every = [known[piece] for piece in pieces]
    kinds = list(compress(every, every))
    shown = {piece: piece.upper() if kind is Lex.KEYWORD else piece for piece, kind in known.items() if kind}
    texts = [shown[piece] for piece in compress(pieces, every)]
    starts = list(compress(all_starts, every))
    kinds += [Lex.END] * AHEAD
    texts += [""] * AHEAD
    starts += [end] * AHEAD
    return Tokens(kinds, texts, starts, pragmas), problems


def _kind(piece: str) -> Lex:
    if piece == NOTHING:
        return Lex.UNREADABLE
    first = piece[0]
    if first.isspace() or first == "\ufeff":
        return Lex.BLANK
    if first == "_" or first.isalpha():
        if "#" in piece:
            return Lex.TIME if _is_time(piece) else Lex.TYPED
        return Lex.KEYWORD if piece.upper() in KEYWORDS else Lex.NAME
    if piece in OPERATORS:
        return Lex.OPERATOR
    if "0" <= first <= "9":
        return Lex.INTEGER if "#" in piece or piece.replace("_", "").isdigit() else Lex.REAL
    if len(piece) > 1:
        if piece in ("(*", "/*"):
            return Lex.OPEN
        return {"%": Lex.ADDRESS, "'": Lex.STRING, '"': Lex.STRING}.get(first, Lex.BLANK)
    return Lex.OPEN if first == "{" else Lex.UNREADABLE


def _readable(piece: str, kind: Lex) -> Lex:
    """The kind of a token; what has no meaning is left out. What is not named yet is a name, so that only it is wrong and not what is around it."""
    if kind is not Lex.UNREADABLE:
        return kind
    return Lex.NAME if piece == NOTHING else Lex.BLANK


def _is_time(piece: str) -> bool:
    prefix, value = piece.split("#", 1)
    return prefix.upper() in TIME_TYPES and value[0] in "+-0123456789"


def _unreadable(source: Source, at: int, char: str) -> Problem:
    span = source.span(at, at + 1)
    if char in "'\"":
        return Problem("S002", "This string never ends; close it on the same line.", span)
    if char == NOTHING:
        message = "`???` stands for what is not connected or named yet; write a variable, a wire or a value."
        return Problem("S001", message, source.span(at, at + len(NOTHING)))
    found = next((each for each in FOREIGN if source.text.startswith(each, at)), "")
    if found:
        return Problem("S001", f"`{found}` is of another language; {FOREIGN[found]}.", source.span(at, at + len(found)))
    return Problem("S001", f"`{char}` has no meaning here; remove it.", span)


def _with_closed_strings(source: Source, text: str, pieces: list[str], start: int, problems: list[Problem]) -> str:
    """The text with an empty string for one that never ends in its line, which is reported; a `;` at the end stays."""
    at, closed = start, -1
    for piece in pieces:
        if piece in ("'", '"') and at > closed and len(problems) < MAX_UNREADABLE:
            problems.append(_unreadable(source, at, piece))
            closed = text.find("\n", at)
            closed = len(text) if closed < 0 else closed
            rest = text[at:closed]
            last = ";" if rest.rstrip().endswith(";") else ""
            made = f"{2 * piece}{last}" if len(rest) > 2 else ""
            text = text[:at] + made.ljust(len(rest)) + text[closed:]
        at += len(piece)
    return text


NOTHING = "???"
"""What an editor of drawings, like those of other tools, writes at a pin that is not connected."""
DATA = "DB"
"""What the size of an address within a data block (`d.%DBW4`) begins with; its index is the number of its first bit."""
GLOBAL_MARK = '"'
"""What a name begins with that is the one of something global, whatever the POU declares: SCL tells them apart by quotes."""
FOREIGN = {
    "!=": "write `<>`",
    "!": "write NOT",
    "?": "write IF, or SEL(condition, value if FALSE, value if TRUE)",
    "%": "write MOD",
}
"""Operators of other languages that no token begins with, the longer ones first."""


NESTING = re.compile(r"""//[^\n]*|'(?:\$.|[^$'\n])*'|"(?:\$.|[^$"\n])*"|\(\*|/\*|\{""", re.DOTALL)
COMMENT_MARKS = {"(": re.compile(r"\(\*|\*\)"), "/": re.compile(r"/\*|\*/"), "{": re.compile(r"[{}]")}
NO_BLANK = re.compile(r"[^\n]")


def _without_nested(source: Source, start: int, end: int, problems: list[Problem]) -> str:
    """The text with spaces for comments, which nest (edition 3); one that never ends is reported."""
    text = source.text
    parts, at = [text[:start]], start
    while (found := NESTING.search(text, at, end)) is not None:
        first = found.start()
        if found.group()[0] not in "({" and found.group() != "/*":
            parts.append(text[at : found.end()])
            at = found.end()
            continue
        last = nested_end(text, first, end)
        simple = text[first] == "{" and text.find("{", first + 1, last) < 0 <= last
        if last < 0:
            what = "pragma" if text[first] == "{" else "comment"
            problems.append(Problem("S002", f"This {what} never ends; close it.", source.span(first, first + 1)))
            last = end
        parts += [text[at:first], text[first:last] if simple else NO_BLANK.sub(" ", text[first:last])]
        at = last
    return "".join([*parts, text[at:]])


def nested_end(text: str, at: int, end: int) -> int:
    """Position after the comment or pragma that begins with a bracket at `at`, or -1."""
    marks, depth = COMMENT_MARKS[text[at]], 0
    for mark in marks.finditer(text, at, end):
        depth += 1 if mark.group() in ("(*", "/*", "{") else -1
        if depth == 0:
            return mark.end()
    return -1
