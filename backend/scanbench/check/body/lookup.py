"""What names mean in the statements of a POU."""

from scanbench.check.body import enumerations, objects, places
from scanbench.check.body.context import Body, Found
from scanbench.check.context import Rejected
from scanbench.problems import Span
from scanbench.program.program import Const, Place
from scanbench.program.types import Member, Record
from scanbench.syntax import tree


class PouLookup:
    """Variables of the POU and its instance, globals, enumerations; `Lookup` says what each method does."""

    def variable(self, body: Body, name: str, span: Span) -> Found:
        return objects.variable(body, name, span)

    def bit(self, body: Body, node: tree.PartialAccess) -> Place | None:
        return None

    def unknown(self, body: Body, name: str, span: Span) -> Rejected:
        return objects.unknown(body, name, span)

    def inside(self, body: Body, place: Place, record: Record, member: Member, span: Span) -> Place:
        return places.inside(place, record, member)

    def this(self, body: Body, word: str, span: Span) -> Place:
        return objects.this(body, word, span)

    def this_trap(self, body: Body) -> int:
        return objects.this_trap(body)

    def may_use(self, body: Body, record: Record, member: Member) -> bool:
        return objects.may_use(body, record, member)

    def qualified_value(self, body: Body, node: tree.MemberOf) -> Const | None:
        return enumerations.qualified_value(body, node)
