"""Checks of a project that changes a little from one to the next.

What is kept: the tree of each chunk of text, all declarations, and the checked body of each POU. A body holds as long as its
own text and all declarations are the same; spans move by themselves (`Source.above`). Where anything else changes, all is
checked again; but where only problems are asked for, what was found in bodies that cannot see the change is found again. So the
programs of one `Checks` share POUs: only the newest is to be run, and the one before it may run on natively.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, fields

from scanbench.check.affected import SIZES, Words, inner_changes, tainted, tells_enumerators
from scanbench.check.body.notes import Looks
from scanbench.check.build import (
    ENABLING,
    Checked,
    Checker,
    checker_of,
    concluded,
    program_files,
    with_user_errors,
)
from scanbench.check.context import Report
from scanbench.check.declare.names import qualified
from scanbench.check.dialect import Dialect
from scanbench.check.dialect_table import IEC, dialect_in
from scanbench.garbage import without_collection
from scanbench.plcmodel.as_used import as_used
from scanbench.plcmodel.model import Model
from scanbench.program.program import Pou
from scanbench.syntax import tree
from scanbench.syntax.chunks import Chunk, Chunked, read
from scanbench.syntax.objects import joined
from scanbench.syntax.parse_file import is_stimulus

_TELLS_PLACE = re.compile(r"\bline \d|:\d+:\d+")


class Checks:
    """Checks the projects of a server, or of one PLC; remembers some."""

    def __init__(self, limit: int = 1) -> None:
        self._limit = limit
        self._known: list[Project] = []

    def check(self, sources: Mapping[str, str], model: Model, interval_ns: int) -> Checked:
        """What `check_sources` finds."""
        return with_user_errors(self._changed(sources, model, interval_ns, whole=True).checked, sources, model)

    def diagnose(self, sources: Mapping[str, str], model: Model, interval_ns: int) -> Checked:
        """The same, but the program may be missing though nothing is wrong."""
        return with_user_errors(self.project(sources, model, interval_ns).checked, sources, model)

    def project(self, sources: Mapping[str, str], model: Model, interval_ns: int) -> "Project":
        """What is known of these sources, besides what is wrong with them; good until the next call."""
        return self._changed(sources, model, interval_ns, whole=False)

    def _changed(self, files: Mapping[str, str], model: Model, interval_ns: int, whole: bool) -> "Project":
        sources, dialect = program_files(files), dialect_in(files)
        found = (each for each in self._known if each.dialect == dialect and each.is_about(sources, model, interval_ns))
        project = next(found, None)
        if project is None:
            project = Project(model, interval_ns, dialect)
            project.check_all(sources)
        else:
            self._known.remove(project)
            with without_collection():  # which would look through all that is known, for an edit of one line
                project.change(sources, whole)
        self._known.insert(0, project)
        del self._known[self._limit :]
        return project


@dataclass(slots=True)
class _Edit:
    """One chunk that was parsed again."""

    file: str
    chunk: Chunk
    before: tree.PouDeclaration | None
    """Its POU before."""
    moved: bool
    """Whether lines below it are others now."""


@dataclass(slots=True)
class Project:
    """The sources of one project, read and checked."""

    model: Model
    interval_ns: int
    dialect: Dialect = IEC
    files: dict[str, Chunked] = field(init=False)
    checker: Checker = field(init=False)
    checked: Checked = field(init=False)
    whole: bool = False
    """Whether all bodies are there, and not only what was found in them."""
    words: Words = field(default_factory=Words)
    looks: Looks = field(default_factory=Looks)

    def is_about(self, sources: Mapping[str, str], model: Model, interval_ns: int) -> bool:
        """Whether these are likely an edit of the same files."""
        same = self.interval_ns == interval_ns and list(self.files) == list(sources)
        return same and (self.model is model or self.model == model)

    def start(self) -> None:
        """Checks everything that was read."""
        files = list(self.files.values())
        self.checker = checker_of(files, self.model, self.looks, self.dialect)
        with without_collection():
            self.checked = concluded(files, self.checker.report, self.checker.run(self.interval_ns))
        self.whole = True

    def change(self, sources: Mapping[str, str], whole: bool) -> None:
        """Checks what changed; a program comes out only if it is to be `whole`."""
        edited = {name: text for name, text in sources.items() if text != self.files[name].text}
        if not edited and (self.whole or not whole):
            return
        if edited and self.whole and all(map(is_stimulus, edited)):
            self._retable(edited)
            return
        edits: list[_Edit] = []
        for name, text in edited.items():
            found = self._edits(name, text)
            if found is None:
                self.check_all(sources)
                return
            edits += found
        # spans of kept trees move by themselves, but what tells a place in words does not
        telling = self._telling() if any(edit.moved for edit in edits) else set()
        if telling is None:
            self.check_all(sources)
            return
        looked_at = self.looks.at(chunk for file in self.files.values() for chunk in file.chunks)
        used = as_used(self.model, (file.text for file in self.files.values()))
        if (whole and not self.whole) or looked_at != self.checker.looked_at or used is not self.checker.model:
            self.start()
            return
        bodies = [self._changed_body(edit) for edit in edits]
        told = self._declarations_of(telling)
        if len(told) < len(telling):
            self.check_all(sources)
        elif None not in bodies:
            again = {body[0]: body[1] for body in bodies if body is not None}
            for pou, declaration in (told | again).items():
                self.checker.recheck(pou, declaration)
            self._finish()
        elif whole or not self._redeclare(edits, telling):
            self.start()

    def _retable(self, edited: Mapping[str, str]) -> None:
        """Takes other tables of inputs, which no body sees."""
        for name, text in edited.items():
            self.files[name] = read(name, text, self.dialect.defines)
        self.checker.parsed = joined([file.file for file in self.files.values()])[0]
        self._finish()

    def _finish(self) -> None:
        program = self.checker.finish(self.interval_ns)
        files = list(self.files.values())
        self.checked = concluded(files, self.checker.report, program, self.whole)

    def _redeclare(self, edits: list[_Edit], telling: set[Pou]) -> bool:
        """Declares everything again, and checks only bodies that may see what changed; false when that cannot be told."""
        files = [file.file for file in self.files.values()]
        if not all(_is_plain(edit.before) and _is_plain(edit.chunk.pou) for edit in edits):
            return False
        if self.checker.is_generic:
            return False
        if any(each.block_tasks for file in files for conf in file.configurations for each in _programs(conf)):
            return False  # the last pass looks into bodies then
        seeing = self._seeing(edits)
        before, self.checker = self.checker, checker_of(list(self.files.values()), self.model, self.looks, self.dialect)
        self.checker.declare()
        if next(iter(self.checker.pous.classes.methods()), None) is not None or before.pous.dispatchers:
            return False
        self.whole = False
        again = _Successors(before, self.checker)
        for declaration in self.checker.names.user:
            found = None if id(declaration.span) in seeing else again.of(declaration, telling)
            if found is None:
                self.checker.check_body(declaration)
            else:
                self.checker.reuse(*found)
        self._finish()
        return True

    def _seeing(self, edits: list[_Edit]) -> set[int]:
        """The POUs, by the identity of their spans, whose bodies may see what changed in declarations."""
        chunks = [chunk for file in self.files.values() for chunk in file.chunks]
        edited = {id(edit.chunk) for edit in edits}
        names = [pou.name for edit in edits for pou in (edit.before, edit.chunk.pou) if pou is not None]
        changed = tainted(names, chunks, self.words)
        inner = [inner_changes(edit.before, edit.chunk.pou) for edit in edits if edit.before and edit.chunk.pou]
        members = None if None in inner else frozenset[str]().union(*(each for each in inner if each is not None))
        wrong = {pou.name.upper() for pou, part in self.checker.report.parts.items() if part.problems}
        seeing = set()
        for chunk in chunks:
            if chunk.pou is None:
                continue
            words = self.words.of(chunk)
            # whoever cannot see a member that changed sees nothing, unless near matches of a wrong name are to be told
            name = qualified(chunk.pou.namespace, chunk.pou.name).upper()
            sees = members is None or name in wrong or not words.isdisjoint(members | SIZES)
            if id(chunk) in edited or (sees and not words.isdisjoint(changed)):
                seeing.add(id(chunk.pou.span))
        return seeing

    def check_all(self, sources: Mapping[str, str]) -> None:
        """Reads and checks everything."""
        with without_collection():
            self.files = {name: read(name, text, self.dialect.defines) for name, text in sources.items()}
        self.start()

    def _edits(self, name: str, text: str) -> list[_Edit] | None:
        """Takes the file's new text; None when more than POUs changed."""
        file = self.files[name]
        before = {id(chunk): (chunk.pou, chunk.source.text.count("\n")) for chunk in file.chunks}
        chunks = file.edited(text)
        if chunks is None:
            return None
        made = []
        for chunk in chunks:
            pou, lines = before[id(chunk)]
            made.append(_Edit(name, chunk, pou, chunk.source.text.count("\n") != lines))
        return made

    def _changed_body(self, edit: _Edit) -> tuple[Pou, tree.PouDeclaration] | None:
        """The POU to be checked again, if nothing but its body changed."""
        old, new, names = edit.before, edit.chunk.pou, self.checker.names
        if old is None or new is None or self.checker.is_generic:
            return None  # what is generic is made for those who use it
        if edit.file in self.checker.enabling:
            old, new = names.with_enable("", old), names.with_enable("", new)
        elif ENABLING.search(edit.chunk.source.text):
            return None
        if old.methods or not _same_declarations(old, new):
            return None
        key = qualified(new.namespace, new.name).upper()
        pous = self.checker.pous
        pou = (pous.functions if new.kind == "function" else pous.blocks).get(key)
        if pou is None or pou not in self.checker.frames or pou.inline or pou.span != new.span:
            return None
        return pou, new

    def _telling(self) -> set[Pou] | None:
        """POUs in whose bodies something was found that tells a place in words; None when that was not in a body."""
        parts = self.checker.report.parts
        inside = {id(problem) for part in parts.values() for problem in part.problems}
        others = [problem for problem in self.checker.report.problems if id(problem) not in inside]
        others += [problem for file in self.files.values() for problem in file.problems]
        if any(_TELLS_PLACE.search(problem.message) for problem in others):
            return None
        own = ((pou, part) for pou, part in parts.items() if not pou.inline)  # the library does not move
        return {pou for pou, part in own if any(map(_TELLS_PLACE.search, _said(part)))}

    def _declarations_of(self, pous: set[Pou]) -> dict[Pou, tree.PouDeclaration]:
        """Declarations of those that are programs, blocks or functions."""
        found = {}
        for declaration in self.checker.names.user:
            key = qualified(declaration.namespace, declaration.name).upper()
            tables = self.checker.pous
            pou = (tables.functions if declaration.kind == "function" else tables.blocks).get(key)
            if pou is not None and pou in pous:
                found[pou] = declaration
        return found


