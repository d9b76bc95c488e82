"""The files of a project -> one PLCopen file: TC6 2.01, or IEC 61131-10 made of it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from functools import partial
from typing import cast

from lxml import etree

from scanbench.syntax import tree
from scanbench.syntax.chart import Chart
from scanbench.syntax.lexer import tokenize
from scanbench.syntax.networks import NetworkBody, Rung
from scanbench.syntax.parse_file import is_in_plant, is_program_file, parse_file
from scanbench.syntax.parse_type import POU_ENDS
from scanbench.syntax.plcopen.write_chart import write_chart
from scanbench.syntax.plcopen.write_declarations import write_initial, write_sections, write_type
from scanbench.syntax.plcopen.write_diagram import DiagramWriter
from scanbench.syntax.plcopen.write_ladder import LadderWriter
from scanbench.syntax.plcopen.write_objects import OF_NETWORK, CannotWrite, Known, Objects, add, paragraph, text
from scanbench.syntax.plcopen.write_part10 import SPACE, to_part10
from scanbench.syntax.source import Source, Stretch
from scanbench.syntax.xml_tree import Element

XHTML = "http://www.w3.org/1999/xhtml"
NAMESPACE = "http://www.plcopen.org/xml/tc6_0201"
KINDS = {"program": "program", "function": "function", "function_block": "functionBlock"}
_ENDS = POU_ENDS | {"ACTION", "METHOD", "PROPERTY"}
NO_TIME = "1970-01-01T00:00:00"
"""The same project makes the same bytes."""


@dataclass(slots=True)
class Written:
    data: bytes
    left_out: list[str] = field(default_factory=list)
    """What the format has no place for, by POU, type or file."""


class Form(StrEnum):
    """PLCopen's TC6 XML 2.01, or IEC 61131-10."""

    TC6 = "tc6"
    PART10 = "iec61131-10"


def write_project(name: str, files: Mapping[str, str], form: Form = Form.TC6) -> Written:
    """Files with errors are left out as a whole, and told."""
    root = etree.Element("project", nsmap=cast(dict[str, str], {None: NAMESPACE, "xhtml": XHTML}))
    add(root, "fileHeader", companyName="", productName="Scanbench", productVersion="0.1.0", creationDateTime=NO_TIME)
    info = add(add(root, "contentHeader", name=name), "coordinateInfo")
    for language in ("fbd", "ld", "sfc"):
        add(add(info, language), "scaling", x="1", y="1")
    types = add(root, "types")
    data_types, pous = add(types, "dataTypes"), add(types, "pous")
    configurations = add(add(root, "instances"), "configurations")
    left: list[str] = []
    read: list[tree.File] = []
    for path, content in files.items():
        if not is_program_file(path) or is_in_plant(path):
            continue
        file, problems = parse_file(Source(path, content))
        if problems:
            left.append(f"{path}, the whole of it: it has problems: {problems[0].message}")
        else:
            read.append(file)
    inputs = {pou.name.upper(): _inputs(pou) for file in read for pou in file.pous if pou.kind == "function"}
    for file in read:
        _file(file, (data_types, pous, configurations), inputs, left)
    _globals(configurations, read, left)
    if form is Form.PART10:
        root = to_part10(root, left)
    for each in root.iter(etree.Element):
        each.attrib.pop(OF_NETWORK, "")
        if "}" not in str(each.tag):
            each.tag = f"{{{NAMESPACE if form is Form.TC6 else SPACE}}}{each.tag}"
    data = etree.tostring(root, xml_declaration=True, encoding="utf-8", pretty_print=True)
    return Written(data, left)


def _inputs(pou: tree.PouDeclaration) -> tuple[str, ...]:
    sections = (each for each in pou.sections if each.keyword in ("VAR_INPUT", "VAR_IN_OUT"))
    return tuple(variable.name for section in sections for variable in section.variables)


def _file(
    file: tree.File, into: tuple[Element, Element, Element], inputs: Mapping[str, tuple[str, ...]], left: list[str]
) -> None:
    data_types, pous, configurations = into
    for each in file.types:
        _tried(data_types, each.name, left, partial(_type, data_types, each))
    for pou in file.pous:
        _tried(pous, pou.name, left, partial(_pou, pous, pou, inputs, left))
    for one in file.configurations:
        _tried(configurations, one.name, left, partial(_configuration, configurations, one))


def _globals(configurations: Element, files: Sequence[tree.File], left: list[str]) -> None:
    """Global variables outside of a CONFIGURATION come into the first one; where there is none, into one that runs nothing, which is read
    as variables alone."""
    for file in files:
        for section in file.globals:
            if section.list_name or section.namespace:
                left.append(f"{file.name}: a list of global variables with a name, or in a NAMESPACE")
                continue
            found = next(iter(configurations), None)
            into = add(configurations, "configuration", name="Config") if found is None else found
            _tried(into, file.name, left, partial(write_sections, into, [section]))


