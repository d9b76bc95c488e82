"""Breakpoints in the program that runs: the place of each, or the reason why it has none."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from difflib import get_close_matches

from scanbench.debug.assign import Assigning
from scanbench.debug.breakpoint import Breakpoint, Verdict
from scanbench.debug.hits import HitRule, parse_hits
from scanbench.debug.texts import BadText, Holds, Says, Texts
from scanbench.problems import perhaps
from scanbench.program.bodies import every
from scanbench.program.program import Pou, Program, Return
from scanbench.program.types import BOOL, Kind, Record
from scanbench.symbols.call_sites import formal_of
from scanbench.symbols.sites import Sites
from scanbench.symbols.symbols import Symbol, UnknownPath, resolve


@dataclass(eq=False, slots=True)
class Placed:
    """A breakpoint, and what it means in one program. Texts are understood in the scope of each POU in which it is placed."""

    breakpoint: Breakpoint
    sites: frozenset[int] = frozenset()
    symbol: Symbol | None = None
    copy: Symbol | None = None
    """What a block works on that takes the in-out by value; `symbol` is what was passed."""
    block: Symbol | None = None
    """The instance of that block."""
    rule: HitRule | None = None
    instance: int | None = None
    """Offset of the only instance in which it acts."""
    task: str = ""
    conditions: Mapping[Pou | None, Holds] = field(default_factory=dict)
    messages: Mapping[Pou | None, Says] = field(default_factory=dict)
    assigns: Mapping[Pou | None, Assigning] = field(default_factory=dict)
    flaw: str = ""
    """Why it has no place; empty if it has one."""
    remark: str = ""
    hits: int = 0

    @property
    def active(self) -> bool:
        """Whether it does anything."""
        return self.breakpoint.enabled and not self.flaw

    @property
    def halts(self) -> bool:
        """Whether it halts where it acts."""
        return not self.breakpoint.log and not self.breakpoint.assign

    def verdict(self, sites: Sites) -> Verdict:
        """As people see it."""
        if self.flaw:
            return Verdict(self.breakpoint, False, self.flaw, hits=self.hits)
        if not self.sites:
            return Verdict(self.breakpoint, True, self.remark, hits=self.hits)
        span = sites.statements[min(self.sites)].span
        return Verdict(
            self.breakpoint, True, self.remark, span.line, span.column, span.end_line, span.end_column, self.hits
        )  # fmt: skip


class Placing:
    """Places breakpoints in one program."""

    def __init__(self, program: Program, sites: Sites, texts: Texts) -> None:
        self.program, self.sites, self.texts = program, sites, texts
        self.pou_of: dict[int, Pou] = {site: pou for pou, numbers in sites.bodies.items() for site in numbers}
        """The POU of each statement; lines of a CONFIGURATION have none."""
        self.task_of: dict[int, str] = {
            each.offset: task.name for task in program.tasks for each in task.programs
        }  # fmt: skip
        """The task of each program instance."""
        self.minor = frozenset(number for number, site in enumerate(sites.statements) if site.minor)
        self.returns = frozenset(self._returns())
        """The RETURNs: what a block with in-outs by value copies back before one is told as its access."""

    def _returns(self) -> Iterator[int]:
        for pou in self.sites.bodies:
            if any(each.copied for each in pou.instance.members.values()):
                spans = {each.span.plain() for each in every(pou.body) if isinstance(each, Return)}
                yield from (each for each in self.sites.bodies[pou] if self.sites.statements[each].span in spans)

    def place(self, breakpoint: Breakpoint, scan: int) -> Placed:
        """What the breakpoint means in this program; `scan` is the next scan of the PLC."""
        placed = Placed(breakpoint)
        try:
            rule = parse_hits(breakpoint.hits)
            if isinstance(rule, str):
                raise BadText(rule)
            placed.rule = rule
            _KINDS[breakpoint.kind](self, placed, scan)
            self._narrow(placed)
            self._texts(placed)
        except BadText as bad:
            placed.flaw = bad.message
        return placed

    # ---- kinds ----------------------------------------------------------------------------------------------------

    def _line(self, placed: Placed, scan: int) -> None:
        breakpoint = placed.breakpoint
        file = self._file(breakpoint.file)
        found = self.sites.at_line(file, breakpoint.line)
        if not found:
            found = self._below(file, breakpoint.line)
            line = self.sites.statements[found[0]].span.line
            placed.remark = f"moved to line {line}: line {breakpoint.line} has no statement"
        spans = [self.sites.statements[each].span for each in found]
        columns = sorted({span.column for span in spans})
        column = columns[0]
        if breakpoint.column:
            column = max((each for each in columns if each <= breakpoint.column), default=column)
            # the name of a box with contacts of its own is in none: these run first, then the box
            end = max((span.end_line, span.end_column) for span in spans if span.column == column)
            if end <= (breakpoint.line, breakpoint.column):
                column = min((each for each in columns if each > breakpoint.column), default=column)
        placed.sites = frozenset(
            each for each, span in zip(found, spans, strict=True) if span.column == column
        )  # fmt: skip

    def _file(self, name: str) -> str:
        files = list(dict.fromkeys(site.span.file for site in self.sites.statements))
        if name in files:
            return name
        ends = [each for each in files if each.lower() == name.lower() or each.lower().endswith(f"/{name.lower()}")]
        if len(ends) == 1 and name:
            return ends[0]
        near = get_close_matches(name, files, n=3, cutoff=0.3)
        where = f"the program that runs has no statement in {name or 'a file without a name'}"
        raise BadText(f"{where}.{perhaps(near)}")

    def _below(self, file: str, line: int) -> tuple[int, ...]:
        lines = sorted({site.span.line for site in self.sites.statements if site.span.file == file})
        below = next((each for each in lines if each > line), None)
        if below is None:
            raise BadText(f"no statement begins at {file}:{line} or below; the last one is at line {lines[-1]}")
        return self.sites.at_line(file, below)

    def _data(self, placed: Placed, scan: int) -> None:
        breakpoint = placed.breakpoint
        if breakpoint.assign:
            raise BadText("a value is assigned at a line: set a line breakpoint for it")
        placed.symbol = self._symbol(breakpoint.path)
        if placed.symbol.type.size == 0:
            raise BadText(f"{placed.symbol.path} takes no memory, so nothing can be read or written there")
        formal = formal_of(self.program, breakpoint.path)
        if formal is None or not formal.member.copied:
            return
        block, inner = formal.instance, placed.symbol
        if len(inner.slots) == len(block.slots) + 1:  # else there is a reference in the copy
            offset = block.offset + formal.member.offset + inner.offset
            placed.block = block
            placed.copy = replace(block, path=inner.path, type=inner.type, offset=offset, bit=inner.bit)

    def _error(self, placed: Placed, scan: int) -> None:
        known = {each.id: None for each in self.program.layout.model.errors()}
        for name in error_names(placed.breakpoint):
            if name not in known:
                near = get_close_matches(name, known, 3, 0.4)
                raise BadText(f"the model {self.program.layout.model.name} has no error {name}.{perhaps(near)}")

    def _violation(self, placed: Placed, scan: int) -> None:
        if not self.program.checks:
            placed.remark = "the program has no variable of a subrange, so nothing can violate one"

    def _trap(self, placed: Placed, scan: int) -> None:
        """It needs no place."""

    def _scan(self, placed: Placed, scan: int) -> None:
        if placed.breakpoint.scan < scan:
            placed.remark = f"scan {placed.breakpoint.scan} is over: the PLC is at scan {scan}"

    # ---- what narrows it ------------------------------------------------------------------------------------------

    def _narrow(self, placed: Placed) -> None:
        breakpoint = placed.breakpoint
        if breakpoint.task:
            names = [task.name for task in self.program.tasks]
            placed.task = next((each for each in names if each.upper() == breakpoint.task.upper()), "")
            if not placed.task:
                raise BadText(f"there is no task {breakpoint.task}; there are {', '.join(names)}")
        if not breakpoint.instance:
            return
        symbol = self._symbol(breakpoint.instance)
        if not isinstance(symbol.type, Record) or symbol.type.kind is Kind.STRUCT or symbol.slots:
            raise BadText(f"{symbol.path} is no instance: name one of a program or function block")
        placed.instance = symbol.offset
        pous = {self.pou_of[each] for each in placed.sites if each in self.pou_of}
        if pous and not any(_runs_in(pou, symbol.type) for pou in pous):
            owners = " or ".join(sorted(pou.name for pou in pous))
            raise BadText(f"{symbol.path} is a {symbol.type.name}, and the statement is of {owners}")

    def _symbol(self, path: str) -> Symbol:
        try:
            return resolve(self.program, path)
        except UnknownPath as error:
            raise BadText(f"{error.message}{perhaps(error.near)}") from None

    def _texts(self, placed: Placed) -> None:
        breakpoint, texts = placed.breakpoint, self.texts
        scopes = {self.pou_of.get(each) for each in placed.sites} or {None}
        if breakpoint.condition.strip():
            placed.conditions = {pou: texts.condition(pou, breakpoint.condition) for pou in scopes}
        if breakpoint.log.strip():
            placed.messages = {pou: texts.message(pou, breakpoint.log) for pou in scopes}
        if breakpoint.assign.strip():
            placed.assigns = {pou: texts.assigning(pou, breakpoint.assign) for pou in scopes}


_KINDS: Mapping[str, Callable[[Placing, Placed, int], None]] = {
    "line": Placing._line,
    "data": Placing._data,
    "error": Placing._error,
    "violation": Placing._violation,
    "trap": Placing._trap,
    "scan": Placing._scan,
}


def error_names(breakpoint: Breakpoint) -> tuple[str, ...]:
    """The errors it is for; none: any."""
    return tuple(filter(None, (each.strip() for each in breakpoint.error.split(","))))


def bytes_of(symbol: Symbol, memory: bytearray) -> tuple[int, int, int] | None:
    """Where the value is now: offset, size, and the mask of a bit; None while an in-out is bound to nothing."""
    place = symbol.locate(memory)
    if place is None:
        return None
    offset, bit = place
    if bit is not None and symbol.type == BOOL:
        return offset, 1, 1 << bit
    return offset, symbol.type.size, 0xFF


def _runs_in(pou: Pou, record: Record) -> bool:
    """Whether statements of the POU run for instances of this type, or of one that extends it."""
    if pou.kind == "function":  # a method: its THIS says, at run time
        return True
    each: Record | None = record
    while each is not None:
        if pou.instance is each or pou.instance.name.upper() == each.name.upper():
            return True
        each = each.base
    return False
