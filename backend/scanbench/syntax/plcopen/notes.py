"""What is told of a POU that could not be kept as it was."""

MACRO_STEP = "a macro step is left out"
NO_LANGUAGE = "a body in a language that is not known is left out"
NO_SOURCE = "a connection leads to nothing; it is FALSE"


def no_type(wire: str) -> str:
    return f"{wire} is read before its box runs, and its type is not known: it is BOOL until it is written (`{wire} : INT = ...`)"


def not_read(what: str, line: int) -> str:
    return f"{what} in line {line} is left out: it is not read"


def no_methods(names: str) -> str:
    return f"its methods and properties are left out: {names}"


def no_transition(line: int) -> str:
    return f"the transition of line {line} is left out: it does not lead from a step to a step"


def circle(line: int) -> str:
    return f"from the transition of line {line} lines lead in a circle without a step; they are followed once"


def same_name(path: str) -> str:
    return f"something of this name comes before it: this is in {path}"


def drawn_condition(line: int) -> str:
    return f"the condition of the transition of line {line} is drawn; it is FALSE until it is written"


def no_ladder(line: int) -> str:
    return f"the network of line {line} is a function block diagram here"
