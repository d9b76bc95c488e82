"""A stimulus (a table of inputs by scan or time) -> a program of the plant, with the table in constants of its instance.

Moments count from the start of the program. From its moment on a row holds: what it drives is written in every scan, as
inputs are refreshed in every scan; so who wants to try something else forces it.
"""

import re
from dataclasses import dataclass, field, replace

from scanbench.check.body.bodies import body_of
from scanbench.check.body.context import Body
from scanbench.check.body.targets import target, writable
from scanbench.check.context import Rejected, Report, did_you_mean
from scanbench.check.declare.declarations import Declarations
from scanbench.check.declare.scopes import Pous, Scope, place_of
from scanbench.check.system.driven import Driven, Taken
from scanbench.problems import Span
from scanbench.program.layout import Layout
from scanbench.program.program import (
    Assign,
    Base,
    Binary,
    Compare,
    Const,
    Convert,
    Expr,
    If,
    Index,
    Load,
    Place,
    Pou,
    Stmt,
    While,
)
from scanbench.program.sites import TrapKind
from scanbench.program.types import (
    BOOL,
    ELEMENTARY,
    LINT,
    UDINT,
    ULINT,
    ArrayType,
    Elementary,
    Kind,
    Member,
    Record,
    Section,
    StringType,
    Subrange,
    Type,
)
from scanbench.symbols.values import parse_value
from scanbench.syntax import tree
from scanbench.syntax.cursor import Cursor, Unexpected
from scanbench.syntax.parse_expression import expression
from scanbench.syntax.parse_stimulus import cell_span
from scanbench.syntax.source import Source

NEVER = (1 << 64) - 1
MAX_PROBLEMS = 20
_FIRST = re.compile(r"\s*([^\W\d]\w*)\s*")
_ADDRESSED = {1: BOOL, 8: ELEMENTARY["BYTE"], 16: ELEMENTARY["WORD"], 32: ELEMENTARY["DWORD"], 64: ELEMENTARY["LWORD"]}


def name_of(stimulus: tree.Stimulus) -> str:
    """The name of its program: that of the file, as far as it is one."""
    name = re.split(r"[\\/]", stimulus.file)[-1].rpartition(".")[0]
    name = re.sub(r"\W", "_", name) or "_"
    return f"_{name}" if name[0].isdigit() else name


@dataclass(frozen=True, slots=True)
class _Cells:
    """The values of one column, row by row; `given` where some cells are empty."""

    values: bytes
    given: bytes | None


@dataclass(frozen=True, slots=True)
class _Column:
    """Where the values of one column go, and what they are."""

    target: Place
    cells: _Cells


