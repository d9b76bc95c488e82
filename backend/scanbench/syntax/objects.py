"""Exports with a file for each object of a project: texts as scripts of CODESYS write them, whose declaration and implementation are
two texts of one object (`textual_declaration`, `textual_implementation`), and to which nothing says where they end.

- `Pump.st`: the declaration, a mark, the statements. Nothing closes the POU; one without statements may have no mark.
- `Pump.Run.st`: a METHOD, PROPERTY or ACTION of Pump, wherever it is; an action may be its statements alone.
- `Pump.Level.st` with marks for GET and SET, or only with its heading and `Pump.Level.Get.st`, `Pump.Level.Set.st` beside it.
- `Tank.st` or `Tank.gvl.st` that has only VAR_GLOBAL: the list `Tank`.

The marks are those of CODESCRIBE (`// --- BEGIN IMPLEMENTATION ---`, github.com/greenforge-labs/codescribe, src/import_export.py) and of
cds-text-sync (`// === IMPLEMENTATION ===`, `// === GET ===`, in its second version `// --- implementation ---`,
github.com/ArthurkaX/cds-text-sync and its reference project). Each file keeps its text; members come to their POU in `joined`.
"""

import posixpath
import re
from bisect import bisect_left
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from scanbench.problems import Problem, Severity
from scanbench.syntax import parse_declaration, parse_pou, tree
from scanbench.syntax.cursor import Cursor, Unexpected
from scanbench.syntax.lexer import AHEAD, Lex, Tokens, tokenize
from scanbench.syntax.parse_pou import ENDS, MEMBERS, with_member
from scanbench.syntax.parse_st import whole
from scanbench.syntax.source import Source

OBJECTS = "{OBJECTS}"
"""Among the names that a project defines, which no pragma can ask for: its files are such an export."""
MARK = re.compile(
    r"^[ \t]*(?://[ \t]*(?:---+|===+)[ \t]*(?:BEGIN[ \t]+)?(IMPLEMENTATION|GET|SET)[ \t]*(?:---+|===+)|"
    r"\(\*[ \t]*(IMPLEMENTATION)[ \t]*\*\))[ \t]*$",
    re.IGNORECASE | re.MULTILINE,
)
_CLOSED = re.compile(
    r"\bEND_(?:PROGRAM|FUNCTION(?:_BLOCK)?|METHOD|ACTION|PROPERTY|INTERFACE|CLASS|NAMESPACE)\b", re.IGNORECASE
)
_OPENED = re.compile(r"^[ \t]*(?:PROGRAM|FUNCTION_BLOCK|FUNCTION)[ \t]+\w", re.IGNORECASE | re.MULTILINE)
_LEFT_OUT = re.compile(r"^//%[ \t]*cds-text-sync\.exclude_from_build=true[ \t]*$", re.MULTILINE)
MEMBER = "member"
"""The kind of what has the name of a POU, and of it only the METHOD, ACTION or PROPERTY in `methods` that has a file of its own. Its
modifier is `get` or `set` for half a property, which has no type yet, and `heading` where nothing but the type is known of one."""
_HEADING = "heading"
_KINDS = frozenset(("gvl", "prg", "fb", "fun", "dut", "itf", "pou"))
"""What some scripts write before `.st` for the kind of an object."""
_WHOLES = frozenset((*ENDS, "TYPE"))


def is_export(sources: Mapping[str, str]) -> bool:
    """Whether these files are such an export: one has a mark, and nothing in it is closed."""
    return any(_is_marked(text) for name, text in sources.items() if name.lower().endswith(".st"))


def _is_marked(text: str) -> bool:
    # what is asked first costs next to nothing, also of very long texts
    if "IMPLEMENTATION" not in text and "implementation" not in text:
        return False
    return MARK.search(text) is not None and _CLOSED.search(text) is None


def unclosed(sources: Mapping[str, str]) -> int:
    """How many of these files have a POU, where none of the project's own closes one: texts as people copy them out of an editor,
    which never shows what closes a POU. Else 0, as then a missing END is a mistake."""
    found = 0
    for name, text in sources.items():
        path = name.replace("\\", "/")
        if not path.lower().endswith(".st") or posixpath.basename(posixpath.dirname(path)) == "libraries":
            continue
        if _CLOSED.search(text):
            return 0
        found += _OPENED.search(text) is not None
    return found


def is_object(name: str, defined: frozenset[str]) -> bool:
    """Whether a file of this name is an object of such an export."""
    return OBJECTS in defined and name.lower().endswith(".st")


