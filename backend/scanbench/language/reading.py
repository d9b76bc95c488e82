"""One state of the texts of a project: what was read and checked, and what of it is looked up."""

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from scanbench.check.body.context import Body
from scanbench.check.build import Checked, with_user_errors
from scanbench.check.incremental import Checks, Project
from scanbench.check.typed.looking import Looking
from scanbench.check.uses import Symbol
from scanbench.language.comments import Comment, comments
from scanbench.language.declared import Declared, declarations
from scanbench.language.index import Index, chunk_at
from scanbench.language.outline import Block, blocks
from scanbench.plcmodel.model import Model
from scanbench.problems import Span
from scanbench.syntax import tree
from scanbench.syntax.chunks import Chunk, Chunked
from scanbench.syntax.lexer import Lex, Tokens, tokenize
from scanbench.syntax.objects import is_object
from scanbench.syntax.source import Source, Stretch

INTERVAL_NS = 10_000_000


@dataclass(frozen=True, slots=True)
class Around:
    """What a position is inside of."""

    pou: tree.PouDeclaration
    method: tree.PouDeclaration | None

    @property
    def inner(self) -> tree.PouDeclaration:
        """The innermost."""
        return self.method or self.pou


class Part:
    """What the text of one chunk says by itself; kept as long as it says the same. Positions count from its beginning."""

    def __init__(self, chunk: Chunk) -> None:
        self.text = chunk.source.text
        self._source = chunk.source
        self._file = chunk.file

    @cached_property
    def tokens(self) -> Tokens:
        return tokenize(self._source)[0]

    @cached_property
    def comments(self) -> list[Comment]:
        return list(comments(self.text, self.tokens))

    @cached_property
    def blocks(self) -> list[Block]:
        """The outermost blocks."""
        return blocks(self.tokens, len(self.text))

    @cached_property
    def declared(self) -> dict[Symbol, list[Declared]]:
        found: dict[Symbol, list[Declared]] = {}
        for each in declarations(self._file):
            found.setdefault(each.symbol, []).append(each)
        return found


