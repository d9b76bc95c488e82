"""Statements."""

from dataclasses import replace
from typing import assert_never

from scanbench.engines.native import emit_calls, emit_loops, emit_pieces, emit_try, walk
from scanbench.engines.native.emit_body import Body
from scanbench.engines.native.emit_function import Value
from scanbench.engines.native.emit_memory import canonical, load_at, move, put
from scanbench.engines.native.emit_places import address
from scanbench.engines.native.emit_types import elementary, integer, is_real, value_type
from scanbench.engines.native.emit_values import put as put_value
from scanbench.engines.native.speculate import to_selects
from scanbench.program.bodies import keeps_bits
from scanbench.program.program import (
    Assign,
    Blocks,
    CallBlock,
    Case,
    Continue,
    Evaluate,
    Exit,
    For,
    Halt,
    If,
    Jump,
    Place,
    Repeat,
    Return,
    SetBytes,
    Stmt,
    Try,
    While,
)
from scanbench.program.types import Elementary, Kind

WIDEST_RANGE = 64
"""Labels of a CASE that are listed one by one; wider ranges are compared."""


def run(body: Body, statements: tuple[Stmt, ...]) -> None:
    """Emits the statements in order."""
    if not body.divided:
        _one_by_one(body, statements)
        return
    for group, apart in emit_pieces.pieces(statements):
        (emit_pieces.call if apart else _one_by_one)(body, group)


def _one_by_one(body: Body, statements: tuple[Stmt, ...]) -> None:
    flavour = body.unit.flavour
    for statement in statements:
        with flavour.statement(body, statement):
            one(body, statement)
        body.text.end_statement()


def one(body: Body, statement: Stmt) -> None:
    """Emits a statement."""
    match statement:
        case Assign():
            assign(body, statement)
        case SetBytes(target, data):
            where = address(body, target)
            move(body, where.pointer, body.module.constant(data), len(data))
            body.unit.flavour.written(body, target, where)
        case CallBlock():
            emit_calls.block(body, statement)
        case Evaluate(call):
            emit_calls.run(body, call)
        case If():
            speculated = body.unit.flavour.may_select(body, statement) and to_selects(body, statement)
            selects(body, statement) if speculated else branches(body, statement)
        case Case():
            case(body, statement)
        case For():
            with body.unit.flavour.loop(body, statement):
                emit_loops.for_loop(body, statement)
        case While():
            with body.unit.flavour.loop(body, statement):
                emit_loops.while_loop(body, statement)
        case Repeat():
            emit_loops.repeat_loop(body, statement)
        case Blocks(inner):
            blocks(body, inner)
        case Exit() | Continue() | Return() | Jump() | Halt():
            leave(body, statement)
        case Try():
            emit_try.run(body, statement)
        case _:
            assert_never(statement)


def leave(body: Body, statement: Exit | Continue | Return | Jump | Halt) -> None:
    """Goes on somewhere else."""
    match statement:
        case Exit():
            label = body.exits[-1]
        case Continue():
            label = body.rounds[-1]
        case Return():
            label = body.leave
        case Jump(number, back, trap):
            if back:
                emit_loops.take(body, "1", trap)
            label = body.labels[number]
        case Halt(trap):
            label = body.text.fail(str(trap))
        case _:
            assert_never(statement)
    body.text.go(label)
    body.text.begin(body.text.name("dead"))


def blocks(body: Body, inner: tuple[tuple[Stmt, ...], ...]) -> None:
    """One after the other; each can be jumped to."""
    outer, body.labels = body.labels, [body.text.name("block") for _ in inner]
    for label, statements in zip(body.labels, inner, strict=True):
        body.text.go(label)
        body.text.begin(label)
        run(body, statements)
    body.labels = outer


def assign(body: Body, statement: Assign) -> None:
    """Evaluates the value, then the target's address, then stores."""
    target = statement.target
    held = emit_calls.value(body, statement.value, walk.address_disturbs(target))
    if keeps_bits(statement) and isinstance(held, Value):
        held = replace(held, clean=True)
    put_value(body, target, held)


