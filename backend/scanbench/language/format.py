"""Layout of a text: indentation by the blocks, one blank where blanks belong, aligned declarations, keywords in capitals.

Lines stay lines, and comments stay where they are: what changes is the blanks at the beginning, at the end and between the tokens of a
line, and the case of keywords. A continued line keeps its distance from the line that it continues. Bodies in IL keep their columns.
"""

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from scanbench.language.comments import between
from scanbench.language.outline import POUS, Block, blocks
from scanbench.program.types import ELEMENTARY
from scanbench.syntax import tree
from scanbench.syntax.chart import Chart
from scanbench.syntax.chunks import read
from scanbench.syntax.lexer import Lex, Tokens, tokenize
from scanbench.syntax.networks import NetworkBody
from scanbench.syntax.scl import is_scl
from scanbench.syntax.source import Source, Stretch

STEP = 2
"""Blanks a level."""
DECLARING = ("VAR", "STRUCT", "UNION", "TYPE")
QUALIFIERS = frozenset(("CONSTANT", "RETAIN", "NON_RETAIN", "PERSISTENT"))
MIDDLE = frozenset(("ELSE", "ELSIF", "UNTIL", "__CATCH", "__FINALLY"))
ENDING = frozenset((";", "THEN", "ELSE", "DO", "OF", "REPEAT", "__TRY", "__FINALLY", ":"))
"""After these a statement begins."""
TIGHT_BEFORE = frozenset(", ; ) ] . ^ .. #".split())
TIGHT_AFTER = frozenset("( [ . .. #".split())
SPACED = frozenset(":= => <= >= <> ** ?= + - = < > & * / AND OR XOR MOD NOT AND_THEN OR_ELSE TO OF DO THEN".split())
KEPT_APART = frozenset("( [".split())
"""Before these there is a blank if there was one: `INT (0..9)`, `call(x)`."""


@dataclass(slots=True)
class Item:
    """A token or a comment."""

    text: str
    kind: Lex | None
    """None for a comment or pragma."""
    start: int
    end: int
    apart: bool = False
    """Whether a blank was before it."""


@dataclass(slots=True)
class Line:
    items: list[Item]
    indent: int
    """As it was, in blanks."""
    number: int
    level: int = 0
    continued: bool = False
    fixed: bool = False
    """It keeps its blanks: a body in IL."""
    declaring: bool = False
    """In a section or structure: what is there are declarations."""
    body: list[str] = field(default_factory=list)
    """The parts of a declaration, or one part."""


def formatted(name: str, text: str) -> str | None:
    """The text in its layout; None where it cannot be read, or is SCL, and so stays as it is."""
    if is_scl(name):
        return None
    if "\r\n" in text:
        made = formatted(name, text.replace("\r\n", "\n"))
        return None if made is None else made.replace("\n", "\r\n")
    source = Source(name, text)
    tokens, problems = tokenize(source)
    file = read(name, text)
    if problems or any(problem.code.startswith("S") for problem in file.problems):
        return None
    lines = leveled(text, tokens, blocks(tokens, len(text)), file.file.pous)
    made = joined(lines, text)
    return made if keeps(text, lines, made, name) else None


def keeps(text: str, lines: list[Line], made: str, name: str) -> bool:
    """Whatever goes wrong, nothing may change but blanks, and the case of keywords and type names.

    Characters that are no token, as while somebody types, are in no line.
    """
    if "".join(text.split()).upper() != "".join(made.split()).upper():
        return False
    before = [_told(item) for line in lines for item in line.items]
    return before == [_told(item) for item in _items(made, tokenize(Source(name, made))[0])]


def leveled(text: str, tokens: Tokens, top: list[Block], pous: Sequence[tree.PouDeclaration]) -> list[Line]:
    """The lines with something in them, with how far each is to be indented."""
    lines = list(_lines(text, tokens))
    _levels(lines, top, _as_written(pous))
    return lines


@dataclass(frozen=True, slots=True)
class Edit:
    """Lines from `first` up to `after`, which counts no more, become these."""

    first: int
    after: int
    lines: tuple[str, ...]


