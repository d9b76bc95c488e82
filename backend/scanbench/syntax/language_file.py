"""`language.json`: which dialect of Structured Text the programs of a project are written in, which names of libraries they
write before others, and what becomes of values outside of subranges; and a guess of the dialect for imported programs.

It is one of the project's files, so each version, archive and run file has the dialect that its programs were checked in.
"""

import json
import posixpath
import re
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Literal, get_args

from scanbench.problems import Problem, Severity, Span
from scanbench.syntax.objects import OBJECTS, is_export, unclosed
from scanbench.syntax.parse_file import XML_ENDINGS, is_program_file
from scanbench.syntax.pragmas import POLICIES
from scanbench.syntax.scl import is_scl

LANGUAGE_FILE = "language.json"
"""The name of the file, at the top of a project."""
PACKAGE_FILE = "apax.yml"
"""The file of a package of SIMATIC AX."""
FORMAT = 4
"""Version 1 had no `namespaces`. Before version 3 the strings of CODESYS and TwinCAT began with their length here, and a project
keeps that: its programs were laid out so; nor were there `defines`. Version 4 has `subranges`. A file is written in the first version
that says the same."""
BYTES_SINCE = 3
"""The version since which a string is its bytes up to the first 0, where the dialect has that."""
DialectName = Literal["iec", "codesys", "twincat", "siemens", "rockwell", "omron"]
DIALECTS: tuple[DialectName, ...] = get_args(DialectName)
STRICT: DialectName = "iec"
"""The dialect of a project that names none: IEC 61131-3 as it is."""
WHOLE_PROJECT = "*"
"""The name in `subranges` of what is said of all that says nothing itself."""
_KEYS = ("version", "dialect", "namespaces", "defines", "subranges")
_PATH = re.compile(r"[^\W\d]\w*(\.[^\W\d]\w*)*")
_TWINCAT_MARKS = re.compile(r"\bTc[23]_\w+|\bT_MaxString\b|\bT_AmsNetId\b")
_TWINCAT_2_MARKS = re.compile(
    r"\b(FB_Socket\w+|ADS(READ|WRITE|RDSTATE|LOG\w+)\w*|MEM(SET|CPY|CMP|MOVE)|SystemTaskInfo(Arr)?|FB_FileOpen|FB_LocalSystemTime|NT_GetTime)\b",
    re.IGNORECASE,
)
"""What libraries of TwinCAT 2 declare; in a text of CODESYS 2.3 they say whose it is, where nothing declares them itself."""
_EXPORTED = re.compile(r"^\s*\(\*\s*@(NESTEDCOMMENTS|PATH|OBJECTFLAGS|END_DECLARATION)\s*:=", re.MULTILINE)
"""What CODESYS 2.3, and TwinCAT 2 with it, write into each `.exp`."""
_COPIED_MARKS = re.compile(
    r"\b(SMC_\w+|AXIS_REF_SM3|SM3_\w+|SMCB\.)|\b(AND_THEN|OR_ELSE)\b|^\s*\{attribute\s+'", re.MULTILINE
)
"""What a text of CODESYS may have that no strict one has; asked for only where no file closes its POU."""
_CODESYS_MARKS = re.compile(
    r"^\s*\(\*\s*@(NESTEDCOMMENTS|PATH|OBJECTFLAGS|SYMFILEFLAGS)\b|^\s*\{attribute\s+'", re.MULTILINE
)


def is_language_file(path: str) -> bool:
    """Whether a file of this path says in which dialect its project is written."""
    return posixpath.basename(path.replace("\\", "/")) == LANGUAGE_FILE


def is_package(path: str) -> bool:
    """Whether a file of this path says what a package of SIMATIC AX is."""
    return posixpath.basename(path.replace("\\", "/")).lower() == PACKAGE_FILE


@dataclass(frozen=True, slots=True)
class Policy:
    """What becomes of a value outside of its subrange, one of `POLICIES`, and where the file says so."""

    word: str
    span: Span


@dataclass(frozen=True, slots=True)
class Language:
    """What the file says."""

    dialect: DialectName = STRICT
    namespaces: tuple[str, ...] = ()
    """Names of libraries whose texts are among the project's own: `Lib.Name` is `Name`."""
    version: int = FORMAT
    defines: tuple[str, ...] = ()
    """Names that are defined for conditional pragmas, as a TwinCAT project's compiler defines are."""
    subranges: Mapping[str, Policy] = field(default_factory=dict, hash=False)
    """By the name of a variable (`Main.speed`), a type or a POU, as it is written there, or `WHOLE_PROJECT`."""


