"""What a project requires of its errors (`required.reactions`), on one program: names looked up, conditions checked."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import get_args

from scanbench.check.typed.condition import BadCondition, joined, parsed
from scanbench.check.typed.local import Local, Locals
from scanbench.faults.details import choose
from scanbench.faults.reaction.reaction import Grade
from scanbench.faults.reaction.required import Wanted
from scanbench.faults.reference import ErrorRef, find_error, parse_reference
from scanbench.plcmodel.hardware import is_fitted
from scanbench.problems import Problem, Severity, Span
from scanbench.program.program import Program
from scanbench.runtime.command import Refusal
from scanbench.syntax import tree
from scanbench.syntax.requirements import (
    CODE,
    Piece,
    Requirement,
    RequirementsText,
    Rule,
    is_requirements,
    read_requirements,
)

GROUPS = ("all", "fatal", "nonfatal")
GRADES: Mapping[str, Wanted] = {each: each for each in (*get_args(Grade), "none")}


@dataclass(frozen=True, slots=True)
class Condition:
    """An expression of a requirement, checked, with the variables in it."""

    local: Local
    parts: tuple[Local, ...]


@dataclass(frozen=True, slots=True)
class Made:
    """A requirement on one program. `invalid` says why it cannot be checked there."""

    source: Requirement
    condition: Condition | None = None
    until: Condition | None = None
    scans: int = 0
    """of `within`"""
    grade: Wanted | None = None
    invalid: str = ""


@dataclass(frozen=True, slots=True)
class _About:
    """A rule whose error was found."""

    ref: ErrorRef | None
    group: str
    states: tuple[str, ...]
    made: tuple[Made, ...]
    span: Span

    @property
    def wants(self) -> bool:
        """Whether it asks for anything."""
        return any(made.grade != "none" for made in self.made)

    @property
    def rank(self) -> tuple[int, int]:
        """The larger, the more it is about one error."""
        place = GROUPS.index(self.group) + 1 if self.group in GROUPS[1:] else 0
        return (len(self.ref.details) + 4 if self.ref is not None else min(place, 2)), len(self.states)


class Rules:
    """The requirements of a project on one program."""

    def __init__(self, program: Program, text: RequirementsText) -> None:
        self.program = program
        self.problems = list(text.problems)
        self._locals = Locals(program)
        self._rules = [made for rule in text.rules if (made := self._rule(rule)) is not None]

    def __bool__(self) -> bool:
        return bool(self._rules)

    def raised(self, errors: Sequence[ErrorRef], asked: Collection[str] = ()) -> list[ErrorRef]:
        """What a sweep raises: these, and of the same errors those with details that rules name. Of what was asked for and
        is not among them, as it is not fitted, what rules name: so it is seen that it cannot be raised."""
        found: dict[ErrorRef, ErrorRef] = {}
        """By all details: a rule may name what is raised anyway, as the default is."""
        for number, ref in enumerate(errors):
            found.setdefault(self._whole(ref), ref)
            if all(later.id != ref.id for later in errors[number + 1 :]):
                for rule in self._rules:
                    if (
                        rule.ref is not None
                        and rule.ref.details
                        and rule.ref.id == ref.id
                        and (rule.wants or self._is_fitted(rule.ref))
                    ):
                        found.setdefault(self._whole(rule.ref), rule.ref)
        there = {ref.id for ref in errors}
        for rule in self._rules:
            if rule.ref is not None and rule.wants and rule.ref.id in asked and rule.ref.id not in there:
                found.setdefault(self._whole(rule.ref), rule.ref)
        return list(found.values())

    def of(self, ref: ErrorRef, state: str | None) -> tuple[Made, ...]:
        """What must happen when this error comes in this state (None: whichever it is); of grades the one that is most about it."""
        rules = [each for each in self._rules if self._is_about(each, ref) and _in(each, state)]
        grades = [(rule.rank, number) for number, rule in enumerate(rules) if any(made.grade for made in rule.made)]
        best = max(grades)[1] if grades else -1
        return tuple(
            made for number, rule in enumerate(rules) for made in rule.made if made.grade is None or number == best
        )

    def by_states(self, ref: ErrorRef) -> Iterator[tuple[tuple[str, ...], tuple[Made, ...]]]:
        """What is required of it in certain states only, with these states."""
        for rule in self._rules:
            if rule.states and self._is_about(rule, ref):
                yield rule.states, rule.made

    def grade(self, ref: ErrorRef, state: str | None) -> Wanted | None:
        """The grade that it has to have at least; None: the file does not say."""
        return next((made.grade for made in reversed(self.of(ref, state)) if made.grade is not None), None)

    def _is_about(self, rule: _About, ref: ErrorRef) -> bool:
        entry = self.program.layout.model.error(ref.id)
        if entry is None:
            return False
        if rule.ref is None:
            return rule.group in ("all", entry.severity)
        return rule.ref.id == ref.id and set(rule.ref.details) <= set(self._whole(ref).details)

    def _is_fitted(self, ref: ErrorRef) -> bool:
        layout, entry = self.program.layout, find_error(self.program.layout.model, ref.id)
        chosen = entry if isinstance(entry, Refusal) else choose(entry, dict(ref.details), layout)
        if isinstance(entry, Refusal) or isinstance(chosen, Refusal):
            return False
        return is_fitted(layout.model.fitted, entry, chosen.instance.details)

    def _whole(self, ref: ErrorRef) -> ErrorRef:
        """With all its details decided."""
        return whole(self.program, ref)

    # ---- making them ----------------------------------------------------------------------------------------------

    def _rule(self, rule: Rule) -> _About | None:
        word, states = rule.error.text, rule.states
        if word.lower() in GROUPS:
            return _About(None, word.lower(), states, tuple(map(self._made, rule.requirements)), rule.error.span)
        ref = parse_reference(self.program.layout.model, word)
        ref = ref if isinstance(ref, Refusal) else settled(self.program, ref)
        if isinstance(ref, Refusal):
            said = ref.message if ref.message.endswith(("?", ".")) else f"{ref.message}."
            self._problem(rule.error.span, f"{said} Or write one of {', '.join(GROUPS)}.")
            return None
        return _About(ref, "", states, tuple(map(self._made, rule.requirements)), rule.error.span)

    def _made(self, source: Requirement) -> Made:
        if source.form == "grade":
            return self._graded(source)
        scans = self._scans(source)
        condition = self._restarting(source.about) if source.form == "may_restart" else self._condition(source.about)
        until = None if source.until is None else self._condition(source.until)
        bad = [each for each in (condition, until, scans) if isinstance(each, str)]
        if bad:
            return Made(source, invalid=bad[0])
        assert isinstance(condition, Condition)
        assert isinstance(scans, int)
        assert not isinstance(until, str)
        return Made(source, condition, until, scans)

    def _graded(self, source: Requirement) -> Made:
        grade = GRADES.get(source.about.text.lower())
        if grade is not None:
            return Made(source, grade=grade)
        message = f"`{source.about.text}` is no grade; there are {', '.join(GRADES)}"
        return Made(source, invalid=self._problem(source.about.span, message))

    def _scans(self, source: Requirement) -> int | str:
        if source.time is None:
            return source.scans or 0
        found = self._locals.value(None, source.time.text)
        if isinstance(found, BadCondition):
            return self._problem(source.time.span, found.message)
        value = getattr(found.expr, "value", None)
        scans = value // self.program.interval_ns if isinstance(value, int) else 0
        if scans < 1:
            text = f"`{source.time.text}` is shorter than one scan ({self.program.interval_ns / 1e6:g} ms): give it more time"
            return self._problem(source.time.span, text)
        return scans

    def _condition(self, piece: Piece) -> Condition | str:
        found = self._locals.condition(None, piece.text)
        if isinstance(found, BadCondition):
            begin = piece.span.column + found.column - 1
            span = Span(piece.span.file, piece.span.line, begin, piece.span.line, max(begin + 1, piece.span.end_column))
            return self._problem(span, found.message)
        return Condition(found, tuple(self._parts(piece.text)))

    def _restarting(self, piece: Piece) -> Condition | str:
        found = self._locals.value(None, piece.text)
        return self._problem(piece.span, found.message) if isinstance(found, BadCondition) else Condition(found, ())

    def _parts(self, text: str) -> Iterator[Local]:
        text = joined(self.program, text)
        node = parsed(text)
        if isinstance(node, BadCondition):
            return
        for part in dict.fromkeys(_shown(node, text)):
            found = self._locals.value(None, part)
            if not isinstance(found, BadCondition):
                yield found

    def _problem(self, span: Span, message: str) -> str:
        self.problems.append(Problem(CODE, f"{message} The requirement is not checked.", span, Severity.WARNING))
        return message


def settled(program: Program, ref: ErrorRef) -> ErrorRef | Refusal:
    """With the details that were given, each written as everywhere: `unit=3`, not `unit=03`."""
    entry = find_error(program.layout.model, ref.id)
    chosen = entry if isinstance(entry, Refusal) else choose(entry, dict(ref.details), program.layout)
    if isinstance(chosen, Refusal):
        return chosen
    given = {name for name, _ in ref.details}
    return ErrorRef(ref.id, tuple(each for each in chosen.details if each[0] in given))


def whole(program: Program, ref: ErrorRef) -> ErrorRef:
    """With all its details, given or not; as it is where it is unknown."""
    entry = program.layout.model.error(ref.id)
    chosen = None if entry is None else choose(entry, dict(ref.details), program.layout)
    return ref if chosen is None or isinstance(chosen, Refusal) else ErrorRef(ref.id, chosen.details)


def rules_of(program: Program, sources: Mapping[str, str]) -> Rules:
    """The requirements of the sources of a program; none where there is no such file."""
    name = next((each for each in sources if is_requirements(each)), None)
    return Rules(program, RequirementsText() if name is None else read_requirements(sources[name], name))


def problems_of(program: Program | None, sources: Mapping[str, str]) -> list[Problem]:
    """What is wrong with the requirements; without a program only what their text says."""
    if program is not None:
        return rules_of(program, sources).problems
    return [
        each
        for name, text in sources.items()
        if is_requirements(name)
        for each in read_requirements(text, name).problems
    ]


def _in(rule: _About, state: str | None) -> bool:
    return not rule.states or (state is not None and state.casefold() in map(str.casefold, rule.states))


def _shown(node: tree.Expression, text: str) -> Iterator[str]:
    """The variables, addresses and elements in an expression, as they are written."""
    match node:
        case (
            tree.Name()
            | tree.MemberOf()
            | tree.IndexOf()
            | tree.PartialAccess()
            | tree.DirectAddress()
            | tree.Dereference()
        ):
            yield text[node.span.column - 1 : node.span.end_column - 1].strip()
        case tree.UnaryOp():
            yield from _shown(node.operand, text)
        case tree.BinaryOp():
            yield from _shown(node.left, text)
            yield from _shown(node.right, text)
        case tree.Call():
            for each in node.arguments:
                if each.value is not None:
                    yield from _shown(each.value, text)
        case _:
            return
