"""Observed code: a mark where a statement begins, a note where watched bits are read; see `engines.observe`.

Both go to memory outside of the image, whose addresses are in `STATE`. A read costs a look into a map of the watched bits, and
only if the place may be in an area of the model. The statement is a number in the code; before a call of code without
statements of its own, such as the library's, the number is stored where that code finds it.
"""

from collections.abc import Iterator
from contextlib import contextmanager

from scanbench.engines.native.emit_body import Body, Unit
from scanbench.engines.native.emit_memory import Address
from scanbench.engines.native.flavour import Flavour
from scanbench.engines.observe import LIMIT, areas_end
from scanbench.program.copies import makes_copies
from scanbench.program.layout import Layout
from scanbench.program.origin import is_system
from scanbench.program.program import Base, Place, Pou, Program, Stmt
from scanbench.program.types import Kind
from scanbench.symbols.sites import Sites, sites_of

STATE = "@observed"
"""What the code and the engine share: pointers to the marks and to the map in use, to the log, u64 the site that calls the
library, pointers to the marks and the map of the program, and to those that are used while something else runs."""
MARKS, MAP, LOG, SITE, OWN_MARKS, OWN_MAP, SPARE_MARKS, SPARE_MAP = range(0, 64, 8)
STATE_BYTES = 64

SLOTS = 2 * LIMIT
"""Of the table that finds an entry of the log: the number of the entry plus one, or 0."""
ENTRIES = 8 + 4 * SLOTS
"""Where the entries begin in the log, after u32 entries, u32 reads lost, and the table. An entry: u32 site, offset, mask."""
ENTRY_BYTES = 12
LOG_BYTES = ENTRIES + ENTRY_BYTES * LIMIT

