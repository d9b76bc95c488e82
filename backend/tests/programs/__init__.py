"""Random programs: well-formed, small enough to run in both engines, nasty enough to make them differ.

`generate(seed)` always gives the same text for the same seed. Each program has Main with two variables of some of
the elementary types, and what a few of the `INGREDIENTS` add.
"""

from collections.abc import Sequence

from tests.programs.areas import areas
from tests.programs.calls import calls
from tests.programs.derived import enumerations, parts_of_bits, subranges, unions
from tests.programs.expressions import literal
from tests.programs.frames import frames
from tests.programs.library import library
from tests.programs.lists import instruction_lists, tasks
from tests.programs.objects import enabled, objects
from tests.programs.references import open_arrays, pointers, references
from tests.programs.scope import COUNTERS, TEXT, TYPES, Draw, Ingredient, Parts, Scope
from tests.programs.statements import body
from tests.programs.texts import dates, wide_strings

INGREDIENTS: tuple[Ingredient, ...] = (
    calls, frames, library, enumerations, subranges, parts_of_bits, unions, open_arrays, wide_strings, dates, objects, enabled,
    instruction_lists, tasks, areas, references, pointers,
)  # fmt: skip
"""In the order in which they are added: the later ones refer to what the earlier ones declare."""
ALWAYS = (TEXT, "INT", "BOOL")
"""Types whose variables every ingredient may count on."""


def generate(seed: int, ingredients: Sequence[Ingredient] = INGREDIENTS) -> str:
    """The text of a program, with up to three of the ingredients."""
    draw = Draw(seed)
    parts = Parts(draw, Scope())
    for type in TYPES:
        if type in ALWAYS or draw.likely(45):
            name = f"v_{type.lower().split('[')[0]}"
            parts.variables += [f"{name}{number} : {type} := {literal(draw, type)};" for number in range(2)]
            parts.main.add(type, f"{name}0", f"{name}1")
    for number in sorted(draw.sample(range(len(ingredients)), min(draw.randint(1, 3), len(ingredients)))):
        ingredients[number](parts)
    statements = [*parts.start, body(draw, parts.main, 2, 3, 8), *parts.end]
    return "\n".join(
        [
            *parts.declarations,
            "PROGRAM Main\nVAR",
            *parts.variables,
            f"{COUNTERS}\nEND_VAR",
            *statements,
            "END_PROGRAM",
            *parts.after,
        ]
    )
