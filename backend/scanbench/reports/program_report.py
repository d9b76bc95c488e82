"""How much of a program runs here: its POUs, its constructs, what stops the others, and which libraries it uses and misses."""

import re
from bisect import bisect
from collections import Counter, deque
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from scanbench.check.build import program_files
from scanbench.check.libraries.catalogue import NO_CODE, PLACEHOLDERS, library_of_file
from scanbench.problems import Problem, Severity, Span
from scanbench.syntax import tree
from scanbench.syntax.constructs import count_constructs
from scanbench.syntax.language_file import defined_in
from scanbench.syntax.parse_file import parse_file
from scanbench.syntax.source import Source

REFUSED = "X001"
OF_THE_WHOLE = "D011"
"""No program: an error of no POU."""


@dataclass(frozen=True, slots=True)
class FileReport:
    """One file: constructs that are supported by name, refused ones by message, and other errors."""

    name: str
    pous: int
    clean: int
    """POUs without an error of their own. Such a POU may still use one that has an error."""
    run: int
    """POUs that would run: neither they nor anything that they use has an error, and they are no stubs, which do nothing."""
    stubbed: int
    """Of these, POUs that use a stub, by whatever way."""
    placeheld: int
    """Of those that run, POUs that use a placeholder of a missing library, by whatever way."""
    aided: int
    """Of those that run, POUs that use one or the other."""
    supported: Counter[str]
    refused: Counter[str]
    errors: int


@dataclass(slots=True)
class _Unit:
    """One declaration: a POU, a type, a list of globals."""

    line: int
    names: tuple[str, ...]
    """What others use of it, in upper case."""
    is_pou: bool
    name: str = ""
    """As it is written, of a POU."""
    stub: bool = False
    wrong: Span | None = None
    """Where its first error is."""
    own: frozenset[str] = frozenset()
    """Its variables, in upper case: such a word in its text is no use of anything else."""
    words: set[str] = field(default_factory=set)
    """All words in its text, in upper case."""


@dataclass(frozen=True, slots=True)
class Cause:
    """A mistake that is the same but for the names in it."""

    code: str
    message: str
    """With `_` for each name that is not the same everywhere."""
    places: tuple[Span, ...]
    """Where each is."""
    pous: int
    """POUs that have it."""


@dataclass(frozen=True, slots=True)
class Waiting:
    """A POU without an error of its own that does not run."""

    pou: str
    place: Span
    """Where the first error is of what it needs, by whatever way."""


@dataclass(frozen=True, slots=True)
class ProgramReport:
    """What is said of a whole program."""

    files: tuple[FileReport, ...]
    """Those of the project itself; libraries are not counted."""
    causes: tuple[Cause, ...]
    """What stops most POUs comes first."""
    libraries: tuple[str, ...]
    """Those whose texts are among its files."""
    missing: tuple[str, ...]
    """Those that it refers to and has no text of."""
    stubs: tuple[Problem, ...]
    """What is told of each stub that it uses."""
    absent: tuple[str, ...] = ()
    """Files that its project lists and nobody has."""
    waiting: tuple[Waiting, ...] = ()
    """In the order of the files."""


WORD = re.compile(r"[A-Za-z_]\w*")
_PLACES = re.compile(r" It is used in \d+ places\.$")
_NAMED = re.compile(r"`[^`]*`")
STUB = "W008"


def program_report(
    sources: Mapping[str, str],
    problems: Sequence[Problem],
    missing: Collection[str] = (),
    own: Collection[str] | None = None,
    absent: Collection[str] = (),
) -> ProgramReport:
    """The report of a program of these files, in which its check found these problems. `missing` are libraries without a text, `absent`
    files of the project that nobody has. With `own`, only these files are reported, and what is wrong in them."""
    texts, defined = program_files(sources), defined_in(sources)
    trees = {name: parse_file(Source(name, text, defined=defined))[0] for name, text in texts.items()}
    files, waiting = _files(trees, texts, problems, own)
    if own is not None:
        problems = [each for each in problems if each.span.file in own]
    some = any(each.pous for each in files)  # a library stops at nothing where no program is
    errors = [each for each in problems if each.severity is Severity.ERROR and not (some and each.code == OF_THE_WHOLE)]
    return ProgramReport(
        tuple(files),
        _causes(errors, trees),
        tuple(sorted(library for name in texts if (library := library_of_file(name)))),
        tuple(missing),
        tuple(each for each in problems if each.code == STUB),
        tuple(absent),
        tuple(waiting),
    )


