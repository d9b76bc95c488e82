"""Mends of what is written wrong: a word or mark that is missing, or one that a different one has to replace."""

import re
from collections.abc import Iterator

from scanbench.language.fix import Fix, offset
from scanbench.language.reading import Reading
from scanbench.problems import Problem
from scanbench.syntax.lexer import KEYWORDS

AFTER = re.compile(r"`(;|THEN|OF|DO)` expected (?:at the end of|after) ")
"""The problem is at the last character before."""
CLOSING = re.compile(r"`([)\]])` expected to close [^,]*, (?:found `(.*)`|but the file ends here)\.", re.DOTALL)
"""The problem is at what comes instead."""
BLOCK = re.compile(r"`(END_\w+)` expected to close the \w+ of line (\d+)")
WHOLE = re.compile(r"`(END_\w+)` expected to close ")
ARROW = re.compile(r"write `\w+ (=>|:=) \.\.\.`\.$")
OTHER = re.compile(r"`(.+)` is of another language; write (?:`(.+)`|([A-Z]+))\.$")
COMPARED = re.compile(r"An assignment is written `:=`")
POINTS = re.compile(r"This is a reference; write `\^`|.* Dereference it with `\^`\.$")
STRING = re.compile(r"This string never ends")
STATEMENTS = ("END_IF", "END_CASE", "END_FOR", "END_WHILE", "END_REPEAT", "__ENDTRY")
GOES_ON = re.compile(r"(ELSE|ELSIF|UNTIL|__CATCH|__FINALLY)\b", re.IGNORECASE)
OPENING = {"(*": "*)", "/*": "*/", "{": "}"}


def of_syntax(reading: Reading, file: str, problem: Problem, start: int, end: int) -> Iterator[Fix]:
    """What the message says is missing, or is to be written."""
    text, message = reading.text(file), problem.message
    written = text[start:end]
    if problem.code == "S002":
        yield from _never_ends(text, message, start)
    if (after := AFTER.match(message)) is not None:
        word = after.group(1)
        yield Fix(f"Insert `{word}`", end, end, word if word == ";" else f" {word}")
    if (closing := CLOSING.match(message)) is not None and _ends_here(closing.group(2)):
        at = _after_last(reading, file, start)
        yield Fix(f"Insert `{closing.group(1)}`", at, at, closing.group(1))
    if WHOLE.match(message) is not None:
        yield from _block_end(reading, file, message, start)
    if COMPARED.match(message) and (at := offset(written, "=")) >= 0:
        yield Fix("Write `:=`", start + at, start + at + 1, ":=")
    if (arrow := ARROW.search(message)) is not None:
        wrong = ":=" if arrow.group(1) == "=>" else "=>"
        if (at := offset(written, wrong)) >= 0:
            yield Fix(f"Write `{arrow.group(1)}`", start + at, start + at + 2, arrow.group(1))
    if (other := OTHER.match(message)) is not None and text.startswith(other.group(1), start):
        yield _translated(text, start, start + len(other.group(1)), other.group(2) or other.group(3))
    if POINTS.match(message):
        yield Fix("Insert `^`", end, end, "^")


def _ends_here(found: str | None) -> bool:
    """Whether what was found can only come after the expression: then nothing but the mark is missing before it."""
    return found is None or found == ";" or found in KEYWORDS


def _translated(text: str, start: int, end: int, word: str) -> Fix:
    """A word needs a space on both sides."""
    if not word.isalpha():
        return Fix(f"Write `{word}`", start, end, word)
    before = " " if text[start - 1 : start].isalnum() else ""
    after = " " if text[end : end + 1].isalnum() else ""
    return Fix(f"Write `{word}`", start, end, f"{before}{word}{after}")


def _after_last(reading: Reading, file: str, position: int) -> int:
    """The end of the last token before a position; comments between the two are no tokens."""
    last = position
    for start, tokens in reading.tokens(file):
        for token, at in zip(tokens.texts, tokens.starts, strict=False):
            if not token or start + at >= position:
                break
            last = start + at + len(token)
    return last


def _never_ends(text: str, message: str, start: int) -> Iterator[Fix]:
    """Closed at the end of its line; a string before what ends the statement."""
    line_end = text.find("\n", start)
    line = text[start : len(text) if line_end < 0 else line_end].rstrip()
    if STRING.match(message):
        body = line.rstrip(";) ")
        yield Fix("Close the string", start + len(body), start + len(body), text[start])
        return
    closing = next((close for open_, close in OPENING.items() if line.startswith(open_)), None)
    if closing is not None:
        at = start + len(line)
        yield Fix("Close the comment at the end of the line", at, at, closing if closing == "}" else f" {closing}")


def _block_end(reading: Reading, file: str, message: str, found: int) -> Iterator[Fix]:
    """Where the layout says that the block ends; else before what comes instead."""
    whole, block = WHOLE.match(message), BLOCK.match(message)
    assert whole is not None
    keyword, text = whole.group(1), reading.text(file)
    if block is None:
        yield _line_with(text, _after_last(reading, file, found), "", keyword)
        return
    begin = reading.position(file, int(block.group(2)), 1)
    indent = _indent(text, begin)
    place = _laid_out(text, begin, len(indent), found) if keyword in STATEMENTS else found
    yield _line_with(
        text, _after_last(reading, file, place), indent, f"{keyword};" if keyword in STATEMENTS else keyword
    )


def _line_with(text: str, after: int, indent: str, word: str) -> Fix:
    """A line with the word, below the line in which something ends; what else is in that line stays there."""
    line_end = text.find("\n", after)
    if (
        line_end >= 0
        and not text[after:line_end].strip().startswith(("(*", "//", "{", "/*"))
        and text[after:line_end].strip()
    ):
        return Fix(f"Insert `{word.rstrip(';')}`", after, after, f" {word}")
    at = len(text) if line_end < 0 else line_end
    return Fix(f"Insert `{word.rstrip(';')}`", at, at, f"\n{indent}{word}")


def _laid_out(text: str, begin: int, depth: int, found: int) -> int:
    """The first line below that is no further in than the block, where the lines between are; else the place that the parser found."""
    at, inner = text.find("\n", begin) + 1, False
    while 0 < at <= found:
        line = text[at:end] if (end := text.find("\n", at)) >= 0 else text[at:]
        if line.strip() and len(_indent(text, at)) <= depth and not GOES_ON.match(line.strip()):
            return at if inner else found
        inner = inner or bool(line.strip())
        at = text.find("\n", at) + 1
    return found


def _indent(text: str, line: int) -> str:
    match = re.compile(r"[ \t]*").match(text, line)
    return match.group() if match else ""
