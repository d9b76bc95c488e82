"""CONFIGURATION -> which program instances run in which task, with which names. Nothing has a place yet."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from scanbench.check.context import Rejected, Report, did_you_mean
from scanbench.check.declare.declarations import Declarations
from scanbench.check.declare.names import Space
from scanbench.check.declare.scopes import Pous
from scanbench.check.dialect import Allowance
from scanbench.check.uses import Symbol
from scanbench.problems import Span
from scanbench.program.program import Const, Pou
from scanbench.program.types import LTIME, TIME, Record, Type
from scanbench.syntax import tree
from scanbench.syntax.scl import STARTUP

SHORTEST_NS = 1_000
BACKGROUND = 1 << 16
"""Priority of programs without a task: after all others."""


@dataclass(slots=True)
class PlannedInstance:
    """A program instance; its name has the resource in front where there are several."""

    name: str
    pou: Pou
    declaration: tree.ProgramDeclaration | None = None


@dataclass(slots=True)
class PlannedBlock:
    """An instance of a block in a program that runs in a task of its own."""

    owner: PlannedInstance
    member: str
    span: Span


@dataclass(slots=True)
class PlannedTask:
    """`interval_ns` is 0 for a task that only an event starts."""

    name: str
    interval_ns: int
    priority: int = 0
    runs: list[PlannedInstance | PlannedBlock] = field(default_factory=list)
    single: tree.Expression | None = None


@dataclass(slots=True)
class Resource:
    """The tasks of one RESOURCE, or those declared outside of every RESOURCE."""

    name: str
    prefix: str
    tasks: dict[str, PlannedTask] = field(default_factory=dict)
    background: list[PlannedInstance | PlannedBlock] = field(default_factory=list)


class Planner:
    def __init__(
        self,
        report: Report,
        declarations: Declarations,
        pous: Pous,
        variables: Record,
        interval_ns: int,
        plant: Sequence[Pou] = (),
    ) -> None:
        self._report = report
        self._variables = variables
        self._declarations = declarations
        self._pous = pous
        self._interval_ns = interval_ns
        self._plant = plant
        self._names: dict[str, Span] = {}
        self.resources: list[Resource] = []

    def plant(self) -> None:
        """Names of the plant's programs, which nothing else may have."""
        for pou in self._plant:
            self._is_free(pou.name.rpartition(".")[2], pou.span)

    def _programs(self) -> list[Pou]:
        """Programs that a task may run."""
        programs = (pou for pou in self._pous.blocks.values() if pou.kind == "program" and not pou.inline)
        return [pou for pou in programs if pou not in self._plant]

    @property
    def named(self) -> list[str]:
        """Names of the resources that have one."""
        return [each.name for each in self.resources if each.name]

    @property
    def has_programs(self) -> bool:
        """Whether there is any that a task may run."""
        return bool(self._programs())

    def free(self) -> list[PlannedTask]:
        """Without a CONFIGURATION every PROGRAM that no other POU calls runs, in order of declaration, in one task; one for the start first."""
        task = PlannedTask("Main", self._interval_ns)
        programs = self._programs()
        called = {each for pou in programs for each in self._called_by(pou) if each is not pou}
        for pou in sorted(programs, key=self._is_later):
            if pou in called:
                continue
            name = pou.name.rpartition(".")[2]  # of a namespace: the dot is for resources
            if self._is_free(name, pou.span):
                task.runs.append(PlannedInstance(name, pou))
        return [task]

    def _is_later(self, pou: Pou) -> bool:
        """Whether it is not the one that runs at a start, which comes before the others."""
        declaration = self._declarations.block_trees.get(pou.name.upper())
        return declaration is None or STARTUP not in declaration.modifiers

    def _called_by(self, pou: Pou) -> set[Pou]:
        """All that this program leads to."""
        found, open_ = {pou}, [pou]
        while open_:
            fresh = self._pous.uses.get(open_.pop(), {}).keys() - found
            found |= fresh
            open_ += fresh
        return found

    def configured(self, configuration: tree.Configuration) -> list[PlannedTask]:
        """All tasks, the highest priority first; those of one priority in order of declaration."""
        resources = configuration.resources
        with self._declarations.names.within(Space("", configuration.using)):
            for resource in resources:
                several = len(resources) > 1 and self._is_free(resource.name, resource.span)
                made = Resource(resource.name, f"{resource.name}." if several else "")
                self._resource(made, resource.tasks, resource.programs)
            self._resource(Resource("", ""), configuration.tasks, configuration.programs)
        planned = [task for resource in self.resources for task in resource.tasks.values()]
        background = [each for resource in self.resources for each in resource.background]
        planned.sort(key=lambda each: each.priority)
        if background:
            # as often as the fastest, after all others
            interval = min((each.interval_ns for each in planned if each.interval_ns), default=self._interval_ns)
            planned.append(PlannedTask("Background", interval, BACKGROUND, background))
        return [each for each in planned if each.runs]

    def _resource(
        self,
        resource: Resource,
        tasks: tuple[tree.TaskDeclaration, ...],
        programs: tuple[tree.ProgramDeclaration, ...],
    ) -> None:
        self.resources.append(resource)
        for task in tasks:
            if task.name.upper() in resource.tasks:
                self._report.error("D001", f"The task `{task.name}` is declared already; rename one.", task.span)
                continue
            try:
                resource.tasks[task.name.upper()] = self._task(task, resource.prefix)
            except Rejected:
                continue
        for program in programs:
            self._program(resource, program)

    def _is_free(self, name: str, span: Span) -> bool:
        """Takes the name of a program instance or resource, unless something has it."""
        first = self._names.setdefault(name.upper(), span)
        if name.upper() in self._variables.members:
            self._report.error("D001", f"`{name}` is a VAR_GLOBAL already; rename one.", span)
            return False
        if first is not span:
            self._report.error("D001", f"`{name}` is declared already in line {first.line}; rename one.", span)
        return first is span

    # ---- tasks ------------------------------------------------------------------------------------------

    def _task(self, task: tree.TaskDeclaration, prefix: str) -> PlannedTask:
        interval = 0 if task.single is not None else self._interval_ns
        if task.interval is not None:
            finer = Allowance.SHORT_TIMES in self._declarations.dialect.allows  # there too it may be less than 1 ms
            interval = self._number(task.interval, LTIME if finer else TIME, "The interval of a task is a TIME.")
        if not interval >= SHORTEST_NS and not (interval == 0 and task.single is not None):
            raise self._report.reject("D010", "The interval of a task is at least T#1us.", task.span)
        priority = 0
        if task.priority is not None:
            priority = self._number(task.priority, None, "The priority of a task is an integer.")
            if not 0 <= priority < BACKGROUND:
                raise self._report.reject(
                    "D010", f"The priority of a task is 0 (the highest) to {BACKGROUND - 1}.", task.priority.span
                )
        return PlannedTask(prefix + task.name, interval, priority, single=task.single)

    def _number(self, node: tree.Expression, type: Type | None, message: str) -> int:
        constant: Const = self._declarations.constant_of(node, type)
        if not isinstance(constant.value, int):
            raise self._report.reject("D010", message, node.span)
        return constant.value

    # ---- program instances ------------------------------------------------------------------------------

    def _program(self, resource: Resource, program: tree.ProgramDeclaration) -> None:
        pou = self._pou(program)
        name = resource.prefix + program.name
        if pou is None or not self._is_free(name, program.span):
            return
        made = PlannedInstance(name, pou, program)
        runs = self._task_of(resource, program.task, program.span)
        if runs is not None:
            runs.append(made)
        for path, task, span in program.block_tasks:
            runs = self._task_of(resource, task, span)
            if runs is not None:
                runs.append(PlannedBlock(made, path, span))

    def _pou(self, program: tree.ProgramDeclaration) -> Pou | None:
        key = self._declarations.names.find(program.type.name, program.span, self._pous.blocks)
        pou = self._pous.blocks.get(key or "")
        if pou is not None and pou in self._plant:
            self._report.error(
                "D010", f"`{program.type.name}` is of the plant, which runs by itself in every scan; take it out here.",
                program.span,
            )  # fmt: skip
            return None
        programs = self._programs()
        if pou in programs:
            self._report.use(program.type.span, program.type.name, Symbol("pou", "", pou.name.upper()))
            return pou
        hint = did_you_mean(program.type.name, [each.name for each in programs])
        self._report.error("D010", f"There is no PROGRAM `{program.type.name}`.{hint}", program.span)
        return None

    def _task_of(self, resource: Resource, task: str | None, span: Span) -> list[PlannedInstance | PlannedBlock] | None:
        if task is None:
            return resource.background
        known = resource.tasks.get(task.upper())
        if known is not None:
            return known.runs
        hint = did_you_mean(task, [each.name.removeprefix(resource.prefix) for each in resource.tasks.values()])
        where = f" in the resource `{resource.name}`" if resource.prefix else ""
        self._report.error("D010", f"There is no TASK `{task}`{where}.{hint}", span)
        return None
