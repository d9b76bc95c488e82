"""The instance that runs: THIS and SUPER, its own variables, and the rights to variables of other instances."""

from dataclasses import replace

from scanbench.check.body.context import Body, Found
from scanbench.check.body.variables import declared, is_broken, no_member, undeclared
from scanbench.check.context import Rejected
from scanbench.check.declare.classes import Class
from scanbench.problems import Span
from scanbench.program.program import Base, Place
from scanbench.program.sites import TrapKind, TrapSite
from scanbench.program.types import Member, Record, Section
from scanbench.syntax import tree


def own_class(body: Body) -> Class | None:
    """The class whose body or method this is."""
    return body.pous.classes.of(body.scope.instance)


def this(body: Body, name: str, span: Span) -> Place:
    """The instance that runs: THIS, or as its base SUPER."""
    owner = own_class(body)
    if owner is None or owner.record is None:
        raise body.report.reject("T010", f"{name} is the instance that runs; a FUNCTION has none.", span)
    record = owner.record
    if name.upper() == "SUPER":
        if record.open and owner.base is None:
            raise Rejected
        if owner.base is None or owner.base.record is None:
            raise body.report.reject("T010", f"`{owner.name}` extends nothing, so it has no SUPER.", span)
        record = owner.base.record
    return own(body, Place(record, Base.SELF, 0))


def own(body: Body, place: Place) -> Place:
    """A place of the instance, as the body reaches it: in a method through the slot of THIS."""
    slot = body.scope.this
    if slot is None:
        return place
    if place.slot is not None:
        return replace(place, slot=own(body, place.slot))
    if place.base is not Base.SELF:
        return place
    return replace(place, base=Base.FRAME, slot=slot, null_trap=body.lookup.this_trap(body), variable="")


def this_trap(body: Body) -> int:
    """The site of the trap where THIS refers to nothing: one in a method."""
    pou = body.pou
    assert pou is not None
    site = TrapSite(TrapKind.NULL, pou.span, body.scope.pou, "THIS refers to no instance")
    known = body.pous.this_traps.get(pou.name, 0)
    if not known or body.report.traps[known - 1 : known] != [site]:  # new, or undone meanwhile
        known = body.trap(site.kind, site.span, site.message)
        body.pous.this_traps[pou.name] = known
    return known


def qualified_place(body: Body, node: tree.MemberOf) -> Found | None:
    """The variable qualified by THIS, SUPER, a namespace or a list of globals; None if there is no such variable."""
    for word in ("THIS", "SUPER"):
        if named_itself(node.owner, word):
            return _own_member(body, node, word)
    full = qualified_variable(body, node)
    if full is None:
        return None
    scope = body.scope  # a variable of the POU with the same name is not meant
    body.scope = replace(scope, frame=None, instance=None, externals={}, kept={}, constants=())
    try:
        return declared(body, full, node.span)
    finally:
        body.scope = scope


def qualified_variable(body: Body, node: tree.MemberOf) -> str | None:
    """`Namespace.x` or `List.x`: the name that the global variable is kept under."""
    path = dotted(node)
    if path is None or body.scope.find(path.split(".")[0]) is not None:
        return None
    alias = body.pous.aliases.get(path.upper())
    if alias is not None:
        return alias
    if body.scope.find(path) is not None:
        return path
    plain = body.declarations.names.plain(path)
    alias = body.pous.aliases.get(plain.upper())
    found = None if plain == path or alias is not None else body.scope.find(plain)
    # a library has global variables: a variable of the POU with the same name is not meant
    return plain if found is not None and found[2] is body.scope.globals else alias


def _own_member(body: Body, node: tree.MemberOf, word: str) -> Found | None:
    """`THIS.x`; None where x is something else of the instance."""
    place = body.lookup.this(body, word, node.owner.span)
    record = place.type
    assert isinstance(record, Record)
    member = record.members.get(node.name.upper())
    if member is None or member.hidden:
        raise no_member(body, record, node)
    scope, body.scope = body.scope, replace(body.scope, frame=None, instance=record, externals={})
    try:
        return body.lookup.variable(body, node.name, node.span)
    finally:
        body.scope = scope


def variable(body: Body, name: str, span: Span) -> Found:
    """The variable of this name, as the body of the POU sees it."""
    place, member = declared(body, name, span)
    if body.pous.ambiguous and member is not None and body.scope.globals.members.get(name.upper()) is member:
        choices = body.pous.ambiguous.get(name.upper())
        if choices and f"{body.scope.space.globals_of}.{name}".upper() not in map(str.upper, choices):
            raise body.report.reject("T001", f"`{name}` may be {' or '.join(choices)}; write which.", span)
    if member is not None and member.access == "PRIVATE":
        _not_of_base(body, member, span)
    return (place if body.scope.this is None else own(body, place)), member


def _not_of_base(body: Body, member: Member, span: Span) -> None:
    """Refuses a PRIVATE variable that this class has from its base."""
    instance, owner = body.scope.instance, own_class(body)
    if instance is None or owner is None or instance.members.get(member.name.upper()) is not member:
        return
    if member.home not in ("", owner.name):
        raise body.report.reject("T014", f"`{member.name}` is PRIVATE of `{member.home}`.", span)


def unknown(body: Body, name: str, span: Span) -> Rejected:
    """Reports a name that means nothing in this POU or instance."""
    instance = body.scope.instance
    result = (body.scope.pou.upper(), name.upper())
    if result in body.declarations.broken:
        return Rejected()
    if instance is not None and (instance.open or is_broken(body, instance, name)):
        return Rejected()
    owner = own_class(body)
    if owner is not None and owner.find(name.upper()) is not None:
        return body.report.reject("T010", f"`{name}` is a method; call it with `{name}(...)`.", span)
    return undeclared(body, name, span)


def may_use(body: Body, record: Record, member: Member) -> bool:
    """Whether this POU may use the member of a block, which is not an input or output."""
    if member.hidden or member.section is not Section.VAR:
        return False
    if member.access in ("PUBLIC", "INTERNAL"):
        return is_open(body, member.access, None, body.pous.classes.of(record))
    # an instance may read private variables of other instances of its class, as in `equals(other)`
    home = body.pous.classes.by_key.get((member.home or record.name).upper())
    return is_open(body, member.access, own_class(body), home)


def is_open(body: Body, access: str, user: Class | None, home: Class | None) -> bool:
    """Whether something of the class `home` with this access can be used here, by the class `user`."""
    if access == "PUBLIC" or home is None:
        return True
    if access == "INTERNAL":
        return home.declaration.namespace.upper() in ("", *body.scope.space.around())
    if user is None:
        return False
    return user is home or (access == "PROTECTED" and home in user.ancestors())


def named_itself(node: tree.Expression, word: str) -> bool:
    """`THIS` or `THIS^`, likewise for SUPER."""
    if isinstance(node, tree.Dereference):
        node = node.reference
    return isinstance(node, tree.Name) and node.name.upper() == word


def dotted(node: tree.Expression) -> str | None:
    """`A.B.c` as it was written; None when it is not made of names alone."""
    parts = []
    while isinstance(node, tree.MemberOf):
        parts.append(node.name)
        node = node.owner
    return ".".join([node.name, *reversed(parts)]) if isinstance(node, tree.Name) else None
