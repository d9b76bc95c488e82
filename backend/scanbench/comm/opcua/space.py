"""The address space: nodes of the program that runs, and what asyncua's own holds."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from asyncua import ua
from asyncua.server.address_space import AddressSpace, AttributeValue, NodeData

from scanbench.comm.opcua.forms import Form, form_of
from scanbench.comm.opcua.ids import INDEX, own, standard
from scanbench.comm.opcua.tree import Item, items, writable
from scanbench.program.program import Program
from scanbench.program.types import ArrayType, Enumeration, Kind, Record, Type
from scanbench.symbols.symbols import Symbol, UnknownPath, resolve
from scanbench.wire.memory import AreaSpan
from scanbench.wire.variables import VariablesAre

NAMESPACE = "urn:scanbench:plc"
_ASKED = 10_000
"""Nodes that are made because a client asked for their path. Where there are more, those without a subscriber go."""
ORGANIZES, HAS_COMPONENT, _HAS_TYPE, _HAS_SUBTYPE, HAS_PROPERTY = (
    standard(each)
    for each in (
        ua.ObjectIds.Organizes, ua.ObjectIds.HasComponent, ua.ObjectIds.HasTypeDefinition, ua.ObjectIds.HasSubtype,
        ua.ObjectIds.HasProperty,
    )
)  # fmt: skip
_FOLDER, _OBJECT, _VARIABLE, PROPERTY = (
    standard(each)
    for each in (
        ua.ObjectIds.FolderType, ua.ObjectIds.BaseObjectType, ua.ObjectIds.BaseDataVariableType, ua.ObjectIds.PropertyType,
    )
)  # fmt: skip
_Attributes = dict[ua.AttributeIds, AttributeValue]
READ, WRITE = 1, 3
"""Access levels: CurrentRead, and that with CurrentWrite."""


@dataclass(frozen=True, slots=True)
class Iec:
    """How PLCopen calls what a program has; see `plcopen.py`."""

    program: ua.NodeId
    """The type above those of programs."""
    block: ua.NodeId
    sections: Mapping[str, ua.NodeId]
    """References to variables, by their section."""


@dataclass(eq=False, slots=True)
class Variable:
    """A node with a value: of the program, or what is told of the PLC with each answer."""

    id: ua.NodeId
    path: str
    """Empty where `head` says what it is."""
    type: str
    form: Form
    attribute: AttributeValue
    writable: bool
    head: Callable[[VariablesAre], Any] | None = None
    span: AreaSpan | None = None
    """Where it lies in the memory of the model."""
    raw: bytes | None = None
    """What its attribute holds; None where that is no value."""

    @property
    def watched(self) -> bool:
        """Whether a client has subscribed to it."""
        return bool(self.attribute.datachange_callbacks)


class Space(AddressSpace):
    """asyncua's, with the nodes of a program, which change with it. A path that is not shown gets its node when it is asked for."""

    def __init__(self) -> None:
        super().__init__()
        self._nodes = _Nodes(self)
        self.variables: dict[ua.NodeId, Variable] = {}
        self._program: Program | None = None
        self._lost: dict[ua.NodeId, Variable] = {}
        """What the program has no more, and somebody still subscribes to."""
        self._own: list[ua.NodeId] = []
        self._asked: dict[ua.NodeId, None] = {}
        self._types: dict[str, ua.NodeId] = {}
        self.iec: Iec | None = None
        self.also: Mapping[ua.NodeId, ua.NodeId] = {}
        """Folders that refer to the same programs and global variables, by those of `take`."""
        self.renewed: tuple[ua.NodeId, ...] = ()
        """Nodes besides that refer to what a program has."""

    def delete_datachange_callback(self, handle: int) -> None:
        """As asyncua does; the node may be gone with the program that had it."""
        place = self._handle_to_attribute_map.pop(handle, None)
        if place is None:
            return
        id, which = place
        lost, node = self._lost.get(id), self._nodes.get(id)
        attributes = (None if lost is None else lost.attribute, None if node is None else node.attributes.get(which))
        for attribute in attributes:
            if attribute is not None:
                attribute.datachange_callbacks.pop(handle, None)

    # ---- nodes of a program ---------------------------------------------------------------------------------------

    def take(self, program: Program, programs: ua.NodeId, globals: ua.NodeId) -> list[Variable]:
        """Shows another program below two folders. A variable that it has, too, keeps who has subscribed to it; those that are
        gone and that somebody has subscribed to are given back."""
        before = {**self._lost, **self.variables}
        for id in self._own:
            self._nodes.pop(id, None)
        for folder in (programs, globals, standard(ua.ObjectIds.Enumeration), *self.renewed):
            references = self._nodes[folder].references
            references[:] = [each for each in references if not (each.IsForward and _of_program(each.NodeId))]
        self._program, self._own, self._asked, self._types = program, [], {}, {}
        self.variables = {id: each for id, each in before.items() if not each.path}
        for item in items(program):
            folder = programs if item.symbol.section == "PROGRAM" else globals
            self._add(item, own(item.parent) if item.parent else folder, before)
        watched = [each for id, each in before.items() if id not in self.variables and each.watched]
        for each in watched:
            found = self._found(each.path)
            if found is not None and form_of(found.symbol.type) is not None:
                self._add(found, None, before, each.id)
                self._asked[each.id] = None
        self._lost = {each.id: each for each in watched if each.id not in self.variables}
        return list(self._lost.values())

    def ask(self, id: ua.NodeId) -> NodeData | None:
        """The node of a path that is not shown: an element, an address; None where the program has none."""
        if id.NamespaceIndex != INDEX or not isinstance(id.Identifier, str):
            return None
        item = self._found(id.Identifier)
        if item is None or form_of(item.symbol.type) is None:
            return None
        if len(self._asked) >= _ASKED:
            self._drop_asked()
        self._asked[id] = None
        return self._add(item, None, {}, id)

    def _drop_asked(self) -> None:
        """Takes away the nodes that were asked for and that nobody has subscribed to: they are made again when they are."""
        dropped = {each for each in self._asked if not (each in self.variables and self.variables[each].watched)}
        for id in dropped:
            self._nodes.pop(id, None)
            self.variables.pop(id, None)
            del self._asked[id]
        self._own = [each for each in self._own if each not in dropped]

    def _found(self, path: str) -> Item | None:
        if self._program is None:
            return None
        try:
            symbol = resolve(self._program, path)
        except UnknownPath:
            return None
        return Item(symbol, "", variable=True)

    def _add(
        self, item: Item, parent: ua.NodeId | None, before: dict[ua.NodeId, Variable], id: ua.NodeId | None = None
    ) -> NodeData:  # fmt: skip
        symbol = item.symbol
        id = id or own(item.path)
        if item.variable:
            self._variable(id, symbol, before.get(id))
            node = self._nodes[id]
            kind, type = ua.NodeClass.Variable, _VARIABLE
        else:
            node = self.put(id, symbol.name, ua.NodeClass.Object, {ua.AttributeIds.EventNotifier: _byte(0)})
            kind, type = ua.NodeClass.Object, self._kind(symbol)
        node.attributes[ua.AttributeIds.Description] = _text(f"{symbol.type.name} {symbol.address or ''}".strip())
        self._own.append(id)
        self.refer(id, _HAS_TYPE, type)
        if parent is not None:
            self.join(parent, id, ORGANIZES if not _of_program(parent) else self._how(symbol), kind, type)
            if parent in self.also:
                self.join(self.also[parent], id, ORGANIZES, kind, type)
        return node

    def _kind(self, symbol: Symbol) -> ua.NodeId:
        """The type of an object: one for each POU."""
        type, iec = symbol.type, self.iec
        if iec is None or not isinstance(type, Record) or type.kind is not Kind.BLOCK:
            return _OBJECT
        name, above = f"pou:{type.name}", iec.program if symbol.section == "PROGRAM" else iec.block
        if name not in self._types:
            self._types[name] = own(name)
            self.put_type(own(name), type.name, above)
            self.mine(own(name))
        return self._types[name]

    def _how(self, symbol: Symbol) -> ua.NodeId:
        """What a variable is of the instance that has it."""
        return HAS_COMPONENT if self.iec is None else self.iec.sections.get(symbol.section, HAS_COMPONENT)

    def mine(self, id: ua.NodeId) -> None:
        """This node goes with the program."""
        self._own.append(id)

    def _variable(self, id: ua.NodeId, symbol: Symbol, before: Variable | None) -> None:
        program = self._program
        form = form_of(symbol.type)
        assert program is not None
        assert form is not None
        attribute = before.attribute if before is not None else AttributeValue(_NOT_READ)
        raw = before.raw if before is not None else None
        if before is not None and before.type != symbol.type.name:
            raw, attribute.value = None, _NOT_READ
        found = Variable(
            id, symbol.path, symbol.type.name, form, attribute, writable(symbol, program), span=_span(symbol, program),
            raw=raw,
        )  # fmt: skip
        self.put_variable(found, symbol.name, self._type(form, symbol.type))

    def _type(self, form: Form, type: Type) -> ua.NodeId:
        """The node of a type; an enumeration gets one with the names of its values."""
        if isinstance(form.data_type, ua.NodeId):
            return form.data_type
        element = type.element if isinstance(type, ArrayType) else type
        assert isinstance(element, Enumeration)
        known = self._types.get(form.data_type)
        if known is not None:
            return known
        id = self._types[form.data_type] = own(f"type:{form.data_type}")
        names = [ua.EnumField(number, ua.LocalizedText(name), Name=name) for name, number in element.values]
        definition = ua.EnumDefinition(names)
        values = [ua.EnumValueType(number, ua.LocalizedText(name)) for name, number in element.values]
        self.put(
            id, form.data_type, ua.NodeClass.DataType,
            {
                ua.AttributeIds.IsAbstract: AttributeValue(_value(False, ua.VariantType.Boolean)),
                ua.AttributeIds.DataTypeDefinition: AttributeValue(_value(definition, ua.VariantType.ExtensionObject)),
            },
        )  # fmt: skip
        self._own.append(id)
        self.join(standard(ua.ObjectIds.Enumeration), id, _HAS_SUBTYPE, ua.NodeClass.DataType, None)
        property = own(f"values:{form.data_type}")
        self.put(property, "EnumValues", ua.NodeClass.Variable, _described(_value(values, ua.VariantType.ExtensionObject),
                 standard(ua.ObjectIds.EnumValueType), (len(values),), READ), space=0)  # fmt: skip
        self._own.append(property)
        self.refer(property, _HAS_TYPE, PROPERTY)
        self.join(id, property, HAS_PROPERTY, ua.NodeClass.Variable, PROPERTY)
        return id

    # ---- nodes of any kind ----------------------------------------------------------------------------------------

    def put_variable(self, variable: Variable, name: str, data_type: ua.NodeId) -> NodeData:
        """A node with a value."""
        level = WRITE if variable.writable else READ
        attributes = _described(variable.attribute, data_type, variable.form.dimensions, level)
        self.variables[variable.id] = variable
        return self.put(variable.id, name, ua.NodeClass.Variable, attributes)

    def put_object(
        self, id: ua.NodeId, name: str, type: ua.NodeId, parent: ua.NodeId, events: bool = False, *,
        how: ua.NodeId | None = None, space: int = INDEX,
    ) -> None:  # fmt: skip
        """An object or a folder below another one, which organizes it unless `how` says otherwise; `events`: it tells of some."""
        self.put(id, name, ua.NodeClass.Object, {ua.AttributeIds.EventNotifier: _byte(int(events))}, space)
        self.refer(id, _HAS_TYPE, type)
        self.join(parent, id, how or ORGANIZES, ua.NodeClass.Object, type)

    def put_type(self, id: ua.NodeId, name: str, above: ua.NodeId, space: int = INDEX, abstract: bool = False) -> None:
        """A type of objects."""
        self.put(id, name, ua.NodeClass.ObjectType, {ua.AttributeIds.IsAbstract: _bool(abstract)}, space)
        self.join(above, id, _HAS_SUBTYPE, ua.NodeClass.ObjectType, None)

    def put_reference_type(self, id: ua.NodeId, name: str, inverse: str, above: ua.NodeId, space: int) -> None:
        """A type of references."""
        attributes = {
            ua.AttributeIds.IsAbstract: _bool(False), ua.AttributeIds.Symmetric: _bool(False),
            ua.AttributeIds.InverseName: _text(inverse),
        }  # fmt: skip
        self.put(id, name, ua.NodeClass.ReferenceType, attributes, space)
        self.join(above, id, _HAS_SUBTYPE, ua.NodeClass.ReferenceType, None)

    def put_fixed(self, variable: Variable, name: str, parent: ua.NodeId) -> None:
        """A variable that every program has."""
        assert isinstance(variable.form.data_type, ua.NodeId)
        self.put_variable(variable, name, variable.form.data_type)
        self.refer(variable.id, _HAS_TYPE, _VARIABLE)
        self.join(parent, variable.id, HAS_COMPONENT, ua.NodeClass.Variable, _VARIABLE)

    def put_method(self, id: ua.NodeId, name: str, parent: ua.NodeId, arguments: Sequence[tuple[str, str]]) -> None:
        """A method whose arguments are texts: name and description of each."""
        yes = AttributeValue(_value(True, ua.VariantType.Boolean))
        self.put(id, name, ua.NodeClass.Method, {ua.AttributeIds.Executable: yes, ua.AttributeIds.UserExecutable: yes})
        self.join(parent, id, HAS_COMPONENT, ua.NodeClass.Method, None)
        if not arguments:
            return
        taken = [
            ua.Argument(each, standard(ua.ObjectIds.String), -1, [], ua.LocalizedText(about))
            for each, about in arguments
        ]
        value = ua.DataValue(ua.Variant(taken, ua.VariantType.ExtensionObject, is_array=True))
        property = own(f"arguments:{name}")
        described = _described(value, standard(ua.ObjectIds.Argument), (len(taken),), READ)
        self.put(property, "InputArguments", ua.NodeClass.Variable, described, space=0)
        self.refer(property, _HAS_TYPE, PROPERTY)
        self.join(id, property, HAS_PROPERTY, ua.NodeClass.Variable, PROPERTY)

    def put(
        self, id: ua.NodeId, name: str, kind: ua.NodeClass, attributes: _Attributes, space: int = INDEX
    ) -> NodeData:  # fmt: skip
        """A node, with its name."""
        node = NodeData(id)
        node.attributes = {
            ua.AttributeIds.NodeId: AttributeValue(_value(id, ua.VariantType.NodeId)),
            ua.AttributeIds.NodeClass: _KINDS[kind],
            ua.AttributeIds.BrowseName: AttributeValue(
                _value(ua.QualifiedName(name, space), ua.VariantType.QualifiedName)
            ),
            ua.AttributeIds.DisplayName: _text(name),
            **attributes,
        }
        self._nodes[id] = node
        return node

    def refer(self, id: ua.NodeId, how: ua.NodeId, to: ua.NodeId) -> None:
        """A reference in one direction."""
        target = self._nodes[to].attributes
        self._nodes[id].references.append(
            ua.ReferenceDescription(
                how, True, to, _held(target, ua.AttributeIds.BrowseName), _held(target, ua.AttributeIds.DisplayName),
                ua.NodeClass(_held(target, ua.AttributeIds.NodeClass)), ua.NodeId(),
            )
        )  # fmt: skip

    def join(
        self, parent: ua.NodeId, id: ua.NodeId, how: ua.NodeId, kind: ua.NodeClass, type: ua.NodeId | None
    ) -> None:  # fmt: skip
        """A reference and its inverse."""
        over, node = self._nodes[parent], self._nodes[id]
        own, outer = node.attributes, over.attributes
        over.references.append(
            ua.ReferenceDescription(
                how, True, id, _held(own, ua.AttributeIds.BrowseName), _held(own, ua.AttributeIds.DisplayName), kind,
                type or ua.NodeId(),
            )
        )  # fmt: skip
        node.references.append(
            ua.ReferenceDescription(
                how, False, parent, _held(outer, ua.AttributeIds.BrowseName), _held(outer, ua.AttributeIds.DisplayName),
                ua.NodeClass(_held(outer, ua.AttributeIds.NodeClass)), ua.NodeId(),
            )
        )  # fmt: skip


