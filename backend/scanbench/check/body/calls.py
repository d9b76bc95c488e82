"""Calls -> checked calls: of functions, methods and blocks, with EN and ENO."""

from collections.abc import Container
from contextlib import nullcontext
from dataclasses import dataclass, replace

from scanbench.check.body import fold
from scanbench.check.body.arguments import Invocation, together
from scanbench.check.body.dispatch import Dispatcher
from scanbench.check.body.generic import GenericChecker
from scanbench.check.body.methods import Receiver
from scanbench.check.body.notes import note_of
from scanbench.check.body.objects import dotted, named_itself
from scanbench.check.context import Rejected, did_you_mean
from scanbench.check.declare.classes import Class, Method
from scanbench.check.declare.names import Names
from scanbench.check.declare.scopes import decode, place_of
from scanbench.check.standard.functions import FUNCTIONS
from scanbench.problems import Span
from scanbench.program.origin import in_library
from scanbench.program.program import (
    Assign,
    Base,
    CallBlock,
    CallFunction,
    Const,
    Evaluate,
    Expr,
    If,
    Load,
    Place,
    Pou,
    Sequence,
    SetBytes,
    Stmt,
    TrapKind,
    Violates,
)
from scanbench.program.shown import shown
from scanbench.program.types import (
    BOOL,
    ULINT,
    Elementary,
    Member,
    Record,
    Reference,
    Section,
    Subrange,
    Type,
    actual_of,
    base_of,
    initial_of,
)
from scanbench.program.untyped import is_untyped, settle
from scanbench.syntax import tree


@dataclass(frozen=True, slots=True)
class Enabling:
    """The EN and ENO of a call, apart from the call itself."""

    call: tree.Call
    en: tree.Argument | None
    eno: tree.Argument | None


def enabling(node: tree.Call) -> Enabling:
    """Takes EN and ENO off the arguments."""
    en = next((each for each in node.arguments if each.name and each.name.upper() == "EN" and not each.output), None)
    eno = next((each for each in node.arguments if each.name and each.name.upper() == "ENO" and each.output), None)
    if en is None and eno is None:
        return Enabling(node, None, None)
    rest = tuple(each for each in node.arguments if each is not en and each is not eno)
    return Enabling(replace(node, arguments=rest), en, eno)


def given_enable(apart: Enabling, inputs: Container[str]) -> tree.Call:
    """The call itself; it runs when EN is TRUE, and so that is what a declared input EN gets."""
    node, en = apart.call, apart.en
    if en is None or en.value is None or "EN" not in inputs:
        return node
    argument = replace(en, value=tree.Literal("bool", 1, None, en.span))
    return replace(node, arguments=(*node.arguments, argument))


