"""What a CONFIGURATION wires once everything has a place: inputs and outputs of program instances, events of tasks."""

from scanbench.check.body.bodies import body_of
from scanbench.check.body.coercion import as_type, coerce
from scanbench.check.body.targets import target
from scanbench.check.context import Rejected, Report, did_you_mean
from scanbench.check.declare.declarations import Declarations
from scanbench.check.declare.scopes import Pous, Scope
from scanbench.check.uses import variable_symbol
from scanbench.problems import Span
from scanbench.program.bodies import bodies
from scanbench.program.program import Assign, CallBlock, Load, Place, Stmt
from scanbench.program.shown import shown
from scanbench.program.tasks import ProgramInstance
from scanbench.program.types import BOOL, Kind, Member, Record, Section
from scanbench.syntax import tree

SOURCES = (tree.Literal, tree.TypedName, tree.Name, tree.MemberOf, tree.IndexOf, tree.DirectAddress, tree.PartialAccess)


class Wiring:
    """Names in a CONFIGURATION: globals, and `Main.x` or `Resource.Main.x` of the program instances."""

    def __init__(
        self,
        report: Report,
        declarations: Declarations,
        pous: Pous,
        variables: Record,
        instances: list[ProgramInstance],
        resources: list[str],
    ) -> None:
        self._report = report
        scope = Scope(
            "CONFIGURATION",
            variables,
            externals=_roots(variables, instances, resources),
            system=(declarations.symbols,),
        )
        self._body = body_of(report, declarations, pous, scope, None)

    def event(self, node: tree.Expression) -> Place | None:
        """The BOOL whose rising edge starts a task."""
        try:
            place, _ = self._body.place(node)
            if place.type != BOOL:
                raise self._report.reject("D010", f"SINGLE is a BOOL variable, not {place.type}.", node.span)
            self._fixed(place, node.span)
        except Rejected:
            return None
        return place

    def connect(
        self, instance: ProgramInstance, declaration: tree.ProgramDeclaration
    ) -> tuple[tuple[Stmt, ...], tuple[Stmt, ...]]:
        """What is copied before the program runs, and after."""
        self._body.pou = instance.pou  # values are run, so subranges are checked
        before: list[Stmt] = []
        after: list[Stmt] = []
        seen: set[str] = set()
        for argument in declaration.connections:
            try:
                (after if argument.output else before).append(self._connection(instance, argument, seen))
            except Rejected:
                continue
        return tuple(before), tuple(after)

    def _connection(self, instance: ProgramInstance, argument: tree.Argument, seen: set[str]) -> Stmt:
        value, span = argument.value, argument.span
        if argument.name is None or value is None or argument.negated:
            raise self._report.reject(
                "T004", "A connection is written `input := variable` or `output => variable`.", span
            )
        members = instance.pou.instance.members
        member = members.get(argument.name.upper())
        if member is None or member.section not in (Section.INPUT, Section.OUTPUT):
            known = [each.name for each in members.values() if each.section in (Section.INPUT, Section.OUTPUT)]
            hint = did_you_mean(argument.name, known)
            raise self._report.reject(
                "T004", f"`{instance.pou.name}` has no input or output `{argument.name}`.{hint}", span
            )
        if argument.place is not None:
            self._report.use(argument.place, argument.name, variable_symbol(member, instance.pou.instance))
            if member.section is Section.INPUT:
                self._report.written.append(argument.place)
        if argument.output != (member.section is Section.OUTPUT):
            arrow = "=>" if member.section is Section.OUTPUT else ":="
            raise self._report.reject(
                "T004", f"`{member.name}` is {member.section.value}: write `{member.name} {arrow} ...`.", span
            )
        if member.name.upper() in seen:
            raise self._report.reject("T004", f"`{member.name}` is connected twice.", span)
        seen.add(member.name.upper())
        if not isinstance(value, SOURCES):
            raise self._report.reject(
                "T004", "A program is connected to a variable, an address or a literal; compute in the program.", value.span
            )  # fmt: skip
        own, _ = self._body.place(_path(instance.name, member.name, span))
        if argument.output:
            wired = target(self._body, value)
            self._fixed(wired, value.span)
            return Assign(wired, coerce(self._body, Load(own), wired.type, span, f"`{shown(value)}`"), span)
        checked = as_type(self._body, value, own.type, f"`{member.name}`")
        if isinstance(checked, Load):
            self._fixed(checked.place, value.span)
        return Assign(own, checked, span)

    def _fixed(self, place: Place, span: Span) -> None:
        """Refuses what has to be computed: a wire goes to one place."""
        if place.indices or place.reference is not None or place.slot is not None:
            raise self._report.reject("T004", "A variable with a fixed place is needed here.", span)


def _path(instance: str, member: str, span: Span) -> tree.Expression:
    first, *rest = [*instance.split("."), member]
    node: tree.Expression = tree.Name(first, span)
    for name in rest:
        node = tree.MemberOf(node, name, span)
    return node


def _roots(variables: Record, instances: list[ProgramInstance], resources: list[str]) -> dict[str, Member]:
    """Program instances as variables; each resource as a structure of its program instances and all globals."""
    made: dict[str, Member] = {}
    for resource in resources:
        record = Record(resource, Kind.STRUCT, dict(variables.members))
        made[resource.upper()] = Member(resource, record, Section.GLOBAL, _span(instances))
    for instance in instances:
        resource, _, name = instance.name.rpartition(".")
        member = Member(name, instance.pou.instance, Section.GLOBAL, instance.pou.span, instance.offset, home="GLOBAL")
        owners = [resource] if resource else resources
        if not resource:
            made[name.upper()] = member
        for owner in owners:
            record_type = made[owner.upper()].type
            assert isinstance(record_type, Record)
            record_type.members[name.upper()] = member
    return made


def _span(instances: list[ProgramInstance]) -> Span:
    return instances[0].pou.span if instances else Span("", 1, 1, 1, 1)


def calls_instance(body: tuple[Stmt, ...], offset: int) -> bool:
    """Whether a body calls the block at this offset of its own instance."""
    for statement in body:
        match statement:
            case CallBlock(instance=place):
                if place.slot is None and place.reference is None and place.offset == offset and not place.indices:
                    return True
            case _:
                if any(calls_instance(inner, offset) for inner in bodies(statement)):
                    return True
    return False
