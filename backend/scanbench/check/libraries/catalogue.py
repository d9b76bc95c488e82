"""The libraries that Scanbench has: each is one text of this folder, and becomes a file of the project that uses it.

There it is like every text of the project: it is kept with each version and in run files, can be read, stepped through and
changed, so no run depends on which version of a library Scanbench has later.
"""

import posixpath
import re
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from scanbench.syntax import tree
from scanbench.syntax.language_file import DialectName, defined_in
from scanbench.syntax.parse_file import is_program_file, is_stimulus, parse_file
from scanbench.syntax.parse_st import parse_st
from scanbench.syntax.source import Source

FOLDER = "libraries"
"""Of a project: the file `libraries/Util.st` is the library `Util`, whose name may be written before what it declares."""
PLACEHOLDERS = "Placeholders"
"""The library that takes the place of those that a project refers to and nobody has."""
SHIPPED: dict[str, tuple[DialectName, ...]] = {
    "__HEAP": ("codesys", "twincat"),
    "__SYSTEM": ("codesys", "twincat"),
    "AxUnit": ("siemens",),
    "CAA": ("codesys",),
    "FILE": ("codesys",),
    "IBaseLibrary": ("twincat",),
    "Libc": ("codesys",),
    "Logix": ("rockwell",),
    "SM3_Basic": ("codesys",),
    "Siemens": ("siemens",),
    "SiemensDevices": ("siemens",),
    "SiemensS5": ("siemens",),
    "Standard64": ("codesys", "twincat"),
    "SysLibs": ("codesys",),
    "System": ("siemens",),
    "Tc2_ControllerToolbox": ("twincat",),
    "Tc2_Drive": ("twincat",),
    "Tc2_EtherCAT": ("twincat",),
    "Tc2_MC2": ("twincat",),
    "Tc2_Math": ("twincat",),
    "Tc2_ModbusSrv": ("twincat",),
    "Tc2_SUPS": ("twincat",),
    "Tc2_SerialCom": ("twincat",),
    "Tc2_System": ("twincat",),
    "Tc2_TcpIp": ("twincat",),
    "Tc2_Utilities": ("twincat",),
    "Tc3_EventLogger": ("twincat",),
    "Tc3_IotBase": ("twincat",),
    "Tc3_JsonXml": ("twincat",),
    "Tc3_Module": ("twincat",),
    "Tc3_PackML_V2": ("twincat",),
    "TcUnit": ("twincat",),
    "TwinCAT_SystemInfoVarList": ("twincat",),
    "Util": ("codesys", "twincat"),
}
"""Each name, and the dialects that it is written in."""
ALWAYS = frozenset("__HEAP __SYSTEM IBaseLibrary TwinCAT_SystemInfoVarList".split())
"""Those that a project of TwinCAT has without a reference."""
UNSET = {"_TASKINFO": "_TaskInfo", "_APPINFO": "_AppInfo", "SYSTEMTASKINFOARR": "SystemTaskInfoArr"}
"""Global variables of libraries that the vendor's controller sets, and nothing here: whoever uses one is told."""
NEEDED_BY = {
    "__HEAP": frozenset({"__NEW", "__DELETE"}),
    "AxUnit": frozenset({"AXUNIT", "AXUNIT.ASSERT", "AXUNIT.MOCKING", "AXUNIT.RESULTFUNCTIONS"}),
    "Siemens": frozenset(
        {"CLOCK_0", "CLOCK_1", "CLOCK_2", "NORM_X", "SCALE_X", "SWAP", "STRG_VAL", "VAL_STRG", "S_CONV"}
    ),
    "System": frozenset(
        "SYSTEM.TIMER SYSTEM.COUNTERS SYSTEM.EDGEDETECTION SYSTEM.STRINGS SYSTEM.DATETIME SYSTEM.SERIALIZATION SIEMENS.SIMATIC".split()
    ),
}
"""Operators, instructions and namespaces that use a library without a name that it declares."""
NAMED_BY = {
    "TcUnit": frozenset({"FB_TESTSUITE"}),
    "SiemensS5": frozenset(
        "S5TIME S5T S_PULSE S_PEXT S_ODT S_ODTS S_OFFDT S_CU S_CD S_CUD S5TIME_TO_TIME TIME_TO_S5TIME".split()
    ),
}
"""Libraries whose other names are words that programs have for themselves, RUN, TEST or TIMER: these names say that one is used."""
_WORD = re.compile(r"\b[A-Z_]\w*")
_IN_NAMESPACE = re.compile(r"\b(?=([A-Z_]\w*\.[A-Z_]\w*))")
NO_CODE = re.compile(r"\(\*.*?\*\)|/\*.*?\*/|//[^\n]*|'(?:\$.|[^'\n])*'", re.DOTALL)


