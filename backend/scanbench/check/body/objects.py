"""The instance that runs: THIS and SUPER, its own variables, and who may use those of another."""

from dataclasses import replace

from scanbench.check.body.arguments import ArgumentChecker
from scanbench.check.context import Rejected
from scanbench.check.declare.classes import Class
from scanbench.problems import Span
from scanbench.program.program import Base, Place, TrapKind, TrapSite
from scanbench.program.types import Member, Record, Section
from scanbench.syntax import tree


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


class ObjectChecker(ArgumentChecker):
    def own_class(self) -> Class | None:
        """The class whose body or method this is."""
        return self.pous.classes.of(self.scope.instance)

    def self_place(self, name: str, span: Span) -> Place:
        """The instance that runs: THIS, or as its base SUPER."""
        owner = self.own_class()
        if owner is None or owner.record is None:
            raise self.report.reject("T010", f"{name} is the instance that runs; a FUNCTION has none.", span)
        record = owner.record
        if name.upper() == "SUPER":
            if record.open and owner.base is None:
                raise Rejected
            if owner.base is None or owner.base.record is None:
                raise self.report.reject("T010", f"`{owner.name}` extends nothing, so it has no SUPER.", span)
            record = owner.base.record
        return self.own(Place(record, Base.SELF, 0))

    def own(self, place: Place) -> Place:
        """A place of the instance, as the body sees it: behind the slot of THIS in a method."""
        this = self.scope.this
        if this is None:
            return place
        if place.slot is not None:
            return replace(place, slot=self.own(place.slot))
        if place.base is not Base.SELF:
            return place
        return replace(place, base=Base.FRAME, slot=this, null_trap=self._this_trap(), variable="")

    def _this_trap(self) -> int:
        pou = self.pou
        assert pou is not None
        site = TrapSite(TrapKind.NULL, pou.span, self.scope.pou, "THIS refers to no instance")
        known = self.pous.this_traps.get(pou.name, 0)
        if not known or self.report.traps[known - 1 : known] != [site]:  # new, or undone meanwhile
            known = self.trap(site.kind, site.span, site.message)
            self.pous.this_traps[pou.name] = known
        return known

    def qualified_place(self, node: tree.MemberOf) -> tuple[Place, Member | None] | None:
        for word in ("THIS", "SUPER"):
            if named_itself(node.owner, word):
                return self._own_member(node, word)
        full = self._qualified_variable(node)
        return None if full is None else super()._named(full, node.span)

    def _qualified_variable(self, node: tree.MemberOf) -> str | None:
        """`Namespace.x` or `List.x`: the name that the global variable is kept under."""
        path = dotted(node)
        if path is None or self.scope.find(path.split(".")[0]) is not None:
            return None
        alias = self.pous.aliases.get(path.upper())
        if alias is not None:
            return alias
        return path if self.scope.find(path) is not None else None

    def _own_member(self, node: tree.MemberOf, word: str) -> tuple[Place, Member | None] | None:
        """`THIS.x`; None where x is something else of the instance."""
        place = self.self_place(word, node.owner.span)
        record = place.type
        assert isinstance(record, Record)
        member = record.members.get(node.name.upper())
        if member is None or member.hidden:
            raise self.no_member(record, node)
        scope, self.scope = self.scope, replace(self.scope, frame=None, instance=record, externals={})
        try:
            return self._named(node.name, node.span)
        finally:
            self.scope = scope

    def _named(self, name: str, span: Span) -> tuple[Place, Member | None]:
        place, member = super()._named(name, span)
        if self.pous.ambiguous and member is not None and self.scope.globals.members.get(name.upper()) is member:
            choices = self.pous.ambiguous.get(name.upper())
            if choices:
                raise self.report.reject("T001", f"`{name}` may be {' or '.join(choices)}; write which.", span)
        if member is not None and member.access == "PRIVATE":
            self._not_of_base(member, span)
        return (place if self.scope.this is None else self.own(place)), member

    def _not_of_base(self, member: Member, span: Span) -> None:
        """Refuses a PRIVATE variable that this class has from its base."""
        instance, owner = self.scope.instance, self.own_class()
        if instance is None or owner is None or instance.members.get(member.name.upper()) is not member:
            return
        if member.home not in ("", owner.name):
            raise self.report.reject("T014", f"`{member.name}` is PRIVATE of `{member.home}`.", span)

    def unknown(self, name: str, span: Span) -> Rejected:
        instance = self.scope.instance
        result = (self.scope.pou.upper(), name.upper())
        if result in self.declarations.broken:
            return Rejected()
        if instance is not None and (instance.open or self.is_broken(instance, name)):
            return Rejected()
        owner = self.own_class()
        if owner is not None and owner.find(name.upper()) is not None:
            return self.report.reject("T010", f"`{name}` is a method; call it with `{name}(...)`.", span)
        return super().unknown(name, span)

    def may_use(self, record: Record, member: Member) -> bool:
        if member.hidden or member.section is not Section.VAR:
            return False
        if member.access in ("PUBLIC", "INTERNAL"):
            return self._open(member.access, None, self.pous.classes.of(record))
        # an instance may look into another of its own class, as in `equals(other)`
        home = self.pous.classes.by_key.get((member.home or record.name).upper())
        return self._open(member.access, self.own_class(), home)

    def _open(self, access: str, user: Class | None, home: Class | None) -> bool:
        if access == "PUBLIC" or home is None:
            return True
        if access == "INTERNAL":
            return home.declaration.namespace.upper() in ("", *self.scope.space.around())
        if user is None:
            return False
        return user is home or (access == "PROTECTED" and home in user.ancestors())
