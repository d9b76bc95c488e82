"""The scan: the contract of `engines/engine.py` in IR. The loop that runs scans is in `emit_loop`, the same for all programs."""

from scanbench.engines.native import emit_expressions, emit_statements
from scanbench.engines.native.emit_body import Body, Unit
from scanbench.engines.native.emit_checks import note_call
from scanbench.engines.native.emit_function import UNLIKELY, FunctionText, Value
from scanbench.engines.native.emit_loop import FORCES_NAME
from scanbench.engines.native.emit_memory import store
from scanbench.engines.native.emit_places import address, load
from scanbench.problems import Span
from scanbench.program.layout import FORCE_AFTER_PROGRAM, FORCE_BEFORE, Layout
from scanbench.program.program import Pou, Program, Stmt
from scanbench.program.tasks import ProgramInstance, Task
from scanbench.program.types import BOOL, Kind, Record

SCRATCH = '@"t.scan"'
"""Memory of the temporaries of what a configuration connects."""


def emit(unit: Unit, program: Program) -> None:
    """Adds `@scan` to the module."""
    unit.module.declare(f"@{FORCES_NAME}", f'declare void @"{FORCES_NAME}"(ptr, i64, i32) cold nounwind willreturn')
    unit.module.add(_scan(unit, program))


def _scan(unit: Unit, program: Program) -> str:
    size = program.layout.size
    head = f"define i32 @scan(ptr nonnull noundef align 8 dereferenceable({size}) %img) #0"
    text = FunctionText(head, SCRATCH)
    body = _around(unit, text)
    unit.flavour.begin(body)
    scan = _field(text, Layout.SCAN)
    number = text.op(f"load i64, ptr {scan}, align 8{unit.module.tag('#scan')}")
    origin = text.op(f"load i64, ptr {_field(text, Layout.ORIGIN)}, align 8{unit.module.tag('#origin')}")
    passed = text.op(f"mul i64 {number}, {program.interval_ns}")
    clock = text.op(f"and i64 {text.op(f'add i64 {origin}, {passed}')}, {(1 << 63) - 1}")
    text.do(f"store i64 {clock}, ptr {_field(text, Layout.CLOCK)}, align 8{unit.module.tag('#clock')}")
    limit = text.op(f"load i64, ptr {_field(text, Layout.BUDGET_LIMIT)}, align 8{unit.module.tag('#limit')}")
    text.do(f"store i64 {limit}, ptr {_field(text, Layout.BUDGET)}, align 8{unit.module.tag('#budget')}")
    text.do(
        f"store i64 {program.interval_ns}, ptr {_field(text, Layout.INTERVAL)}, align 8{unit.module.tag('#interval')}"
    )
    text.do(f"store i32 0, ptr {_field(text, Layout.ASKED_COUNT)}, align 8{unit.module.tag('#asked')}")
    if any(pou.recursive for pou in program.pous):
        text.do(f"store i32 0, ptr {_field(text, Layout.DEPTH)}, align 8{unit.module.tag('#depth')}")
    body.unit.flavour.silence(body, True)
    for instance in program.common:
        _program(body, instance)
    if program.life:
        body.unit.flavour.silence(body, False)
        for instance in program.life:
            _program(body, instance)
        body.unit.flavour.silence(body, True)
    for instance in program.plant:
        _program(body, instance)
    body.unit.flavour.silence(body, False)
    _forces(unit, text, FORCE_BEFORE, size)
    for task in program.tasks:
        _task(body, task, number)
    _forces(unit, text, FORCE_AFTER_PROGRAM, size)
    unit.flavour.done(body)
    following = text.op(f"add i64 {number}, 1")
    text.do(f"store i64 {following}, ptr {scan}, align 8{unit.module.tag('#scan')}")
    text.do("ret i32 0")
    if text.scratch_size:
        unit.reserve(body.pou, SCRATCH, text.scratch_size)
    return text.text()


def _around(unit: Unit, text: FunctionText) -> Body:
    """What runs around the programs, for which all places are in the image."""
    empty = Record("CONFIGURATION", Kind.STRUCT)
    pou = Pou("CONFIGURATION", "function", empty, empty, (), None, Span("", 0, 0, 0, 0))
    return Body(unit, pou, text, emit_expressions.scalar, emit_expressions.pieces, emit_statements.run)


def _field(text: FunctionText, offset: int) -> str:
    return text.op(f"getelementptr inbounds nuw i8, ptr %img, i64 {offset}")


def _forces(unit: Unit, text: FunctionText, note: int, size: int) -> None:
    where = _field(text, Layout.FORCE_COUNT)
    count = text.op(f"load i32, ptr {where}, align 4{unit.module.tag('#forcecount')}")
    apply, on = text.name("force"), text.name("on")
    text.choose(text.op(f"icmp ne i32 {count}, 0"), apply, on, UNLIKELY)
    text.begin(apply)
    text.do(f'call void @"{FORCES_NAME}"(ptr %img, i64 {note}, i32 {size})')
    text.go(on)
    text.begin(on)


def _task(body: Body, task: Task, number: str) -> None:
    text = body.text
    due, on = text.name("due"), text.name("on")
    text.choose(_is_due(body, task, number), due, on)
    text.begin(due)
    for instance in task.programs:
        _program(body, instance)
    text.go(on)
    text.begin(on)


def _is_due(body: Body, task: Task, number: str) -> str:
    text, cyclic = body.text, "false"
    if task.every:
        cyclic = text.op(f"icmp eq i64 {text.op(f'urem i64 {number}, {task.every}')}, 0") if task.every > 1 else "true"
    if task.single is None or task.previous is None:
        return cyclic
    single = load(body, task.single).ssa
    where = address(body, task.previous)
    before = load(body, task.previous).ssa
    store(body, where, BOOL, Value(single, 0, 1))
    return text.op(f"select i1 {single}, i1 {text.op(f'xor i1 {before}, true')}, i1 {cyclic}")


def _program(body: Body, instance: ProgramInstance) -> None:
    _joined(body, instance, instance.before)
    note_call(body, instance.pou, 0)
    call = f"call i32 {body.unit.symbol(instance.pou)}(ptr %img, i64 {instance.offset})"
    body.text.check_status(body.text.op(call))
    _joined(body, instance, instance.after)


def _joined(body: Body, instance: ProgramInstance, statements: tuple[Stmt, ...]) -> None:
    if statements:
        with body.unit.flavour.joined(body, instance):
            body.run(statements)