def _same_declarations(old: tree.PouDeclaration, new: tree.PouDeclaration) -> bool:
    """Whether two POUs of one place differ in their bodies only; that one of them names ENO is part of its declarations."""
    return all(getattr(old, each.name) == getattr(new, each.name) for each in fields(old) if each.name != "body")


def _said(part: Report) -> list[str]:
    return [*(problem.message for problem in part.problems), *(site.needless for site in part.checks)]


def _programs(configuration: tree.Configuration) -> tuple[tree.ProgramDeclaration, ...]:
    resources = configuration.resources
    return (*configuration.programs, *(program for each in resources for program in each.programs))


def _is_plain(pou: tree.PouDeclaration | None) -> bool:
    """Whether others see nothing of its declarations but by its name."""
    return pou is not None and not pou.methods and not pou.namespace and not tells_enumerators(pou)


class _Successors:
    """The POUs of a checker, for those of the checker before it."""

    def __init__(self, before: Checker, now: Checker) -> None:
        self._before, self._now = before, now
        tables = ((before.pous.functions, now.pous.functions), (before.pous.blocks, now.pous.blocks))
        self._pous = {old: new[key] for olds, new in tables for key, old in olds.items() if key in new}

    def of(self, declaration: tree.PouDeclaration, telling: set[Pou]) -> tuple[Pou, Report, dict[Pou, int]] | None:
        """The POU that is declared here, what was found in its body before, and whom that calls."""
        key = qualified(declaration.namespace, declaration.name).upper()
        function = declaration.kind == "function"
        old = (self._before.pous.functions if function else self._before.pous.blocks).get(key)
        part = None if old is None else self._before.report.parts.get(old)
        if old is None or part is None or old not in self._pous or old in telling:
            return None
        uses = self._before.pous.uses.get(old, {})
        if any(callee not in self._pous for callee in uses):
            return None
        return self._pous[old], part, {self._pous[callee]: places for callee, places in uses.items()}
