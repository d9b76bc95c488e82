"""A file of IEC 61131-10 -> the elements of TC6, which say the same by other names: one reader serves both.

What Sysmac Studio, Bachmann and PLCnext write is known from files of theirs; no chart of one has been seen, and none is read.
"""

from collections.abc import Iterator

from lxml import etree

from scanbench.syntax.plcopen.part10_bodies import add_body
from scanbench.syntax.plcopen.write_objects import add
from scanbench.syntax.xml_tree import Element, attribute, child, children, kind, number_of, of_type, text_of

POUS = {"Program": "program", "FunctionBlock": "functionBlock", "Function": "function"}
PARAMETERS = {"InputVars": "inputVars", "OutputVars": "outputVars", "InoutVars": "inOutVars"}
SAID = ("Documentation", "AddData", "UsingDirective")
"""What says nothing about a program, or is read with what it belongs to."""
INSIDE = ("Extends", "Implements", "ResultType", "Parameters", "MainBody", "Action", "Transition", "Method")
SECTIONS = {"Vars": "localVars", "TempVars": "tempVars", "ExternalVars": "externalVars", "GlobalVars": "globalVars"}


def to_tc6(root: Element) -> Element:
    """The element `project` for one of `Project`, or of a POU that is a file by itself."""
    project = etree.Element("project")
    header = child(root, "FileHeader")
    maker = f"{attribute(header, 'companyName')} {attribute(header, 'productName')}"
    add(project, "fileHeader", productName=maker.strip())
    name = attribute(child(root, "ContentHeader"), "name") or attribute(root, "name")
    add(project, "contentHeader", name=name)
    types = add(project, "types")
    data_types, pous = add(types, "dataTypes"), add(types, "pous")
    if kind(root) in POUS:
        _pou(pous, root, "")
    _namespace((data_types, pous), child(root, "Types", "GlobalNamespace"), "")
    configurations = add(add(project, "instances"), "configurations")
    for each in children(child(root, "Instances"), "Configuration"):
        _configuration(configurations, each)
    return project


def _namespace(into: tuple[Element, Element], node: Element | None, name: str) -> None:
    for each in children(node):
        match kind(each):
            case "NamespaceDecl":
                inner = attribute(each, "name")
                _namespace(into, each, f"{name}.{inner}" if name else inner)
            case "DataTypeDecl":
                made = _copy(into[0], "dataType", each, name=attribute(each, "name"), namespace=name)
                _spec(add(made, "baseType"), child(each, "UserDefinedTypeSpec"))
            case found if found in POUS:
                _pou(into[1], each, name)
            case found if found not in SAID:
                _unread(into[1], each)


def _copy(parent: Element, name: str, node: Element, /, **attributes: str) -> Element:
    """An element that is in the line of the one that it is made of."""
    made = add(parent, name, **attributes)
    made.sourceline = node.sourceline
    return made


def _unread(parent: Element, node: Element) -> None:
    """What the reader of TC6 tells as left out."""
    _copy(parent, "unread", node, name=f"{kind(node)} {attribute(node, 'name')}".strip())


# ---- POUs -------------------------------------------------------------------------------------------------------


def _pou(parent: Element, node: Element, namespace: str) -> None:
    made = _copy(
        parent, "pou", node, name=attribute(node, "name"), pouType=POUS[kind(node)], namespace=namespace,
        extends=_named(child(node, "Extends")),
        implements=", ".join(_named(each) for each in children(node, "Implements")),
    )  # fmt: skip
    _inside(made, node)
    actions, transitions = add(made, "actions"), add(made, "transitions")
    for each in children(node, "Action", "Transition"):
        word = kind(each).lower()
        own = _copy(actions if word == "action" else transitions, word, each, name=attribute(each, "name"))
        add_body(own, child(each, "Body") if child(each, "Body") is not None else child(each, "MainBody"))
    for each in children(node, "Method"):
        access = attribute(each, "accessSpecifier").upper()
        words = " ".join(word for word in ("abstract", "final", "override") if attribute(each, word) == "true")
        own = _copy(made, "method", each, name=attribute(each, "name"), words=f"{access} {words.upper()}".strip())
        _inside(own, each)
    for each in children(node):
        if kind(each) not in (*INSIDE, *SECTIONS, *SAID):
            _unread(made, each)


def _named(node: Element | None) -> str:
    return text_of(child(node, "TypeName")).strip() or text_of(node).strip()


def _inside(made: Element, node: Element) -> None:
    """Result, variables and body."""
    said = next((each for each in node.iter(etree.Element) if kind(each).lower() == "textdeclaration"), None)
    if said is not None:
        add(made, "declaration").text = text_of(said).strip("\r\n ")
    interface = add(made, "interface")
    if child(node, "ResultType") is not None:
        _spec(add(interface, "returnType"), child(node, "ResultType"))
    for each in children(child(node, "Parameters"), *PARAMETERS):
        _section(interface, PARAMETERS[kind(each)], each)
    _sections(interface, node)
    add_body(made, child(node, "MainBody"))


