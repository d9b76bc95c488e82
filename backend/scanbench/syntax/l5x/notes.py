"""What is told of a routine or tag that could not be kept as it was."""

NOT_RETAINED = "`[:=]` is `:=` here: the variable keeps its value over a restart"


def other_language(routine: str, language: str) -> str:
    return f"the routine {routine} is written in {language}; it is left out"


def protected(routine: str) -> str:
    return f"the routine {routine} is encrypted; it is left out"


def with_parameters(routine: str) -> str:
    return f"JSR of {routine} passes parameters, which is not read"


def unused(routine: str) -> str:
    return f"the routine {routine} runs at times that do not exist here (faults, prescan, postscan); nothing calls it"