def language_text(
    dialect: DialectName, namespaces: Collection[str] = (), version: int = FORMAT, defines: Collection[str] = (),
    subranges: Mapping[str, str] | None = None,
) -> str:  # fmt: skip
    """The text of the file for a dialect, in this version or in the first one that says the same."""
    least = FORMAT if subranges else BYTES_SINCE if defines else 2 if namespaces else 1
    written = max(least, min(version, BYTES_SINCE)) if dialect in ("codesys", "twincat") else least
    said: dict[str, object] = {"version": written, "dialect": dialect}
    if namespaces:
        said["namespaces"] = sorted(namespaces)
    if defines:
        said["defines"] = sorted(defines)
    if subranges:
        said["subranges"] = dict(subranges)
    return json.dumps(said, indent=2) + "\n"


def with_dialect(sources: Mapping[str, str], dialect: DialectName, name: str = LANGUAGE_FILE) -> dict[str, str]:
    """The sources, in this dialect whatever they say themselves; `name` is that of the file if they have none."""
    own = next((each for each in sources if is_language_file(each)), name)
    said = language_of(sources)[0]
    version = said.version if said.dialect == dialect else FORMAT
    return {**sources, own: language_text(dialect, said.namespaces, version, said.defines, _words(said))}


def with_dialect_by_format(
    sources: Mapping[str, str], name: str = LANGUAGE_FILE, others: Iterable[str] = ()
) -> dict[str, str]:
    """The sources, in the dialect of their files' format if they name none; `name` is that of the file that says so then.

    `others` are names of files beside them, which may say whose tool wrote them: a package of SIMATIC AX has `.st` files, too.
    """
    of_format = dialect_by_text(sources)
    if of_format == STRICT and any(map(is_package, others)):
        of_format = "siemens"
    if of_format == STRICT or any(map(is_language_file, sources)):
        return dict(sources)
    return with_dialect(sources, of_format, name)


def with_subranges(
    sources: Mapping[str, str], policies: Mapping[str, str], name: str = LANGUAGE_FILE
) -> dict[str, str]:  # fmt: skip
    """The sources, which say this, and nothing else, of values outside of subranges."""
    own = next((each for each in sources if is_language_file(each)), name)
    said = language_of(sources)[0]
    return {**sources, own: language_text(said.dialect, said.namespaces, said.version, said.defines, policies)}


def with_namespaces(
    sources: Mapping[str, str], namespaces: Collection[str], name: str = LANGUAGE_FILE, defines: Collection[str] = ()
) -> dict[str, str]:
    """The sources, which say these names of libraries besides their own, and define these names where their version can."""
    if not namespaces and not defines:
        return dict(sources)
    own = next((each for each in sources if is_language_file(each)), name)
    said = language_of(sources)[0]
    all_defines = {*said.defines, *(defines if said.version >= BYTES_SINCE else ())}
    names = {*said.namespaces, *namespaces}
    return {**sources, own: language_text(said.dialect, names, said.version, all_defines, _words(said))}


def _words(said: Language) -> dict[str, str]:
    return {name: policy.word for name, policy in said.subranges.items()}


def dialect_named(name: str) -> DialectName | None:
    """The dialect of this name, in any case."""
    return next((each for each in DIALECTS if each == name.strip().lower()), None)


def dialect_of(sources: Mapping[str, str]) -> tuple[DialectName, list[Problem]]:
    """The dialect that these files are written in, and what is wrong with the file that says so."""
    language, problems = language_of(sources)
    return language.dialect, problems


def language_of(sources: Mapping[str, str]) -> tuple[Language, list[Problem]]:
    """What these files say of their language, and what is wrong with the file that says so."""
    names = [name for name in sources if is_language_file(name)]
    if not names:
        return Language(), []
    found = _read(sources[names[0]], names[0])
    problems = [] if isinstance(found, Language) else [found]
    for name in names[1:]:
        message = f"A program has one {LANGUAGE_FILE}, and {names[0]} is it already: delete this one."
        problems.append(_problem(name, message))
    return (found if isinstance(found, Language) else Language()), problems


def defined_in(sources: Mapping[str, str]) -> frozenset[str]:
    """The names, in upper case, that these files define for conditional pragmas; and OBJECTS, where each is an object."""
    language = language_of(sources)[0]
    copied = language.dialect in ("codesys", "twincat") and unclosed(sources)
    objects = {OBJECTS} if copied or is_export(sources) else ()
    return frozenset((*objects, *(each.upper() for each in language.defines)))


