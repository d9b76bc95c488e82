"""Instruction List -> checked statements, by way of the tree of ST: every rule of ST holds for IL by itself.

The current result is an expression of the tree: a literal that has no type yet, or the name of a hidden temporary,
one a type and depth of parentheses, that the instruction before has set. Each instruction is a statement of its own.
"""

from dataclasses import dataclass

from scanbench.check.body import conversions, statements
from scanbench.check.body.callees import called
from scanbench.check.body.coercion import as_type
from scanbench.check.body.context import Body
from scanbench.check.body.forms import FORMS
from scanbench.check.body.il_flow import BROKEN, NOTHING, Current, Flow, Label
from scanbench.check.body.il_goals import Goal, goals, remembered
from scanbench.check.body.il_operands import BINARY, callee, hidden, literal, negated, shown, type_of, wanted_by
from scanbench.check.context import Rejected
from scanbench.check.standard.functions import FUNCTIONS
from scanbench.problems import Span
from scanbench.program.program import Assign, Blocks, Const, If, Jump, Pou, Return, Stmt
from scanbench.program.sites import TrapKind
from scanbench.program.types import (
    BOOL,
    Kind,
    Record,
    Section,
    Type,
    has_instance,
)
from scanbench.program.untyped import ANY_INT, settle
from scanbench.syntax import tree

MNEMONICS = (*BINARY, "LD", "ST", "S", "R", "NOT", "JMP", "CAL", "RET")
NEGATABLE = ("LD", "ST", "AND", "&", "OR", "XOR")
CONDITIONAL = ("JMP", "CAL", "RET")
BLOCK_INPUTS = ("S", "R", "S1", "R1", "CLK", "CU", "CD", "LD", "PV", "IN", "PT")
"""Operators of table 70: inputs of the standard blocks."""


@dataclass(frozen=True, slots=True)
class _Open:
    """A parenthesis: the operator that waits for what is inside, and what stood before it."""

    node: tree.IlInstruction
    before: tree.Expression