@dataclass(slots=True)
class StimulusChecker:
    """Makes the program of one file. Everything wrong is reported at its cell."""

    report: Report
    declarations: Declarations
    pous: Pous
    variables: Record
    stimulus: tree.Stimulus
    programs: dict[str, Record]
    """Variables of the program instances, by upper-case name of the instance."""
    pou: Pou = field(init=False)
    driven: list[Driven] = field(init=False, default_factory=list)
    """What its columns drive, as far as they are right."""
    _body: Body = field(init=False)

    def __post_init__(self) -> None:
        name = name_of(self.stimulus)
        instance, frame = Record(name, Kind.BLOCK), Record(name, Kind.STRUCT)
        self.pou = Pou(name, "program", instance, frame, (), None, self.stimulus.span)
        scope = Scope(name, self.variables, frame=frame, system=(self.declarations.symbols,), who="engine")
        self._body = body_of(self.report, self.declarations, self.pous, scope, None)

    def make(self) -> Pou:
        """The program; without a body when something is wrong."""
        made: list[_Column] = []
        taken = Taken()
        for number, (text, span) in enumerate(self.stimulus.columns):
            try:
                made.append(self._column(number, self._own_target(taken, text, span)))
            except Rejected:
                continue
        if len(made) == len(self.stimulus.columns):
            self.pou.body = _Statements(self.report, self.pou, self.stimulus).statements(made)
        return self.pou

    # ---- where values go ----------------------------------------------------------------------------------

    def _own_target(self, taken: Taken, text: str, span: Span) -> Place:
        driven = Driven(self._target(text, span), text, span)
        other = taken.take(driven)
        if other is not None:
            raise self.report.reject(
                "S003", f"`{text}` drives what the column `{other.text}` drives already: leave one of them out.", span
            )
        self.driven.append(driven)
        return driven.place

    def _target(self, text: str, span: Span) -> Place:
        """An address, a global variable or a part of one, or a located variable of a program."""
        if not text:
            raise self.report.reject("S003", "This column has no name: write an address or a variable.", span)
        first = _FIRST.match(text)
        name = first.group(1) if first else ""
        if name and self._body.scope.find(name) is not None:
            return self._simple(target(self._body, self._parsed(text, span)), text, span)
        record = self.programs.get(name.upper())
        if record is not None and first is not None:
            return self._located(record, text, text[first.end() :].lstrip(". "), span)
        model = self.declarations.model
        location = model.locate(text)
        if location is None:
            known = [
                *(each.name for each in self.variables.members.values()),
                *(each.name for each in self.programs.values()),
            ]
            hint = did_you_mean(text, [*known, *([f"%{text}"] if model.locate(f"%{text}") else [])])
            hint = hint or f" {model.why_not(text)}"
            raise self.report.reject("T001", f"There is no variable and no address `{text}`.{hint}", span)
        offset = self.declarations.areas[location.area.name] + location.byte
        place = Place(_ADDRESSED[location.bits], Base.IMAGE, offset, bit=location.bit, variable="@")
        writable(self._body, place, span)
        return place

    def _parsed(self, text: str, span: Span) -> tree.Expression:
        # as if the heading were a line of ST, so that its spans are right
        source = Source(self.stimulus.file, " " * (span.column - 1) + text, span.line - 1)
        parser = Cursor(source)
        try:
            node = expression(parser)
            if parser.ended():
                return node
        except Unexpected:
            pass
        raise self.report.reject(
            "S003", f"`{text}` is no variable; write an address, or a variable like `list[2].on`.", span
        )

    def _simple(self, place: Place, text: str, span: Span) -> Place:
        if place.indices or place.slot is not None or place.reference is not None:
            raise self.report.reject("T010", f"`{text}` is not always at the same place; a stimulus needs that.", span)
        if not isinstance(place.type, Elementary | StringType) or place.type.kind is Kind.REF:
            raise self.report.reject(
                "T010", f"`{text}` is {place.type}, which has no single value; name its members.", span
            )
        return place

    def _located(self, record: Record, text: str, path: str, span: Span) -> Place:
        member = record.members.get(path.upper())
        located = [each for each in record.members.values() if each.located]
        if member is None or not member.located:
            hint = did_you_mean(path, [each.name for each in located])
            raise self.report.reject(
                "T010", f"`{text}` is no located variable (AT), and others of a program are its own business.{hint} "
                "Use an address or a VAR_GLOBAL.", span,
            )  # fmt: skip
        place = place_of(member, Base.IMAGE, record, 0)
        writable(self._body, place, span)
        return self._simple(place, text, span)

    # ---- what goes there ----------------------------------------------------------------------------------

    def _column(self, number: int, target: Place) -> _Column:
        """Every cell, read as a value of the target's type; once for a type, as a table may be long."""
        type = target.type
        before = self.stimulus.known.get(number)
        if before is not None and before[0] == type and isinstance(before[1], _Cells):
            return _Column(target, before[1])
        cells = self._cells(number, type)
        self.stimulus.known[number] = type, cells
        return _Column(target, cells)

    def _cells(self, number: int, type: Type) -> _Cells:
        known: dict[str, bytes] = {"": bytes(type.size)}
        values, given, wrong = bytearray(), bytearray(), 0
        for index, row in enumerate(self.stimulus.rows):
            text = row[number] if number < len(row) else ""
            data = known.get(text)
            if data is None:
                data = self._value(type, text, index, number)
                wrong += not data
                if wrong >= MAX_PROBLEMS:
                    break
                known[text] = data
            values += data
            given.append(text != "")
        if wrong:
            raise Rejected
        return _Cells(bytes(values), None if all(given) else bytes(given))

    def _value(self, type: Type, text: str, index: int, number: int) -> bytes:
        """The bytes of a cell; none when it cannot be read."""
        try:
            data = parse_value(type, text)
            value = int.from_bytes(data, "little", signed=isinstance(type, Elementary) and type.signed)
            if isinstance(type, Subrange) and not type.low <= value <= type.high:
                raise ValueError(f"{value} is outside of {type.low}..{type.high}")
        except ValueError as error:
            where = self.stimulus.columns[number][0]
            self.report.error("S004", f"`{where}`: {error}.", cell_span(self.stimulus, index, number))
            return b""
        return data.ljust(type.size, b"\0")


