"""Calls whose callee depends on the class of the instance: a generated POU that looks at `$type` and goes on."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from scanbench.check.context import Report
from scanbench.check.declare.classes import TYPE_NUMBER, Class, Method, reachable_pou
from scanbench.check.declare.scopes import Pous, place_of
from scanbench.problems import Span
from scanbench.program.program import (
    Assign,
    Base,
    CallBlock,
    CallFunction,
    Case,
    Const,
    Evaluate,
    Expr,
    Load,
    Place,
    Pou,
    Stmt,
)
from scanbench.program.sites import CallSite, TrapKind
from scanbench.program.types import BOOL, NULL, UDINT, Kind, Member, Record, Section


def type_number(instance: Place) -> Place:
    """The number of the class of this instance."""
    return replace(instance, type=UDINT)


def in_this_instance(slot: Place, offset: int, null_trap: int) -> Place:
    """The place `offset` bytes after the beginning of the instance that THIS is bound to."""
    return Place(UDINT, Base.FRAME, offset, slot=slot, null_trap=null_trap)


@dataclass(slots=True)
class Dispatcher:
    """Makes the dispatching POUs of one program, each once."""

    report: Report
    pous: Pous

    def method(self, owner: Class, method: Method, always: bool) -> Pou | None:
        """What a call of this method on an instance of `owner`, or of something derived from it, runs.

        Where there is one candidate, that itself, unless the class is to be looked at `always`.
        """
        found = self.pous.classes.implementations(owner, lambda each: reachable_pou(each, method.key))
        if not owner.polymorphic or (len(found) == 1 and not always):
            return next(iter(found), None)
        signature = method.pou
        if signature is None:
            return None
        name = f"{owner.name}.{method.key}.dispatch"
        known = self.pous.dispatchers.get(name)
        return known or self._remember(name, found, lambda: self._method(name, owner, signature, found))

    def body(self, owner: Class, always: bool) -> Pou | None:
        """What a call of an instance of `owner`, or of something derived from it, runs."""
        blocks = self.pous.blocks
        found = self.pous.classes.implementations(owner, lambda each: blocks.get(each.name.upper()))
        if not owner.polymorphic or (len(found) == 1 and not always):
            return next(iter(found), None)
        name = f"{owner.name}.dispatch"
        known = self.pous.dispatchers.get(name)
        return known or self._remember(name, found, lambda: self._body(name, owner, found))

    def _remember(self, name: str, found: dict[Pou, list[int]], make: Callable[[], Pou]) -> Pou:
        with self.report.apart() as part:
            made = self.pous.dispatchers[name] = make()
        self.report.parts[made] = part
        for callee in found:
            self.pous.use(made, callee)
        return made

    # ---- methods ----------------------------------------------------------------------------------------

    def _method(self, name: str, owner: Class, signature: Pou, found: dict[Pou, list[int]]) -> Pou:
        frame = Record(name, Kind.STRUCT)
        frame.open = signature.frame.open
        for key in signature.parameters:
            member = signature.frame.members[key]
            this = owner.record if key == "THIS" else None
            frame.place(replace(member, type=this or member.type, offset=0, home="", initial=b""))
        parameters = signature.parameters
        if "ENO" not in parameters and any("ENO" in callee.parameters for callee in found):
            frame.place(Member("ENO", BOOL, Section.OUTPUT, signature.span))
            parameters = (*parameters, "ENO")
        if signature.returned is not None:
            frame.place(replace(signature.returned, offset=0, home="", initial=b""))
        trap = self.report.trap(TrapKind.NULL, signature.span, name, "THIS refers to no instance")
        made = Pou(name, "function", Record(name, Kind.BLOCK), frame, parameters, signature.result, signature.span)
        branches = [(_labels(numbers), (self._go_on(made, callee, trap),)) for callee, numbers in found.items()]
        slot = place_of(frame.members["THIS"], Base.FRAME, frame, trap).slot
        assert slot is not None
        otherwise = self._nothing(made)
        choice = Case(Load(in_this_instance(slot, 0, trap)), tuple(branches), (otherwise,), signature.span)
        made.body = (*self._succeeds(made), choice if branches else otherwise)
        return made

    def _succeeds(self, made: Pou) -> tuple[Stmt, ...]:
        """ENO is TRUE where the method does not say otherwise."""
        eno = made.frame.members.get("ENO")
        if eno is None or eno.section is not Section.OUTPUT:
            return ()
        return (Assign(place_of(eno, Base.FRAME, made.frame, 0), Const(BOOL, 1), made.span),)

    def _go_on(self, made: Pou, callee: Pou, trap: int) -> Stmt:
        """Calls the method with the same arguments."""
        args = tuple(self._passed(made, callee, key, trap) for key in callee.parameters)
        site = self.report.call(CallSite(made.span, made.name, passes=True))
        call = CallFunction(callee, callee.result, args, site)
        if made.returned is None:
            return Evaluate(call, made.span)
        return Assign(place_of(made.returned, Base.FRAME, made.frame, 0), call, made.span)

    def _passed(self, made: Pou, callee: Pou, key: str, trap: int) -> Expr | Place | None:
        wanted = callee.frame.members[key]
        member = made.frame.members.get(key)
        if member is None:  # EN or ENO, which the signature need not have
            return None if wanted.section is Section.OUTPUT else Const(wanted.type, 1)  # type: ignore[arg-type]
        place = place_of(member, Base.FRAME, made.frame, trap)
        if member.section is Section.INPUT:
            return Load(place)
        return replace(place, type=wanted.type)

    def _nothing(self, made: Pou) -> Stmt:
        """Traps: this instance is of a class that has no body for the call."""
        site = self.report.trap(TrapKind.ABSTRACT, made.span, made.name, "the instance has no body for this call")
        lost = Member("$lost", UDINT, Section.TEMP, made.span, hidden=True)
        made.frame.place(lost)
        nowhere = Place(UDINT, Base.IMAGE, 0, reference=Const(NULL, 0), null_trap=site)
        return Assign(place_of(lost, Base.FRAME, made.frame, 0), Load(nowhere), made.span)

    # ---- bodies of blocks -------------------------------------------------------------------------------

    def _body(self, name: str, owner: Class, found: dict[Pou, list[int]]) -> Pou:
        assert owner.record is not None
        span: Span = owner.declaration.span
        made = Pou(name, "function_block", owner.record, Record(name, Kind.STRUCT), (), None, span)
        branches = []
        for callee, numbers in found.items():
            itself = Place(callee.instance, Base.SELF, 0)
            site = self.report.call(CallSite(span, name, passes=True))
            branches.append((_labels(numbers), (CallBlock(itself, callee, (), (), (), span, site),)))
        number = owner.record.members[TYPE_NUMBER.upper()]
        selector = Load(place_of(number, Base.SELF, owner.record, 0))
        otherwise = self._nothing(made)
        made.body = (Case(selector, tuple(branches), (otherwise,), span) if branches else otherwise,)
        return made


def _labels(numbers: list[int]) -> tuple[tuple[int, int], ...]:
    return tuple((number, number) for number in numbers)
