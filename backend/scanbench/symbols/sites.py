"""Sites: the statements of a user's program, as people would count them, each with a number of its own.

For tools that say where something happened: who read a bit, which statements ran. What the compiler made has no site: start
values, what goes around a call, bodies that choose a method; nor have the system program, the plant and the library.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from scanbench.garbage import without_collection
from scanbench.problems import Span
from scanbench.program.bodies import bodies
from scanbench.program.origin import in_library, is_system
from scanbench.program.program import Assign, Blocks, Case, For, If, Pou, Program, Stmt, While
from scanbench.program.types import Record

POWER = "$POWER"
"""How the names of temporaries begin that keep the power after a contact."""


@dataclass(frozen=True, slots=True)
class StatementSite:
    """A statement, or a line of a CONFIGURATION that connects a program to a variable."""

    span: Span
    pou: str
    """The POU that has the statement. One statement of the text has several sites if several POUs are made from that text."""
    minor: bool = False
    """A contact of a rung, or a link that is read: a step over goes on to the next coil, box or jump."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """One way a statement can go: a branch of an IF or CASE (`THEN`, `ELSIF 2`, `ELSE`, `CASE 3`), a loop's `BODY`, or
    `NO ROUND` if the loop runs no round at all. `ELSE` is also the outcome of an IF or CASE without ELSE that takes no branch.
    A REPEAT, whose body always runs, has no outcome; nor have IFs that the compiler made (EN, S=, JMPC)."""

    site: int
    name: str


class Sites:
    """The sites of one program. The numbers are the same wherever the same program is checked."""

    def __init__(self, program: Program) -> None:
        self._program = program  # the numbers count while its statements live
        found = [(pou, stmt, span) for pou in program.tasked for stmt, span in _of_pou(pou)]
        joined = [(each.name, stmt) for task in program.tasks for each in task.programs for stmt in each.before]
        joined += [(each.name, stmt) for task in program.tasks for each in task.programs for stmt in each.after]
        named = [(pou.name, stmt, span) for pou, stmt, span in found]
        named += [(name, stmt, stmt.span.plain()) for name, stmt in joined]
        named.sort(key=lambda each: (each[2].file, each[2].line, each[2].column))
        self.statements = tuple(StatementSite(span, name, _is_minor(stmt)) for name, stmt, span in named)
        """Ordered by file, line and column; those at the same place in the order of the program."""
        self._numbers = {id(stmt): number for number, (_, stmt, _) in enumerate(named)}
        self._first: dict[int, int] = {}
        self.outcomes: tuple[Outcome, ...] = tuple(self._number_outcomes([(stmt, span) for _, stmt, span in named]))
        """In the order of their statements, and for each as `outcome` counts them."""
        numbers: dict[Pou, list[int]] = {}
        for pou, stmt, _ in found:
            numbers.setdefault(pou, []).append(self._numbers[id(stmt)])
        self.bodies: Mapping[Pou, tuple[int, ...]] = {pou: tuple(each) for pou, each in numbers.items()}
        """The sites of each POU that has any, outer statements before inner ones."""
        self._lines: dict[tuple[str, int], list[int]] = {}
        for number, site in enumerate(self.statements):
            self._lines.setdefault((site.span.file, site.span.line), []).append(number)

    def number(self, stmt: Stmt) -> int | None:
        """The number of this very statement, or None if it has none."""
        return self._numbers.get(id(stmt))

    def outcome(self, stmt: Stmt, way: int) -> int | None:
        """The number of a way that this very statement can go, an index into `outcomes`; None if it has none.

        `way`: of an IF or CASE the index of the branch, or how many there are for ELSE; of a FOR or WHILE 0 is BODY, 1
        is NO ROUND.
        """
        first = self._first.get(id(stmt))
        return None if first is None else first + way

    def _number_outcomes(self, ordered: Iterable[tuple[Stmt, Span]]) -> Iterator[Outcome]:
        count = 0
        for site, (stmt, span) in enumerate(ordered):
            if _goes_around_itself(stmt, span):
                continue
            names = _ways(stmt)
            if names:
                self._first[id(stmt)] = count
                count += len(names)
                yield from (Outcome(site, name) for name in names)

    def at_line(self, file: str, line: int) -> tuple[int, ...]:
        """The statements that begin in this line."""
        return tuple(self._lines.get((file, line), ()))


def sites_of(program: Program) -> Sites:
    """The sites of a program, for its present statements: the next incremental check may move and change them."""
    with without_collection():
        return Sites(program)


def _of_pou(pou: Pou) -> Iterator[tuple[Stmt, Span]]:
    if in_library(pou.span) or is_system(pou.span):
        return
    # the span of a start value is that of the variable's declaration; of what was made for the whole POU, that of the POU
    made = frozenset((pou.span.plain(), *_declared(pou.frame), *_declared(pou.instance)))
    yield from _in_order(pou.body, made)


def _declared(record: Record) -> Iterator[Span]:
    return (member.span.plain() for member in record.members.values() if not member.hidden)


def _in_order(body: Iterable[Stmt], made: frozenset[Span]) -> Iterator[tuple[Stmt, Span]]:
    """Statements in the order of the text. An IL instruction may make several; only the first has a span after the one before.
    Around what a chart says, its control is made."""
    end = (0, 0)
    for stmt in body:
        span = stmt.span.plain()
        if span in made:
            yield from _inside(stmt, made)
        elif (span.line, span.column) >= end:
            yield from _of_statement(stmt, span, made)
            end = span.end_line, span.end_column


def _of_statement(stmt: Stmt, span: Span, made: frozenset[Span]) -> Iterator[tuple[Stmt, Span]]:
    if isinstance(stmt, Blocks):  # the whole of an instruction list that has labels
        yield from _inside(stmt, made)
        return
    yield stmt, span
    if not _goes_around_itself(stmt, span):
        yield from _inside(stmt, made)


def _inside(stmt: Stmt, made: frozenset[Span]) -> Iterator[tuple[Stmt, Span]]:
    for body in bodies(stmt):
        yield from _in_order(body, made)


def _goes_around_itself(stmt: Stmt, span: Span) -> bool:
    """Whether it was made around what the text says: EN, S=, JMPC, what an argument needs before a call."""
    return any(each.span.plain() == span for body in bodies(stmt) for each in body)


def _is_minor(stmt: Stmt) -> bool:
    return isinstance(stmt, Assign) and stmt.target.variable.rpartition(".")[2].startswith(POWER)


def _ways(stmt: Stmt) -> tuple[str, ...]:
    match stmt:
        case If(branches):
            return ("THEN", *(f"ELSIF {number}" for number in range(1, len(branches))), "ELSE")
        case Case(_, branches):
            return (*(f"CASE {number}" for number in range(1, len(branches) + 1)), "ELSE")
        case For() | While():
            return ("BODY", "NO ROUND")
        case _:
            return ()
