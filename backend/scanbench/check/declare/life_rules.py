"""What CODESYS and TwinCAT ask of FB_init, FB_reinit, FB_exit and methods that are called after the initialisation."""

from scanbench.check.context import Report
from scanbench.check.declare.classes import Class, Method
from scanbench.check.declare.creations import FB_EXIT, FB_INIT, inputs_of, is_called
from scanbench.check.dialect import Allowance, Dialect
from scanbench.check.dialect_rules import said
from scanbench.check.libraries.catalogue import library_of_file
from scanbench.syntax import tree

RETAINS, COPY = "BINITRETAINS", "BINCOPYCODE"
GIVEN = (RETAINS, COPY)
"""Inputs of FB_init that the system gives."""


def check_life_method(method: Method, report: Report, dialect: Dialect) -> None:
    """Tells of a method that runs by itself, and what is wrong with its inputs."""
    declaration = method.declaration
    name, what = declaration.name.upper(), f"`{method.name}`"
    if name == FB_EXIT:
        report.warn(
            "W006",
            f"{what} is called by `__DELETE` alone here: nothing outside of the program is to be released, and a restart or a "
            f"program change replaces the whole memory. Call it yourself where it has to run.",
            declaration.span,
        )
        return
    if not is_called(declaration):
        return
    used = f"{what} is called when an instance is initialised"
    if library_of_file(declaration.span.file) is None:
        report.warn("W006", said(dialect, Allowance.LIFE, used), declaration.span)
    names = {each.name.upper() for _, each in inputs_of(declaration)}
    if name == FB_INIT:
        _check_inputs(method, names, report)
    elif names:
        report.error("D014", f"{what} is called without arguments, so it can have no inputs.", declaration.span)


def _check_inputs(method: Method, names: set[str], report: Report) -> None:
    declaration = method.declaration
    if 0 < len(names.intersection(GIVEN)) < len(GIVEN):
        report.error(
            "D014",
            f"`{method.name}` has both inputs `bInitRetains : BOOL` and `bInCopyCode : BOOL`, or none of them.",
            declaration.span,
        )
        return
    above, missing = inherited_init(method.owner), _missing(method)
    if above is not None and missing:
        report.error(
            "D014", f"`{method.name}` needs the input `{missing[0].name}` as well, which it passes on to `{above.name}`.",
            declaration.span,
        )  # fmt: skip


def _missing(method: Method) -> list[tree.Variable]:
    """Inputs of the FB_init that this one extends, and that this one lacks."""
    above = inherited_init(method.owner)
    names = {each.name.upper() for _, each in inputs_of(method.declaration)}
    names.update(GIVEN)  # which the system gives, and RuSTy's have not
    return [] if above is None else [each for _, each in inputs_of(above.declaration) if each.name.upper() not in names]


def is_whole(method: Method) -> bool:
    """Whether an FB_init has all inputs that it has to have."""
    names = {each.name.upper() for _, each in inputs_of(method.declaration)}
    return len(names.intersection(GIVEN)) != 1 and not _missing(method)


def inherited_init(owner: Class) -> Method | None:
    """The FB_init of the nearest base that has one."""
    return None if owner.base is None else init_of(owner.base)


def init_of(owner: Class) -> Method | None:
    """The FB_init that an instance of this class has."""
    each: Class | None = owner
    while each is not None:
        if FB_INIT in each.methods:
            return each.methods[FB_INIT]
        each = each.base
    return None


def extra_inputs(owner: Class) -> list[tuple[tree.VariableSection, tree.Variable]]:
    """What a declaration gives to FB_init."""
    found = init_of(owner)
    if found is None:
        return []
    return [(section, each) for section, each in inputs_of(found.declaration) if each.name.upper() not in GIVEN]
