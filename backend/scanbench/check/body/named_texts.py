"""The text of an enumeration's value that is its name: `{attribute 'to_string'}` of CODESYS and TwinCAT."""

from scanbench.check.body import conversions, fold
from scanbench.check.body.context import Body
from scanbench.check.body.standard_arguments import hold
from scanbench.problems import Span
from scanbench.program.program import Const, Expr, Intrinsic, Sequence
from scanbench.program.types import BOOL, ELEMENTARY, Enumeration, StringType


def name_of(
    body: Body, value: Expr, type: Enumeration, target: StringType, library: conversions.Library, span: Span
) -> Expr:
    """The name of an enumeration's value as text; of a number that has none, the number."""
    base = ELEMENTARY[type.base_name]
    first, number = hold(body, fold.convert(base, value), span)
    names = {each: name for name, each in reversed(type.values)}  # of two names of a number the first
    text = StringType(max(21, *map(len, names.values())))
    plain = conversions.convert(number, text, "plain", library)
    assert not isinstance(plain, str)
    more, other = hold(body, plain, span)

    def chosen(numbers: list[int]) -> Expr:
        half = len(numbers) // 2
        if half:
            below = fold.compare("lt", BOOL, number, Const(base, numbers[half]))
            return Intrinsic("SEL", text, (below, chosen(numbers[half:]), chosen(numbers[:half])))
        equal = fold.compare("eq", BOOL, number, Const(base, numbers[0]))
        return Intrinsic("SEL", text, (equal, other, Const(text, names[numbers[0]].encode("latin-1", "replace"))))

    found = conversions.convert(chosen(sorted(names)), target, "plain", library)
    assert not isinstance(found, str)
    return Sequence((*first, *more), found) if first or more else found