class _Nodes(dict[ua.NodeId, NodeData]):
    """Nodes by their ids; one of a path that is not there is made when somebody asks for it."""

    def __init__(self, space: Space) -> None:
        super().__init__()
        self._space = space

    def __missing__(self, id: ua.NodeId) -> NodeData:
        found = self._space.ask(id)
        if found is None:
            raise KeyError(id)
        return found

    def __contains__(self, id: object) -> bool:
        return super().__contains__(id) or (isinstance(id, ua.NodeId) and self._space.ask(id) is not None)

    def get(self, id: ua.NodeId, default: Any = None) -> Any:
        """The node, made if need be."""
        found = super().get(id)
        return found if found is not None else self._space.ask(id) or default


def _of_program(id: ua.NodeId) -> bool:
    return id.NamespaceIndex == INDEX and isinstance(id.Identifier, str)


def _span(symbol: Symbol, program: Program) -> AreaSpan | None:
    found = None if symbol.slots else program.layout.area_at(symbol.offset)
    size = 1 if symbol.bit is not None else symbol.type.size
    return None if found is None else AreaSpan(found[0].name, found[1], size)


def _value(value: object, variant: ua.VariantType) -> ua.DataValue:
    return ua.DataValue(ua.Variant(value, variant))


def _text(text: str) -> AttributeValue:
    return AttributeValue(_value(ua.LocalizedText(text), ua.VariantType.LocalizedText))