@dataclass(frozen=True, slots=True)
class Library:
    """One of them."""

    name: str
    dialects: tuple[DialectName, ...]
    text: str
    about: str
    """What it is, in a sentence."""
    source: str
    """The address of its documentation; both are in the comment that its text begins with."""
    declared: tuple[tree.PouDeclaration | tree.TypeDeclaration, ...]
    names: frozenset[str]
    """All that it declares, in upper case; what is in a namespace with its name in front."""
    words: frozenset[str]
    """All words of its text, in upper case, and all that have a name in front."""

    @property
    def named_by(self) -> frozenset[str]:
        """What a program writes that uses it: its names, or its own name before another, also before one of the standard."""
        before = f"{self.name.upper()}."
        names = NAMED_BY.get(self.name, self.names)
        inside = any(name.startswith(before) for name in names)
        return names if inside else names | {before}

    @property
    def path(self) -> str:
        """Where it is in a project."""
        return f"{FOLDER}/{self.name}.st"

    @property
    def stubs(self) -> tuple[str, ...]:
        """Names of its POUs without a real body."""
        return tuple(each.name for each in self.declared if isinstance(each, tree.PouDeclaration) and each.stub)


def catalogue() -> tuple[Library, ...]:
    """All of them, by name."""
    return tuple(map(_library, SHIPPED))


def _of_dialect(dialect: DialectName) -> list[Library]:
    """Those of a dialect; no other text is read for that."""
    return [_library(name) for name, dialects in SHIPPED.items() if dialect in dialects]


def library_named(name: str) -> Library | None:
    """The one of this name, in any case."""
    return next((each for each in catalogue() if each.name.lower() == name.lower()), None)


def library_of_file(path: str) -> str | None:
    """The library that a file of a project is; None of all others."""
    folder, name = posixpath.split(path.replace("\\", "/"))
    stem, point, ending = name.rpartition(".")
    return stem if posixpath.basename(folder) == FOLDER and point and ending.lower() == "st" else None


def used_libraries(
    sources: Mapping[str, str], dialect: DialectName, only: Collection[str] | None = None
) -> list[Library]:
    """The libraries of the dialect that declare what these programs name and do not have themselves; those that they use as well.
    With `only`, what a program names is of these libraries, in any case, or of those that every project has."""
    possible = _of_dialect(dialect)
    if not possible:
        return []
    named = None if only is None else {each.lower() for each in (*only, *ALWAYS)}
    first = [each for each in possible if named is None or each.name.lower() in named]
    texts = {name: text for name, text in sources.items() if is_program_file(name) and not is_stimulus(name)}
    known = defined_in(sources)
    files = [parse_file(Source(path, text, defined=known))[0] for path, text in texts.items()]
    own = {name for file in files for name in _names(file)}
    have = {library.lower() for path in texts if (library := library_of_file(path))}
    wanted = {word for text in texts.values() for word in _words(text)} - own
    wanted |= {f"{word.partition('.')[0]}." for word in wanted if "." in word}
    found = [each for each in first if not wanted.isdisjoint(each.named_by)]
    fresh = found
    while fresh:
        wanted = {word for each in fresh for word in each.words}
        fresh = [each for each in possible if each not in found and not wanted.isdisjoint(each.named_by)]
        found = found + fresh
    return [each for each in found if each.name.lower() not in have]


def where_declared(name: str, dialect: DialectName) -> str | None:
    """The library of the dialect that declares this name, perhaps with its own name before it."""
    wanted = {name.upper(), name.rpartition(".")[2].upper()}
    return next((each.name for each in _of_dialect(dialect) if wanted & each.names), None)


@cache
def _library(name: str) -> Library:
    text = files("scanbench.check").joinpath(f"libraries/{name}.st").read_text("utf-8")
    file, problems = parse_st(Source(f"{FOLDER}/{name}.st", text))
    assert not problems, problems
    about, _, source = " ".join(text.partition("(*")[2].partition("*)")[0].split()).partition(" From ")
    return Library(
        name,
        SHIPPED[name],
        text,
        about,
        source,
        (*file.types, *file.pous),
        frozenset(_names(file)) | NEEDED_BY.get(name, frozenset()),
        _words(text),
    )


def _words(text: str) -> frozenset[str]:
    """The words of a text outside of comments and literals."""
    code = NO_CODE.sub(" ", text).upper()
    return frozenset(_WORD.findall(code)) | frozenset(_IN_NAMESPACE.findall(code))


def _names(file: tree.File) -> Iterable[str]:
    yield from (_full(each).upper() for each in file.types)
    yield from (_full(each).upper() for each in file.pous)
    yield from (each.name.upper() for section in file.globals for each in section.variables)


def _full(declared: tree.PouDeclaration | tree.TypeDeclaration) -> str:
    return f"{declared.namespace}.{declared.name}".lstrip(".")
