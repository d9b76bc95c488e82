"""The last pass: which programs run in which task, and where everything lives in the image."""

import math
from dataclasses import dataclass, field, replace

from scanbench.check.context import Rejected, Report, did_you_mean
from scanbench.check.declare.configuration import PlannedBlock, PlannedInstance, PlannedTask, Planner
from scanbench.check.declare.connections import Wiring, calls_instance
from scanbench.check.declare.declarations import Declarations
from scanbench.check.declare.scopes import Pous
from scanbench.check.declare.settings import Settings
from scanbench.check.declare.start_references import bind_start_references
from scanbench.check.life.whole import Whole
from scanbench.plcmodel.model import Location, Model
from scanbench.problems import Severity, Span
from scanbench.program.copies import copies_of
from scanbench.program.layout import Layout, align
from scanbench.program.program import Base, Place, Pou, Program
from scanbench.program.tasks import ProgramInstance, Task
from scanbench.program.types import BOOL, Kind, Member, Record, Section
from scanbench.syntax import tree
from scanbench.syntax.scl import is_scl

BUDGET = 10_000_000
"""Loop rounds a scan may take before it counts as endless: about 10 ms of native code at least."""


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


@dataclass(frozen=True, slots=True)
class Around:
    """Programs that run in every scan without a task: common processing, and the plant in its order."""

    common: list[Pou]
    plant: list[Pou]
    life: Whole | None
    """What initialises instances."""
    placed: Record
    """Programs that have their place already (`placed_programs`)."""
    settings: list[tree.Variable]
    """VAR_CONFIG outside of a CONFIGURATION."""


def assemble(
    report: Report,
    declarations: Declarations,
    pous: Pous,
    variables: Record,
    order: list[Pou],
    configurations: list[tree.Configuration],
    interval_ns: int,
    where: Span,
    around: "Around",
) -> Program | None:
    """The program, or None when there is nothing that can run."""
    planner = Planner(report, declarations, pous, variables, interval_ns, around.plant)
    configuration = configurations[0] if configurations else None
    planned = _planned(report, planner, configurations)
    if not any(task.runs for task in planned):
        if configuration is not None or not planner.has_programs:  # else they call each other, which was reported
            _tell_empty(report, where, around)
        return None
    model = declarations.model
    layout = Layout(model, place_areas(model), variables, pous.aliases, declarations.symbols)
    placing = _Placing(report, pous, align(around.placed.size), dict(around.placed.members))
    common = placing.one_by_one(around.common)
    life = placing.one_by_one([] if around.life is None else [around.life.pou])
    placing.programs(planned)
    called = placing.called()
    plant = placing.one_by_one(around.plant)
    instances = [*placing.instances.values(), *called]
    wiring = Wiring(report, declarations, pous, variables, instances, planner.named)
    tasks, interval = _tasks(planned, placing, wiring, interval_ns)
    run = {each.pou for each in (*life, *(each for task in tasks for each in task.programs))}
    others = {*around.common, *around.plant, *(each.pou for each in called)}
    needed, tasked = _reachable(order, pous, others | run), _reachable(order, pous, run)
    noted = _noted(report, needed, pous)
    layout.frames = _place_violations(report, layout, align(placing.at), bool(noted))
    if around.life is not None:
        around.life.write([*instances, *plant])
    layout.state_size = _place_frames([each for each in needed if each.addressed], layout.frames)
    layout.size = _place_frames([each for each in needed if not each.addressed], layout.state_size)
    layout.size = _place_callers(needed, noted, layout.size)
    running = [*common, *life, *instances, *plant]
    if any(member.copied for pou in needed for member in pou.instance.members.values()):
        layout.copies = copies_of([(variables, 0), *((each.pou.instance, each.offset) for each in running)])
    image = _initial_image(layout, declarations, variables, running)
    program = Program(
        tuple(needed), tasks, interval, tuple(report.traps), layout, image, tuple(report.checks), tuple(report.calls),
        common=common, plant=plant, tasked=tuple(tasked), life=life, called=called,
    )  # fmt: skip
    made = Settings(report, declarations, program, planner.named).apply(configuration, around.settings)
    return replace(made, checks=tuple(report.checks), dialect=declarations.dialect.name)


def _tell_empty(report: Report, where: Span, around: Around) -> None:
    alone = " What is in plant/ drives the inputs of a program." if around.plant else ""
    program = "ORGANIZATION_BLOCK" if is_scl(where.file) else "PROGRAM"
    report.error("D011", f"There is no {program}, so nothing would run.{alone}", where)