LOOK = """\
declare i64 @llvm.umin.i64(i64, i64)
define internal void @observed.look(i64 %offset, i64 %size, i8 %bits, i32 %site) noinline #0 {{
; notes which of these bits are watched, of so many bytes at the offset
entry:
  %inside = icmp ult i64 %offset, {end}
  br i1 %inside, label %start, label %done
start:
  %stop = add i64 %offset, %size
  %last = call i64 @llvm.umin.i64(i64 %stop, i64 {end})
  %map = load ptr, ptr getelementptr (i8, ptr {state}, i64 {map}), align 8
  br label %next
next:
  %at = phi i64 [ %offset, %start ], [ %after, %on ]
  %more = icmp ult i64 %at, %last
  br i1 %more, label %byte, label %done
byte:
  %maskat = getelementptr inbounds i8, ptr %map, i64 %at
  %mask = load i8, ptr %maskat, align 1
  %read = and i8 %mask, %bits
  %any = icmp ne i8 %read, 0
  br i1 %any, label %watched, label %on
watched:
  call void @observed.note(i64 %at, i8 %read, i32 %site)
  br label %on
on:
  %after = add i64 %at, 1
  br label %next
done:
  ret void
}}
define internal void @observed.note(i64 %at, i8 %read, i32 %site) noinline cold #0 {{
; finds the entry of the site and byte, or appends one
entry:
  %log = load ptr, ptr getelementptr (i8, ptr {state}, i64 {log}), align 8
  %offset = trunc i64 %at to i32
  %bits = zext i8 %read to i32
  %a = mul i32 %site, -1640531535
  %b = mul i32 %offset, -2048144789
  %mixed = xor i32 %a, %b
  %hash = lshr i32 %mixed, 15
  br label %probe
probe:
  %number = phi i32 [ %hash, %entry ], [ %following, %other ]
  %slot = and i32 %number, {last}
  %wide = zext i32 %slot to i64
  %scaled = mul i64 %wide, 4
  %slotoffset = add i64 %scaled, 8
  %slotat = getelementptr inbounds i8, ptr %log, i64 %slotoffset
  %found = load i32, ptr %slotat, align 4
  %free = icmp eq i32 %found, 0
  br i1 %free, label %new, label %known
known:
  %index = sub i32 %found, 1
  %entryat = call ptr @observed.entry(ptr %log, i32 %index)
  %itssite = load i32, ptr %entryat, align 4
  %itsoffsetat = getelementptr inbounds i8, ptr %entryat, i64 4
  %itsoffset = load i32, ptr %itsoffsetat, align 4
  %samesite = icmp eq i32 %itssite, %site
  %sameoffset = icmp eq i32 %itsoffset, %offset
  %same = and i1 %samesite, %sameoffset
  br i1 %same, label %again, label %other
other:
  %following = add i32 %slot, 1
  br label %probe
again:
  %maskat = getelementptr inbounds i8, ptr %entryat, i64 8
  %before = load i32, ptr %maskat, align 4
  %now = or i32 %before, %bits
  store i32 %now, ptr %maskat, align 4
  ret void
new:
  %count = load i32, ptr %log, align 4
  %full = icmp uge i32 %count, {limit}
  br i1 %full, label %lose, label %append
lose:
  %lostat = getelementptr inbounds i8, ptr %log, i64 4
  %lost = load i32, ptr %lostat, align 4
  %more = add i32 %lost, 1
  store i32 %more, ptr %lostat, align 4
  ret void
append:
  %grown = add i32 %count, 1
  store i32 %grown, ptr %log, align 4
  store i32 %grown, ptr %slotat, align 4
  %fresh = call ptr @observed.entry(ptr %log, i32 %count)
  store i32 %site, ptr %fresh, align 4
  %freshoffset = getelementptr inbounds i8, ptr %fresh, i64 4
  store i32 %offset, ptr %freshoffset, align 4
  %freshmask = getelementptr inbounds i8, ptr %fresh, i64 8
  store i32 %bits, ptr %freshmask, align 4
  ret void
}}
define internal ptr @observed.entry(ptr %log, i32 %index) #0 {{
  %wide = zext i32 %index to i64
  %distance = mul i64 %wide, {entry_bytes}
  %position = add i64 %distance, {entries}
  %at = getelementptr inbounds i8, ptr %log, i64 %position
  ret ptr %at
}}"""


class Observing(Flavour):
    """Code that is observed."""

    exact = True

    def __init__(self, program: Program) -> None:
        self.sites: Sites = sites_of(program)
        self.end = areas_end(program.layout)

    def has_sites(self, pou: Pou) -> bool:
        """Whether statements of the POU are the user's."""
        return pou in self.sites.bodies

    def declare(self, unit: Unit) -> None:
        unit.module.define(STATE, f"global [{STATE_BYTES} x i8] zeroinitializer, align 8")

    # ---- the scan ---------------------------------------------------------------------------------------------

    def silence(self, body: Body, silent: bool) -> None:
        # says where it is noted
        for own, spare, used in ((OWN_MARKS, SPARE_MARKS, MARKS), (OWN_MAP, SPARE_MAP, MAP)):
            pointer = body.text.op(f"load ptr, ptr {field(spare if silent else own)}, align 8")
            body.text.do(f"store ptr {pointer}, ptr {field(used)}, align 8")

    # ---- statements -------------------------------------------------------------------------------------------

    @contextmanager
    def statement(self, body: Body, statement: Stmt) -> Iterator[None]:
        number = self.sites.number(statement)
        if number is None:
            yield
            return
        self.begins(body, number)
        outer, body.site = body.site, number
        yield
        body.site = outer

    def begins(self, body: Body, site: int) -> None:
        """The statement begins."""
        body.text.do(f"store i8 1, ptr {body.text.address(_marks(body), site)}, align 1")

    def calls(self, body: Body, callee: Pou) -> None:
        # what has no statements of its own is told on whose behalf it runs
        if body.site is not None and (not self.has_sites(callee) or makes_copies(callee.instance)):
            body.text.do(f"store i32 {body.site}, ptr {field(SITE)}, align 8")

    # ---- accesses ---------------------------------------------------------------------------------------------

    def unheard(self, body: Body) -> bool:
        """What is read or written here is not the user's program's: what looks whether a task is due, the start of a
        body, what was made from the model. In-outs by value are copied by the statement that calls."""
        if is_system(body.pou.span):
            return True
        if body.site is not None:
            return False
        return not body.unit.has(body.pou) or (self.has_sites(body.pou) and not makes_copies(body.pou.instance))

    def read(self, body: Body, place: Place, where: Address) -> None:
        # noted if any of it is watched
        if self.unheard(body) or (place.variable and not place.variable.startswith("@")):
            return
        _declare(body.unit, self)
        mask = _mask(body, place, where)
        if place.slot is not None or place.reference is not None or place.indices:
            pointer, image = (body.text.op(f"ptrtoint ptr {each} to i64") for each in (where.pointer, body.image))
            offset = body.text.op(f"sub i64 {pointer}, {image}")
            _look(body, offset, place.type.size, mask)
        elif place.base is Base.IMAGE and Layout.HEADER_SIZE <= place.offset < self.end:
            _look_if(body, place.offset, place.type.size, mask)


