"""The last pass: which programs run in which task, and where everything lives in the image."""

import math

from scanbench.check.context import Rejected, Report, did_you_mean
from scanbench.check.declare import Declarations
from scanbench.check.layout import Layout
from scanbench.check.program import Const, Pou, Program, ProgramInstance, Task
from scanbench.check.scopes import Pous
from scanbench.check.types import TIME, Record, Type
from scanbench.plcmodel.model import Model
from scanbench.problems import Span
from scanbench.syntax import tree

BUDGET = 10_000_000
"""Loop rounds a scan may take before it counts as endless: about 10 ms of native code at least."""


def align(offset: int) -> int:
    return -(-offset // 8) * 8


def place_areas(model: Model) -> dict[str, int]:
    """Offsets of the model's areas: the same for every program of a model."""
    offsets, at = {}, Layout.HEADER_SIZE
    for area in model.areas:
        offsets[area.name] = at
        at = align(at + area.size)
    return offsets


def place_globals(model: Model, areas: dict[str, int], variables: Record) -> None:
    """Makes the globals' offsets absolute: they follow the areas."""
    base = max([Layout.HEADER_SIZE, *(align(areas[area.name] + area.size) for area in model.areas)])
    for member in variables.members.values():
        if not member.located:
            member.offset += base
    variables.size += base


def assemble(
    report: Report,
    declarations: Declarations,
    pous: Pous,
    variables: Record,
    order: list[Pou],
    configurations: list[tree.Configuration],
    interval_ns: int,
    where: Span,
) -> Program | None:
    """The program, or None when there is nothing that can run."""
    tasks = _Tasks(report, declarations, pous, variables, interval_ns)
    planned = tasks.configured(configurations[0]) if configurations else tasks.free()
    for extra in configurations[1:]:
        report.error("D010", "A program has one CONFIGURATION; remove this one.", extra.span)
    if not any(programs for _, _, _, programs in planned):
        report.error("D011", "There is no PROGRAM, so nothing would run.", where)
        return None
    layout = Layout(declarations.model, place_areas(declarations.model))
    layout.globals = variables
    at = align(variables.size)
    interval = math.gcd(*(each[1] for each in planned)) if planned else interval_ns
    made, instances = [], []
    for name, task_interval, priority, programs in planned:
        placed = []
        for instance_name, pou in programs:
            placed.append(ProgramInstance(instance_name, pou, at))
            at = align(at + pou.instance.size)
        instances += placed
        made.append(Task(name, task_interval, priority, task_interval // interval, tuple(placed)))
    layout.state_size = at
    needed = _reachable(order, pous, {instance.pou for instance in instances})
    for pou in needed:
        pou.frame_offset = at
        at = align(at + pou.frame.size)
    layout.size = at
    image = _initial_image(layout, declarations, variables, instances)
    return Program(tuple(needed), tuple(made), interval, tuple(report.traps), layout, image)


def _reachable(order: list[Pou], pous: Pous, roots: set[Pou]) -> list[Pou]:
    """What the programs call, in the order callees first."""
    found, open_ = set(roots), list(roots)
    while open_:
        for callee in pous.uses.get(open_.pop(), {}):
            if callee not in found:
                found.add(callee)
                open_.append(callee)
    return [pou for pou in order if pou in found]


def _initial_image(
    layout: Layout, declarations: Declarations, variables: Record, instances: list[ProgramInstance]
) -> bytes:
    image = bytearray(layout.size)
    image[layout.BUDGET_LIMIT : layout.BUDGET_LIMIT + 8] = BUDGET.to_bytes(8, "little")
    for member in variables.members.values():
        if member.initial and not member.located:
            image[member.offset : member.offset + len(member.initial)] = member.initial
    for instance in instances:
        data = instance.pou.instance.initial()
        image[instance.offset : instance.offset + len(data)] = data
    for offset, mask, data in declarations.located:
        for index, byte in enumerate(data, offset):
            image[index] = image[index] & ~mask | byte & mask
    return bytes(image)


Planned = list[tuple[str, int, int, list[tuple[str, Pou]]]]
"""Task name, interval in ns, priority (0 first), and its program instances."""


class _Tasks:
    def __init__(
        self, report: Report, declarations: Declarations, pous: Pous, variables: Record, interval_ns: int
    ) -> None:
        self.report = report
        self.variables = variables
        self.declarations = declarations
        self.pous = pous
        self.interval_ns = interval_ns

    def free(self) -> Planned:
        """Without a CONFIGURATION every PROGRAM runs, in order of declaration, in one task."""
        programs = [(pou.name, pou) for pou in self.pous.blocks.values() if pou.kind == "program"]
        for name, pou in programs:
            if name.upper() in self.variables.members:
                self.report.error("D001", f"`{name}` is a VAR_GLOBAL already; rename one.", pou.span)
        return [("Main", self.interval_ns, 0, programs)]

    def configured(self, configuration: tree.Configuration) -> Planned:
        planned: dict[str, tuple[str, int, int, list[tuple[str, Pou]]]] = {}
        for task in configuration.tasks:
            if task.name.upper() in planned:
                self.report.error("D001", f"`{task.name}` is declared already; rename one.", task.span)
                continue
            interval, priority = self.interval_ns, 0
            try:
                if task.interval is not None:
                    interval = self._number(task.interval, TIME)
                if task.priority is not None:
                    priority = self._number(task.priority, None)
            except Rejected:
                continue
            if interval < 1_000:
                self.report.error("D010", "The interval of a task is at least T#1us.", task.span)
                continue
            planned[task.name.upper()] = (task.name, interval, priority, [])
        background: list[tuple[str, Pou]] = []
        names: set[str] = set()
        for program in configuration.programs:
            self._add(program, planned, background, names)
        result = sorted(planned.values(), key=lambda each: each[2])
        if background:
            # a program without a task runs as often as the fastest, after all others
            interval = min((each[1] for each in result), default=self.interval_ns)
            result.append(("Background", interval, 1 << 16, background))
        return [each for each in result if each[3]] or result

    def _number(self, node: tree.Expression, type: Type | None) -> int:
        constant: Const = self.declarations.constant_of(node, type)
        if not isinstance(constant.value, int):
            raise self.report.reject("D010", "The priority of a task is an integer.", node.span)
        return constant.value

    def _add(
        self,
        program: tree.ProgramDeclaration,
        planned: dict[str, tuple[str, int, int, list[tuple[str, Pou]]]],
        background: list[tuple[str, Pou]],
        names: set[str],
    ) -> None:
        pou = self.pous.blocks.get(program.type_name.upper())
        programs = [each.name for each in self.pous.blocks.values() if each.kind == "program"]
        if pou is None or pou.kind != "program":
            hint = did_you_mean(program.type_name, programs)
            self.report.error("D010", f"There is no PROGRAM `{program.type_name}`.{hint}", program.span)
            return
        if program.name.upper() in names or program.name.upper() in self.variables.members:
            self.report.error("D001", f"`{program.name}` is declared already; rename one.", program.span)
            return
        names.add(program.name.upper())
        if program.task is None:
            background.append((program.name, pou))
        elif program.task.upper() in planned:
            planned[program.task.upper()][3].append((program.name, pou))
        else:
            hint = did_you_mean(program.task, [each[0] for each in planned.values()])
            self.report.error("D010", f"There is no TASK `{program.task}`.{hint}", program.span)
