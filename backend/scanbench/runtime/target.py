"""What a path means for a command: the variable it leads to, its place in the image now, and whether a tool may write there.

A path may lead through an in-out or a reference: `Main.fb1.level`. What is meant is the variable that the block's last
execution was given, so that is what a command names in the journal.
"""

from dataclasses import dataclass, replace

from scanbench.program.copies import Copies, Copy, Image, Spot
from scanbench.program.program import Pou
from scanbench.program.types import Elementary, StringType, Subrange
from scanbench.runtime.command import Command, Patch, Refusal, View
from scanbench.runtime.rights import Right, may
from scanbench.symbols.call_sites import Calls, CallSite, Formal, address, formal_of
from scanbench.symbols.names import names_of
from scanbench.symbols.symbols import Symbol, UnknownPath, resolve
from scanbench.symbols.values import parse_value


@dataclass(frozen=True, slots=True)
class Naming(Command):
    """A command about one variable; see `Write`."""

    path: str
    value: str
    through: str = ""
    site: str = ""

    def settled(self, view: View) -> Command:
        """With the variable that is meant now."""
        found = meant(view, self.path, self.site)
        if not isinstance(found, Meant) or not found.through:
            return self
        return replace(self, path=found.path, through=found.through, site="")

    def unsettled(self, view: View) -> Refusal | None:
        """Why the call that `site` names passes nothing that could be meant."""
        found = meant(view, self.path, self.site) if self.site else None
        return found if isinstance(found, Refusal) else None


@dataclass(frozen=True, slots=True)
class Meant:
    """The variable that a path means at the moment."""

    path: str
    """That of the variable itself; as it was typed where nothing of the program has a name there."""
    through: str
    """The path that led here, if it differs: `Main.fb1.level`."""


@dataclass(frozen=True, slots=True)
class Target:
    """A place of the image that a value can be written to."""

    symbol: Symbol
    offset: int
    bit: int | None
    type: Elementary | StringType
    through: str = ""

    @property
    def shown(self) -> str:
        """Where it is, for people: `Main.fb1.level -> Main.tank[3].level (D120)`."""
        return shown(self.through, self.symbol)

    def patch(self, text: str) -> Patch | Refusal:
        """The patch that gives it this value, as typed."""
        try:
            data = parse_value(self.type, text)
        except ValueError as error:
            return Refusal(f"{self.shown}: {error}")
        if self.through and isinstance(self.type, Subrange) and self.outside(text):
            value = int.from_bytes(data, "little", signed=self.type.signed)
            return Refusal(
                f"{self.shown}: {value} is outside of {self.type.name} ({self.type.low} to {self.type.high}). To try out "
                f"what the program does with it, write {self.symbol.path} itself"
            )
        if self.bit is not None:
            return Patch.of_bit(self.offset, self.bit, data[0] != 0)
        return Patch.whole(self.offset, data)

    def outside(self, text: str) -> str:
        """What is to be said of a value, as typed, that a subrange does not have; empty where there is nothing."""
        if not isinstance(self.type, Subrange):
            return ""
        value = int.from_bytes(parse_value(self.type, text), "little", signed=self.type.signed)
        if self.type.low <= value <= self.type.high:
            return ""
        return f", outside of {self.type.low} to {self.type.high}: where the program reads the variable before it writes it, it finds that, and limits the value"


def shown(through: str, symbol: Symbol) -> str:
    """A variable for people, with its address, and with the path that led to it."""
    address = f" ({symbol.address})" if symbol.address not in (None, symbol.path) else ""
    return f"{through} -> {symbol.path}{address}" if through else symbol.path


def find(view: View, path: str) -> Symbol | Refusal:
    """The symbol of a path, or the reason why there is none, with near matches."""
    try:
        return resolve(view.program, path.strip())
    except UnknownPath as error:
        return Refusal(error.message, tuple(error.near))


def meant(view: View, path: str, site: str) -> Meant | Refusal:
    """The variable to which a path leads through in-outs, or that the call at `site` (`file:line`) passes; why there is none."""
    symbol = find(view, path)
    if isinstance(symbol, Refusal):
        return symbol
    if not symbol.slots:
        return (
            Meant(path, "") if not site else Refusal(f"{symbol.path} is no in-out, so no call passes anything for it")
        )
    place = symbol.locate(view.memory) if not site else _at_site(view, symbol.path, site)
    if isinstance(place, Refusal):
        return place
    named = None if place is None else names_of(view.program).variable(place, symbol.type)
    if named is None:
        return Meant(path, "") if not site else Refusal(_nowhere(view, symbol.path, site, place))
    return Meant(named.path, symbol.path)


def _at_site(view: View, path: str, site: str) -> Spot | Refusal | None:
    """What the call at `site` would pass now."""
    formal = formal_of(view.program, path)
    if formal is None:
        return Refusal(f"{path} is reached through a reference, and no call passes anything for that")
    sites = Calls(view.statements).sites(formal, view.memory)
    wanted = [each for each in sites if site in (str(each.span), f"{each.span.file}:{each.span.line}")]
    if not wanted:
        near = tuple(f"{each.span.file}:{each.span.line}" for each in sites)
        return Refusal(f"{site} is no call that passes something for {formal.path}", near)
    return passed_by(view, formal, path, wanted[0])


