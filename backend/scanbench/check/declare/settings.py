"""VAR_CONFIG and VAR_ACCESS: addresses and initial values of single instances, and names that tools know."""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace

from scanbench.check.context import Rejected, Report
from scanbench.check.declare.addresses import offset_of
from scanbench.check.declare.declarations import Declarations
from scanbench.check.declare.initial_values import initial_image
from scanbench.check.declare.members import own_memory
from scanbench.check.dialect import Allowance
from scanbench.check.dialect_rules import said
from scanbench.problems import Span, perhaps
from scanbench.program.program import Program
from scanbench.program.tasks import AccessPath
from scanbench.program.types import SLOT_BYTES, ArrayType, Member, Record, Section, Type, initial_of
from scanbench.symbols.symbols import Symbol, UnknownPath, resolve
from scanbench.syntax import tree


class Settings:
    """Completes a program whose instances have their places, and its initial image."""

    def __init__(self, report: Report, declarations: Declarations, program: Program, resources: list[str]) -> None:
        self._report = report
        self._declarations = declarations
        self._program = program
        self._resources = [name.upper() for name in resources]
        self._image = bytearray(program.initial_image)
        self._open = dict(_incomplete(program)) if declarations.incomplete else {}

    def apply(self, configuration: tree.Configuration | None, beside: list[tree.Variable]) -> Program:
        """The program with all that the configuration says, and the VAR_CONFIG beside it."""
        accesses: list[AccessPath] = []
        for setting in (*(() if configuration is None else configuration.settings), *self._allowed(beside)):
            with suppress(Rejected):
                self._setting(setting)
        if configuration is not None:
            for access in configuration.accesses:
                try:
                    accesses.append(self._access(access, accesses))
                except Rejected:
                    continue
        for slot, (path, member, own) in self._open.items():
            self._image[slot : slot + SLOT_BYTES] = own.to_bytes(SLOT_BYTES, "little")
            self._report.warn(
                "W002", f"`{path}` is AT {member.incomplete} and has no address, so nothing outside reaches it; give it one in "
                f"VAR_CONFIG: `{path} AT {member.incomplete[:-1]}... : ...;`.", member.span,
            )  # fmt: skip
        return replace(self._program, initial_image=bytes(self._image), accesses=tuple(accesses))

    # ---- VAR_CONFIG -------------------------------------------------------------------------------------

    def _allowed(self, beside: list[tree.Variable]) -> list[tree.Variable]:
        """Those outside of a CONFIGURATION, where the dialect has that."""
        if not beside:
            return []
        dialect = self._declarations.dialect
        if Allowance.SETTING_LISTS in dialect.allows:
            used = "This VAR_CONFIG is outside of a CONFIGURATION"
            self._report.warn("W006", said(dialect, Allowance.SETTING_LISTS, used), beside[0].span)
            return beside
        self._report.error(
            "X001", "VAR_CONFIG is not supported here; write it inside of the CONFIGURATION.", beside[0].span
        )
        return []

    def _setting(self, setting: tree.Variable) -> None:
        symbol = self._symbol(setting.name, setting.span)
        type = self._typed(setting.name, symbol.type, setting.type, setting.span)
        waiting = None
        if symbol.slots and symbol.offset == 0 and len(symbol.slots) == 1:
            waiting = self._open.get(symbol.slots[0])
        offset, bit = symbol.offset, symbol.bit
        if setting.address is not None:
            span = setting.address_span or setting.span
            if waiting is None:
                raise self._report.reject(
                    "D005", f"`{setting.name}` does not wait for an address: only `AT %I*`, `AT %Q*` and `AT %M*` do.", span
                )  # fmt: skip
            offset, bit = self._located(setting.address, waiting[1], type, span)
            reference = offset | (bit or 0) << 32
            slot = symbol.slots[0]
            self._image[slot : slot + SLOT_BYTES] = reference.to_bytes(SLOT_BYTES, "little")
            declared = bytes(self._image[waiting[2] : waiting[2] + type.size])
            if declared != initial_of(type):  # a value that the declaration itself gives
                self._write(offset, bit, declared)
            del self._open[slot]
        elif symbol.slots:
            raise self._report.reject("D005", f"`{setting.name}` needs an address here: `AT %...`.", setting.span)
        elif setting.initial is None:
            raise self._report.reject("D004", f"Nothing is set here; give `{setting.name}` a value.", setting.span)
        if setting.initial is not None:
            self._write(offset, bit, initial_image(self._declarations, setting.initial, type))

    def _located(self, address: str, member: Member, type: Type, span: Span) -> tuple[int, int | None]:
        letter = member.incomplete[1:2].upper()
        if address.startswith("%") and address[1:2].upper() in "IQM" and address[1:2].upper() != letter:
            raise self._report.reject(
                "D005", f"`{address}` does not complete `{member.incomplete}`; it begins with %{letter}.", span
            )
        return offset_of(self._declarations, address, type, span)

    def _write(self, offset: int, bit: int | None, data: bytes) -> None:
        if bit is None:
            self._image[offset : offset + len(data)] = data
        else:
            self._image[offset] = self._image[offset] & ~(1 << bit) | data[0] << bit

    def _typed(self, path: str, known: Type, spec: tree.TypeSpec, span: Span) -> Type:
        declared = self._declarations.type_of(spec)
        if declared != known:
            raise self._report.reject("T002", f"`{path}` is {known}, not {declared}.", span)
        return known

    # ---- VAR_ACCESS -------------------------------------------------------------------------------------

    def _access(self, access: tree.AccessDeclaration, known: list[AccessPath]) -> AccessPath:
        if any(each.name.upper() == access.name.upper() for each in known):
            raise self._report.reject("D001", f"`{access.name}` is declared already; rename one.", access.span)
        symbol = self._symbol(access.path, access.span)
        self._typed(access.path, symbol.type, access.type, access.span)
        return AccessPath(access.name, symbol.path, access.writable)

    def _symbol(self, path: str, span: Span) -> Symbol:
        """The variable of a path that may begin with the name of a resource."""
        first, _, rest = path.partition(".")
        if first.strip().upper() in self._resources:
            if len(self._resources) == 1:
                path = rest
            with suppress(UnknownPath):
                return resolve(self._program, rest)
        try:
            return resolve(self._program, path)
        except UnknownPath as unknown:
            hint = perhaps(unknown.near[:1])
            raise self._report.reject("D010", f"{unknown.message}{hint}", span) from None