def _planned(report: Report, planner: Planner, configurations: list[tree.Configuration]) -> list[PlannedTask]:
    planned = planner.configured(configurations[0]) if configurations else planner.free()
    planner.plant()
    for extra in configurations[1:]:
        report.error("D010", "A program has one CONFIGURATION; remove this one.", extra.span)
    return planned


def _noted(report: Report, needed: list[Pou], pous: Pous) -> set[Pou]:
    """What is called and has checks, or calls something that has: its callers write down that they call it."""
    callers: dict[Pou, list[Pou]] = {}
    for pou in needed:
        for callee in pous.uses.get(pou, {}):
            callers.setdefault(callee, []).append(pou)
    parts = ((pou, report.parts.get(pou)) for pou in needed)
    open_ = [pou for pou, part in parts if part is not None and any(not each.needless for each in part.checks)]
    found = set(open_)
    while open_:
        for caller in callers.get(open_.pop(), ()):
            if caller not in found:
                found.add(caller)
                open_.append(caller)
    return found & callers.keys()


def _place_violations(report: Report, layout: Layout, at: int, paths: bool) -> int:
    """Gives the list of violations its place, where the program has subrange checks, and their paths; the byte after the state."""
    if not report.checks:
        return at
    layout.violations = at
    at = align(at + 8 + Layout.VIOLATION_LIMIT * Layout.VIOLATION_BYTES)
    if not paths:
        return at
    layout.paths = at
    return at + 8 * Layout.PATH_LIMIT * Layout.VIOLATION_LIMIT


def _tasks(
    planned: list[PlannedTask], placing: "_Placing", wiring: Wiring, interval_ns: int
) -> tuple[tuple[Task, ...], int]:
    """The tasks, and the length of a scan: what divides all their intervals."""
    intervals = [each.interval_ns for each in planned if each.interval_ns]
    interval = math.gcd(*intervals) if intervals else interval_ns
    made = []
    for task in planned:
        runs = []
        for each in task.runs:
            if isinstance(each, PlannedInstance):
                instance = placing.instances[each.name.upper()]
                if each.declaration is not None:
                    before, after = wiring.connect(instance, each.declaration)
                    instance = replace(instance, before=before, after=after)
                runs.append(instance)
            elif (block := placing.block(each)) is not None:
                runs.append(block)
        single = wiring.event(task.single) if task.single is not None else None
        previous = placing.flag(f"{task.name}.previous") if single is not None else None
        every = task.interval_ns // interval
        span = task.single.span if task.single is not None else None
        made.append(Task(task.name, task.interval_ns, task.priority, every, tuple(runs), single, previous, span))
    return tuple(made), interval


