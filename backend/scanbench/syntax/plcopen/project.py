"""A PLCopen file (TC6 1.01, 2.0, 2.01, and IEC 61131-10 by the names of TC6) -> the files of a project, and what became of each POU."""

from collections.abc import Iterator, Mapping
from itertools import count

from lxml import etree

from scanbench.syntax.imported import Project, Read
from scanbench.syntax.language_file import LANGUAGE_FILE, DialectName, language_text
from scanbench.syntax.parse_file import parse_file
from scanbench.syntax.plcopen import notes
from scanbench.syntax.plcopen.chart import Chart
from scanbench.syntax.plcopen.declarations import (
    duration_text,
    section_text,
    sections_text,
    type_declaration,
    type_text,
)
from scanbench.syntax.plcopen.diagram import Diagram
from scanbench.syntax.plcopen.document import own_data, parse
from scanbench.syntax.plcopen.elements import Thing, things_in
from scanbench.syntax.plcopen.grouping import networks_of
from scanbench.syntax.plcopen.ladder import NoLadder, Rung
from scanbench.syntax.plcopen.write_objects import text
from scanbench.syntax.source import Source
from scanbench.syntax.xml_tree import Element, attribute, child, children, kind, line_of, text_of

WORDS = {"functionBlock": "FUNCTION_BLOCK", "function": "FUNCTION", "program": "PROGRAM"}
DIALECTS: Mapping[str, DialectName] = {"codesys": "codesys", "sysmac": "omron"}
"""By the product that says that it wrote the file."""
CONFIGURATION = "Configuration.st"
QUOTE = "'"
LANGUAGES = ("ST", "IL", "LD", "FBD", "SFC")


def read_project(data: bytes) -> Project:
    """Raises `BadXml` where the file cannot be read at all."""
    root = parse(data)
    made = Project(attribute(child(root, "contentHeader"), "name") or "PLCopen")
    types = list(children(child(root, "types", "dataTypes"), "dataType"))
    for space in dict.fromkeys(attribute(each, "namespace") for each in types):
        own = "".join(type_declaration(each) for each in types if attribute(each, "namespace") == space)
        made.files[_file(space, "Types")] = _in_namespace(space, f"TYPE\n{own}END_TYPE\n")
    for each in children(child(root, "types", "pous"), "pou"):
        name, body = attribute(each, "name"), next(children(child(each, "body"), *LANGUAGES), None)
        space = attribute(each, "namespace")
        read = Read(name, line_of(each), "" if body is None else kind(body))
        made.pous.append(read)
        path = _free(_file(space, name), made.files)
        if path != _file(space, name):
            read.notes.append(notes.same_name(path))
        made.files[path] = _in_namespace(space, _pou(each, read))
    for each in children(child(root, "types", "pous"), "unread"):
        said = notes.not_read(attribute(each, "name"), line_of(each))
        made.pous.append(Read(attribute(each, "name"), line_of(each), "", [said], refused=True))
    configurations = "".join(
        _configuration(each) for each in children(child(root, "instances", "configurations"), "configuration")
    )
    if configurations:
        made.files[CONFIGURATION] = configurations
    for each in own_data(root, "globalVars"):
        name = attribute(each, "name") or "GVL"
        made.files[f"{name}.TcGVL"] = _global_list(name, each)
    product = attribute(child(root, "fileHeader"), "productName").lower()
    for word, dialect in DIALECTS.items():
        if word in product:
            made.files[LANGUAGE_FILE] = language_text(dialect)
    return made


def _file(space: str, name: str) -> str:
    return f"{space}.{name}.st" if space else f"{name}.st"


def _free(path: str, files: Mapping[str, str]) -> str:
    """The name of a file that is not there yet, whatever the case of its letters."""
    taken = {each.upper() for each in (*files, CONFIGURATION)}
    names = (path if number == 1 else f"{path.removesuffix('.st')}_{number}.st" for number in count(1))
    return next(each for each in names if each.upper() not in taken)


def _in_namespace(space: str, text: str) -> str:
    return f"NAMESPACE {space}\n{text}END_NAMESPACE\n" if space else text


def _global_list(name: str, node: Element) -> str:
    """A list of global variables that is named in the program: only files of this kind have a name for their variables."""
    text = section_text(node).replace("]]>", "]] >")
    return (
        f'<?xml version="1.0" encoding="utf-8"?>\n<TcPlcObject>\n  <GVL Name="{name}">\n'
        f"    <Declaration><![CDATA[{text}]]></Declaration>\n  </GVL>\n</TcPlcObject>\n"
    )


def _pou(node: Element, read: Read) -> str:
    word = WORDS.get(attribute(node, "pouType"), "FUNCTION_BLOCK")
    conditions = {
        attribute(each, "name").upper(): _body(child(each, "body"), read)
        for each in children(child(node, "transitions"), "transition")
    }
    actions = "".join(
        f"ACTION {attribute(each, 'name')}:\n{_body(child(each, 'body'), read)}END_ACTION\n"
        for each in children(child(node, "actions"), "action")
    )
    own = "".join(_method(each, read) for each in children(node, "method"))
    body = "".join(_body(each, read, conditions) for each in children(node, "body"))
    methods = ", ".join(attribute(each, "name") for each in own_data(node, "Method", "Property"))
    read.notes += [notes.not_read(attribute(each, "name"), line_of(each)) for each in children(node, "unread")]
    if methods:
        read.notes.append(notes.no_methods(methods))
    return f"{_head(node, word, read.pou)}{actions}{own}{body}END_{word}\n"


def _method(node: Element, read: Read) -> str:
    words = " ".join(each for each in ("METHOD", attribute(node, "words")) if each)
    body = "".join(_body(each, read) for each in children(node, "body"))
    return f"{_head(node, words, attribute(node, 'name'))}{body}END_METHOD\n"