class CallChecker(GenericChecker):
    # ---- calls for their value --------------------------------------------------------------------------

    def call(self, node: tree.Call, wanted: Type | None = None) -> Expr:
        apart = enabling(node)
        if apart.en is not None or apart.eno is not None:
            statements, value = self._enabled(apart, wanted)
            if value is None:
                raise self.report.reject("T010", "This has no result; call it as a statement.", node.span)
            return Sequence(tuple(statements), value)
        callee = self._callee(node.callee, node)
        if callee is not None:
            return self.as_value(self._invoked(callee, node), node.span)
        return self._standard(node, wanted)

    def call_statement(self, node: tree.Call) -> Stmt | None:
        """A call as a statement: of an instance, or of a function or method whose result is dropped."""
        apart = enabling(node)
        callee = self._callee(node.callee, apart.call)
        if callee is None and self._names_instance(node.callee):
            return self.call_block(node)
        if apart.en is not None or apart.eno is not None:
            return together(self._enabled(apart, None)[0], node.span)
        if callee is not None:
            return together(self._invoked(callee, node).statements(node.span), node.span)
        value = self.form(node) or self._standard(node, None)
        if isinstance(value, Violates) and value.site:
            return Assign(self.temporary(BOOL, node.span), value, node.span)
        if isinstance(value, CallFunction):
            return Evaluate(value, node.span)
        if isinstance(value, Sequence):
            last = [Evaluate(value.value, node.span)] if isinstance(value.value, CallFunction) else []
            return together([*value.body, *last], node.span)
        self.report.warn("W001", "The result of this call is dropped.", node.span)
        return None

    def called(self, callee: tree.Expression) -> Pou | None:
        """The FUNCTION or method that a call would run; None for instances and standard functions."""
        found = self._callee(callee)
        return found if found is None or isinstance(found, Pou) else found[1].pou

    def _callee(self, callee: tree.Expression, node: tree.Call | None = None) -> Pou | tuple[Receiver, Method] | None:
        """The FUNCTION or method that is called; None for instances and standard functions.

        Of a generic FUNCTION it is the one for the arguments of `node`.
        """
        method = self.method_called(callee)
        if method is not None:
            return method
        name = dotted(callee)
        if name is None or self._hides(name):
            return None
        names: Names = self.declarations.names
        key = names.find(name, callee.span, self.pous.functions, self.pous.generic)
        found = self.pous.functions.get(key) if key is not None else None
        if in_library(callee.span) and (found is None or not found.inline):
            return None  # the library means its own, which is no POU
        if key in self.pous.generic:
            return self.instantiated(self.pous.generic[key], node or tree.Call(callee, (), callee.span))
        return found

    def _hides(self, path: str) -> bool:
        """Whether this is a variable, and no function: a plain value of the same name, as a result, hides none."""
        found = self.scope.find(path.split(".")[0])
        return found is not None and ("." in path or isinstance(found[0].type, Record | Reference))

    def _invoked(self, callee: Pou | tuple[Receiver, Method], node: tree.Call, eno: Place | None = None) -> Invocation:
        if isinstance(callee, Pou):
            return self.invoke(node, callee, callee.name, None, eno)
        return self.send(*callee, node, eno)

    def _standard(self, node: tree.Call, wanted: Type | None, eno: Place | None = None) -> Expr:
        """A function that is no POU; `eno` becomes FALSE where it finds that its result is not right."""
        if not isinstance(node.callee, tree.Name):
            path = dotted(node.callee)
            if path is not None and self._is_qualified_name(node.callee):
                hint = did_you_mean(path, [pou.name for pou in self.pous.functions.values()])
                raise self.report.reject("T001", f"There is no function `{path}`.{hint}", node.span)
            self._no_value(node.callee)
            raise self.report.reject(
                "T010", "Only functions, methods and instances of function blocks can be called.", node.span
            )
        name = node.callee.name
        key = name.upper()
        if self._hides(name):
            self._no_value(node.callee)
        declared = self.declarations.block_trees.get(key)
        if declared is not None and declared.kind == "program" and not in_library(node.span):  # which means its own
            raise self.report.reject(
                "X001",
                f"`{name}` is a PROGRAM, which a task runs and nobody calls. Make it a FUNCTION_BLOCK, and declare an "
                "instance in VAR.",
                node.span,
            )
        standard = self.standard(node, key, wanted, eno)
        if standard is not None:
            return standard
        known = [*(pou.name for pou in self.pous.functions.values() if not pou.name.startswith("__")), *FUNCTIONS]
        hint = did_you_mean(name, known)
        if self.declarations.find_type(name, node.span) in self.declarations.block_trees:
            hint = f" `{name}` is a FUNCTION_BLOCK: declare an instance in VAR and call that."
        untyped = {(self.scope.pou.upper(), key), ("GLOBAL", key)} & self.declarations.broken
        if key in self.pous.broken or untyped or (self.scope.instance is not None and self.scope.instance.open):
            raise Rejected
        if self.scope.find(name) is not None:
            raise self.report.reject("T010", f"`{name}` is a variable; it cannot be called.", node.span)
        raise self.report.reject("T001", f"There is no function `{name}`.{hint}", node.span)

    def _is_qualified_name(self, callee: tree.Expression) -> bool:
        return isinstance(callee, tree.MemberOf) and self._is_qualified(callee)

    def _no_value(self, callee: tree.Expression) -> None:
        """Refuses an instance of a block that is called for a value."""
        place, _ = self.place(callee)
        if isinstance(place.type, Record):
            raise self.report.reject(
                "T010", f"This is an instance of {place.type}; call it as a statement, then use its outputs.",
                callee.span,
            )  # fmt: skip

    # ---- EN and ENO -------------------------------------------------------------------------------------

    def _enabled(self, apart: Enabling, wanted: Type | None) -> tuple[list[Stmt], Expr | None]:
        """A call with EN or ENO: what runs, and where its result is."""
        with self.explicitly(apart.call):
            return self._enabled_call(apart, wanted)

    def _enabled_call(self, apart: Enabling, wanted: Type | None) -> tuple[list[Stmt], Expr | None]:
        node, span = apart.call, apart.call.span
        condition = self._condition_of(apart.en)
        ok = self.temporary(BOOL, span) if apart.eno is not None else None
        callee = self._callee(node.callee, node)
        if callee is None:
            run, result, told = self._enabled_standard(node, wanted, ok)
        else:
            called = callee if isinstance(callee, Pou) else callee[1].pou
            inputs = called.frame.members if called is not None else ()
            made = self._invoked(callee, given_enable(apart, inputs), ok)
            pou = made.call.pou
            result = self.temporary(pou.result, span) if pou.result is not None else None
            run, told = made.statements(span, result), "ENO" in pou.parameters
        if ok is not None and not told:
            run.append(Assign(ok, Const(BOOL, 1), span))
        if condition is not None:
            skipped = [self._zero(result, span)] if result is not None else []
            if ok is not None:
                skipped.append(Assign(ok, Const(BOOL, 0), span))
            run = [If(((condition, tuple(run)),), tuple(skipped), span)]
        if ok is not None and apart.eno is not None:
            run.append(self._store_eno(Load(ok), apart.eno))
        return run, Load(result) if result is not None else None

    def _enabled_standard(
        self, node: tree.Call, wanted: Type | None, ok: Place | None
    ) -> tuple[list[Stmt], Place | None, bool]:
        """The same for a standard function: what runs, its result, and whether it tells ENO itself."""
        value = self._standard(node, wanted, ok)
        if is_untyped(value):
            literal = isinstance(wanted, Elementary)
            value = self.coerce(value, wanted, node.span, "The result") if literal and wanted else settle(value)
        assert value.type is not None
        result = self.temporary(value.type, node.span)
        run: list[Stmt] = [] if ok is None else [Assign(ok, Const(BOOL, 1), node.span)]
        return [*run, Assign(result, value, node.span)], result, ok is not None

    def _condition_of(self, en: tree.Argument | None) -> Expr | None:
        if en is None or en.value is None:
            return None
        return self.as_type(en.value, BOOL, "`EN`")

    def _store_eno(self, value: Expr, eno: tree.Argument) -> Stmt:
        if eno.value is None:
            raise self.report.reject("T004", "`ENO` needs a variable: write `ENO => ...`.", eno.span)
        target = self.target(eno.value)
        value = fold.unary("not", BOOL, value) if eno.negated else value
        return Assign(target, self.coerce(value, target.type, eno.span, "The target of `ENO`"), eno.span)

    def _zero(self, place: Place, span: Span) -> Stmt:
        data = initial_of(place.type)
        constant = decode(place.type, data)
        if constant is not None and isinstance(place.type, Elementary):
            return Assign(place, constant, span)
        return SetBytes(place, data, span)

    # ---- blocks -----------------------------------------------------------------------------------------

    def _names_instance(self, callee: tree.Expression) -> bool:
        if named_itself(callee, "THIS") or named_itself(callee, "SUPER"):
            return True
        if isinstance(callee, tree.Name):
            found = self.scope.find(callee.name)
            return found is not None and isinstance(found[0].type, Record | Reference)
        return True

    def call_block(self, node: tree.Call) -> Stmt:
        """`instance(...)` as a statement."""
        apart = enabling(node)
        instance, callee, name = self._instance(apart.call)
        record = callee.instance
        condition = self._condition_of(apart.en)
        told = {
            key: _inside(instance, record, member)
            for key, section in (("EN", Section.INPUT), ("ENO", Section.OUTPUT))
            if (member := record.members.get(key)) is not None and member.section is section and member.type == BOOL
        }
        given = given_enable(apart, told)
        with self.explicitly(given) if apart.en is not None or apart.eno is not None else nullcontext():
            statements = self._block_statements(given, instance, callee, name)
        if apart.eno is not None:
            ok: Expr = Load(told["ENO"]) if "ENO" in told else Const(BOOL, 1)
            statements.append(self._store_eno(ok, apart.eno))
        if condition is None:
            return together(statements, node.span)
        skipped: list[Stmt] = [Assign(place, Const(BOOL, 0), node.span) for place in told.values()]
        if apart.eno is not None:
            skipped.append(self._store_eno(Const(BOOL, 0), apart.eno))
        return If(((condition, tuple(statements)),), tuple(skipped), node.span)

    def _instance(self, node: tree.Call) -> tuple[Place, Pou, str]:
        """The instance that is called, the POU that runs, and the name of its type."""
        receiver = self.receiver(node.callee)
        if receiver is None:
            place, _ = self.place(node.callee)
            raise self.report.reject("T010", f"{place.type} has no body and cannot be called.", node.span)
        _, member = (None, None) if receiver.place.reference else self._declared(node.callee)
        if member is not None and member.constant:
            raise self.report.reject("T003", f"`{member.name}` is CONSTANT, so it cannot run.", node.span)
        owner = receiver.owner
        callee = self._body_of(receiver, owner)
        if callee is None and owner.open:
            raise Rejected  # it may be of a kind that has one
        if callee is None:
            raise self.report.reject(
                "T010", f"`{owner.name}` has no body that could be called; call one of its methods.", node.span
            )
        return replace(receiver.place, type=callee.instance), callee, owner.name

    def _declared(self, callee: tree.Expression) -> tuple[None, Member | None]:
        if named_itself(callee, "THIS") or named_itself(callee, "SUPER"):
            return None, None
        return None, self.place(callee)[1]

    def _body_of(self, receiver: Receiver, owner: Class) -> Pou | None:
        own = self.pous.blocks.get(owner.name.upper())
        if owner.kind not in ("function_block", "program"):
            return None
        if receiver.exact or receiver.above:
            return own
        through = receiver.place.reference is not None
        return Dispatcher(self.report, self.pous).body(owner, always=through)

    def _block_statements(self, node: tree.Call, instance: Place, callee: Pou, name: str) -> list[Stmt]:
        record = callee.instance
        formals = list(record.members.values())
        given = self.given(node, [each for each in formals if each.section is not Section.VAR], record, name)
        before: list[Stmt] = []
        after: list[Stmt] = []
        in_outs, bound = [], {}
        for each in formals:
            if each.section is Section.IN_OUT and not each.hidden:
                argument = given.get(each.name.upper())
                target = self.in_out(each, argument.value if argument else None, node.span, before)
                bound[each.name.upper()] = target
                slot = actual_of(record, each) if each.copied else each
                if not each.copied or self._rebinds(node, record, each, target, before):
                    in_outs.append((_slot(record, slot), target))
        inputs, outputs = [], []
        for key, argument in given.items():
            formal = record.members[key]
            if argument.value is None or formal.section is Section.IN_OUT:
                continue
            own = own_place(record, formal)
            if formal.section is Section.INPUT:
                inputs += self._noted_input(
                    own, self.as_type(argument.value, formal.type, f"`{formal.name}`"), formal, argument.span
                )
                continue
            target, member = self.declared_target(argument.value)
            note = self.noting(target, member)
            if note is not None and isinstance(target.type, Subrange):
                taken = self.temporary(base_of(target.type), argument.span)
                outputs.append((self._output(Load(own), taken.type, argument), taken))
                value = self.coerce(Load(taken), target.type, argument.span, f"`{shown(argument.value)}`")
                after.append(Assign(target, self.keeping(value, note, argument.span), argument.span))
                continue
            outputs.append((self._output(Load(own), target.type, argument), target))
        for each in formals:
            if each.hidden and each.section is Section.INPUT:
                inputs.append((own_place(record, each), self.open_bound(each, bound)))
        self.pous.use(self.pou, callee)
        call = CallBlock(instance, callee, tuple(inputs), tuple(in_outs), tuple(outputs), node.span)
        return [*before, call, *after]

    def _noted_input(self, own: Place, value: Expr, formal: Member, span: Span) -> list[tuple[Place, Expr]]:
        """An input, and its note: what the caller gave before it was limited."""
        note = note_of(own, formal, None)
        if note is None or not isinstance(formal.type, Subrange):
            return [(own, value)]
        kept = self.temporary(base_of(formal.type), span)
        return [(own, self.keeping(value, kept, span)), (note, Load(kept))]

    def _rebinds(self, node: tree.Call, record: Record, member: Member, target: Place, before: list[Stmt]) -> bool:
        """Whether an in-out by value is bound to something else by this call: SUPER runs in the same instance. So what this body
        made of it goes back first, and when it is passed on as it is, it stays bound to what was passed here."""
        if not named_itself(node.callee, "SUPER"):
            return True
        inside = self.own(place_of(member, Base.SELF, record, 0))
        trap = self.trap(TrapKind.NULL, node.span, f"the in-out {member.name} is not connected")
        outside = self.own(place_of(actual_of(record, member), Base.SELF, record, trap))
        if not member.constant:
            before.append(Assign(outside, Load(inside), node.span))
        return target != inside


def own_place(record: Record, member: Member) -> Place:
    """A member of a block, seen from its own body."""
    if member.located:
        return Place(member.type, Base.IMAGE, member.offset, bit=member.bit, variable="@")
    return Place(member.type, Base.SELF, member.offset, bit=member.bit, variable=_variable(record, member))


def _slot(record: Record, member: Member) -> Place:
    return Place(ULINT, Base.SELF, member.offset, variable=_variable(record, member))


def _inside(instance: Place, record: Record, member: Member) -> Place:
    """An output of an instance, seen from outside."""
    free = instance.slot is not None or instance.reference is not None or instance.variable.startswith("@")
    variable = instance.variable if free else _variable(record, member)
    return replace(instance, type=member.type, offset=instance.offset + member.offset, variable=variable)


def _variable(record: Record, member: Member) -> str:
    return f"{member.home or record.name}.{member.name}".upper()