def edits(before: str, after: str, first: int = 0, last: int | None = None) -> list[Edit]:
    """What makes the formatted text of a text, in the lines from `first` to `last`; lines count from 0."""
    old, new = before.split("\n"), after.split("\n")
    last = len(old) - 1 if last is None else last
    found = []
    at = 0  # in the new lines: formatting only takes empty lines away
    number = 0
    while number < len(old):
        gone = number
        while gone < len(old) and not old[gone].strip() and (at >= len(new) or new[at].strip()):
            gone += 1
        if gone > number:
            if first <= number and gone - 1 <= last:
                found.append(Edit(number, gone, ()))
            number = gone
            continue
        if old[number] != new[at] and first <= number <= last:
            found.append(Edit(number, number + 1, (new[at],)))
        number, at = number + 1, at + 1
    return found


def _told(item: Item) -> str:
    """What of it must stay."""
    return item.text.upper() if item.kind in (Lex.NAME, Lex.KEYWORD) else item.text


# ---- lines and items ------------------------------------------------------------------------------------------------


def _items(text: str, tokens: Tokens) -> Iterator[Item]:
    """Tokens and comments in order."""
    at = 0
    for number, (kind, start) in enumerate(zip(tokens.kinds, tokens.starts, strict=True)):
        gap = at < start and not text[at:start].isspace()
        for each in between(text, at, start) if gap else ():
            yield Item(each.text, None, each.start, each.end, each.start > 0 and text[each.start - 1].isspace())
        if kind is Lex.END:
            return
        end = start + len(tokens.texts[number])
        written = tokens.texts[number] if kind is Lex.KEYWORD else text[start:end]
        yield Item(written, kind, start, end, start > 0 and text[start - 1].isspace())
        at = end


def _lines(text: str, tokens: Tokens) -> Iterator[Line]:
    """Lines with something in them; what follows a comment of several lines is in the line in which it began."""
    items: list[Item] = []
    number = counted = 0
    for item in _items(text, tokens):
        if items and "\n" in text[items[-1].end : item.start]:
            number, counted = number + text.count("\n", counted, items[0].start), items[0].start
            yield _line(text, items, number)
            items = []
        items.append(item)
    if items:
        yield _line(text, items, number + text.count("\n", counted, items[0].start))


def _line(text: str, items: list[Item], number: int) -> Line:
    begin = text.rfind("\n", 0, items[0].start) + 1
    return Line(items, len(text[begin : items[0].start].expandtabs(4)), number)


# ---- levels ---------------------------------------------------------------------------------------------------------


def _as_written(pous: Sequence[tree.PouDeclaration]) -> list[tuple[int, int]]:
    """Lines that are bodies in IL, LD, FBD or SFC, from one to another."""
    found = []
    for pou in (each for outer in pous for each in (outer, *outer.methods)):
        body = pou.body
        if isinstance(body, tree.IlBody | NetworkBody | Chart) and isinstance(body.span, Stretch):
            found.append((body.span.line - 1, body.span.end_line - 1))
    return found


def _levels(lines: list[Line], top: list[Block], il: list[tuple[int, int]]) -> None:
    """Sets how far each line is indented."""
    depth = 0
    open_ = True
    """Whether a statement or declaration begins with the next line."""
    otherwise: set[int] = set()
    """Where the CASEs begin that are at what comes after their ELSE."""
    for line in lines:
        holding = _holding(top, line.items[0].start)
        line.fixed = any(first <= line.number <= last for first, last in il)
        line.level = _level(line, holding, otherwise)
        if holding and holding[-1].keyword == "CASE" and line.items[0].text == "ELSE":
            otherwise.add(holding[-1].start)
        line.declaring = bool(holding) and holding[-1].keyword.startswith(DECLARING)
        code = [item for item in line.items if item.kind is not None]
        line.continued = depth > 0 or (not open_ and bool(code) and _continues(line))
        for item in code:
            depth += item.text in ("(", "[")
            depth -= item.text in (")", "]")
        if code:
            open_ = _ends(code, holding)