class Reading:
    """What is known of the texts until they change. Positions are characters from the beginning of a file."""

    def __init__(self, project: Project, checked: Checked, parts: dict[Source, Part]) -> None:
        self.checked = checked
        self.project = project
        self._parts = parts

    @property
    def files(self) -> Mapping[str, Chunked]:
        """The program files, as they were read."""
        return self.project.files

    @cached_property
    def index(self) -> Index:
        return Index(self.files, self.project.checker)

    def declared(self, symbol: Symbol) -> list[Declared]:
        """Where the files declare a symbol."""
        keys = [symbol]
        if symbol.owner == "GLOBAL" and "." in symbol.name:  # perhaps a list and its variable
            keys.append(symbol._replace(name=symbol.name.rpartition(".")[2]))
        chunks = (chunk for file in self.files.values() for chunk in file.chunks)
        found = (each for chunk in chunks for key in keys for each in self.part(chunk).declared.get(key, ()))
        return [each for each in map(self._of_list, found) if each.symbol == symbol]

    def declared_near(self, file: str, position: int) -> list[Declared]:
        """What the chunk declares that a position is in."""
        part = self.part(chunk_at(self.files[file], position))
        return [self._of_list(each) for found in part.declared.values() for each in found]

    def declared_between(self, file: str, start: int, end: int) -> Iterator[tuple[int, Declared]]:
        """What is declared in a stretch of a file, each with the position of its name."""
        for chunk in self.files[file].chunks:
            if chunk.start < end and start < chunk.end:
                for each in (each for same in self.part(chunk).declared.values() for each in same):
                    at = chunk.start + each.span.start if isinstance(each.span, Stretch) else end
                    if at < end and start < at + len(each.name):
                        yield at, self._of_list(each)

    def declared_in(self, file: str) -> Iterator[Declared]:
        """All that a file declares, in the order of the text."""
        for chunk in self.files[file].chunks:
            found = (each for same in self.part(chunk).declared.values() for each in same)
            yield from map(self._of_list, sorted(found, key=lambda each: (each.span.line, each.span.column)))

    def _of_list(self, found: Declared) -> Declared:
        """Of a variable that several lists have, the name with its list, under which the checks keep it."""
        if not found.list_name:
            return found
        member = self.project.checker.globals.members.get(found.symbol.name)
        if member is None or member.span is found.span:
            return found
        return replace(found, symbol=found.symbol._replace(name=f"{found.list_name}.{found.name}".upper()))

    def part(self, chunk: Chunk) -> Part:
        """What is known of a chunk; positions in it count from its beginning."""
        kept = self._parts.get(chunk.source)
        if kept is None or kept.text is not chunk.source.text:
            kept = self._parts[chunk.source] = Part(chunk)
        return kept

    def text(self, file: str) -> str:
        return self.files[file].text

    def written(self, span: Span) -> str:
        """The text of a place in a file."""
        start = self.position(span.file, span.line, span.column)
        return self.text(span.file)[start : self.position(span.file, span.end_line, span.end_column)]

    def tokens(self, file: str) -> Iterator[tuple[int, Tokens]]:
        """Of each chunk of a file, with the position that its positions count from."""
        for chunk in self.files[file].chunks:
            yield chunk.start, self.part(chunk).tokens

    def blocks(self, file: str) -> Iterator[tuple[int, Block]]:
        """The outermost blocks of a file, each with the position that its positions count from."""
        for chunk in self.files[file].chunks:
            for each in self.part(chunk).blocks:
                yield chunk.start, each

    def comments(self, file: str) -> Iterator[tuple[int, Comment]]:
        """The comments of a file, each with the position that its positions count from."""
        for chunk in self.files[file].chunks:
            for each in self.part(chunk).comments:
                yield chunk.start, each

    def is_code(self, file: str, position: int) -> bool:
        """Whether what is typed at a position is neither in a comment nor in a string."""
        chunk = chunk_at(self.files[file], position)
        part, within = self.part(chunk), position - chunk.start
        if any(each.start < within < each.end + each.goes_on for each in part.comments):
            return False
        tokens = part.tokens
        at = bisect_left(tokens.starts, within) - 1
        if at < 0 or tokens.kinds[at] not in (Lex.STRING, Lex.TYPED):
            return True
        return tokens.texts[at][-1] not in "'\"" or within >= tokens.starts[at] + len(tokens.texts[at])

    def around(self, file: str, position: int) -> Around | None:
        """The POU and method that a position is in."""
        chunk = chunk_at(self.files[file], position)
        if chunk.pou is not None and not chunk.pou.methods:
            return Around(chunk.pou, None)
        if is_object(file, chunk.source.defined):
            return self._around_object(chunk.file)
        starts = {each.name_at for each in self._holding(chunk, position)}
        for pou in chunk.file.pous:
            if _start(pou) in starts:
                return Around(pou, next((each for each in pou.methods if _start(each) in starts), None))
        return None

    def _around_object(self, file: tree.File) -> Around | None:
        """What a file of one object is all inside of; a member is in its POU, which has a file of its own."""
        wanted = {id(method.span) for member in file.members for method in member.methods}
        for pou in (pou for each in self.project.checker.parsed for pou in each.pous):
            method = next((each for each in pou.methods if id(each.span) in wanted), None)
            if method is not None or any(pou.span is each.span for each in file.pous):
                return Around(pou, method)
        return None

    def _holding(self, chunk: Chunk, position: int) -> list[Block]:
        found: list[Block] = []
        within = position - chunk.start
        level = self.part(chunk).blocks
        while (block := next((each for each in level if each.start <= within <= each.end), None)) is not None:
            found.append(block)
            level = block.inner
        return found

    def holding(self, file: str, position: int) -> list[str]:
        """The keywords of the blocks that a position is in, the outermost first."""
        return [each.keyword for each in self._holding(chunk_at(self.files[file], position), position)]

    def body(self, around: Around) -> Body | None:
        """A body in which texts can be checked as if they were in this POU; it only looks."""
        return self.project.checker.body_at(around.pou, around.method, Looking())

    def place(self, file: str, position: int) -> tuple[int, int]:
        """Line and column of a position, from 1."""
        starts = self._starts(file)
        line = bisect_right(starts, position)
        return line, position - starts[line - 1] + 1

    def position(self, file: str, line: int, column: int) -> int:
        """The position of a line and column, which count from 1; what is beyond the end of a line is its end."""
        starts, text = self._starts(file), self.text(file)
        if line > len(starts):
            return len(text)
        end = starts[line] - 1 if line < len(starts) else len(text)
        return min(starts[max(line, 1) - 1] + max(column, 1) - 1, end)

    def _starts(self, file: str) -> list[int]:
        if file not in self._line_starts:
            text = self.text(file)
            starts = [0]
            while (at := text.find("\n", starts[-1])) >= 0:
                starts.append(at + 1)
            self._line_starts[file] = starts
        return self._line_starts[file]

    @cached_property
    def _line_starts(self) -> dict[str, list[int]]:
        return {}


class Readings:
    """The texts of one project while they are edited."""

    def __init__(self, model: Model, interval_ns: int = INTERVAL_NS) -> None:
        self.model = model
        self._interval_ns = interval_ns
        self._checks = Checks()
        self._parts: dict[Source, Part] = {}

    def read(self, sources: Mapping[str, str]) -> Reading:
        """The newest state; the one before must not be asked any more."""
        project = self._checks.project(sources, self.model, self._interval_ns)
        checked = with_user_errors(project.checked, sources, self.model)
        known = {chunk.source for file in project.files.values() for chunk in file.chunks}
        self._parts = {source: part for source, part in self._parts.items() if source in known}
        return Reading(project, checked, self._parts)


def _start(pou: tree.PouDeclaration) -> int:
    return pou.span.start if isinstance(pou.span, Stretch) else -1