def _read(text: str, file: str) -> Language | Problem:
    choice = f'Write {{"version": {BYTES_SINCE}, "dialect": "codesys"}}; the dialects are {", ".join(DIALECTS)}.'
    try:
        content = json.loads(text)
    except (ValueError, RecursionError) as error:
        return _problem(file, f"This is no JSON ({error}). {choice}", getattr(error, "lineno", 1))
    if not isinstance(content, dict):
        return _problem(file, f"This does not name a dialect. {choice}")
    version = content.get("version", 1)
    if not isinstance(version, int):
        return _problem(file, f"`version` is a number. {choice}")
    if version > FORMAT:
        return _problem(file, f"This is version {version} of {LANGUAGE_FILE}, which a newer Scanbench reads.")
    unknown = next((key for key in content if key not in _KEYS), None)
    if unknown is not None:
        return _problem(file, f"There is no setting `{unknown}`. {choice}")
    name = content.get("dialect", STRICT)
    dialect = dialect_named(name) if isinstance(name, str) else None
    if dialect is None:
        return _problem(file, f"There is no dialect `{name}`. {choice}")
    for key, example in (("namespaces", "Tc2_Utilities"), ("defines", "WithHeater")):
        if not _names(content.get(key, [])):
            return _problem(file, f'`{key}` is a list of names, as ["{example}"].')
    for key, since in (("defines", BYTES_SINCE), ("subranges", FORMAT)):
        if version < since and key in content:
            return _problem(file, f'`{key}` needs "version": {since}.')
    policies = _policies(content.get("subranges", {}), text, file)
    if isinstance(policies, Problem):
        return policies
    return Language(dialect, tuple(content.get("namespaces", [])), version, tuple(content.get("defines", [])), policies)


def _policies(value: object, text: str, file: str) -> dict[str, Policy] | Problem:
    """What the file says of values outside of subranges."""
    words, example = "', '".join(POLICIES), '{"*": "report", "Main.speed": "trap"}'
    if not isinstance(value, dict):
        return _problem(file, f"`subranges` has names of variables, types and POUs, as {example}.")
    made = dict[str, Policy]()
    for name, word in value.items():
        at = text.find(f'"{name}"')
        line = text.count("\n", 0, max(at, 0)) + 1
        if name != WHOLE_PROJECT and not _PATH.fullmatch(name):
            return _problem(file, f"`{name}` is no name of a variable, a type or a POU. Write them as {example}.", line)
        if word not in POLICIES:
            return _problem(file, f"One of '{words}' expected for `{name}`, found `{word}`.", line)
        if any(name.upper() == each.upper() for each in made):
            return _problem(file, f"`{name}` is there twice; remove one.", line)
        made[name] = Policy(word, Span(file, line, 1, line, 2))
    return made


def _names(value: object) -> bool:
    return isinstance(value, list) and all(isinstance(each, str) and each.isidentifier() for each in value)


def _problem(file: str, message: str, line: int = 1) -> Problem:
    return Problem("S003", message, Span(file, line, 1, line, 2), Severity.ERROR)


def dialect_by_format(names: Iterable[str]) -> DialectName:
    """The dialect that files of these names are written in: of a format that only one vendor's tool writes; else the strict one."""
    for name in map(str.lower, names):
        if name.endswith((".plcproj", ".tsproj", *XML_ENDINGS)):
            return "twincat"
        if name.endswith((".scl", ".udt")):
            return "siemens"
        if name.endswith(".l5x"):
            return "rockwell"
    return STRICT


def dialect_by_text(sources: Mapping[str, str]) -> DialectName:
    """The same, of formats that only the texts tell: exports of CODESYS. Nothing is guessed by what any program may have."""
    if is_export(sources) or (unclosed(sources) > 1 and any(map(_COPIED_MARKS.search, sources.values()))):
        return "codesys"
    exported = [text for name, text in sources.items() if name.lower().endswith(".exp") and _EXPORTED.search(text)]
    if exported:
        return "twincat" if any(map(_of_twincat_2, exported)) else "codesys"
    return dialect_by_format(sources)


def _of_twincat_2(text: str) -> bool:
    return _TWINCAT_MARKS.search(text) is not None or _TWINCAT_2_MARKS.search(text) is not None


def guess_dialect(files: Mapping[str, str], others: Iterable[str] = ()) -> DialectName:
    """The dialect that imported programs are probably written in; `others` are files that were not taken over."""
    names = [name.lower() for name in (*files, *others)]
    if (of_format := dialect_by_format(names)) != STRICT:
        return of_format
    programs = [text for name, text in files.items() if is_program_file(name)]
    of_text = dialect_by_text(files)
    if any(map(_TWINCAT_MARKS.search, programs)) or of_text == "twincat":
        return "twincat"
    exported = of_text == "codesys" or any(name.endswith((".exp", ".project", ".export")) for name in names)
    if exported or any(map(_CODESYS_MARKS.search, programs)):
        return "codesys"
    if any(name.endswith(".awl") or is_package(name) for name in names) or any(map(is_scl, files)):
        return "siemens"
    if any(name.endswith(".acd") for name in names):
        return "rockwell"
    return "omron" if any(name.endswith((".smc2", ".cxp", ".cxt")) for name in names) else STRICT