def _holding(level: list[Block], at: int) -> list[Block]:
    """The blocks that a position is inside of, the outermost first; what opens or closes a block is not inside of it."""
    found: list[Block] = []
    while True:
        number = bisect_left(level, at, key=lambda each: each.start) - 1
        block = level[number] if number >= 0 else None
        if block is None or at >= block.end - _closer(block):
            return found
        found.append(block)
        level = block.inner


def _closer(block: Block) -> int:
    """The length of what closes it."""
    if not block.closed:
        return 0
    if block.keyword == "__TRY":
        return len("__ENDTRY")
    return len("END_") + len("VAR" if block.keyword.startswith("VAR") else block.keyword)


def _level(line: Line, holding: list[Block], otherwise: set[int]) -> int:
    first = next((item.text for item in line.items if item.kind is not None), "")
    inner = holding[-1].keyword if holding else ""
    pairs = pairwise(holding)
    # sections are at the level of their POU, statements a level deeper
    level = len(holding) - sum(outer.keyword in POUS and each.keyword.startswith("VAR") for outer, each in pairs)
    if inner in POUS and first.startswith(("VAR", "END_VAR")):
        level -= 1
    if inner in ("IF", "CASE", "REPEAT", "__TRY") and first in MIDDLE:
        level -= 1
    # statements of a branch are a level deeper than its label, those after ELSE are at the level of the labels
    branches = [block for block in holding if block.keyword == "CASE" and block.start not in otherwise]
    label = inner == "CASE" and holding[-1] in branches and (first in MIDDLE or _is_label(line))
    return level + len(branches) - label


def _is_label(line: Line) -> bool:
    """Whether a line of a CASE begins with the label of a branch."""
    if line.declaring:
        return False
    depth = 0
    for item in line.items:
        if item.kind is None:
            continue
        depth += item.text in ("(", "[")
        depth -= item.text in (")", "]")
        if depth == 0 and item.text == ":":
            return True
        if item.text in (";", ":=", "(") or (item.kind is Lex.KEYWORD and item.text not in ("TRUE", "FALSE")):
            return False
    return False


def _continues(line: Line) -> bool:
    """Whether a line that follows an unfinished one goes on with it, and does not begin or end a block."""
    first = next(item for item in line.items if item.kind is not None)
    return not (
        first.kind is Lex.KEYWORD and (first.text.startswith(("END_", "VAR", "__ENDTRY")) or first.text in MIDDLE)
    )


def _ends(code: list[Item], holding: list[Block]) -> bool:
    """Whether a statement, declaration or head is over at the end of this line."""
    last = code[-1]
    if last.text in ENDING or last.text.startswith(("END_", "__ENDTRY")):
        return True
    first = code[0].text.upper()
    inner = holding[-1].keyword if holding else ""
    if first.startswith("VAR") or first in ("STRUCT", "TYPE", "UNION", "REPEAT", "__CATCH") or not holding:
        return True
    heads = (*POUS, "NAMESPACE", "RESOURCE", "CONFIGURATION", "USING", "EXTENDS", "IMPLEMENTS", "GET", "SET")
    if first in heads or last.text.upper() in ("STRUCT", "UNION"):
        return True
    return inner in ("CONFIGURATION", "RESOURCE", "NAMESPACE") and last.text not in (":", ",", ":=")


# ---- blanks ---------------------------------------------------------------------------------------------------------


def joined(lines: list[Line], text: str, step: int = STEP) -> str:
    """The whole text, with so many blanks a level."""
    made: list[str] = []
    shift = 0
    for line in lines:
        if line.fixed:
            begin = text.rfind("\n", 0, line.items[0].start) + 1
            line.body = [text[begin : line.items[-1].end].rstrip()]
            continue
        if not line.continued:
            shift = step * line.level - line.indent
        line.body = _parts(line)
        line.indent = step * line.level if not line.continued else max(0, line.indent + shift)
    _align(lines)
    at = 0
    for line in lines:
        begin = line.items[0].start
        if made and text.count("\n", at, begin) > 1:
            made.append("")
        made.append(line.body[0] if line.fixed else (" " * line.indent + "".join(line.body)).rstrip())
        at = line.items[-1].end
    return "\n".join(made) + "\n" if made else ""