def joined(reports: Sequence[ProgramReport]) -> ProgramReport:
    """The report of several programs that are looked at together, none of which has a file of another."""
    same: dict[tuple[str, str], list[Cause]] = {}
    for each in (cause for report in reports for cause in report.causes):
        same.setdefault((each.code, _NAMED.sub("`_`", each.message)), []).append(each)
    causes = []
    for (code, general), found in same.items():
        message = _shared([each.message for each in found], general)
        places = tuple(place for each in found for place in each.places)
        causes.append(Cause(code, message, places, sum(each.pous for each in found)))
    return ProgramReport(
        tuple(each for report in reports for each in report.files),
        tuple(sorted(causes, key=_rank)),
        tuple(sorted({each for report in reports for each in report.libraries})),
        tuple(sorted({each for report in reports for each in report.missing}, key=str.lower)),
        tuple(each for report in reports for each in report.stubs),
        tuple(dict.fromkeys(each for report in reports for each in report.absent)),
        tuple(each for report in reports for each in report.waiting),
    )


def _shared(messages: Sequence[str], general: str) -> str:
    """Messages that are the same but for their names, with those names that are the same in all."""
    names = iter(zip(*(_NAMED.findall(each) for each in messages), strict=True))
    return _NAMED.sub(lambda _: found.pop() if len(found := set(next(names))) == 1 else "`_`", general)


def _rank(cause: Cause) -> tuple[int, int, str, str]:
    return -cause.pous, -len(cause.places), cause.code, cause.message


def _causes(errors: Sequence[Problem], trees: Mapping[str, tree.File]) -> tuple[Cause, ...]:
    begins = {name: [each.span.line for each in file.pous] for name, file in trees.items()}
    same: dict[tuple[str, str], list[Problem]] = {}
    for each in errors:
        same.setdefault((each.code, _NAMED.sub("`_`", each.message)), []).append(each)
    made = []
    for (code, general), found in same.items():
        pous = {(each.span.file, bisect(begins.get(each.span.file, []), each.span.line)) for each in found}
        message = _shared([each.message for each in found], general)
        made.append(Cause(code, message, tuple(each.span for each in found), len(pous)))
    return tuple(sorted(made, key=_rank))


def _files(
    files: Mapping[str, tree.File],
    texts: Mapping[str, str],
    problems: Sequence[Problem],
    wanted: Collection[str] | None,
) -> tuple[list[FileReport], list[Waiting]]:
    """A report of every file that is wanted, by the problems that its check found; and what does not run without an error of its own."""
    errors = [each for each in problems if each.severity is Severity.ERROR]
    units = {name: _units(file, texts[name], errors) for name, file in files.items()}
    every = [each for own in units.values() for each in own]
    _join(every, files.values())
    stopped = _reached(every, [each for each in every if each.wrong is not None])
    stubbed = _reached(every, [each for each in every if each.stub])
    held = [each for name, own in units.items() if library_of_file(name) == PLACEHOLDERS for each in own]
    placeheld = _reached(every, held)
    made, waiting = [], []
    for name, file in files.items():
        if library_of_file(name) or (wanted is not None and name not in wanted):
            continue
        own = [each for each in errors if each.span.file == name]
        refused = Counter(each.message for each in own if each.code == REFUSED)
        pous = [each for each in units[name] if each.is_pou]
        clean = [each for each in pous if each.wrong is None]
        causes = ((each, stopped[id(each)].wrong) for each in clean if id(each) in stopped)
        waiting += [Waiting(each.name, place) for each, place in causes if place is not None]
        run = [each for each in pous if id(each) not in stopped and not each.stub]
        with_stubs = sum(id(each) in stubbed for each in run)
        with_held = sum(id(each) in placeheld for each in run)
        aided = sum(id(each) in stubbed or id(each) in placeheld for each in run)
        counts = len(pous), len(clean), len(run), with_stubs, with_held, aided
        made.append(FileReport(name, *counts, count_constructs(file), refused, len(own) - refused.total()))
    return made, waiting