def _head(node: Element, words: str, name: str) -> str:
    """What is declared: as text where the file has it as text, else of its elements."""
    declared = text_of(child(node, "declaration"))
    if declared:
        return f"{declared}\n"
    interface = child(node, "interface")
    result = child(interface, "returnType")
    bases = "".join(
        f" {word.upper()} {attribute(node, word)}" for word in ("extends", "implements") if attribute(node, word)
    )
    return f"{words} {name}{bases}{f' : {type_text(result)}' if result is not None else ''}\n{sections_text(interface)}"


def _body(body: Element | None, read: Read, conditions: dict[str, str] | None = None) -> str:
    """The text of a body, in its own language."""
    found = next(children(body, *LANGUAGES), None)
    unread = child(body, "unread")
    if body is not None and unread is not None:
        read.notes.append(notes.not_read(f"a body in {attribute(unread, 'name')}", line_of(body)))
        read.refused = True
        return ""
    if found is None:
        if body is not None and any(True for _ in children(body)):
            read.notes.append(notes.NO_LANGUAGE)
            read.refused = True
        return ""
    language = kind(found)
    if language in ("ST", "IL"):
        paragraphs = [text_of(each) for each in children(found)] or [text_of(found)]
        written = "\n".join(paragraphs).replace("\r\n", "\n").strip("\n")
        return f"{written}\n" if written.strip() else ""
    if language == "SFC":
        chart = Chart(found, lambda inline: _body(inline, read), conditions or {})
        made = chart.text()
        read.notes += chart.notes
        return made
    return "".join(_networks(found, language, read))


def _networks(body: Element, language: str, read: Read) -> Iterator[str]:
    things = things_in(body)
    for each in things:
        if each.kind == "unread":
            read.notes.append(notes.not_read(each.name, each.line))
            read.refused = True
    rails = {each.id for each in things if each.kind in ("leftPowerRail", "rightPowerRail")}
    comments = sorted((each for each in things if each.kind == "comment" and each.name), key=lambda each: each.place)
    label: Thing | None = None
    numbers, types = count(1), _types(body)
    word = "RUNG" if language == "LD" else "NETWORK"

    def head(before: tuple[float, ...]) -> str:
        """Label and title, of the comments that come before."""
        nonlocal label
        said = []
        while comments and comments[0].place < before:
            said.append(comments.pop(0).name)
        written = f" {label.name}:" if label is not None else ""
        label = None
        return f"{written} {_title(' '.join(said))}" if said else written

    for group in networks_of(things, language == "LD", attribute(body, "order") == "given"):
        own = [each for each in group if each.kind not in ("label", "unread")]
        for each in (one for one in group if one.kind == "label"):
            if label is not None:
                yield f"{word}{head(label.place)}\nEND_{word}\n"
            label = each
        if own and _does_something(own):
            yield _network(own, rails, head(min(each.place for each in own)), language, numbers, types, read)
    if label is not None:
        yield f"{word}{head(label.place)}\nEND_{word}\n"


def _types(body: Element) -> dict[str, str]:
    """Those of the variables of the POU around a body, by name in upper case."""
    around = [each for each in body.iterancestors() if kind(each) in ("pou", "method")]
    found: dict[str, str] = {}
    for each in reversed(around):
        file, _ = parse_file(Source("declaration.st", f"{_head(each, 'PROGRAM', 'Own')}END_PROGRAM\n"))
        for section in (one for pou in file.pous for one in pou.sections):
            found |= {one.name.upper(): text(one.type) for one in section.variables}
    return found


def _title(text: str) -> str:
    return f"'{text.replace('$', '$$').replace(QUOTE, f'${QUOTE}')}'"


def _does_something(group: list[Thing]) -> bool:
    return any(each.kind not in ("inVariable", "continuation", "connector") for each in group)


def _network(
    group: list[Thing],
    rails: set[str],
    head: str,
    language: str,
    numbers: Iterator[int],
    types: Mapping[str, str],
    read: Read,
) -> str:
    if language == "LD":
        try:
            return f"RUNG{head}\n    {Rung(group, rails).elements()}\nEND_RUNG\n"
        except NoLadder:
            read.notes.append(notes.no_ladder(min(each.line for each in group)))
    diagram = Diagram(group, rails, numbers, types)
    written = diagram.text(head)
    read.notes += diagram.notes
    return written


def _configuration(node: Element) -> str:
    name = attribute(node, "name") or "Config"
    inner = sections_text(node)
    for resource in children(node, "resource"):
        own = sections_text(resource)
        tasks, programs = "", ""
        for task in children(resource, "task"):
            interval = attribute(task, "interval")
            said = f"INTERVAL := {duration_text(interval)}, " if interval else ""
            tasks += f"TASK {attribute(task, 'name')}({said}PRIORITY := {attribute(task, 'priority', '0')});\n"
            for each in children(task, "pouInstance"):
                programs += f"PROGRAM {attribute(each, 'name')} WITH {attribute(task, 'name')} : {attribute(each, 'typeName')};\n"
        for each in children(resource, "pouInstance"):
            programs += f"PROGRAM {attribute(each, 'name')} : {attribute(each, 'typeName')};\n"
        inner += f"RESOURCE {attribute(resource, 'name') or 'PLC'} ON PLC\n{own}{tasks}{programs}END_RESOURCE\n"
    if not _runs_something(node):  # it would run none: as without a configuration, all of them run
        return "".join((sections_text(node), *(sections_text(each) for each in children(node, "resource"))))
    return f"CONFIGURATION {name}\n{inner}END_CONFIGURATION\n"


def _runs_something(configuration: Element) -> bool:
    return any(kind(each) == "pouInstance" for each in configuration.iter(etree.Element))
