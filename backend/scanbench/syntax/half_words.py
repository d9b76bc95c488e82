"""The first words of drawn bodies, half written or misspelt: what was meant, where Structured Text and Instruction List have nothing like it."""

from difflib import get_close_matches

from scanbench.syntax.cursor import NAME, Cursor
from scanbench.syntax.lexer import Lex
from scanbench.syntax.parse_statement import STOPS

NETWORKS = ("RUNG", "NETWORK")
CHARTS = ("INITIAL_STEP", "STEP", "TRANSITION")
SHORTEST = 3
"""Letters that a half word has; what is shorter may be an instruction."""


def network(c: Cursor) -> str:
    """RUNG or NETWORK, where such a word is alone on its line and a network goes on or nothing follows; else empty."""
    meant = _meant(c, NETWORKS)
    following = c.at + 1
    if not meant or (not first_of_line(c, following) and c.kinds[following] is not Lex.END):
        return ""
    at = following
    while c.texts[at] not in STOPS - {"RETURN"}:
        if c.kinds[at] is NAME and c.texts[at].upper() in ("END_RUNG", "END_NETWORK") and first_of_line(c, at):
            return meant
        at += 1
    return meant if at == following else ""


def chart(c: Cursor) -> str:
    """INITIAL_STEP, STEP or TRANSITION, where a step or a transition goes on or nothing follows; else empty."""
    meant = _meant(c, CHARTS)
    second, third = c.at + 1, c.at + 2
    if not meant or c.texts[second] in STOPS:
        return meant
    if meant == "TRANSITION":
        return meant if "FROM" in (c.word(1), c.word(2)) and c.kinds[second] is NAME else ""
    return meant if c.kinds[second] is NAME and c.texts[third] == ":" else ""


def report(c: Cursor, meant: str) -> None:
    c.report("S003", f"`{c.texts[c.at]}` begins no part of a body. Did you mean `{meant}`?", c.here())


def first_of_line(c: Cursor, at: int) -> bool:
    return at == 0 or c.source.text.find("\n", c.starts[at - 1], c.starts[at]) >= 0


def _meant(c: Cursor, words: tuple[str, ...]) -> str:
    word = c.word()
    if len(word) < SHORTEST or word in words or word.startswith("END_"):
        return ""
    found = [each for each in words if each.startswith(word)] or get_close_matches(word, words, 1, 0.8)
    return found[0] if found else ""