def _units(file: tree.File, text: str, errors: Sequence[Problem]) -> list[_Unit]:
    """What a file declares, in order, with the errors that are in the lines of each."""
    made = [
        _Unit(each.span.line, (each.name.upper(),), True, each.name, each.stub, own=_variables(each))
        for each in file.pous
    ]
    made += [_Unit(each.span.line, (each.name.upper(),), is_pou=False) for each in file.types]
    for member in file.members:
        own = frozenset[str]().union(*map(_variables, member.methods))
        made.append(_Unit(1, _name_of(member), is_pou=False, own=own))
    for section in file.globals:
        made.append(_Unit(section.span.line, tuple(each.name.upper() for each in section.variables), is_pou=False))
    made.sort(key=lambda each: each.line)
    begins = [each.line for each in made]
    for error in errors:
        at = bisect(begins, error.span.line) - 1
        if error.span.file == file.name and at >= 0 and error.code != OF_THE_WHOLE:
            made[at].wrong = made[at].wrong or error.span
    lines = text.split("\n")
    for each, end in zip(made, [*begins[1:], len(lines) + 1], strict=False):  # a file may declare nothing
        code = NO_CODE.sub(" ", "\n".join(lines[each.line - 1 : end - 1]))
        each.words = {word.upper() for word in WORD.findall(code)} - each.own
    return made


def _join(units: Sequence[_Unit], files: Iterable[tree.File]) -> None:
    """A POU uses its members that have files of their own; its variables are theirs."""
    pous = {each.names[0]: each for each in units if each.is_pou}
    apart = {each.names: each for each in units if not each.is_pou and each.names}
    for member in (each for file in files for each in file.members):
        owner, unit = pous.get(member.name.upper()), apart.get(_name_of(member))
        if owner is not None and unit is not None:
            owner.words.update(unit.names)
            unit.words -= owner.own


def _name_of(member: tree.PouDeclaration) -> tuple[str, ...]:
    """A word that no text has."""
    return (" ".join((member.name, *member.modifiers, *(each.name for each in member.methods))).upper(),)


def _variables(pou: tree.PouDeclaration) -> frozenset[str]:
    return frozenset(each.name.upper() for section in pou.sections for each in section.variables)


def _reached(units: Sequence[_Unit], first: Sequence[_Unit]) -> dict[int, _Unit]:
    """The units, by identity, that are among the first ones or use one of them, by whatever way; each with the one that it uses."""
    users: dict[str, list[_Unit]] = {}
    for each in units:
        for word in each.words:
            users.setdefault(word, []).append(each)
    open_ = deque(first)
    reached = {id(each): each for each in open_}
    while open_:
        used = open_.popleft()
        for name in used.names:
            for user in users.get(name, ()):
                if id(user) not in reached:
                    reached[id(user)] = reached[id(used)]
                    open_.append(user)
    return reached


def report_lines(report: ProgramReport) -> list[str]:
    """For people: a line a file, how many POUs run, what stops the others, libraries, then what the program uses."""
    reports = report.files
    width = max((len(each.name) for each in reports), default=3)
    whole = whole_of(reports)
    lines = [f"{'file':{width}}  POUs  run  with stubs  without errors  constructs  refused  other errors"]
    for each in [*reports, whole] if len(reports) > 1 else reports:
        lines.append(
            f"{each.name:{width}}  {each.pous:4}  {each.run:3}  {each.aided:10}  {each.clean:14}  "
            f"{each.supported.total():10}  {each.refused.total():7}  {each.errors:12}"
        )
    if whole.pous:
        lines += ["", *pou_lines(whole)]
    if report.causes:
        lines.append("a program runs when none of its files has an error")
    if report.missing:
        lines += ["", f"missing libraries: {', '.join(report.missing)}"]
    if report.absent:
        lines += ["", f"files that the project lists and that are missing: {', '.join(report.absent)}"]
    if report.libraries:
        lines += ["", f"libraries: {', '.join(report.libraries)}"]
    if report.stubs:
        lines += ["", "stubs:", *_stub_lines(report)]
    if report.causes:
        lines += ["", "  POUs  places  what stops them"]
        for cause in report.causes:
            lines.append(f"{cause.pous:6}  {len(cause.places):6}  {cause.code} {cause.message} ({cause.places[0]})")
    if report.waiting:
        lines += ["", "without an error of their own, and stopped by what they need:"]
        lines += [f"  {each.pou}: {each.place}" for each in report.waiting]
    return [*lines, "", "in use:", *(f"{count:6}  {name}" for name, count in whole.supported.most_common())]