# ---- IF -------------------------------------------------------------------------------------------------------


def branches(body: Body, statement: If) -> None:
    """IF with jumps."""
    text = body.text
    after = text.name("endif")
    for way, (condition, inside) in enumerate(statement.branches):
        then, otherwise = text.name("then"), text.name("else")
        text.choose(body.scalar(condition).ssa, then, otherwise)
        text.begin(then)
        body.unit.flavour.goes(body, statement, way)
        run(body, inside)
        text.go(after)
        text.begin(otherwise)
    body.unit.flavour.goes(body, statement, len(statement.branches))
    run(body, statement.orelse)
    text.go(after)
    text.begin(after)


def selects(body: Body, statement: If) -> None:
    """IF without jumps: every target is stored, with its own value where the condition is false."""
    text, still = body.text, "true"
    for condition, inside in statement.branches:
        holds = body.scalar(condition).ssa
        _guarded(body, text.op(f"and i1 {still}, {holds}"), inside)
        still = text.op(f"and i1 {still}, {text.op(f'xor i1 {holds}, true')}")
    _guarded(body, still, statement.orelse)


def _guarded(body: Body, guard: str, statements: tuple[Stmt, ...]) -> None:
    for statement in statements:
        assert isinstance(statement, Assign)
        body.unit.flavour.selected(body, statement, guard)
        _store_if(body, guard, statement.target, statement)


def _store_if(body: Body, guard: str, target: Place, statement: Assign) -> None:
    type = elementary(target.type)
    value = body.scalar(statement.value)
    ssa = canonical(body, type, value) if is_real(type) and not keeps_bits(statement) else value.ssa
    where = address(body, target)
    if type.kind is Kind.BOOL and not where.bit:  # the whole byte is kept, also the bits that mean nothing
        whole = body.text.op(f"load i8, ptr {where.pointer}, align 1{where.tag}")
        byte = body.text.op(f"zext i1 {ssa} to i8")
        kept = body.text.op(f"select i1 {guard}, i8 {byte}, i8 {whole}")
        body.text.do(f"store i8 {kept}, ptr {where.pointer}, align 1{where.tag}")
        return
    old = load_at(body, where, type)
    name = value_type(type)
    put(body, where, type, body.text.op(f"select i1 {guard}, {name} {ssa}, {name} {old.ssa}"))


# ---- CASE -----------------------------------------------------------------------------------------------------


def case(body: Body, statement: Case) -> None:
    """CASE: a switch, after comparisons for wide ranges."""
    text, type = body.text, elementary(statement.selector.type)
    value, name = body.scalar(statement.selector), value_type(type)
    after, otherwise = text.name("endcase"), text.name("else")
    targets = [text.name("case") for _ in statement.branches]
    single: list[str] = []
    for (labels, _), target in zip(statement.branches, targets, strict=True):
        for low, high in labels:
            if high - low < WIDEST_RANGE:
                single += [f"{name} {integer(each, type)}, label %{target}" for each in range(low, high + 1)]
            else:
                _wide_label(body, type, value.ssa, (low, high), target)
    text.do(f"switch {name} {value.ssa}, label %{otherwise} [ {' '.join(single)} ]")
    for way, ((_, inside), target) in enumerate(zip(statement.branches, targets, strict=True)):
        text.begin(target)
        body.unit.flavour.goes(body, statement, way)
        run(body, inside)
        text.go(after)
    text.begin(otherwise)
    body.unit.flavour.goes(body, statement, len(statement.branches))
    run(body, statement.orelse)
    text.go(after)
    text.begin(after)


def _wide_label(body: Body, type: Elementary, ssa: str, label: tuple[int, int], target: str) -> None:
    text, name, sign = body.text, value_type(type), "s" if type.signed else "u"
    above = text.op(f"icmp {sign}ge {name} {ssa}, {integer(label[0], type)}")
    below = text.op(f"icmp {sign}le {name} {ssa}, {integer(label[1], type)}")
    on = text.name("on")
    text.choose(text.op(f"and i1 {above}, {below}"), target, on)
    text.begin(on)