def _parts(line: Line) -> list[str]:
    """The text of a line; of a declaration the name, the address, the type and the rest, the comment at its end."""
    texts = [""]
    before: Item | None = None
    declares, last = _declares(line), len(line.items) - 1
    for number, item in enumerate(line.items):
        part = 1 if item.text == "AT" else 2 if item.text == ":" else 3 if item.kind is None and number == last else 0
        if declares and len(texts) <= part and (part < 3 or len(texts) == 3):
            texts += [""] * (part + 1 - len(texts))
            before = None
        blank = before is not None and _blank(line, before, item, number)
        texts[-1] += (" " if blank else "") + _cased(line, item, number)
        before = item
    return texts


def _cased(line: Line, item: Item, number: int) -> str:
    if item.kind is not Lex.NAME:
        return item.text
    upper, first = item.text.upper(), line.items[0].text
    typed = number > 0 and line.items[number - 1].text.upper() in (":", "OF", "REF_TO", "TO")
    before = line.items[number - 1].text.upper() if number > 0 else ""
    word = (upper == "BY" and first == "FOR" and before not in ("FOR", "TO", "BY")) or (
        upper in QUALIFIERS and first.startswith("VAR")
    )
    return upper if word or (typed and upper in ELEMENTARY) else item.text


def _declares(line: Line) -> bool:
    """Whether it is `name : type ...;`, perhaps with an address."""
    code = [item for item in line.items if item.kind is not None]
    if not line.declaring or line.continued or len(code) < 4 or code[-1].text != ";" or code[0].kind is not Lex.NAME:
        return False
    before = [item.text for item in code]
    return ":" in before and not {",", ":=", "("} & set(before[: before.index(":")])


def _blank(line: Line, before: Item, item: Item, number: int) -> bool:
    """Whether a blank is between two items of a line."""
    if before.kind is None or item.kind is None:
        return item.apart or item.text.startswith("//")
    if item.text in TIGHT_BEFORE or before.text in TIGHT_AFTER:
        return False
    if item.text in KEPT_APART:
        return (
            item.apart
            if before.kind in (Lex.NAME, Lex.KEYWORD, Lex.TYPED) and before.text not in SPACED
            else (before.text not in (")", "]", "^"))
        )
    if item.text == "=" and before.text.upper() in ("S", "R", "REF"):
        return item.apart  # `S=`, `R=` and `REF=` of CODESYS are one operator each
    if item.text == "=" and before.text in ("+", "-", "*", "/"):
        return item.apart  # `+=` and the like are one operator each
    if before.text in ("-", "+") and _is_sign(line, number - 1):
        return False
    if item.text == ":":
        return _colon_apart(line, number)
    return True


def _is_sign(line: Line, number: int) -> bool:
    """Whether a plus or minus is of one operand."""
    before = next((item for item in reversed(line.items[:number]) if item.kind is not None), None)
    if before is None:
        return False
    operand = before.kind not in (Lex.OPERATOR, Lex.KEYWORD) or before.text in (")", "]", "^", "TRUE", "FALSE")
    return not operand


def _colon_apart(line: Line, number: int) -> bool:
    """A blank is before the colon of a declaration, and none before that of a label."""
    return not _is_label(line) or _declares(line) or line.items[number].apart


def _align(lines: list[Line]) -> None:
    """Puts the types of declarations that follow each other into one column, and the comments after them into another."""
    group: list[Line] = []
    for line in [*lines, None]:
        follows = (
            bool(group) and line is not None and line.number == group[-1].number + 1 and line.indent == group[-1].indent
        )
        if line is not None and len(line.body) > 1 and (follows or not group):
            group.append(line)
            continue
        _columns(group)
        group = [line] if line is not None and len(line.body) > 1 else []


def _columns(group: list[Line]) -> None:
    """Each part as wide as the widest of its column; a column that no line has takes no room."""
    for column in range(max((len(line.body) for line in group), default=1) - 1):
        width = max(len(line.body[column]) for line in group if len(line.body) > column)
        for line in group:
            if width and len(line.body) > column + 1:
                line.body[column] = f"{line.body[column]:<{width}} "