def parse_object(source: Source) -> tuple[tree.File, list[Problem]]:
    """What the file of one object declares; members of a POU that has a file of its own are in `members`."""
    if _LEFT_OUT.search(source.text):
        return tree.File(source.name), []
    text = _Text(source)
    stem, owner, names = _named(source.name)
    first = text.words[0] if text.words else ""
    if first in MEMBERS and owner:
        return text.members(owner, first)
    if owner and first not in _WHOLES and first != "VAR_GLOBAL":
        if len(names) == 2 and names[1].upper() in ("GET", "SET"):
            return text.accessor(owner, names[0], names[1].lower())
        text.insert(0, ("ACTION", names[0], ":"), 0)
        return text.members(owner, "ACTION")
    if first in ENDS and ENDS[first] not in text.words:
        text.close(ENDS[first])
    cursor = text.cursor()
    cursor.list_name = stem if first == "VAR_GLOBAL" and _WHOLES.isdisjoint(text.words) else ""
    return whole(cursor)


def _named(path: str) -> tuple[str, str, list[str]]:
    """The name of the object; and of a member the POU, and the names below that: `Level`, or `Level` and `Get`."""
    parts = posixpath.basename(path.replace("\\", "/"))[: -len(".st")].split(".")
    if len(parts) > 1 and parts[-1].lower() in _KINDS:
        parts.pop()
    return parts[0], parts[0] if len(parts) in (2, 3) else "", parts[1:]


class _Text:
    """The tokens of a file, with those that it leaves unsaid."""

    def __init__(self, source: Source) -> None:
        self._source = source
        tokens, self._problems = tokenize(source)
        self._kinds, self._texts = tokens.kinds[:-AHEAD], tokens.texts[:-AHEAD]
        self._starts, self._pragmas = tokens.starts[:-AHEAD], tokens.pragmas
        self.words = [text.upper() for text in self._texts]

    def insert(self, at: int, texts: Sequence[str], start: int) -> None:
        """These tokens before the one of this number, all at one position of the text."""
        kinds = {":": Lex.OPERATOR} | {each: Lex.KEYWORD for each in texts if each.startswith("END_")}
        self._kinds[at:at] = [kinds.get(each, Lex.NAME) for each in texts]
        self._texts[at:at] = texts
        self._starts[at:at] = [start] * len(texts)
        self.words[at:at] = [each.upper() for each in texts]

    def close(self, *texts: str) -> None:
        """These tokens at the end."""
        self.insert(len(self._texts), texts, len(self._source.text))

    def cursor(self) -> Cursor:
        end = [len(self._source.text)] * AHEAD
        kinds, texts = [*self._kinds, *[Lex.END] * AHEAD], [*self._texts, *[""] * AHEAD]
        made = Cursor(self._source, Tokens(kinds, texts, [*self._starts, *end], self._pragmas))
        made.problems += self._problems
        return made

    def members(self, owner: str, first: str) -> tuple[tree.File, list[Problem]]:
        """A METHOD, ACTION or PROPERTY that begins here."""
        heading = False
        if first == "PROPERTY":
            heading = not self._accessors()
        if f"END_{first}" not in self.words:
            self.close(f"END_{first}")
        cursor = self.cursor()
        made = list[tree.PouDeclaration]()
        try:
            made += parse_pou.member(cursor, "INTERFACE" if heading else "FUNCTION_BLOCK")
            if not cursor.ended():
                raise cursor.fail("the end of the file expected, as it has one METHOD, ACTION or PROPERTY")
        except Unexpected:
            pass
        return self._file(cursor, owner, tuple(made), _HEADING if heading else "")

    def _accessors(self) -> bool:
        """Writes GET and SET where marks say them; whether there are any."""
        marks = [(found.start(), (found[1] or found[2]).upper()) for found in MARK.finditer(self._source.text)]
        said = [each for each in marks if each[1] != "IMPLEMENTATION"]
        if not said and marks and bisect_left(self._starts, marks[0][0]) < len(self._starts):
            said = [(marks[0][0], "GET")]
        end = len(self._texts)
        for number, (start, word) in reversed([*enumerate(said)]):
            at = bisect_left(self._starts, start)
            after = said[number + 1][0] if number + 1 < len(said) else len(self._source.text)
            self.insert(end, (f"END_{word}",), after)
            self.insert(at, (word,), start)
            end = at
        return not {"GET", "SET"}.isdisjoint(self.words)

    def accessor(self, owner: str, name: str, kind: str) -> tuple[tree.File, list[Problem]]:
        """The declaration and the statements of one half of a property, whose heading is in a file of its own."""
        cursor = self.cursor()
        sections = parse_declaration.sections(cursor)
        body: parse_pou.Body = ()
        try:
            body = parse_pou.whole_body(cursor)
            if not cursor.ended():
                raise cursor.fail("the end of the file expected")
        except Unexpected:
            pass
        made = tree.PouDeclaration(kind, name, None, sections, body, self._source.span(0, 1))
        return self._file(cursor, owner, (made,), kind)

    def _file(
        self, cursor: Cursor, owner: str, pous: tuple[tree.PouDeclaration, ...], part: str
    ) -> tuple[tree.File, list[Problem]]:
        parse_pou.check_pragmas(cursor)
        cursor.problems.sort(key=lambda problem: (problem.span.line, problem.span.column))
        span = pous[0].span if pous else self._source.span(0, 1)
        member = tree.PouDeclaration(MEMBER, owner, None, (), (), span, pous, modifiers=(part,) if part else ())
        return tree.File(self._source.name, members=[member]), cursor.problems