def field(offset: int) -> str:
    """The address of a field of the state."""
    return f"getelementptr (i8, ptr {STATE}, i64 {offset})" if offset else STATE


def site(body: Body) -> str:
    """The number of the statement that runs; in the library, that of the user's statement that called it."""
    if body.site is not None:
        return str(body.site)
    return _at_entry(body, "%caller", f"load i32, ptr {field(SITE)}, align 8")


def _marks(body: Body) -> str:
    """Pointer to the marks."""
    # the scan itself begins before it says which marks are in use
    marks = MARKS if body.unit.has(body.pou) else OWN_MARKS
    return _at_entry(body, "%marks", f"load ptr, ptr {field(marks)}, align 8")


def _at_entry(body: Body, name: str, text: str) -> str:
    """What stays the same for a whole call."""
    line = f"  {name} = {text}"
    if line not in body.text.entry:
        body.text.entry.append(line)
    return name


def _mask(body: Body, place: Place, where: Address) -> str:
    if place.type.kind is not Kind.BOOL:
        return "-1"
    bit = where.bit or "0"
    return str((1 << int(bit) ^ 0x80) - 0x80) if bit.isdigit() else body.text.op(f"shl i8 1, {bit}")


def _look(body: Body, offset: str, size: int, mask: str) -> None:
    body.text.do(f"call void @observed.look(i64 {offset}, i64 {size}, i8 {mask}, i32 {site(body)})")


def _look_if(body: Body, offset: int, size: int, mask: str) -> None:
    """A look of the code's own first, as nearly nothing is watched."""
    text = body.text
    if size not in (1, 2, 4, 8):
        _look(body, str(offset), size, mask)
        return
    width = f"i{8 * size}"
    map = text.op(f"load ptr, ptr {field(MAP)}, align 8")
    found = text.op(f"load {width}, ptr {text.op(f'getelementptr inbounds i8, ptr {map}, i64 {offset}')}, align 1")
    if mask != "-1":
        found = text.op(f"and {width} {found}, {mask}")
    watched, on = text.name("watched"), text.name("on")
    text.choose(text.op(f"icmp ne {width} {found}, 0"), watched, on)
    text.begin(watched)
    _look(body, str(offset), size, mask)
    text.go(on)
    text.begin(on)


def _declare(unit: Unit, observing: Observing) -> None:
    look = LOOK.format(
        state=STATE, map=MAP, log=LOG, end=observing.end, last=SLOTS - 1, limit=LIMIT, entries=ENTRIES,
        entry_bytes=ENTRY_BYTES,
    )  # fmt: skip
    unit.module.declare("@observed.look", look)
