"""Goes over the declarations of a project, and over their bodies."""

from collections.abc import Iterable, Mapping

from scanbench.check.placeholders.shapes import Shape, Unknown, join, of_type
from scanbench.check.placeholders.uses import Body
from scanbench.check.placeholders.world import World
from scanbench.problems import Span
from scanbench.syntax import tree


def look(world: World, files: Iterable[tree.File]) -> None:
    """All bodies and declarations of these files."""
    for file in files:
        for each in file.types:
            _type(world, each.type)
            if each.initial is not None:
                _initial(world, of_type(each.type), each.initial)
        for section in file.globals:
            _declarations(world, section.variables, Body(world, _NOBODY), "CONSTANT" in section.qualifiers)
        for pou in file.pous:
            _pou(world, pou)
    for key in world.unknown_globals.keys() & world.unknown.keys():
        del world.unknown_globals[key]  # the name of a type, which a use further down told
    for unknown in world.unknown.values():
        for interface in filter(None, map(world.unknown.get, unknown.gives)):
            for key in interface.members.keys() & unknown.members.keys() if interface.interface else ():
                join(interface.members[key].shape, unknown.members[key].shape)


_NOBODY = tree.PouDeclaration("program", "", None, (), (), Span("", 1, 1, 1, 1))
"""Around what is declared outside of a POU."""


def _pou(world: World, pou: tree.PouDeclaration) -> None:
    for each in pou.extends:
        if isinstance(found := world.resolved(each), Unknown):
            found.interface = found.interface or pou.kind == "interface"
            found.block = pou.kind != "interface"
    for each in pou.implements:
        if isinstance(found := world.resolved(each), Unknown):
            found.interface = True
            _implemented(world, found, pou)
    for owner, method in ((pou, None), *((each, each) for each in pou.methods)):
        body = Body(world, pou, method)
        _type(world, owner.result)
        for section in owner.sections:
            _declarations(world, section.variables, body, "CONSTANT" in section.qualifiers)
        if isinstance(owner.body, tuple):
            body.statements(owner.body)


def _implemented(world: World, interface: Unknown, pou: tree.PouDeclaration) -> None:
    """Methods of a block that may be those of its interface: they are, where somebody calls them by it."""
    own: Mapping[str, tree.PouDeclaration] = {each.name.upper(): each for each in pou.methods}
    for key, (_, signature) in interface.methods.items():
        signature.declared = signature.declared or own.get(key)


def _type(world: World, spec: tree.TypeSpec | None) -> None:
    match spec:
        case tree.NamedType():
            world.resolved(spec)
        case tree.ArraySpec(element=element, ranges=ranges):
            _type(world, element)
            for bound in (bound for pair in ranges for bound in pair):
                Body(world, _NOBODY).of(bound)
                world.fixed |= {name.upper() for name in _names(bound)}
        case tree.OpenArraySpec(element=element):
            _type(world, element)
        case tree.ReferenceSpec(target=target):
            _type(world, target)
        case tree.StringSpec(length=length) if length is not None:
            world.fixed |= {name.upper() for name in _names(length)}
        case tree.StructSpec(members=members, extends=extends):
            _type(world, extends)
            for each in members:
                _type(world, each.type)
                if each.initial is not None:
                    _initial(world, of_type(each.type), each.initial)
        case _:
            pass


def _names(expression: tree.Expression) -> Iterable[str]:
    match expression:
        case tree.Name(name=name):
            yield name
        case tree.MemberOf(owner=owner, name=name):
            yield name
            yield from _names(owner)
        case tree.BinaryOp(left=left, right=right):
            yield from (*_names(left), *_names(right))
        case tree.UnaryOp(operand=operand):
            yield from _names(operand)
        case _:
            pass


def _declarations(world: World, declared: Iterable[tree.Variable], body: Body, constant: bool = False) -> None:
    for each in declared:
        _type(world, each.type)
        if constant and each.initial is not None and isinstance(each.initial, tree.Expression):
            world.fixed |= {name.upper() for name in _names(each.initial)}
        if each.initial is not None:
            _initial(world, of_type(each.type), each.initial, body)
        if each.elements and isinstance(each.type, tree.ArraySpec):
            _count(world, each.type, len(each.elements))
        for arguments in (each.arguments, *each.elements):
            spec = each.type.element if isinstance(each.type, tree.ArraySpec) else each.type
            found = world.resolved(spec)
            if isinstance(found, tree.PouDeclaration) and arguments:
                body.created(arguments, found)
            if isinstance(found, Unknown) and arguments:
                found.block = True
                body.arguments(arguments, found.arguments, found.arguments)


def _count(world: World, spec: tree.ArraySpec, elements: int) -> None:
    """Of `ARRAY[1..SIZE, 1..SIZE]` with so many elements, the number SIZE."""
    highs = {name.upper() for _, high in spec.ranges for name in list(_names(high))[:1]}
    ones = all(isinstance(low, tree.Literal) and low.value == 1 for low, _ in spec.ranges)
    number = round(elements ** (1 / len(spec.ranges)))
    if ones and len(highs) == 1 and number ** len(spec.ranges) == elements:
        world.counted.setdefault(highs.pop(), number)


def _initial(world: World, shape: Shape, initial: tree.Initial, body: Body | None = None) -> None:
    body = body or Body(world, _NOBODY)
    match initial:
        case tree.StructInit(members=members):
            for name, value, _ in members:
                part = world.part(shape, name)
                if isinstance(found := world.resolved(shape.known), Unknown):
                    found.members[name.upper()].written = True
                _initial(world, part, value, body)
        case tree.ArrayInit(items=items):
            element = body.index(shape, [])
            for _, value in items:
                _initial(world, element, value, body)
        case _:
            given = body.of(initial)
            body.gives(given, shape)
            join(shape, given)