# ---- the files of a project -----------------------------------------------------------------------------------------


@dataclass(slots=True)
class _Owner:
    """A POU, and what other files have for it."""

    file: int
    pou: int
    found: list[tree.PouDeclaration]


def joined(files: Sequence[tree.File]) -> tuple[list[tree.File], list[Problem]]:
    """The same files, in which each POU has the members that have files of their own; and what is wrong with these."""
    if not any(file.members for file in files):
        return list(files), []
    owners: dict[str, list[_Owner]] = {}
    for at, file in enumerate(files):
        for number, pou in enumerate(file.pous):
            owners.setdefault(pou.name.upper(), []).append(_Owner(at, number, []))
    problems = []
    for file in files:
        for member in file.members:
            possible = owners.get(member.name.upper(), [])
            if possible:
                max(possible, key=lambda each: _nearness(files[each.file].name, file.name)).found.append(member)
            else:
                message = f"No file has the POU `{member.name}`, so this member of it is left out; export the POU as text, too."
                problems.append(Problem("D002", message, member.span, Severity.WARNING))
    made = [replace(file, pous=list(file.pous)) if file.pous else file for file in files]
    every = [owner for same in owners.values() for owner in same if owner.found]
    halves = _halves((files[each.file].pous[each.pou], each.found) for each in every)
    for each in every:
        pous = made[each.file].pous
        members, wrong = _members(pous[each.pou], each.found, halves)
        pous[each.pou] = with_member(pous[each.pou], members)
        problems += wrong
    return made, problems


def _nearness(one: str, other: str) -> int:
    """How many folders two files have in common."""
    return len(posixpath.commonpath([f"/{posixpath.dirname(each.replace(chr(92), '/'))}" for each in (one, other)]))


def _halves(
    owners: Iterable[tuple[tree.PouDeclaration, Sequence[tree.PouDeclaration]]],
) -> dict[tuple[str, str], set[str]]:
    """Of a property of an interface, of which an export may have nothing but the heading: the halves that all have who implement it."""
    made: dict[tuple[str, str], set[str]] = {}
    for owner, found in owners:
        own: dict[str, set[str]] = {}
        for each in (method for member in found if _HEADING not in member.modifiers for method in member.methods):
            if each.kind in ("get", "set"):
                own.setdefault(each.name.upper(), set()).add(each.kind)
        for interface in owner.implements:
            for name, kinds in own.items():
                key = interface.name.rpartition(".")[2].upper(), name
                made[key] = made.get(key, kinds) & kinds
    return made


def _members(
    owner: tree.PouDeclaration, found: Sequence[tree.PouDeclaration], halves: Mapping[tuple[str, str], set[str]]
) -> tuple[list[tree.PouDeclaration], list[Problem]]:
    """The members of a POU; the halves of a property get what its heading says."""
    heads = {each.methods[0].name.upper(): each for each in found if _HEADING in each.modifiers and each.methods}
    made, problems, halved = list[tree.PouDeclaration](), list[Problem](), set[str]()
    for each in found:
        if not {"get", "set"}.isdisjoint(each.modifiers):
            half = each.methods[0]
            halved.add(half.name.upper())
            head = heads.get(half.name.upper())
            if head is None:
                message = f"No file has the heading of the PROPERTY `{owner.name}.{half.name}`: `{owner.name}.{half.name}.st` is missing."
                problems.append(Problem("D002", message, each.span))
                continue
            said = head.methods[0]
            made.append(replace(half, name=said.name, result=said.result, access=said.access, modifiers=said.modifiers))
        elif _HEADING not in each.modifiers:
            made += each.methods
    for name, head in heads.items():
        if owner.kind == "interface" and name not in halved:
            known = halves.get((owner.name.upper(), name)) or {"get", "set"}
            made += (each for each in head.methods if each.kind in known)
        elif name not in halved:
            message = f"PROPERTY {head.methods[0].name} has neither GET nor SET: `{owner.name}.{head.methods[0].name}.Get.st` is missing."
            problems.append(Problem("S003", message, head.span))
    return made, problems
