"""The blocks of a text, by its tokens alone: so they are there while the text is being typed, too."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from scanbench.syntax.lexer import Lex, Tokens

CLOSED = {
    "PROGRAM": "END_PROGRAM", "FUNCTION": "END_FUNCTION", "FUNCTION_BLOCK": "END_FUNCTION_BLOCK",
    "CONFIGURATION": "END_CONFIGURATION", "TYPE": "END_TYPE", "STRUCT": "END_STRUCT",
    "IF": "END_IF", "CASE": "END_CASE", "FOR": "END_FOR", "WHILE": "END_WHILE", "REPEAT": "END_REPEAT", "__TRY": "__ENDTRY",
    **{f"VAR{section}": "END_VAR" for section in (
        "", "_INPUT", "_OUTPUT", "_IN_OUT", "_TEMP", "_GLOBAL", "_EXTERNAL", "_ACCESS", "_CONFIG", "_STAT", "_INST", "_GENERIC",
    )},
}  # fmt: skip
"""Keywords that begin a block, and what ends it."""
NAMED = {
    "CLASS": "END_CLASS", "INTERFACE": "END_INTERFACE", "METHOD": "END_METHOD", "PROPERTY": "END_PROPERTY",
    "ACTION": "END_ACTION", "NAMESPACE": "END_NAMESPACE", "RESOURCE": "END_RESOURCE",
}  # fmt: skip
"""Words that begin a block where a name follows; elsewhere they are names themselves."""
BARE = {"UNION": "END_UNION", "GET": "END_GET", "SET": "END_SET"}
"""Words that begin a block where nothing that continues an expression follows."""
STATEMENTS = frozenset(("IF", "CASE", "FOR", "WHILE", "REPEAT", "__TRY"))
POUS = frozenset(("PROGRAM", "FUNCTION", "FUNCTION_BLOCK", "CLASS", "INTERFACE", "METHOD", "PROPERTY", "ACTION"))
_BETWEEN = frozenset("PUBLIC PRIVATE PROTECTED INTERNAL ABSTRACT FINAL OVERRIDE".split())
ENDS = frozenset((*CLOSED.values(), *NAMED.values(), *BARE.values()))
"""What ends any of them."""


@dataclass(slots=True)
class Block:
    """From a keyword to its end, or as far as the block around it goes where the end is missing. Positions in the text."""

    keyword: str
    start: int
    end: int = 0
    name_at: int = -1
    """Of a POU, type or namespace."""
    closed: bool = False
    inner: list["Block"] = field(default_factory=list)

    def walk(self) -> Iterator["Block"]:
        """It, and all inside of it."""
        yield self
        for each in self.inner:
            yield from each.walk()


def blocks(tokens: Tokens, length: int) -> list[Block]:
    """The outermost blocks of a text of this length, in order."""
    top = Block("", 0, length)
    open_ = [top]
    for at, (kind, text) in enumerate(zip(tokens.kinds, tokens.texts, strict=True)):
        word = text if kind is Lex.KEYWORD else text.upper() if kind is Lex.NAME else ""
        if word in ENDS and kind is Lex.KEYWORD:
            _close(open_, word, tokens.starts[at], tokens.starts[at] + len(text))
        elif (name := _opens(tokens, at, word, open_[-1].keyword)) is not None:
            made = Block(word, tokens.starts[at], name_at=name)
            open_[-1].inner.append(made)
            open_.append(made)
    for each in open_:
        each.end = length
    return top.inner


def _close(open_: list[Block], word: str, start: int, end: int) -> None:
    """Ends the nearest block that this closes; those inside of it were never closed, and end where it begins."""
    ends = {**CLOSED, **NAMED, **BARE}
    depth = next((at for at in range(len(open_) - 1, 0, -1) if ends[open_[at].keyword] == word), None)
    if depth is None:
        return
    for each in open_[depth + 1 :]:
        each.end = start
    open_[depth].end, open_[depth].closed = end, True
    del open_[depth:]


def _opens(tokens: Tokens, at: int, word: str, around: str) -> int | None:
    """Where the name of the block is that begins here, -1 for one without; None when none begins."""
    if word in CLOSED:
        if word == "PROGRAM" and around in ("CONFIGURATION", "RESOURCE"):
            return None  # an instance
        named = word in POUS or word in ("TYPE", "CONFIGURATION")
        return tokens.starts[at + 1] if named and tokens.kinds[at + 1] is Lex.NAME else -1
    if word in NAMED:
        name = at + 1
        while tokens.texts[name].upper() in _BETWEEN and tokens.kinds[name + 1] is Lex.NAME:
            name += 1
        return tokens.starts[name] if tokens.kinds[name] is Lex.NAME else None
    if word == "UNION":
        return -1 if tokens.kinds[at + 1] is Lex.NAME and tokens.texts[at + 2] in (":", ",", "AT") else None
    if word in ("GET", "SET"):
        return -1 if around == "PROPERTY" else None
    return None
