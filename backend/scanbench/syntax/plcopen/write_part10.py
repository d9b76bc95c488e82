"""The elements of TC6 -> a file of IEC 61131-10: the other way of `part10`.

The schema of IEC 61131-10 is not published freely; the names are those of files that Sysmac Studio, Bachmann's tool and PLCnext write or read.
"""

from collections.abc import Callable
from itertools import count
from typing import cast

from lxml import etree

from scanbench.syntax.plcopen.part10 import PARAMETERS, POUS, SECTIONS
from scanbench.syntax.plcopen.part10_bodies import KINDS, PINS
from scanbench.syntax.plcopen.write_objects import OF_NETWORK, CannotWrite, add
from scanbench.syntax.xml_tree import Element, attribute, child, children, kind, text_of

SPACE = "www.iec.ch/public/TC65SC65BWG7TF10"
XSI = "http://www.w3.org/2001/XMLSchema-instance"
TYPE = f"{{{XSI}}}type"
_NAMES = {old: new for new, old in {**PARAMETERS, **SECTIONS}.items()}
_POUS = {old: new for new, old in POUS.items()}
_KINDS = {old: new for new, old in KINDS.items()}
_LADDER = frozenset(("leftPowerRail", "rightPowerRail", "contact", "coil"))


def to_part10(root: Element, left: list[str]) -> Element:
    """`left` gets the POUs that are left out."""
    made = etree.Element("Project", nsmap=cast(dict[str, str], {None: SPACE, "xsi": XSI}))
    made.set("schemaVersion", "1")
    header = child(root, "fileHeader")
    names = ("companyName", "productName", "productVersion")
    add(made, "FileHeader", **{name: attribute(header, name) for name in names})
    add(
        made, "ContentHeader", name=attribute(child(root, "contentHeader"), "name"),
        creationDateTime=attribute(header, "creationDateTime"),
    )  # fmt: skip
    space = add(add(made, "Types"), "GlobalNamespace")
    for each in children(child(root, "types", "dataTypes"), "dataType"):
        _tried(space, each, _data_type, left)
    for each in children(child(root, "types", "pous"), "pou"):
        _tried(space, each, _pou, left)
    instances = add(made, "Instances")
    for each in children(child(root, "instances", "configurations"), "configuration"):
        _tried(instances, each, _configuration, left)
    return made


def _tried(parent: Element, node: Element, make: Callable[[Element, Element], None], left: list[str]) -> None:
    """What cannot be written is left out as a whole."""
    before = len(parent)
    try:
        make(parent, node)
    except CannotWrite as why:
        del parent[before:]
        left.append(f"{attribute(node, 'name')}, the whole of it: {why}")


# ---- declarations -----------------------------------------------------------------------------------------------


def _data_type(parent: Element, node: Element) -> None:
    if child(node, "initialValue") is not None:
        raise CannotWrite("the start value of a type")
    _spec(add(parent, "DataTypeDecl", name=attribute(node, "name")), "UserDefinedTypeSpec", child(node, "baseType"))


def _configuration(parent: Element, node: Element) -> None:
    made = add(parent, "Configuration", name=attribute(node, "name"))
    for each in children(node, "resource"):
        resource = add(made, "Resource", name=attribute(each, "name"), resourceTypeName="")
        for section in children(each, "globalVars"):
            _section(resource, section, None)
        for task in children(each, "task"):
            marks = {word: attribute(task, word) for word in ("name", "interval", "priority") if attribute(task, word)}
            add(resource, "Task", **marks).set(TYPE, "StandardTask")
        for one in children(each, "pouInstance"):
            add(resource, "ProgramInstance", name=attribute(one, "name"), typeName=attribute(one, "typeName"))
        for task in children(each, "task"):
            for one in children(task, "pouInstance"):
                name, type = attribute(one, "name"), attribute(one, "typeName")
                add(resource, "ProgramInstance", name=name, typeName=type, associatedTaskName=attribute(task, "name"))
    for section in children(node, "globalVars"):
        _section(made, section, None)


def _pou(parent: Element, node: Element) -> None:
    made = add(parent, _POUS[attribute(node, "pouType")], name=attribute(node, "name"))
    interface = child(node, "interface")
    if child(interface, "returnType") is not None:
        _type(made, "ResultType", child(interface, "returnType"))
    parameters = list(children(interface, *PARAMETERS.values()))
    if kind(made) != "Program":
        group, numbers = add(made, "Parameters"), count()
        for each in parameters:
            _section(group, each, numbers)
    elif parameters:
        raise CannotWrite("inputs or outputs of a program")
    for each in children(interface, "externalVars", "tempVars", "localVars"):
        _section(made, each, None)
    _body(add(made, "MainBody"), child(node, "body"))
    for each in children(child(node, "actions"), "action"):
        _body(add(add(made, "Action", name=attribute(each, "name")), "Body"), child(each, "body"))


