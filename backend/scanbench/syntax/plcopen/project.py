"""A PLCopen file (TC6 1.01, 2.0, 2.01) -> the files of a project, and what became of each POU."""

from collections.abc import Iterator
from itertools import count

from scanbench.syntax.imported import Project, Read
from scanbench.syntax.language_file import LANGUAGE_FILE, language_text
from scanbench.syntax.plcopen import notes
from scanbench.syntax.plcopen.chart import Chart, expression
from scanbench.syntax.plcopen.declarations import (
    duration_text,
    section_text,
    sections_text,
    type_declaration,
    type_text,
)
from scanbench.syntax.plcopen.diagram import Diagram
from scanbench.syntax.plcopen.document import own_data, parse
from scanbench.syntax.plcopen.elements import Thing, networks_of, things_in
from scanbench.syntax.plcopen.ladder import NoLadder, Rung
from scanbench.syntax.xml_tree import Element, attribute, child, children, kind, line_of, text_of

WORDS = {"functionBlock": "FUNCTION_BLOCK", "function": "FUNCTION", "program": "PROGRAM"}
LANGUAGES = ("ST", "IL", "LD", "FBD", "SFC")


def read_project(data: bytes) -> Project:
    """Raises `BadXml` where the file cannot be read at all."""
    root = parse(data)
    made = Project(attribute(child(root, "contentHeader"), "name") or "PLCopen")
    types = "".join(type_declaration(each) for each in children(child(root, "types", "dataTypes"), "dataType"))
    if types:
        made.files["Types.st"] = f"TYPE\n{types}END_TYPE\n"
    for each in children(child(root, "types", "pous"), "pou"):
        name, body = attribute(each, "name"), next(children(child(each, "body"), *LANGUAGES), None)
        read = Read(name, line_of(each), "" if body is None else kind(body))
        made.pous.append(read)
        made.files[f"{name}.st"] = _pou(each, read)
    configurations = "".join(
        _configuration(each) for each in children(child(root, "instances", "configurations"), "configuration")
    )
    if configurations:
        made.files["Configuration.st"] = configurations
    for each in own_data(root, "globalVars"):
        name = attribute(each, "name") or "GVL"
        made.files[f"{name}.TcGVL"] = _global_list(name, each)
    product = attribute(child(root, "fileHeader"), "productName")
    if "codesys" in product.lower():
        made.files[LANGUAGE_FILE] = language_text("codesys")
    return made


def _global_list(name: str, node: Element) -> str:
    """A list of global variables that is named in the program: only files of this kind have a name for their variables."""
    text = section_text(node).replace("]]>", "]] >")
    return (
        f'<?xml version="1.0" encoding="utf-8"?>\n<TcPlcObject>\n  <GVL Name="{name}">\n'
        f"    <Declaration><![CDATA[{text}]]></Declaration>\n  </GVL>\n</TcPlcObject>\n"
    )


def _pou(node: Element, read: Read) -> str:
    word = WORDS.get(attribute(node, "pouType"), "FUNCTION_BLOCK")
    interface = child(node, "interface")
    result = child(interface, "returnType")
    head = f"{word} {read.pou}{f' : {type_text(result)}' if result is not None else ''}\n"
    conditions = {
        attribute(each, "name").upper(): expression(_body(child(each, "body"), read))
        for each in children(child(node, "transitions"), "transition")
    }
    actions = "".join(
        f"ACTION {attribute(each, 'name')}:\n{_body(child(each, 'body'), read)}END_ACTION\n"
        for each in children(child(node, "actions"), "action")
    )
    body = "".join(_body(each, read, conditions) for each in children(node, "body"))
    methods = ", ".join(attribute(each, "name") for each in own_data(node, "Method", "Property"))
    if methods:
        read.notes.append(notes.no_methods(methods))
    return f"{head}{sections_text(interface)}{actions}{body}END_{word}\n"


def _body(body: Element | None, read: Read, conditions: dict[str, str] | None = None) -> str:
    """The text of a body, in its own language."""
    found = next(children(body, *LANGUAGES), None)
    if found is None:
        if body is not None and any(True for _ in children(body)):
            read.notes.append(notes.NO_LANGUAGE)
            read.refused = True
        return ""
    language = kind(found)
    if language in ("ST", "IL"):
        paragraphs = [text_of(each) for each in children(found)] or [text_of(found)]
        text = "\n".join(paragraphs).replace("\r\n", "\n").strip("\n")
        return f"{text}\n" if text.strip() else ""
    if language == "SFC":
        chart = Chart(found, lambda inline: _body(inline, read), conditions or {})
        made = chart.text()
        read.notes += chart.notes
        return made
    return "".join(_networks(found, language, read))


def _networks(body: Element, language: str, read: Read) -> Iterator[str]:
    things = things_in(body)
    rails = {each.id for each in things if each.kind in ("leftPowerRail", "rightPowerRail")}
    label, numbers = "", count(1)
    for group in networks_of(things, language == "FBD"):
        names = [each.name for each in group if each.kind == "label"]
        own = [each for each in group if each.kind != "label"]
        label = names[0] if names else label
        if not own or not _does_something(own):
            continue
        head = f" {label}:" if label else ""
        label = ""
        yield _network(own, rails, head, language, numbers, read)


def _does_something(group: list[Thing]) -> bool:
    return any(each.kind not in ("inVariable", "continuation", "connector") for each in group)


def _network(group: list[Thing], rails: set[str], head: str, language: str, numbers: Iterator[int], read: Read) -> str:
    if language == "LD":
        try:
            return f"RUNG{head}\n    {Rung(group, rails).elements()}\nEND_RUNG\n"
        except NoLadder:
            read.notes.append(notes.no_ladder(min(each.line for each in group)))
    diagram = Diagram(group, rails, numbers)
    text = diagram.text(head)
    read.notes += diagram.notes
    return text


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
    return f"CONFIGURATION {name}\n{inner}END_CONFIGURATION\n"
