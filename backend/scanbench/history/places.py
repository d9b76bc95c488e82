"""Where the inputs and outputs of a model lie in an image."""

from collections.abc import Iterator

from scanbench.program.program import Program
from scanbench.program.types import Elementary
from scanbench.symbols.descent import Descent


def places(program: Program, letter: str) -> Iterator[range]:
    """The bytes of all `%I` or `%Q`."""
    layout = program.layout
    for each in layout.model.iec_maps:
        if each.letter == letter and each.area.name in layout.areas:
            begin = layout.areas[each.area.name] + 2 * (each.first - each.area.first)
            yield range(begin, begin + 2 * each.words)


def inputs(program: Program) -> list[str]:
    """Variables at inputs; the empty path, which means all inputs, where there are any."""
    descent = Descent(program)
    names = dict.fromkeys(
        part.name
        for stretch in places(program, "I")
        for at in stretch
        for part in descent.located(at)
        if isinstance(part.type, Elementary)
    )
    return [*names, ""] if names else []