def passed_by(view: View, formal: Formal, path: str, site: CallSite) -> Spot | None:
    """What this call would pass now for an in-out, and of it what `path` means: the variable itself in the end."""
    actual = site.passes(formal)
    found = None if actual is None else address(site.caller, actual, site.offset, view.memory)
    inner = resolve(view.program, path)
    begin = resolve(view.program, formal.path)
    if found is None or inner.slots != begin.slots:
        return None
    offset = found[0] + inner.offset
    bit = inner.bit if inner.bit is not None or inner.offset else found[1]
    return view.program.layout.copies.actual(view.memory, offset, bit)


def _nowhere(view: View, path: str, site: str, place: Spot | None) -> str:
    temporary = None if place is None else names_of(view.statements).temporary(place[0])
    if temporary is not None:
        return _gone(path, *temporary)
    return f"what {site} passes for {path} cannot be told now: let that call run first"


def _gone(path: str, pou: Pou | None, name: str) -> str:
    what = f"`{name}`, a temporary of {pou.name}," if pou is not None and name else "a value that was computed,"
    return (
        f"{path} was given {what} which is gone when the call is over: write what that is computed from, or halt inside of "
        "the block and write it there"
    )


def writable_target(view: View, path: str, verb: Right, through: str = "") -> Target | Refusal:
    """The place to which `path` leads if a tool may write (force ...) there now; `verb` is for the refusal."""
    symbol = find(view, path)
    if isinstance(symbol, Refusal):
        return symbol
    if not isinstance(symbol.type, Elementary | StringType):
        return Refusal(f"{symbol.path} is {symbol.type.name}, not a single value: {verb} one of its members instead")
    place = writable_place(view, symbol, through)
    if isinstance(place, Refusal):
        return place
    return may(view.header.mode, verb, symbol.path) or Target(symbol, *place, symbol.type, through)


def writable_place(view: View, symbol: Symbol, through: str = "") -> Spot | Refusal:
    """Byte and bit of a variable now, if the model and the program let tools write there, whatever the mode permits."""
    place = symbol.locate(view.memory)
    if place is None:
        return Refusal(not_called(view, symbol))
    offset, bit = place
    if offset >= view.program.layout.frames:
        found = names_of(view.statements).temporary(offset)
        return Refusal(_gone(symbol.path, *(found or (None, ""))))
    reason = read_only_reason(view, symbol, offset, bit)
    if reason is not None:
        return Refusal(f"{through} -> {reason}" if through else reason)
    return place


def not_called(view: View, symbol: Symbol) -> str:
    """Why a path through an in-out or reference leads nowhere."""
    formal = formal_of(view.program, symbol.path)
    if formal is None:
        return f"{symbol.path} leads through a reference that refers to nothing now (NULL)"
    return (
        f"{symbol.path}: not called yet. {formal.instance.path} has not run since the program started or was changed, so "
        f"its in-out {formal.member.name} is connected to nothing: let a scan run in which it is called"
    )


def read_only_reason(view: View, symbol: Symbol, offset: int, bit: int | None) -> str | None:
    """Why a tool may not write here, or None. An in-out may lead into read-only memory: the place decides."""
    model = view.model
    found = view.program.layout.area_at(offset)
    if found is not None:
        area, byte = found
        if area.protected(byte, 1 if bit is not None else symbol.type.size, "tool") is not None:
            place = model.format(area, byte, bit, 1 if bit is not None else 8 * symbol.type.size)
            return (
                f"{place} is read-only for tools on {model.name}, as on the device. "
                "To see the program react to an error, raise it with the error simulator"
            )
        return None
    if symbol.slots:
        named = names_of(view.program).variable((offset, bit), symbol.type)
        symbol = symbol if named is None else named
    if symbol.constant or symbol.tool != "write":
        return f"{symbol.path} is a constant: change it in the program and build"
    return None


def everywhere(view: View, patch: Patch) -> tuple[Patch, ...]:
    """A patch of a variable, and the same of the copies that blocks with in-outs by value made of it last, or of a part of
    it, or of what it is a part of: a block that a debugger halts goes on with its copy. A patch of such a copy is one of
    the variable."""
    copies = view.program.layout.copies
    real = _of_variable(copies, view.memory, patch) if copies.all else None
    if real is None:
        return (patch,)
    shared = (_of_copy(real, each, copies.actual(view.memory, each.start, None)) for each in copies.all)
    return (real, *(each for each in shared if each is not None))


def _of_variable(copies: Copies, memory: Image, patch: Patch) -> Patch | None:
    """A patch of a copy as one of what it is a copy of; None where that is nothing."""
    single = len(patch.mask) == 1 and patch.mask != b"\xff"
    bit = patch.mask[0].bit_length() - 1 if single else None
    found = copies.actual(memory, patch.offset, bit)
    if found is None:
        return None
    offset, to_bit = found
    if to_bit is None:
        return Patch(offset, patch.mask, patch.data)
    return Patch.of_bit(offset, to_bit, bool(patch.data[0] >> (bit or 0) & 1))


def _of_copy(patch: Patch, copy: Copy, actual: Spot | None) -> Patch | None:
    """What a patch means for a copy of `actual`; None where they have nothing in common."""
    if actual is None:
        return None
    at, bit = actual[0], actual[1] or 0
    begin, end = patch.offset, patch.offset + len(patch.data)
    if copy.boolean:
        if not begin <= at < end or not patch.mask[at - begin] >> bit & 1:
            return None
        return Patch.whole(copy.start, bytes((patch.data[at - begin] >> bit & 1,)))
    low, high = max(at, begin), min(at + copy.end - copy.start, end)
    if low >= high:
        return None
    cut = slice(low - begin, high - begin)
    return Patch(copy.start + low - at, patch.mask[cut], patch.data[cut])
