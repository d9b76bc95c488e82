"""What is told of a routine or tag that could not be kept as it was."""

NOT_RETAINED = "`[:=]` is `:=` here: the variable keeps its value over a restart"


def other_language(routine: str, language: str) -> str:
    return f"the routine {routine} is written in {language}; it is left out"


def not_in_ladder(routine: str, what: str) -> str:
    return f"the routine {routine} has `{what}`, which is not read in a ladder; it is left out"


def protected(routine: str) -> str:
    return f"the routine {routine} is encrypted; it is left out"


def edited(routine: str) -> str:
    return f"the routine {routine} has edits that are not accepted yet: its text before them is read"


def with_parameters(routine: str) -> str:
    return f"{routine} has parameters, which are not read: the statement stays as it is, and is refused"


def other_bytes(call: str) -> str:
    return f"{call} copies between different types, whose bytes are different here: the statement stays as it is, and is refused"


def lost_value(tag: str, written: str) -> str:
    return f"the start value of {tag} is not read ({written}); it is zero"


def hidden_alias(alias: str, target: str) -> str:
    return f"the alias {alias} leads to {target}, of which the program has one of its own; it is left out"


def alias_parameter(parameter: str) -> str:
    return f"the parameter {parameter} is an alias of a member, which it gets and gives at the end of the routine alone, but RETURN leaves before"


def no_alias_type(parameter: str, target: str) -> str:
    return f"the parameter {parameter} is an alias for {target}, whose type the file does not show; it is left out"


def not_run(what: str) -> str:
    return f"{what} does not run: it is disabled, inhibited, or started by an event"


def unused(routine: str) -> str:
    return f"the routine {routine} runs at times that do not exist here (faults, prescan, postscan); nothing calls it"


def too_deep(routine: str) -> str:
    return f"the routine {routine} has calls within calls, too many to be read; it is left out"


def unset_flag(flag: str) -> str:
    return f"nothing sets the flag {flag} here: it keeps what you write to it"


def does_nothing(instruction: str) -> str:
    return f"{instruction} changes nothing here, and is left out: no task interrupts another one, and outputs have no device"


def no_size(call: str) -> str:
    return f"{call} is of an array whose size the file does not show: the statement stays as it is, and is refused"