@dataclass(slots=True)
class _Placing:
    """Gives program instances, and what tasks have to remember, their places in the image."""

    report: Report
    pous: Pous
    at: int
    placed: dict[str, Member]
    """Programs whose first instance has its place, by upper-case name."""
    instances: dict[str, ProgramInstance] = field(default_factory=dict)

    def programs(self, planned: list[PlannedTask]) -> None:
        """All program instances, task by task."""
        for task in planned:
            for each in task.runs:
                if isinstance(each, PlannedInstance):
                    self._connected(each)
                    retain = each.declaration is not None and each.declaration.retain
                    self.instances[each.name.upper()] = ProgramInstance(
                        each.name, each.pou, self._place_of(each.pou), retain=retain
                    )

    def _connected(self, planned: PlannedInstance) -> None:
        """Refuses a program with in-outs, which only a call connects."""
        pou = planned.pou
        if any(each.severity is Severity.ERROR for each in self.report.problems):
            return  # the call that connects it may be in what was refused
        open_ = next((each.name for each in pou.instance.members.values() if each.section is Section.IN_OUT), None)
        if open_ is not None:
            span = pou.span if planned.declaration is None else planned.declaration.span
            self.report.error(
                "T005", f"`{pou.name}` has the in-out `{open_}`, which nothing would connect when a task runs it; call it in "
                f"another program, `{pou.name}({open_} := ...)`.", span,
            )  # fmt: skip

    def _place_of(self, pou: Pou) -> int:
        placed = self.placed.pop(pou.name.upper(), None)
        if placed is not None:
            return placed.offset
        at = align(self.at)
        self.at = at + pou.instance.size
        return at

    def called(self) -> tuple[ProgramInstance, ...]:
        """Instances of the programs that no task runs, but others call or look into."""
        pous = (self.pous.blocks.get(name) for name in self.placed)
        return tuple(
            ProgramInstance(pou.name, pou, self.placed[pou.name.upper()].offset) for pou in pous if pou is not None
        )

    def one_by_one(self, pous: list[Pou]) -> tuple[ProgramInstance, ...]:
        """Instances of what runs around the tasks, named as the programs are."""
        made = []
        for pou in pous:
            self.at = align(self.at)
            made.append(ProgramInstance(pou.name.rpartition(".")[2], pou, self.at))
            self.at += pou.instance.size
        return tuple(made)

    def flag(self, name: str) -> Place:
        """A BOOL of its own."""
        self.at += 1
        return Place(BOOL, Base.IMAGE, self.at - 1, variable=f"${name}".upper())

    def block(self, planned: PlannedBlock) -> ProgramInstance | None:
        """An instance of a function block in a program, for a task that runs it by itself."""
        owner = self.instances.get(planned.owner.name.upper())
        if owner is None:
            return None
        offset, record = 0, owner.pou.instance
        try:
            for name in planned.member.split("."):
                member = self._member(record, name, planned.span)
                offset += member.offset
                assert isinstance(member.type, Record)
                record = member.type
            return self._associated(owner, planned, offset, record)
        except Rejected:
            return None

    def _member(self, record: Record, name: str, span: Span) -> Member:
        member = record.members.get(name.strip().upper())
        if member is None or not isinstance(member.type, Record) or member.type.kind is not Kind.BLOCK:
            blocks = [each.name for each in record.members.values() if isinstance(each.type, Record)]
            hint = did_you_mean(name, blocks)
            raise self.report.reject("D010", f"`{record.name}` has no function block `{name}`.{hint}", span)
        return member

    def _associated(
        self, owner: ProgramInstance, planned: PlannedBlock, offset: int, record: Record
    ) -> ProgramInstance:
        path = f"{owner.name}.{planned.member}"
        pou = self.pous.blocks.get(record.name.upper())
        if pou is None or pou.inline or pou.kind != "function_block":
            raise self.report.reject(
                "X001", f"`{path}` is of the library's {record.name}, which cannot run in a task by itself yet; call it in "
                "a program there.", planned.span,
            )  # fmt: skip
        if any(member.section is Section.IN_OUT for member in record.members.values()):
            raise self.report.reject(
                "T005", f"`{path}` has an in-out, which nothing would connect when a task runs it.", planned.span
            )
        if calls_instance(owner.pou.body, offset):
            raise self.report.reject(
                "X001", f"`{owner.pou.name}` calls `{planned.member}` as well, which a task is to run; take the call out and "
                "assign its inputs.", planned.span,
            )  # fmt: skip
        return ProgramInstance(path, pou, owner.offset + offset)


def _reachable(order: list[Pou], pous: Pous, roots: set[Pou]) -> list[Pou]:
    """What the programs call, in the order callees first."""
    found, open_ = set(roots), list(roots)
    while open_:
        for callee in pous.uses.get(open_.pop(), {}):
            if callee not in found:
                found.add(callee)
                open_.append(callee)
    return [pou for pou in order if pou in found]


def _place_frames(pous: list[Pou], at: int) -> int:
    """Gives each its frame, from this byte of the image on; the byte after the last one."""
    for pou in pous:
        pou.frame_offset = at
        at = align(at + pou.frame.size)
    return at


def _place_callers(pous: list[Pou], noted: set[Pou], at: int) -> int:
    """Gives each of the noted ones the place of its caller, from this byte of the image on; the byte after the last one."""
    for pou in pous:
        pou.called_at = at if pou in noted else 0
        at += 8 if pou in noted else 0
    return at


def _on_at_the_start(model: Model) -> list[Location]:
    """Bits that are on before anything ran: of a device with a standby both CPU Units run."""
    standby = model.standby
    return [] if standby is None else [place for place in (standby.duplex, standby.active) if place is not None]


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
    bind_start_references(declarations, variables, instances, image)
    for place in _on_at_the_start(layout.model):
        offset = layout.areas[place.area.name] + place.byte
        image[offset] |= 1 << (place.bit or 0)
    for offset, mask, data in declarations.located:
        for index, byte in enumerate(data, offset):
            image[index] = image[index] & ~mask | byte & mask
    return bytes(image)
