"""A file in chunks that are parsed one by one: each POU, and the text between. An edit within POUs reparses
only these; any other edit, all of it."""

from bisect import bisect_left
from dataclasses import dataclass, field

from scanbench.problems import Problem
from scanbench.syntax import tree
from scanbench.syntax.conditions import conditions
from scanbench.syntax.cursor import Cursor
from scanbench.syntax.foreign_files import parse_foreign
from scanbench.syntax.lexer import AHEAD, KEYWORDS, Lex, Tokens, tokenize
from scanbench.syntax.objects import is_object
from scanbench.syntax.parse_file import MAX_SIZE, is_exported, is_stimulus, parse_file
from scanbench.syntax.parse_st import whole
from scanbench.syntax.pragmas import in_out_pragmas, is_external, subrange_policies
from scanbench.syntax.scl import is_scl
from scanbench.syntax.source import Source

ENDS = {"PROGRAM": "END_PROGRAM", "FUNCTION": "END_FUNCTION", "FUNCTION_BLOCK": "END_FUNCTION_BLOCK"}
"""Where a POU begins and ends that makes a chunk."""
MARKS = frozenset((*ENDS, *ENDS.values(), "CONFIGURATION", "END_CONFIGURATION"))
TIES = frozenset(
    "METHOD PROPERTY PROPERTY_GET PROPERTY_SET ACTION ACTIONS USING NAMESPACE CLASS INTERFACE ORGANIZATION_BLOCK DATA_BLOCK".split()
)
"""Words that connect what follows to the text before, or contain POUs: a file with such a word is one chunk."""


@dataclass(slots=True)
class Chunk:
    """A stretch of a file, and what is declared there. `pou` is set when it is one POU, and nothing else."""

    start: int
    source: Source
    file: tree.File
    problems: list[Problem]
    single: bool = False

    @property
    def pou(self) -> tree.PouDeclaration | None:
        """The one POU of the chunk."""
        return self.file.pous[0] if self.single and len(self.file.pous) == 1 else None

    @property
    def end(self) -> int:
        """Position after it."""
        return self.start + len(self.source.text)


@dataclass(slots=True)
class Chunked:
    """A file: its text, and its chunks in order."""

    name: str
    text: str
    chunks: list[Chunk] = field(default_factory=list)

    @property
    def file(self) -> tree.File:
        """All that the file declares."""
        whole = tree.File(self.name)
        for chunk in self.chunks:
            whole.types += chunk.file.types
            whole.globals += chunk.file.globals
            whole.pous += chunk.file.pous
            whole.configurations += chunk.file.configurations
            whole.settings += chunk.file.settings
            whole.internal += chunk.file.internal
            whole.stimuli += chunk.file.stimuli
            whole.members += chunk.file.members
        return whole

    @property
    def problems(self) -> list[Problem]:
        """Why some of it could not be read."""
        return [problem for chunk in self.chunks for problem in chunk.problems]

    def edited(self, text: str) -> list[Chunk] | None:
        """Replaces the text if all differences are inside POUs, parses their chunks again and returns these.

        Returns None, and changes nothing, when the whole text must be read again.
        """
        changed = self._inside_one(text) or self._inside_several(text)
        if changed is None:
            return None
        start = above = 0
        for number, chunk in enumerate(self.chunks):
            part = changed.get(number)
            lines = chunk.source.text.count("\n") if part is None else part.count("\n")
            if part is not None:
                chunk.source.edit(part)
                tokens, problems = tokenize(chunk.source)
                chunk.file, chunk.problems = _parsed(chunk.source, tokens, problems)
            chunk.source.above, chunk.start = above, start
            above, start = above + lines, chunk.end
        self.text = text
        return [self.chunks[number] for number in changed]

    def _inside_one(self, text: str) -> dict[int, str] | None:
        """The new text of the POU that holds all that is different, by its number."""
        first, last = _difference(self.text, text)
        for number, chunk in enumerate(self.chunks):
            if chunk.single and chunk.start < first and last < chunk.end:
                part = text[chunk.start : chunk.end + len(text) - len(self.text)]
                tokens, _ = tokenize(Source(self.name, part))
                return {number: part} if _is_one_pou(tokens) else None
        return None

    def _inside_several(self, text: str) -> dict[int, str] | None:
        """The same for any number of POUs."""
        tokens, problems = tokenize(Source(self.name, text))
        stretches = None if problems else _stretches(tokens, len(text))
        if stretches is None or [single for _, _, single in stretches] != [each.single for each in self.chunks]:
            return None
        changed = {}
        for number, (start, end, single) in enumerate(stretches):
            part = text[start:end]
            if part != self.chunks[number].source.text:
                if not single:
                    return None
                changed[number] = part
        return changed


