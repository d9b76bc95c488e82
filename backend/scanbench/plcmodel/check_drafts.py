"""What is wrong with errors as somebody writes them, field by field, in words for whoever fills in the form."""

from collections.abc import Iterator
from dataclasses import dataclass

from scanbench.plcmodel.catalogue import CodeForm, show_code
from scanbench.plcmodel.drafts import DraftError, Drafts
from scanbench.plcmodel.model import Model
from scanbench.plcmodel.user_errors import USER_ERRORS, with_user_errors
from scanbench.plcmodel.write_catalogue import Written, write_catalogue
from scanbench.problems import Problem, Span

_CODES: dict[CodeForm, str] = {
    "hex4": "four hexadecimal digits, such as 4101",
    "hex8": "eight hexadecimal digits, such as 40010000",
    "decimal": "a decimal number, such as 1600",
}
_NUMBER = "a number, decimal or as 16#0E"
_SCHEMA = {
    "id": "small letters, digits and single hyphens, beginning with a letter: pump-overheated",
    "name": "small letters, digits and single hyphens, beginning with a letter: pump-number",
    "detail": "the name of one of the details",
    "priority": "a whole number from 1; 1 is the most serious",
    "flag": "the address of a bit",
    "address": "an address of the model",
    "default": "one of the choices, or a number within Min and Max",
    "shift": f"{_NUMBER}: the first bit in the word",
    "width": f"{_NUMBER}: how many bits",
    "value": _NUMBER,
    "min": _NUMBER,
    "max": _NUMBER,
}
"""What the schema says of a field that it does not take, in plain words."""
_INCOMPLETE = {
    "an ErrorAddress needs an Address": ("address", "give it an address, or let its number be added to the error code"),
    "a choice of a List needs an Id": ("id", "give the choice an id"),
    "writes or adds a number and needs a Value": ("value", "say which number it writes or adds"),
    "needs Min and Max": ("min", "say from where to where, with Min and Max"),
}
"""What the reader says of a whole element: which field it is about, and the same for a form."""


@dataclass(frozen=True, slots=True)
class DraftProblem:
    """A problem at a field, `errors.2.details.0.addresses.1.address`; '' is the whole."""

    path: str
    problem: Problem


def check_drafts(model: Model, drafts: Drafts) -> tuple[Written, list[DraftProblem]]:
    """The text that the drafts make, and everything that is wrong with it."""
    written = write_catalogue(drafts)
    found = list(_missing(drafts, written))
    known = {each.path for each in found}
    for read in with_user_errors(model, written.text)[1]:
        path, problem = _field(written.field_at(read.span.line, read.span.column), read)
        if path not in known and not _says_missing(problem, path, known):
            found.append(DraftProblem(path, _plain(problem, path, model)))
    order = {each.path: number for number, each in enumerate(found)}
    return written, sorted(found, key=lambda each: (each.problem.span.line, order[each.path]))


def _missing(drafts: Drafts, written: Written) -> Iterator[DraftProblem]:
    """What every error needs and no schema says well."""
    lines = {path: line for line, (path, _) in sorted(written.places.items(), reverse=True)}
    for index, error in enumerate(drafts.errors):
        line = lines.get(f"errors.{index}", 1)
        for field, message in _lacks(error):
            yield DraftProblem(f"errors.{index}.{field}", Problem("M002", message, Span(USER_ERRORS, line, 1, line, 2)))


def _lacks(error: DraftError) -> Iterator[tuple[str, str]]:
    if not any(text.language == "en" and text.name.strip() for text in error.texts):
        yield "texts.0.name", "give it a name in English"
    if not error.group or not all(name.strip() for name in error.group):
        yield "group", "say which group it is in"
    for name, value in (("id", error.id), ("code", error.code), ("flag", error.flag), ("priority", error.priority)):
        if not value.strip():
            yield name, "is missing"


def _says_missing(problem: Problem, path: str, known: set[str]) -> bool:
    """Whether the schema says once more that there is no name."""
    return (
        problem.code == "M002"
        and (problem.message.endswith("only <Name> is allowed") or "lacks <Name>" in problem.message)
        and f"{path}.texts.0.name" in known
    )


def _field(path: str, problem: Problem) -> tuple[str, Problem]:
    """The field that lacks something, where the reader names only its element."""
    for told, (name, words) in _INCOMPLETE.items():
        if problem.code == "M008" and told in problem.message:
            return f"{path}.{name}", Problem(problem.code, words, problem.span)
    return path, problem


def _plain(problem: Problem, path: str, model: Model) -> Problem:
    name = path.rpartition(".")[2]
    if problem.code != "M002":
        return problem
    if name == "code":
        words = f"{_CODES[model.code_form]}: the codes of the {model.name} look like {show_code(1, model.code_form)}"
    elif name in _SCHEMA:
        words = _SCHEMA[name]
    else:
        return problem
    return Problem(problem.code, f"must be {words}", problem.span)
