"""Takes out what is never reached."""

from collections.abc import Iterator, Sequence

from scanbench.language.called import parts
from scanbench.language.fix import Fix
from scanbench.language.reading import Reading
from scanbench.problems import Problem, Span
from scanbench.syntax import tree


def of_unreached(reading: Reading, file: str, problem: Problem, start: int) -> Iterator[Fix]:
    """From the statement of the problem to the end of the statements around it; their comments go as well."""
    around = reading.around(file, start)
    if problem.code != "W007" or around is None or not isinstance(around.inner.body, tuple):
        return
    last = _last(around.inner.body, problem.span)
    if last is None:
        return
    text = reading.text(file)
    end = reading.position(file, last.end_line, last.end_column)
    end += len(text[end:]) - len(text[end:].lstrip(" \t;"))
    first = len(text[:start].rstrip(" \t"))
    whole = text[first - 1 : first] == "\n" and text[end : end + 1] == "\n"
    yield Fix("Remove what is never reached", first - whole, end, "")


def _last(statements: Sequence[tree.Statement], span: Span) -> Span | None:
    """The place of the last statement in the list that has one at `span`."""
    for each in statements:
        if each.span.plain() == span.plain():
            return statements[-1].span
        for inner in parts(each)[1]:
            if (found := _last(inner, span)) is not None:
                return found
    return None