def _section(parent: Element, node: Element, numbers: "count[int] | None") -> None:
    marks = {word: "true" for word in ("constant", "retain") if attribute(node, word) == "true"}
    if attribute(node, "persistent") == "true":
        raise CannotWrite("VAR PERSISTENT")
    if attribute(node, "nonretain") == "true":
        marks["non_retain"] = "true"
    made = add(parent, _NAMES[kind(node)], **marks)
    if kind(made) == "Vars":
        made.set("accessSpecifier", "private")
    for each in children(node, "variable"):
        _variable(made, "Variable", each, None if numbers is None else next(numbers))


def _variable(parent: Element, name: str, node: Element, number: int | None) -> None:
    made = add(parent, name, name=attribute(node, "name"))
    if number is not None:
        made.set("orderWithinParamSet", str(number))
    _type(made, "Type", child(node, "type"))
    initial = child(node, "initialValue")
    if initial is not None:
        _value(add(made, "InitialValue"), initial)
    if attribute(node, "address"):
        add(made, "Address", address=attribute(node, "address"))


def _value(made: Element, node: Element) -> None:
    for each in children(node):
        name = kind(each)
        own = add(made, name[0].upper() + name[1:])
        if name == "simpleValue":
            own.set("value", attribute(each, "value"))
        for item in children(each, "value"):
            marks = {word: attribute(item, word) for word in ("repetitionValue", "member") if attribute(item, word)}
            _value(add(own, "Value", **marks), item)


def _type(parent: Element, name: str, node: Element | None) -> None:
    """A type by its name, or written out where it has none."""
    found = next(children(node), None)
    written = "" if found is None else _name_of(found)
    made = add(parent, name)
    if written:
        add(made, "TypeName").text = written
    else:
        _spec(made, "InstantlyDefinedType", node)


def _name_of(node: Element) -> str:
    match kind(node):
        case "derived":
            return attribute(node, "name")
        case "string" | "wstring" as name:
            length = attribute(node, "length")
            return f"{name.upper()}[{length}]" if length else name.upper()
        case "array" | "struct" | "enum" | "subrangeSigned" | "subrangeUnsigned" | "pointer":
            return ""
        case name:
            return name


def _spec(parent: Element, name: str, node: Element | None) -> None:
    found = next(children(node), None)
    if found is None:
        raise CannotWrite("a type")
    made = add(parent, name)
    match kind(found):
        case "array":
            made.set(TYPE, "ArrayTypeSpec")
            _type(made, "BaseType", child(found, "baseType"))
            for number, each in enumerate(children(found, "dimension"), 1):
                dimension = add(made, "DimensionSpec", dimensionNumber=str(number))
                add(dimension, "IndexRange", lower=attribute(each, "lower"), upper=attribute(each, "upper"))
        case "struct" if name == "UserDefinedTypeSpec":
            made.set(TYPE, "StructTypeSpec")
            for each in children(found, "variable"):
                _variable(made, "Member", each, None)
        case "enum" if name == "UserDefinedTypeSpec":
            values = list(children(child(found, "values"), "value"))
            named = child(found, "baseType") is not None or any(attribute(each, "value") for each in values)
            made.set(TYPE, "EnumTypeWithNamedValueSpec" if named else "EnumTypeSpec")
            for each in values:
                value = {"value": attribute(each, "value")} if attribute(each, "value") else {}
                add(made, "Enumerator", name=attribute(each, "name"), **value)
            if child(found, "baseType") is not None:
                _type(made, "BaseType", child(found, "baseType"))
        case "subrangeSigned" | "subrangeUnsigned" if name == "UserDefinedTypeSpec":
            made.set(TYPE, "SubrangeTypeSpec")
            _type(made, "BaseType", child(found, "baseType"))
            limits = child(found, "range")
            add(made, "Range", lower=attribute(limits, "lower"), upper=attribute(limits, "upper"))
        case "struct" | "enum" | "subrangeSigned" | "subrangeUnsigned":
            raise CannotWrite("a structure, enumeration or subrange without a name of its own")
        case "pointer":
            raise CannotWrite("a pointer")
        case _:
            made.set(TYPE, "DirectlyDerivedTypeSpec")
            _type(made, "BaseType", node)


# ---- bodies -----------------------------------------------------------------------------------------------------


def _body(parent: Element, node: Element | None) -> None:
    found = next(children(node), None)
    if found is None:
        return
    language = kind(found)
    if language == "SFC":
        raise CannotWrite("a chart, whose form in IEC 61131-10 is not known here")
    made = add(parent, "BodyContent")
    made.set(TYPE, language)
    if language in ("ST", "IL"):
        add(made, language).text = text_of(found)
        return
    networks: dict[str, list[Element]] = {}
    rails = {attribute(each, "localId") for each in children(found, "leftPowerRail")}
    for each in children(found):
        if kind(each) != "leftPowerRail":
            networks.setdefault(attribute(each, OF_NETWORK), []).append(each)
    for number, own in enumerate(networks.values(), 1):
        _Network(made, language, number, own, rails).write()