def stubs_alike(report: ProgramReport) -> list[tuple[str, list[tuple[str, Span]]]]:
    """What is said of stubs, and the names and first uses of all of which the same is said."""
    same: dict[str, list[tuple[str, Span]]] = {}
    for each in report.stubs:
        name = each.message.partition("`")[2].partition("`")[0]
        general = _PLACES.sub("", each.message).replace(f"`{name}`", "`_`").replace(f"`Stub_{name}`", "`Stub__`")
        same.setdefault(general, []).append((name, each.span))
    return [*same.items()]


def _stub_lines(report: ProgramReport) -> Iterator[str]:
    for said, found in stubs_alike(report):
        if len(found) == 1:
            yield f"  {found[0][1]}: {said.replace('`_`', f'`{found[0][0]}`').replace('`Stub__`', f'`Stub_{found[0][0]}`')}"
            continue
        yield f"  {said}"
        yield from (f"    {name} ({place})" for name, place in found)


def pou_lines(whole: FileReport) -> list[str]:
    """How many POUs run, in sentences."""
    lines = [
        f"{whole.run} of {whole.pous} POUs ({_share(whole.run, whole.pous)}) run: neither they nor what they use has an error"
    ]
    if whole.stubbed:
        lines.append(f"{whole.stubbed} of these {whole.run} use stubs, whose results the user sets")
    if whole.placeheld:
        lines.append(
            f"{whole.placeheld} of these {whole.run} use placeholders: what a missing library or file declares is inferred from its use"
        )
    lines.append(f"{whole.clean} of {whole.pous} POUs ({_share(whole.clean, whole.pous)}) have no error of their own")
    return lines


def report_json(report: ProgramReport) -> dict[str, object]:
    """For machines: `files` has one object a file."""
    files = [
        {
            "file": each.name,
            "supported": dict(each.supported),
            "refused": dict(each.refused),
            "other_errors": each.errors,
            "pous": each.pous,
            "pous_without_errors": each.clean,
            "pous_that_run": each.run,
            "pous_that_run_with_stubs": each.stubbed,
            "pous_that_run_with_placeholders": each.placeheld,
            "pous_that_run_with_either": each.aided,
        }
        for each in report.files
    ]
    causes = [
        {"code": each.code, "message": each.message, "pous": each.pous, "places": [str(place) for place in each.places]}
        for each in report.causes
    ]
    waiting = [{"pou": each.pou, "place": str(each.place)} for each in report.waiting]
    stubs = [{"place": str(each.span), "message": each.message} for each in report.stubs]
    libraries, missing = list(report.libraries), list(report.missing)
    about = {"libraries": libraries, "missing_libraries": missing, "missing_files": list(report.absent)}
    return {"files": files, "causes": causes, "waiting": waiting, **about, "stubs": stubs}


def whole_of(reports: Sequence[FileReport]) -> FileReport:
    """All files as one."""
    supported: Counter[str] = Counter()
    refused: Counter[str] = Counter()
    for each in reports:
        supported += each.supported
        refused += each.refused
    counts = [(it.pous, it.clean, it.run, it.stubbed, it.placeheld, it.aided, it.errors) for it in reports]
    *sums, errors = map(sum, zip((0,) * 7, *counts, strict=True))
    pous, clean, run, stubbed, placeheld, aided = sums
    return FileReport("all", pous, clean, run, stubbed, placeheld, aided, supported, refused, errors)


def _share(part: int, whole: int) -> str:
    return f"{100 * part / whole:.1f} %"