def read(name: str, text: str, defined: frozenset[str] = frozenset()) -> Chunked:
    """Parses a file, chunk by chunk if it falls into chunks. `defined` are the names that the project defines."""
    if (
        len(text) > MAX_SIZE
        or is_stimulus(name)
        or is_exported(name, text)
        or is_scl(name)
        or is_object(name, defined)
        or parse_foreign(Source(name, text))
    ):
        return _whole(name, text, defined)
    source = Source(name, text)
    tokens, problems = tokenize(source)
    stretches = None if problems else _stretches(tokens, len(text))
    if stretches is None:
        return _whole(name, text, defined)
    made = Chunked(name, text)
    above = counted = at = 0
    for start, end, single in stretches:
        above += text.count("\n", counted, start)
        counted = start
        first = at
        while tokens.kinds[at] is not Lex.END and tokens.starts[at] < end:
            at += 1
        part = Source(name, text[start:end], above)
        file, found = _parsed(part, _slice(tokens, first, at, start, end), [])
        made.chunks.append(Chunk(start, part, file, found, single))
    return made


def _whole(name: str, text: str, defined: frozenset[str]) -> Chunked:
    source = Source(name, text, defined=defined)
    file, problems = parse_file(source)
    return Chunked(name, text, [Chunk(0, source, file, problems)])


def _parsed(source: Source, tokens: Tokens, problems: list[Problem]) -> tuple[tree.File, list[Problem]]:
    cursor = Cursor(source, tokens)
    cursor.problems += problems
    return whole(cursor)


def _slice(tokens: Tokens, first: int, last: int, start: int, end: int) -> Tokens:
    """The tokens of a stretch, as if it were a text of its own."""
    pragmas = [(at - start, text) for at, text in tokens.pragmas if start <= at < end]
    return Tokens(
        tokens.kinds[first:last] + [Lex.END] * AHEAD,
        tokens.texts[first:last] + [""] * AHEAD,
        [at - start for at in tokens.starts[first:last]] + [end - start] * AHEAD,
        pragmas,
    )


def _stretches(tokens: Tokens, length: int) -> list[tuple[int, int, bool]] | None:
    """Start and end of each chunk, and whether it is a POU; None for a file that does not fall into chunks."""
    if tokens.pragmas and (conditions(tokens) or is_external(tokens.pragmas, 0, length)):
        return None  # a name that is defined in one is known in the next; what is external is tied to a POU
    texts, made, at, index = tokens.texts, [], 0, 0
    marks = [number for number, text in enumerate(texts) if text in MARKS and text in KEYWORDS]
    while index < len(marks):
        opening = texts[marks[index]]
        closing = "END_CONFIGURATION" if opening == "CONFIGURATION" else ENDS.get(opening)
        if closing is None:
            return None
        end = index + 1
        while opening == "CONFIGURATION" and end < len(marks) and texts[marks[end]] == "PROGRAM":
            end += 1
        if end == len(marks) or texts[marks[end]] != closing:
            return None
        if opening != "CONFIGURATION":
            start, after = _start(tokens, marks[index]), tokens.starts[marks[end]] + len(closing)
            made += [(at, start, False), (start, after, True)]
            at = after
        index = end + 1
    made.append((at, length, False))
    return made if _free(tokens, made) else None


def _start(tokens: Tokens, first: int) -> int:
    """Where a POU begins: with its first token, or with what a pragma before it says of its in-outs or subranges."""
    if not tokens.pragmas:
        return tokens.starts[first]
    before = tokens.starts[first - 1] if first else -1
    tied = [each.start for each in in_out_pragmas(tokens.pragmas)]
    tied += [each.start for each in subrange_policies(tokens.pragmas)]
    own = (start for start in tied if before < start < tokens.starts[first])
    return min(own, default=tokens.starts[first])


def _free(tokens: Tokens, stretches: list[tuple[int, int, bool]]) -> bool:
    """Whether nothing between the POUs is tied to one."""
    ties = [tokens.starts[number] for number, text in enumerate(tokens.texts) if text.upper() in TIES]
    return not any(bisect_left(ties, start) < bisect_left(ties, end) for start, end, single in stretches if not single)


def _is_one_pou(tokens: Tokens) -> bool:
    if tokens.pragmas and conditions(tokens):
        return False
    marks = [text for text in tokens.texts if text in MARKS]
    last = len(tokens.texts) - AHEAD - 1
    return len(marks) == 2 and tokens.texts[0] == marks[0] and tokens.texts[last] == ENDS.get(marks[0]) == marks[1]


def _difference(old: str, new: str) -> tuple[int, int]:
    """The stretch of `old` outside of which the two are the same."""
    first = _common(old, new)
    rest = min(len(old), len(new)) - first
    same_end = _common(old[len(old) - rest :][::-1], new[len(new) - rest :][::-1]) if rest else 0
    return first, len(old) - same_end


def _common(one: str, other: str) -> int:
    """Length of what both begin with."""
    low, high = 0, min(len(one), len(other))
    if one[:high] == other[:high]:
        return high
    while high - low > 1:
        middle = (low + high) // 2
        if one[low:middle] == other[low:middle]:
            low = middle
        else:
            high = middle
    return low
