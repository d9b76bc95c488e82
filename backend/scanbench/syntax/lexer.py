"""Text -> tokens. Comments and pragmas are dropped; what cannot be read is reported and skipped."""

import re
from enum import StrEnum
from typing import NamedTuple

from scanbench.problems import Problem, Span
from scanbench.syntax.source import Source


class Lex(StrEnum):
    NAME = "name"
    KEYWORD = "keyword"
    INTEGER = "number"
    REAL = "real number"
    TIME = "duration"
    STRING = "string"
    ADDRESS = "address"
    OPERATOR = "operator"
    END = "end of file"


class Token(NamedTuple):
    kind: Lex
    text: str
    """As written; keywords in upper case."""
    start: int
    end: int


KEYWORDS = frozenset(
    """
    PROGRAM END_PROGRAM FUNCTION END_FUNCTION FUNCTION_BLOCK END_FUNCTION_BLOCK TYPE END_TYPE STRUCT END_STRUCT
    VAR VAR_INPUT VAR_OUTPUT VAR_IN_OUT VAR_TEMP VAR_GLOBAL VAR_EXTERNAL VAR_ACCESS VAR_CONFIG END_VAR
    CONSTANT RETAIN NON_RETAIN PERSISTENT AT ARRAY OF
    IF THEN ELSIF ELSE END_IF CASE END_CASE FOR TO BY DO END_FOR WHILE END_WHILE REPEAT UNTIL END_REPEAT
    EXIT CONTINUE RETURN AND OR XOR NOT MOD TRUE FALSE
    CONFIGURATION END_CONFIGURATION RESOURCE ON END_RESOURCE TASK WITH
    CLASS END_CLASS INTERFACE END_INTERFACE METHOD END_METHOD NAMESPACE END_NAMESPACE USING UNION END_UNION
    REF_TO POINTER
    """.split()
)

TOKEN = re.compile(
    r"""
    (?P<blank>\s+|//[^\n]*)
  | (?P<comment>\(\*|/\*)
  | (?P<pragma>\{)
  | (?P<time>(?:LTIME|TIME|LT|T)\#[+-]?[0-9a-z_.]+)
  | (?P<based>(?:[a-z_]\w*\#)?(?:2|8|16)\#[0-9a-f_]+)
  | (?P<typed>[^\W\d]\w*\#)
  | (?P<real>\d[\d_]*(?:\.\d[\d_]*(?:e[+-]?\d+)?|e[+-]?\d+))
  | (?P<integer>\d[\d_]*)
  | (?P<name>[^\W\d]\w*)
  | (?P<address>%[a-z]+[*]?[\d.]*|%\d[\d.]*)
  | (?P<string>'(?:\$.|[^$'\n])*'|"(?:\$.|[^$"\n])*")
  | (?P<operator>:=|=>|<=|>=|<>|\*\*|\.\.|\?=|[-+*/=<>&()\[\],;:.^\#])
    """,
    re.VERBOSE | re.IGNORECASE | re.DOTALL,
)


def tokenize(source: Source) -> tuple[list[Token], list[Problem]]:
    """All tokens, closed by one END, and what could not be read."""
    text, tokens, problems = source.text, [], []
    at, end = 0, len(source.text)
    match = TOKEN.match
    while at < end:
        found = match(text, at)
        if found is None:
            problems.append(_unreadable(source, at))
            at += 1
            continue
        group, start, at = found.lastgroup, at, found.end()
        if group == "blank":
            continue
        if group == "comment" or group == "pragma":
            at = _skip_nested(text, start)
            if at < 0:
                what = "comment" if group == "comment" else "pragma"
                problems.append(Problem("S002", f"This {what} never ends; close it.", source.span(start, start + 1)))
                at = end
            continue
        tokens.append(_token(str(group), text[start:at], start, at))
    tokens.append(Token(Lex.END, "", end, end))
    return tokens, problems


def _token(group: str, text: str, start: int, end: int) -> Token:
    if group == "name":
        upper = text.upper()
        if upper in KEYWORDS:
            return Token(Lex.KEYWORD, upper, start, end)
        return Token(Lex.NAME, text, start, end)
    kinds = {
        "time": Lex.TIME,
        "based": Lex.INTEGER,
        "typed": Lex.OPERATOR,
        "real": Lex.REAL,
        "integer": Lex.INTEGER,
        "address": Lex.ADDRESS,
        "string": Lex.STRING,
    }
    return Token(kinds.get(group, Lex.OPERATOR), text, start, end)


def _unreadable(source: Source, at: int) -> Problem:
    span = source.span(at, at + 1)
    if source.text[at] in "'\"":
        return Problem("S002", "This string never ends; close it on the same line.", span)
    return Problem("S001", f"`{source.text[at]}` has no meaning here; remove it.", span)


COMMENT_MARKS = {"(": re.compile(r"\(\*|\*\)"), "/": re.compile(r"/\*|\*/"), "{": re.compile(r"[{}]")}


def _skip_nested(text: str, at: int) -> int:
    """Position behind the comment or pragma that begins at `at`, or -1; comments nest (edition 3)."""
    marks, depth = COMMENT_MARKS[text[at]], 0
    for mark in marks.finditer(text, at):
        depth += 1 if mark.group() in ("(*", "/*", "{") else -1
        if depth == 0:
            return mark.end()
    return -1


def span_of(source: Source, token: Token) -> Span:
    return source.span(token.start, max(token.end, token.start + 1))
