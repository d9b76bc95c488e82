"""What the networks of a body share: where their statements go, temporaries, memories of edges, labels and jumps."""

from collections.abc import Callable

from scanbench.check.body import assignments, fold, statements
from scanbench.check.body.context import Body
from scanbench.check.body.enabling import Enabling, enabled
from scanbench.check.body.il_operands import hidden
from scanbench.check.context import Rejected
from scanbench.problems import Span
from scanbench.program.program import Assign, Blocks, Expr, If, Jump, Load, Place, Return, Stmt
from scanbench.program.sites import TrapKind
from scanbench.program.types import BOOL, Elementary, Type, base_of
from scanbench.syntax import networks, tree


class NetworkCode:
    """The code of one body of networks."""

    def __init__(self, body: Body, written: networks.NetworkBody) -> None:
        self.body = body
        self.report = body.report
        self._written = written
        self._memories = {id(each): name for each, name in networks.edges(written)}
        self._loops = {id(each): name for each, name in networks.loops(written)}
        self._blocks: list[list[Stmt]] = [[]]
        self._labels: dict[str, int] = {}
        self._number = 0
        """Of the network, from 1."""
        self._count = 0
        """Temporaries of the network."""
        self._leaving: list[tuple[networks.Leave, tree.Name | None]] = []
        self._temporaries: dict[str, Place] = {}
        """Where they are: each network has its first, second and so on in the same place, and each is written once and read often."""
        self._find_labels()

    def _find_labels(self) -> None:
        labelled = [each for each in self._written.networks if each.label]
        for number, each in enumerate(labelled, 1):
            if each.label.upper() in self._labels:
                self.report.error("D001", f"The label `{each.label}` is there already; rename one.", each.span)
            self._labels.setdefault(each.label.upper(), number)

    def begin(self, network: networks.Rung | networks.Diagram) -> None:
        self._count, self._leaving = 0, []
        self._number += 1
        self.body.scope.wires.clear()
        self.body.unmade.clear()
        if network.label:
            self._blocks.append([])

    @property
    def leaves(self) -> bool:
        """Whether something in the network jumps or returns."""
        return bool(self._leaving)

    def end(self) -> None:
        """A network is complete only when all its elements are (8.1.5): now its jumps are taken, the first that is TRUE."""
        for leave, condition in self._leaving:
            try:
                self._leave(leave, condition)
            except Rejected:
                continue

    def whole(self) -> tuple[Stmt, ...]:
        """The statements of the body; with labels, one `Blocks`."""
        if len(self._blocks) == 1:
            return tuple(self._blocks[0])
        return (Blocks(tuple(tuple(block) for block in self._blocks), self._written.span),)

    def emit(self, statement: Stmt | None) -> None:
        if statement is not None:
            self._blocks[-1].append(statement)

    def apart(self, make: Callable[[], None]) -> tuple[Stmt, ...]:
        """What is emitted meanwhile, for the inside of a statement."""
        self._blocks.append([])
        try:
            make()
        finally:
            made = self._blocks.pop()
        return tuple(made)

    def truth(self, node: tree.Expression) -> Expr:
        """A BOOL, as IF wants it."""
        return assignments.condition(self.body, node)

    def run(self, node: tree.Statement) -> None:
        self.emit(statements.statement(self.body, node))

    def temporary(self, kind: str, type: Type, span: Span) -> tree.Name:
        """A temporary of its own."""
        self._count += 1
        name = hidden(self.body, f"${kind}{self._count}", type, span).name
        if name not in self._temporaries:
            self._temporaries[name] = self.body.place(tree.Name(name, span))[0]
        return tree.Name(name, span)

    def wire(self, name: str, type: Type, span: Span) -> tree.Name:
        """A wire or link, `#low`, of this network alone: a temporary with its name."""
        made = hidden(self.body, f"{name}/{self._number}", type, span)
        self.body.scope.wires[name.upper()] = made.name.upper()
        return tree.Name(name, span)

    def loop(self, wire: networks.Wire) -> bool:
        """Makes a wire known that keeps its value. Whether the body has a place for it."""
        name = self._loops[id(wire)]
        self.body.scope.wires[wire.name.upper()] = name
        return self.body.scope.find(name) is not None

    def note(self, value: Expr, span: Span, kind: str = "power") -> tree.Name:
        """Keeps a BOOL for what comes after it. `power`: of a contact, which a step over skips (`symbols.sites`)."""
        name = self.temporary(kind, BOOL, span)
        self.store(name, value, span)
        return name

    def store(self, name: tree.Name, value: Expr, span: Span) -> None:
        self.emit(Assign(self._place(name), value, span))

    def load(self, name: tree.Name) -> Expr:
        return Load(self._place(name))

    def _place(self, name: tree.Name) -> Place:
        return self._temporaries.get(name.name) or self.body.place(name)[0]

    def memory(self, each: networks.Contact | networks.Coil) -> tree.Name:
        """The variable that keeps what an edge saw last."""
        if self.body.scope.find(self._memories[id(each)]) is None:
            raise self.report.reject(
                "T010",
                "An edge remembers the last evaluation, and a FUNCTION or METHOD keeps nothing; use R_TRIG or F_TRIG of the caller.",
                each.span,
            )
        return tree.Name(self._memories[id(each)], each.span)

    def edge(self, each: networks.Contact, value: Expr, span: Span, kind: str = "power") -> Expr:
        """Whether a value rose (P) or fell (N) since the last evaluation; it is looked at once."""
        memory, now = self.memory(each), self.note(value, span, kind)
        before = self.note(self.load(memory), span, kind)
        self.store(memory, self.load(now), span)
        first, second = (now, before) if each.mode == "P" else (before, now)
        return fold.binary("and", BOOL, self.load(first), fold.unary("not", BOOL, self.load(second)))

    def leave_later(self, each: networks.Leave, condition: tree.Name | None) -> None:
        """A jump, or RETURN, that was decided where it is written; None: always."""
        self._leaving.append((each, condition))

    def _leave(self, each: networks.Leave, condition: tree.Name | None) -> None:
        taken: Stmt = Return(each.span)
        if each.label:
            target = self._labels.get(each.label.upper())
            if target is None:
                names = [network.label for network in self._written.networks if network.label]
                hint = self.report.near(each.label, lambda: names, "label")
                raise self.report.reject("T001", f"There is no label `{each.label}` to jump to.{hint}", each.span)
            trap = self.body.trap(TrapKind.LOOP, each.span, f"the jumps to {each.label} do not end")
            taken = Jump(target, target < len(self._blocks), trap, each.span)
        self.emit(taken if condition is None else If(((self.load(condition), (taken,)),), (), each.span))

    def _wanted(self, target: tree.Expression) -> Type | None:
        """The type that literals of a box take. Nothing is said here of a target that is wrong."""
        mark = self.report.mark()
        try:
            type = self.body.place(target)[0].type
        except Rejected:
            type = None
        self.report.undo(mark)
        return base_of(type) if isinstance(type, Elementary) else None

    def enabled_result(self, target: tree.Expression, apart: Enabling, ok: tree.Name, span: Span) -> None:
        """Writes the result of a call with EN or ENO, where it worked."""
        run, value = enabled(self.body, apart, self._wanted(target))
        if value is None or value.type is None:
            raise self.report.reject("T002", "This gives no value, so nothing can be assigned.", span)
        for statement in run:
            self.emit(statement)
        made = tree.Name(hidden(self.body, f"$result.{value.type}", value.type, span).name, span)
        self.store(made, value, span)
        self.run(tree.IfStatement(((ok, (tree.Assignment(target, made, span),)),), (), span))