def _sections(made: Element, node: Element) -> None:
    for each in children(node, *SECTIONS):
        _section(made, SECTIONS[kind(each)], each)


def _section(parent: Element, name: str, node: Element) -> None:
    marks = {word: "true" for word in ("constant", "retain", "persistent") if attribute(node, word) == "true"}
    if attribute(node, "non_retain") == "true":
        marks["nonretain"] = "true"
    made = add(parent, name, **marks)
    for each in sorted(children(node, "Variable"), key=lambda one: number_of(one, "orderWithinParamSet")):
        _variable(made, each)


# ---- variables and types ----------------------------------------------------------------------------------------


def _variable(parent: Element, node: Element) -> None:
    address = attribute(child(node, "Address"), "address")
    # an address of a bus (`ECAT://...`) is no place in the memory of the PLC
    made = _copy(parent, "variable", node, name=attribute(node, "name"), address="" if "/" in address else address)
    _spec(add(made, "type"), child(node, "Type"))
    initial = child(node, "InitialValue")
    if initial is not None:
        _value(add(made, "initialValue"), initial)
    comment = text_of(child(node, "Documentation")).strip()
    if "/" in address:
        comment = f"{comment} ({address})".strip()
    if comment:
        add(made, "documentation").text = comment


def _value(made: Element, node: Element) -> None:
    for each in children(node, "SimpleValue", "ArrayValue", "StructValue"):
        name = kind(each)
        own = add(made, name[0].lower() + name[1:])
        if name == "SimpleValue":
            own.set("value", attribute(each, "value"))
        for item in children(each, "Value"):
            marks = {word: attribute(item, word) for word in ("repetitionValue", "member") if attribute(item, word)}
            _value(add(own, "value", **marks), item)


def _spec(made: Element, node: Element | None) -> None:
    """A type below the element around it: by its name, or as it is written out."""
    if node is None:
        return
    written = child(node, "InstantlyDefinedType")
    node = node if written is None else written
    match of_type(node):
        case "ArrayTypeSpec":
            own = add(made, "array")
            for each in sorted(children(node, "DimensionSpec"), key=lambda one: number_of(one, "dimensionNumber")):
                add(own, "dimension", **_limits(each))
            _spec(add(own, "baseType"), child(node, "BaseType"))
        case "StructTypeSpec":
            own = add(made, "struct")
            for each in children(node, "Member"):
                _variable(own, each)
        case "EnumTypeSpec" | "EnumTypeWithNamedValueSpec":
            own = add(made, "enum")
            values = add(own, "values")
            for each in children(node, "Enumerator"):
                add(values, "value", name=attribute(each, "name"), value=attribute(each, "value"))
            if child(node, "BaseType") is not None:
                _spec(add(own, "baseType"), child(node, "BaseType"))
        case "SubrangeTypeSpec":
            own = add(made, "subrangeSigned")
            add(own, "range", **_limits(node))
            _spec(add(own, "baseType"), child(node, "BaseType"))
        case "PointerTypeSpec":
            _spec(add(add(made, "pointer"), "baseType"), child(node, "BaseType"))
        case "ReferenceTypeSpec":
            add(made, "derived", name=f"REF_TO {_named(child(node, 'BaseType'))}")
        case "" | "DirectlyDerivedTypeSpec":
            _by_name(made, node)
        case unknown:
            add(made, "derived", name=unknown)


def _by_name(made: Element, node: Element) -> None:
    base = child(node, "BaseType")
    node = node if base is None else base
    name = _named(node) or next((kind(each) for each in children(node)), "")
    add(made, "derived", name=name)


def _limits(node: Element) -> dict[str, str]:
    found = next((each for each in node.iter(etree.Element) if each.get("lower") is not None), None)
    return {"lower": attribute(found, "lower"), "upper": attribute(found, "upper")}


# ---- configurations ---------------------------------------------------------------------------------------------


def _configuration(parent: Element, node: Element) -> None:
    made = _copy(parent, "configuration", node, name=attribute(node, "name"))
    _sections(made, node)
    for each in children(node, "Resource"):
        resource = _copy(made, "resource", each, name=attribute(each, "name"))
        _sections(resource, each)
        for task in children(each, "Task"):
            name = attribute(task, "name")
            own = add(resource, "task", name=name, interval=attribute(task, "interval"))
            own.set("priority", attribute(task, "priority", "0"))
            for one in _instances(each, name):
                add(own, "pouInstance", name=attribute(one, "name"), typeName=attribute(one, "typeName"))
        for one in _instances(each, ""):
            add(resource, "pouInstance", name=attribute(one, "name"), typeName=attribute(one, "typeName"))


def _instances(resource: Element, task: str) -> Iterator[Element]:
    for each in children(resource, "ProgramInstance"):
        if attribute(each, "associatedTaskName") == task:
            yield each