class _Network:
    def __init__(self, body: Element, language: str, number: int, objects: list[Element], rails: set[str]) -> None:
        self._made = add(body, "Rung" if language == "LD" else "Network", evaluationOrder=str(number))
        if language == "FBD":
            self._made.set(TYPE, "FbdNetwork")
        self._objects = objects
        self._rails = rails
        self._ids = count(1)
        self._outputs: dict[tuple[str, str], str] = {}

    def write(self) -> None:
        connections = [each for one in self._objects for each in one.iter(etree.Element) if kind(each) == "connection"]
        from_rail = [each for each in connections if attribute(each, "refLocalId") in self._rails]
        if from_rail:
            rail = self._object("LdObject", "LeftPowerRail")
            for each in from_rail:
                own = str(next(self._ids))
                add(rail, "ConnectionPointOut", connectionPointOutId=own)
                each.set("outputId", own)
        for each in self._objects:
            self._number(each)
        used = {self._end(each) for each in connections if each not in from_rail}
        for each in self._objects:
            if kind(each) == "label":
                self._made.set("label", attribute(each, "label"))
            elif kind(each) == "comment":
                content = add(self._object("CommonObject", "Comment"), "Content")
                content.set(TYPE, "SimpleText")
                content.text = text_of(child(each, "content"))
            else:
                self._write(each)
        last = [each for each in self._objects if kind(each) == "coil" and (attribute(each, "localId"), "") not in used]
        if last:
            right = self._object("LdObject", "RightPowerRail")
            for each in last:
                into = add(right, "ConnectionPointIn")
                own = self._outputs[attribute(each, "localId"), ""]
                add(into, "Connection", refConnectionPointOutId=own)

    def _object(self, group: str, what: str) -> Element:
        made = add(self._made, group)
        made.set(TYPE, what)
        return made

    def _number(self, node: Element) -> None:
        """Gives the outputs of an object their ids."""
        id = attribute(node, "localId")
        if kind(node) == "block":
            for each in children(child(node, "outputVariables"), "variable"):
                self._outputs[id, attribute(each, "formalParameter")] = str(next(self._ids))
        elif child(node, "connectionPointOut") is not None:
            self._outputs[id, ""] = str(next(self._ids))

    def _end(self, connection: Element) -> tuple[str, str]:
        return attribute(connection, "refLocalId"), attribute(connection, "formalParameter")

    def _write(self, node: Element) -> None:
        what = kind(node)
        made = self._object("LdObject" if what in _LADDER else "FbdObject", _KINDS[what])
        for word in ("negated", "edge"):
            if attribute(node, word) not in ("", "false", "none"):
                made.set(word, attribute(node, word))
        match what:
            case "contact" | "coil":
                made.set("operand", text_of(child(node, "variable")))
                if attribute(node, "storage") in ("set", "reset"):
                    made.set("latch", attribute(node, "storage"))
            case "inVariable" | "outVariable":
                made.set("identifier", text_of(child(node, "expression")))
                if attribute(node, "storage") in ("set", "reset"):
                    raise CannotWrite(f"{text_of(child(node, 'expression'))} that is set or reset in a block diagram")
            case "jump":
                made.set("targetLabel", attribute(node, "label"))
            case "block":
                self._block(made, node)
                return
        for each in children(node, "connectionPointIn"):
            self._connect(made, each)
        if (attribute(node, "localId"), "") in self._outputs:
            add(made, "ConnectionPointOut", connectionPointOutId=self._outputs[attribute(node, "localId"), ""])

    def _block(self, made: Element, node: Element) -> None:
        made.set("typeName", attribute(node, "typeName"))
        if attribute(node, "instanceName"):
            made.set("instanceName", attribute(node, "instanceName"))
        outputs = [attribute(each, "formalParameter") for each in children(child(node, "outputVariables"), "variable")]
        named = next((each for each in outputs if each == attribute(node, "typeName")), "OUT")
        result = "" if attribute(node, "instanceName") else named
        for group in ("InputVariables", "OutputVariables"):
            own = add(made, group)
            for each in children(child(node, PINS[group]), "variable"):
                name = attribute(each, "formalParameter")
                is_result = group == "OutputVariables" and name == result
                pin = add(own, group.removesuffix("s"), parameterName="" if is_result else name)
                for word in ("negated", "edge"):
                    if attribute(each, word):
                        pin.set(word, attribute(each, word))
                for into in children(each, "connectionPointIn"):
                    self._connect(pin, into)
                if group == "OutputVariables":
                    id = self._outputs[attribute(node, "localId"), name]
                    add(pin, "ConnectionPointOut", connectionPointOutId=id)

    def _connect(self, made: Element, node: Element) -> None:
        into = add(made, "ConnectionPointIn")
        for each in children(node, "connection"):
            own = attribute(each, "outputId") or self._outputs.get(self._end(each), "")
            if not own:
                raise CannotWrite("a wire between two networks")
            add(into, "Connection", refConnectionPointOutId=own)