class InstructionList:
    """One body of IL."""

    def __init__(self, body: Body, written: tree.IlBody) -> None:
        self._body = body
        self._report = body.report
        self._written = written
        self._flow = Flow(written)
        self._blocks: list[list[Stmt]] = []
        self._open: list[_Open] = []
        self._current: Current = NOTHING
        self._dead = False
        self._wanted: Type | None = None
        """What the next instruction works on: a function of literals alone gives that type."""
        self._goal: Goal | None = None
        """The variable with a subrange that the result of the instruction is on its way to."""
        self._find_wanted()
        self._goals = goals(body, written)

    def statements(self) -> tuple[Stmt, ...]:
        """The statements of the body; with labels, one `Blocks`."""
        self._labels_once()
        pou, pous = self._body.pou, self._body.pous
        uses = {} if pou is None else pous.uses.setdefault(pou, {})
        while True:
            mark, before = self._report.mark(), dict(uses)
            self._round()
            if not self._flow.revised():
                break
            self._report.undo(mark)
            uses.clear()
            uses.update(before)
        if len(self._blocks) == 1:
            return tuple(self._blocks[0])
        return (Blocks(tuple(tuple(block) for block in self._blocks), self._written.span),)

    def _labels_once(self) -> None:
        first: dict[str, Span] = {}
        for node in self._written.instructions:
            if node.label is None:
                continue
            known = first.setdefault(node.label.upper(), node.span)
            if known is not node.span:
                self._report.error(
                    "D001", f"The label `{node.label}` is already in line {known.line}; rename one.", node.span
                )

    def _find_wanted(self) -> None:
        """What the first instruction at each label works on tells which type a literal takes that a jump brings there."""
        fresh: list[Label] = []
        for node in self._written.instructions:
            if node.label is not None:
                fresh.append(self._flow.labels[node.label.upper()])
            if not node.operator:
                continue
            wanted = wanted_by(self._body.scope, node)
            for label in fresh:
                label.wanted = wanted
            fresh.clear()

    def _literal_for(self, name: str) -> None:
        """Before the way to a label: a literal is kept in the type that is wanted there."""
        label, current = self._flow.labels[name.upper()], self._current
        if not label.used or label.wanted is None or not isinstance(current.node, tree.Literal):
            return
        span, mark = current.node.span, self._report.mark()
        try:
            value = as_type(self._body, current.node, label.wanted, "The current result")
        except Rejected:
            self._report.undo(mark)
            return
        register = self._register(label.wanted, span)
        place, _ = self._body.place(register)
        self._body.truths.pop(place.offset, None)
        self._emit(Assign(place, value, span))
        self._current = Current(register, label.wanted)

    def _round(self) -> None:
        self._flow.start()
        self._blocks, self._open, self._current, self._dead = [[]], [], NOTHING, False
        self._body.truths.clear()
        following = self._following()
        for node, after, goal in zip(self._written.instructions, following, self._goals, strict=True):
            self._goal = goal
            if node.label is not None:
                self._label(node.label, node.span)
            if not node.operator:
                continue
            self._wanted = None if after is None else wanted_by(self._body.scope, after)
            if not self._flow.falls:
                self._unreachable(node)
            try:
                self._instruction(node)
            except Rejected:
                self._current = BROKEN
        for left in self._open:
            self._report.error(
                "S003", f"`{left.node.operator}(` is never closed; write `)` on a line of its own.", left.node.span
            )

    def _following(self) -> list[tree.IlInstruction | None]:
        """The instruction after each one."""
        found: list[tree.IlInstruction | None] = []
        after = None
        for node in reversed(self._written.instructions):
            found.append(after)
            after = node if node.operator else after
        return found[::-1]

    def _unreachable(self, node: tree.IlInstruction) -> None:
        """Warns once for each range of instructions that a JMP or RET makes unreachable."""
        if not self._dead:
            self._report.warn("W001", "This is never reached: there is no label between it and what leaves.", node.span)
            self._current = BROKEN
        self._dead = True

    def _label(self, name: str, span: Span) -> None:
        if self._open:
            # it is told once, and the parentheses count as closed
            self._report.error(
                "T010", f"The label `{name}` is inside parentheses; close them with `)` before it.", span
            )
            self._open.clear()
            self._current = BROKEN
        self._literal_for(name)
        self._body.truths.clear()
        self._blocks.append([])
        joined = self._flow.enter(name, self._current)
        self._dead = self._dead and not self._flow.falls
        if joined.type is not None and joined.node is None:
            joined = Current(self._register(joined.type, span), joined.type)
        self._current = joined

    # ---- the current result -----------------------------------------------------------------------------

    def _result(self, node: tree.IlInstruction) -> tree.Expression:
        """The current result, which this instruction needs."""
        if self._current.broken:
            raise Rejected
        if self._current.node is None:
            raise self._report.reject(
                "T010", f"There is no current result for {shown(node)}; load a value with LD first"
                f"{self._current.why}.", node.span,
            )  # fmt: skip
        result = self._current.node
        return tree.Name(result.name, node.span) if isinstance(result, tree.Name) else result

    def _set(self, node: tree.Expression, span: Span, wanted: Type | None = None) -> None:
        """Makes a value the current result."""
        value = self._body.expression(node, wanted)
        settled = settle(value)
        if settled.type is None or has_instance(settled.type):
            what = "nothing" if settled.type is None else f"an instance of {settled.type}"
            raise self._report.reject("T002", f"This is {what}; a value is needed here.", span)
        name = self._register(settled.type, span)
        place, _ = self._body.place(name)
        self._emit(Assign(place, remembered(self._body, settled, place, self._goal), span))
        kept = literal(node, value)
        self._current = Current(name if kept is None else kept, settled.type)

    def _register(self, type: Type, span: Span) -> tree.Name:
        """The hidden temporary for a current result of this type."""
        depth = len(self._open)
        return tree.Name(hidden(self._body, f"$cr{depth}.{type}", type, span).name, span)

    def _emit(self, statement: Stmt | None) -> None:
        if statement is not None and self._flow.falls:
            self._blocks[-1].append(statement)

    def _run(self, statement: tree.Statement) -> None:
        self._emit(statements.statement(self._body, statement))

    # ---- instructions -----------------------------------------------------------------------------------

    def _instruction(self, node: tree.IlInstruction) -> None:
        self._modifiers(node)
        if node.operator == ")":
            self._close(node)
        elif self._feeds(node):
            self._feed(node)
        elif node.operator in BINARY and not node.arguments:
            self._binary(node)
        else:
            match node.operator:
                case "LD":
                    operand = self._operand(node)
                    self._set(negated(operand) if node.negated else operand, node.span)
                case "ST":
                    target, result = self._operand(node), self._result(node)
                    self._run(tree.Assignment(target, negated(result) if node.negated else result, node.span))
                case "S" | "R":
                    target, result = self._operand(node), self._result(node)
                    self._run(tree.Assignment(target, result, node.span, f"{node.operator}="))
                case "NOT" if node.operand is None and not node.arguments:
                    self._set(negated(self._result(node)), node.span)
                case "JMP":
                    self._jump(node)
                case "RET":
                    self._conditionally(node, Return(node.span))
                    self._flow.falls = self._flow.falls and node.conditional
                case "CAL":
                    call = tree.Call(self._operand(node), node.arguments, node.span)
                    self._call_block(node, tree.ExpressionStatement(call, node.span))
                case _:
                    self._function(node)

    def _modifiers(self, node: tree.IlInstruction) -> None:
        wrong = ""
        if node.negated and not (node.operator in NEGATABLE or (node.operator in CONDITIONAL and node.conditional)):
            wrong = "N"
        elif node.conditional and node.operator not in CONDITIONAL:
            wrong = "C"
        elif node.deferred and node.operator not in BINARY:
            wrong = "("
        if wrong:
            raise self._report.reject("S003", f"{node.operator} has no modifier `{wrong}`.", node.span)

    def _operand(self, node: tree.IlInstruction) -> tree.Expression:
        if node.operand is None or (node.arguments and node.operator != "CAL"):
            raise self._report.reject("S003", f"{node.operator} takes one operand.", node.span)
        return node.operand

    def _binary(self, node: tree.IlInstruction) -> None:
        before = self._result(node)
        if node.deferred:
            self._open.append(_Open(node, before))
            self._current = NOTHING
            if node.operand is not None:
                self._set(node.operand, node.span)
            return
        operand = self._operand(node)
        operand = negated(operand) if node.negated else operand
        self._set(tree.BinaryOp(BINARY[node.operator], before, operand, node.span), node.span, self._wanted)

    def _close(self, node: tree.IlInstruction) -> None:
        if not self._open:
            raise self._report.reject("S003", "This `)` closes nothing; open with an operator, e.g. `AND(`.", node.span)
        left = self._open[-1]
        try:
            inside = self._result(node)
        finally:
            self._open.pop()
        inside = negated(inside) if left.node.negated else inside
        self._set(tree.BinaryOp(BINARY[left.node.operator], left.before, inside, node.span), node.span, self._wanted)

    # ---- jumps and calls --------------------------------------------------------------------------------

    def _jump(self, node: tree.IlInstruction) -> None:
        operand = self._operand(node)
        labels = self._flow.labels
        if not isinstance(operand, tree.Name) or operand.name.upper() not in labels:
            written = operand.name if isinstance(operand, tree.Name) else "this"
            hint = self._report.near(written, lambda: [label.name for label in labels.values()], "label")
            raise self._report.reject("T001", f"There is no label `{written}` to jump to.{hint}", operand.span)
        if self._open:
            raise self._report.reject("T010", "JMP is inside parentheses; close them with `)` first.", node.span)
        target = labels[operand.name.upper()].block
        back = target < len(self._blocks)
        trap = self._body.trap(TrapKind.LOOP, node.span, "the jump back never ends") if back else 0
        self._literal_for(operand.name)
        self._flow.jump(operand.name, self._current)
        self._conditionally(node, Jump(target, back, trap, node.span))
        self._flow.falls = self._flow.falls and node.conditional

    def _conditionally(self, node: tree.IlInstruction, statement: Stmt | None) -> None:
        if statement is None:
            return
        if not node.conditional:
            self._emit(statement)
            return
        result = self._result(node)
        condition = self._body.expression(result)
        if isinstance(condition, Const) and condition.type == ANY_INT and condition.value in (0, 1):
            condition = Const(BOOL, condition.value)
        if condition.type != BOOL:
            raise self._report.reject(
                "T006", f"{shown(node)} asks for a current result of BOOL, not {settle(condition).type}.", node.span
            )
        if node.negated:
            condition = self._body.expression(negated(result))
        self._emit(If(((condition, (statement,)),), (), node.span))

    def _call_block(self, node: tree.IlInstruction, call: tree.ExpressionStatement) -> None:
        statement = statements.statement(self._body, call)
        self._conditionally(node, statement)

    def _feeds(self, node: tree.IlInstruction) -> bool:
        """Whether the operator is an input of the block that is its operand: `CU counter`."""
        if node.operand is None or node.arguments or node.operator == "CAL":
            return False
        if not isinstance(node.operand, tree.Name | tree.MemberOf | tree.IndexOf):
            return False
        named = node.operator in BLOCK_INPUTS or not (node.operator in MNEMONICS or self._is_function(node.operator))
        record = type_of(self._body.scope, node.operand) if named else None
        if not isinstance(record, Record) or record.kind is not Kind.BLOCK:
            return False
        member = record.members.get(node.operator)
        if member is not None and member.section is Section.INPUT:
            return True
        if node.operator in MNEMONICS:
            return False
        inputs = [each.name for each in record.members.values() if each.section is Section.INPUT and not each.hidden]
        hint = self._report.near(node.operator, lambda: inputs, f"input:{record.name}")
        raise self._report.reject("T001", f"{record.name} has no input `{node.operator}`.{hint}", node.span)

    def _feed(self, node: tree.IlInstruction) -> None:
        argument = tree.Argument(node.operator, False, self._result(node), node.span)
        call = tree.Call(self._operand(node), (argument,), node.span)
        self._run(tree.ExpressionStatement(call, node.span))

    def _function(self, node: tree.IlInstruction) -> None:
        """A function's name as operator: the current result is its first argument, unless the call is formal.

        What takes a variable and not a value, as SUBRANGE_ERROR, has it as operand."""
        pou = self._called(node)
        if node.operator in FORMS and node.operator != "EN_CHECK" and pou is None:
            operand = () if node.operand is None else (tree.Argument(None, False, node.operand, node.operand.span),)
            self._set(tree.Call(callee(node), (*operand, *node.arguments), node.span), node.span, self._wanted)
            return
        formal = any(argument.name is not None for argument in node.arguments)
        arguments = node.arguments
        if not formal and self._takes(node, pou):
            first = [self._result(node)] if node.operand is None else [self._result(node), node.operand]
            arguments = (*(tree.Argument(None, False, value, value.span) for value in first), *arguments)
        elif node.operand is not None:
            raise self._report.reject("T004", f"`{node.operator}` takes no operand here.", node.span)
        call = tree.Call(callee(node), arguments, node.span)
        if pou is not None and pou.result is None:
            self._run(tree.ExpressionStatement(call, node.span))
            self._current = NOTHING
        else:
            self._set(call, node.span, self._wanted)

    def _takes(self, node: tree.IlInstruction, pou: Pou | None) -> bool:
        """Whether it has any argument, so that the current result is the first."""
        if pou is None:
            row = FUNCTIONS.get(node.operator)
            return row is None or bool(row.formals)
        formals = [pou.frame.members[key] for key in pou.parameters]
        taken = [each for each in formals if each.section is not Section.OUTPUT and not each.hidden]
        if taken and taken[0].section is Section.IN_OUT:
            raise self._report.reject(
                "T005", f"The in-out `{taken[0].name}` cannot be bound to the current result; write "
                f"{node.operator}({taken[0].name} := ...).", node.span,
            )  # fmt: skip
        return bool(taken)

    def _called(self, node: tree.IlInstruction) -> Pou | None:
        """The FUNCTION or method that is called; what is neither that, an operator nor a standard function is refused."""
        name, functions = node.operator, self._body.pous.functions
        mark = self._report.mark()
        pou = called(self._body, callee(node))
        self._report.undo(mark)
        if pou is None and not (
            name in FUNCTIONS or name in FORMS or "_" in name or "." in name or conversions.parse_name(name)
        ):
            hint = self._report.near(
                name, lambda: [*MNEMONICS, *(each.name for each in functions.values()), *FUNCTIONS], "operator"
            )
            raise self._report.reject("T001", f"There is no operator or function `{name}`.{hint}", node.span)
        return pou

    def _is_function(self, name: str) -> bool:
        return name in self._body.pous.functions or name in FUNCTIONS