class _Statements:
    """The statements: which row it is, then what that row and those before it say."""

    def __init__(self, report: Report, pou: Pou, stimulus: tree.Stimulus) -> None:
        self._report, self._pou, self._stimulus = report, pou, stimulus
        self._count = len(stimulus.moments)
        self._row = self._variable("row", UDINT)
        moments = b"".join(each.to_bytes(8, "little") for each in (*stimulus.moments, NEVER))
        self._moments = self._constants("$moment", ULINT, moments)
        self._at = self._variable("$at", ULINT)

    def statements(self, columns: list[_Column]) -> tuple[Stmt, ...]:
        """All of them."""
        take: list[Stmt] = []
        begin: list[Stmt] = [self._set(self._row, 0), self._set(self._at, 0)]
        hold: list[Stmt] = []
        for number, column in enumerate(columns):
            values = self._constants(f"$value{number}", column.target.type, column.cells.values)
            if column.cells.given is None:
                hold.append(
                    self._when_begun(Assign(column.target, Load(self._element(values, before=True)), self._span))
                )
                continue
            given = self._constants(f"$given{number}", BOOL, column.cells.given)
            kept = self._variable(f"$kept{number}", column.target.type)
            driven = self._variable(f"$driven{number}", BOOL)
            begin.append(self._set(driven, 0))
            copy = Assign(kept, Load(self._element(values)), self._span)
            take.append(self._if(Load(self._element(given)), copy, self._set(driven, 1)))
            hold.append(self._if(Load(driven), Assign(column.target, Load(kept), self._span)))
        following = Binary("add", UDINT, Load(self._row), Const(UDINT, 1))
        take.append(Assign(self._row, following, self._span))
        self._pou.instance.close()
        started = Compare("eq", ULINT, Load(_header(ULINT, Layout.SCAN)), Load(_header(ULINT, Layout.STARTED)))
        return (self._if(started, *begin), *self._now(take), *self._position(), self._catch_up(take), *hold)

    def _now(self, take: list[Stmt]) -> list[Stmt]:
        """Puts into `$at` how far the program is, in this round of the table; what is left of the last round is made up for."""
        fields = (Layout.CLOCK, Layout.STARTED_AT) if self._stimulus.by_time else (Layout.SCAN, Layout.STARTED)
        reached, begin = (Load(_header(ULINT, each)) for each in fields)
        elapsed = Binary("sub", ULINT, reached, begin)
        if not self._stimulus.period:
            return [Assign(self._at, elapsed, self._span)]
        now = self._variable("$now", ULINT)
        inside = Binary("mod", ULINT, elapsed, Const(ULINT, self._stimulus.period))
        rest = self._while(Compare("lt", UDINT, Load(self._row), Const(UDINT, self._count)), take)
        again = self._if(Compare("lt", ULINT, Load(now), Load(self._at)), rest, self._set(self._row, 0))
        return [Assign(now, inside, self._span), again, Assign(self._at, Load(now), self._span)]

    def _position(self) -> list[Stmt]:
        """Starts again from the first row if an online change replaced the table by one that the position does not fit."""
        beyond = Compare("gt", UDINT, Load(self._row), Const(UDINT, self._count))
        early = Compare("gt", ULINT, Load(self._element(self._moments, before=True)), Load(self._at))
        reset = self._set(self._row, 0)
        return [self._if(beyond, reset), self._when_begun(self._if(early, reset))]

    def _catch_up(self, take: list[Stmt]) -> Stmt:
        return self._while(Compare("le", ULINT, Load(self._element(self._moments)), Load(self._at)), take)

    # ---- pieces -------------------------------------------------------------------------------------------

    @property
    def _span(self) -> Span:
        return self._stimulus.span

    def _variable(self, name: str, type: Type, initial: bytes = b"", constant: bool = False) -> Place:
        instance = self._pou.instance
        member = Member(name, type, Section.VAR, self._span, initial=initial, constant=constant, hidden=name[0] == "$")
        instance.place(member)
        return place_of(member, Base.SELF, instance, 0)

    def _constants(self, name: str, element: Type, data: bytes) -> Place:
        return self._variable(name, ArrayType(((0, len(data) // element.size - 1),), element), data, constant=True)

    def _element(self, array: Place, before: bool = False) -> Place:
        """The element of the row that comes next, or of the one that holds."""
        type = array.type
        assert isinstance(type, ArrayType)
        row: Expr = Convert(LINT, Load(self._row))
        if before:
            row = Binary("sub", LINT, row, Const(LINT, 1))
        trap = self._report.trap(TrapKind.BOUNDS, self._span, self._pou.name, "row outside of the table")
        low, high = type.bounds[0]
        return replace(array, type=type.element, indices=(Index(row, low, high, type.stride(0), trap),))

    def _set(self, place: Place, value: int) -> Stmt:
        assert isinstance(place.type, Elementary)
        return Assign(place, Const(place.type, value), self._span)

    def _if(self, condition: Expr, *body: Stmt) -> Stmt:
        return If(((condition, body),), (), self._span)

    def _when_begun(self, statement: Stmt) -> Stmt:
        return self._if(Compare("gt", UDINT, Load(self._row), Const(UDINT, 0)), statement)

    def _while(self, condition: Expr, body: list[Stmt]) -> Stmt:
        trap = self._report.trap(
            TrapKind.LOOP, self._span, self._pou.name, "the table has more rows than a scan may take"
        )
        return While(condition, tuple(body), trap, self._span)


def _header(type: Elementary, offset: int) -> Place:
    return Place(type, Base.IMAGE, offset)