def _bool(yes: bool) -> AttributeValue:
    return AttributeValue(_value(yes, ua.VariantType.Boolean))


def _byte(number: int) -> AttributeValue:
    return AttributeValue(_value(number, ua.VariantType.Byte))


def _held(attributes: _Attributes, which: ua.AttributeIds) -> Any:
    value = attributes[which].value
    variant = None if value is None else value.Value
    assert variant is not None
    return variant.Value


_NOT_READ = ua.DataValue(StatusCode=ua.StatusCode(ua.UInt32(ua.StatusCodes.BadWaitingForInitialData)))
_KINDS = {kind: AttributeValue(_value(kind, ua.VariantType.Int32)) for kind in ua.NodeClass}
_LEVELS = {level: _byte(level) for level in (READ, WRITE)}
_SCALAR = AttributeValue(_value(-1, ua.VariantType.Int32))
_NO_HISTORY = AttributeValue(_value(False, ua.VariantType.Boolean))
_INTERVAL = AttributeValue(_value(50.0, ua.VariantType.Double))


def _described(
    value: ua.DataValue | AttributeValue, data_type: ua.NodeId, dimensions: tuple[int, ...], level: int
) -> _Attributes:  # fmt: skip
    """Attributes of a variable. What never changes is the same object for all of them."""
    rank = AttributeValue(_value(len(dimensions), ua.VariantType.Int32)) if dimensions else _SCALAR
    found = {
        ua.AttributeIds.Value: value if isinstance(value, AttributeValue) else AttributeValue(value),
        ua.AttributeIds.DataType: AttributeValue(_value(data_type, ua.VariantType.NodeId)),
        ua.AttributeIds.ValueRank: rank,
        ua.AttributeIds.AccessLevel: _LEVELS[level],
        ua.AttributeIds.UserAccessLevel: _LEVELS[level],
        ua.AttributeIds.MinimumSamplingInterval: _INTERVAL,
        ua.AttributeIds.Historizing: _NO_HISTORY,
    }
    if dimensions:
        found[ua.AttributeIds.ArrayDimensions] = AttributeValue(
            ua.DataValue(ua.Variant(list(dimensions), ua.VariantType.UInt32, is_array=True))
        )
    return found


def described_one(value: object, variant: ua.VariantType) -> _Attributes:
    """Attributes of a variable with one value that nobody writes."""
    return _described(_value(value, variant), standard(variant.value), (), READ)