def _tried(parent: Element, name: str, left: list[str], make: Callable[[], None]) -> None:
    """What cannot be written is left out as a whole."""
    before = len(parent)
    try:
        make()
    except CannotWrite as why:
        del parent[before:]
        left.append(f"{name}, the whole of it: {why}")


def _type(parent: Element, each: tree.TypeDeclaration) -> None:
    made = add(parent, "dataType", name=each.name)
    write_type(add(made, "baseType"), each.type)
    if each.initial is not None:
        write_initial(add(made, "initialValue"), each.initial)


def _pou(parent: Element, pou: tree.PouDeclaration, inputs: Mapping[str, tuple[str, ...]], left: list[str]) -> None:
    if pou.kind not in KINDS or pou.extends or pou.implements or pou.namespace:
        raise CannotWrite(f"a {pou.kind} with EXTENDS, IMPLEMENTS or in a NAMESPACE")
    made = add(parent, "pou", name=pou.name, pouType=KINDS[pou.kind])
    interface = add(made, "interface")
    if pou.result is not None:
        write_type(add(interface, "returnType"), pou.result)
    write_sections(interface, pou.sections)
    actions = [each for each in pou.methods if not each.sections and each.result is None and each.kind == "method"]
    left += [f"{pou.name}: {each.kind} {each.name}" for each in pou.methods if each not in actions]
    listed = add(made, "actions") if actions else None
    types = {
        each.name.upper(): text(each.type)
        for section in pou.sections
        for each in section.variables
        if isinstance(each.type, tree.NamedType)
    }
    known = Known(types, inputs)
    for action in actions:
        if listed is not None:
            _body(add(add(listed, "action", name=action.name), "body"), action.body, known)
    _body(add(made, "body"), pou.body, known)


def _body(parent: Element, body: object, known: Known) -> None:
    match body:
        case Chart():
            write_chart(Objects(add(parent, "SFC")), body, known)
        case NetworkBody():
            _networks(parent, body, known)
        case tree.IlBody():
            paragraph(add(parent, "IL"), _source(body.span))
        case tuple():
            paragraph(add(parent, "ST"), _statements(body))


def _networks(parent: Element, body: NetworkBody, known: Known) -> None:
    # a ladder may have objects of block diagrams between its rungs
    ladder = not body.networks or any(isinstance(each, Rung) for each in body.networks)
    objects = Objects(add(parent, "LD" if ladder else "FBD"))
    rungs, diagrams = LadderWriter(objects, known), DiagramWriter(objects, known)
    for each in body.networks:
        if isinstance(each, Rung):
            rungs.rung(each)
        else:
            diagrams.diagram(each)


def _source(span: object) -> str:
    assert isinstance(span, Stretch)
    return span.source.text[span.start : span.end]


def _statements(statements: Sequence[tree.Statement]) -> str:
    """From the first to the last, with the comments between them."""
    if not statements:
        return ""
    first, last = statements[0].span, statements[-1].span
    assert isinstance(first, Stretch)
    assert isinstance(last, Stretch)
    whole = first.source.text
    tokens, _ = tokenize(Source("body", whole[last.start :]))
    ended = (at for at, word in zip(tokens.starts, tokens.texts, strict=False) if word.upper() in _ENDS)
    return whole[first.start : last.start + next(ended, len(whole))].rstrip()


def _configuration(parent: Element, one: tree.Configuration) -> None:
    if one.settings or one.accesses:
        raise CannotWrite("VAR_CONFIG or VAR_ACCESS")
    made = add(parent, "configuration", name=one.name)
    resources = one.resources or (tree.ResourceDeclaration("PLC", (), one.tasks, one.programs, one.span),)
    for each in resources:
        resource = add(made, "resource", name=each.name)
        for task in each.tasks:
            if task.single is not None:
                raise CannotWrite(f"the task {task.name} with SINGLE")
            time = {"interval": text(task.interval)} if task.interval is not None else {}
            node = add(
                resource, "task", name=task.name, priority="0" if task.priority is None else text(task.priority), **time
            )
            for program in each.programs:
                if (program.task or "").upper() == task.name.upper():
                    add(node, "pouInstance", name=program.name, typeName=program.type.name)
        write_sections(resource, each.globals)
        for program in each.programs:
            if program.connections or program.block_tasks:
                raise CannotWrite(f"connections of the program {program.name}")
            if program.task is None:
                add(resource, "pouInstance", name=program.name, typeName=program.type.name)
    write_sections(made, one.globals)