Waiting = tuple[int, tuple[str, Member, int]]
"""Offset of the slot; path, declaration, and offset of the memory of its own."""


def _incomplete(program: Program) -> Iterator[Waiting]:
    """Every variable that waits for its address."""
    layout = program.layout
    if layout.globals is not None:
        yield from _waiting("", layout.globals, 0)
    for instance in program.instances:
        yield from _waiting(f"{instance.name}.", instance.pou.instance, instance.offset)


def _waiting(path: str, record: Record, offset: int) -> Iterator[Waiting]:
    for member in record.members.values():
        if member.incomplete:
            own = record.members[own_memory(member.name).upper()]
            yield offset + member.offset, (f"{path}{member.name}", member, offset + own.offset)
        elif _holds(member):
            yield from _inside(f"{path}{member.name}", member.type, offset + member.offset)


def _inside(path: str, type: Type, offset: int) -> Iterator[Waiting]:
    if isinstance(type, Record):
        yield from _waiting(f"{path}.", type, offset)
    elif isinstance(type, ArrayType):
        low = type.bounds[0][0]
        rest = ArrayType(type.bounds[1:], type.element) if len(type.bounds) > 1 else type.element
        for index in range(type.bounds[0][1] - low + 1):
            yield from _inside(f"{path}[{low + index}]", rest, offset + index * type.stride(0))


def waits(type: Type) -> bool:
    """Whether a variable without an address is anywhere in it."""
    if isinstance(type, ArrayType):
        return waits(type.element)
    if not isinstance(type, Record):
        return False
    return any(member.incomplete or _holds(member) for member in type.members.values())


def _holds(member: Member) -> bool:
    return not member.located and member.section is not Section.IN_OUT and waits(member.type)
