"""`python -m tests.programs N [SEED]`: N random programs from a seed on, on all cores; prints those that fail, made small.

A fresh seed is taken when none is given.
"""

import secrets
import sys
import traceback

from tests.programs import conditions, generate
from tests.programs.compare import Refused, checked, compare, levels
from tests.programs.reduce import reduced
from tests.seeds import run


def failure(source: str, seed: int) -> str:
    """How the program fails, '' if it does not. The first words are the same for the same kind of failure."""
    for level in levels(seed):
        try:
            compare(source, level)
        except Refused as error:
            return f"refused: {error}"
        except AssertionError as error:
            return f"O{level} differs: {error}"
        except Exception as error:
            return f"{type(error).__name__} at O{level}: {error}\n{traceback.format_exc(limit=-4)}"
    try:
        program = checked(source)
        if program is not None:
            conditions.compare(program, condition_of(seed))
    except Exception as error:
        return f"condition, {type(error).__name__}: {error}"
    return ""


def condition_of(seed: int) -> str:
    """The condition that is compared on the program of a seed, and on what is left of it when it is made small."""
    program = checked(generate(seed))
    return conditions.text(seed, program) if program is not None else "FALSE"


def reduced_failure(seed: int) -> str:
    """How the program of a seed fails, with it made small; '' if it does not."""
    source = generate(seed)
    how = failure(source, seed)
    if how and not how.startswith("refused"):
        kind = how.split(":")[0]
        source = reduced(source, lambda text: failure(text, seed).startswith(kind))
    return how and f"{failure(source, seed)}\n{source}"


if __name__ == "__main__":
    numbers = [int(word) for word in sys.argv[1:]]
    seed = numbers[1] if len(numbers) > 1 else secrets.randbelow(10**9)
    sys.exit(1 if run(reduced_failure, numbers[0] if numbers else 1000, seed, "programs") else 0)
