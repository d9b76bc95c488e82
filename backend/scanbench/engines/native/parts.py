"""The modules of a program, part by part; what did not change since the last program is not emitted again."""

from dataclasses import dataclass, field

from scanbench.engines.native import inlining, jit
from scanbench.engines.native.effects import Effects, touched
from scanbench.engines.native.emit_body import SCRATCH_LIMIT, TooLarge
from scanbench.engines.native.emit_program import Emitter
from scanbench.engines.native.flavour import RUN, Flavour
from scanbench.engines.native.registers import Signature, registers, signature
from scanbench.garbage import without_collection
from scanbench.program.program import Pou, Program, Stmt

SMALL = 120
"""Statements up to which a program is one module: compiling it whole takes less than compiling its parts."""


@dataclass(eq=False, slots=True)
class Part:
    """One module."""

    text: str
    scratch: int
    """Bytes of temporaries."""
    _keys: dict[int, str] = field(default_factory=dict)

    def key(self, opt_level: int) -> str:
        """Under which its object code is kept."""
        known = self._keys.get(opt_level)
        if known is None:
            known = self._keys[opt_level] = jit.object_key(self.text, opt_level)
        return known


class _Same:
    """Equal to the same object only: a body is never changed, and comparing two would take long."""

    __slots__ = ("body",)

    def __init__(self, body: tuple[Stmt, ...]) -> None:
        self.body = body

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and other.body is self.body

    def __hash__(self) -> int:
        return id(self.body)


@dataclass(frozen=True, slots=True)
class _Body:
    """What a POU's body says, without what it calls."""

    same: _Same
    writes: frozenset[str]
    callees: tuple[Pou, ...]
    shared: bool
    signature: Signature | None
    key: object
    """What the flavour makes of it."""


@dataclass(frozen=True, slots=True)
class _Emitted:
    depends: object
    part: Part


class Parts:
    """Makes the parts of programs. It remembers the last program: the next one may share POUs with it."""

    def __init__(self) -> None:
        self._bodies: dict[Pou, _Body] = {}
        self._emitted: dict[Pou, _Emitted] = {}

    @property
    def fresh(self) -> bool:
        """Whether there was no program before."""
        return not self._bodies

    def of(self, program: Program, flavour: Flavour = RUN) -> list[Part]:
        """One part for each POU, the scan, and the numbers that the others refer to; one part for a small program."""
        with without_collection():
            if sum(inlining.size(pou.body) for pou in program.pous) <= SMALL:
                unit = Emitter(program, flavour=flavour).whole()
                return _fitting([Part(unit.module.text(), unit.scratch)])
            return self._of(program, flavour)

    def _of(self, program: Program, flavour: Flavour) -> list[Part]:
        bodies: dict[Pou, _Body] = {}
        emitted: dict[Pou, _Emitted] = {}
        faces: dict[Pou, object] = {}
        writes: dict[Pou, frozenset[str]] = {}
        signatures: dict[Pou, Signature] = {}
        effects = Effects(writes)
        emitter = Emitter(program, effects, signatures, flavour)
        sizes = program.layout.size, program.layout.state_size
        for pou in program.pous:
            if pou.recursive:  # others may depend on it before its turn comes
                around = bodies[pou] = self._body(pou, flavour)
                faces[pou] = _face(emitter.names[pou], pou, around, effects.written_by(pou), ())
        for pou in program.pous:
            body = bodies[pou] = self._body(pou, flavour)
            writes[pou] = (
                effects.written_by(pou)
                if pou.recursive
                else body.writes.union(*(writes[callee] for callee in body.callees))
            )
            if body.signature is not None:
                signatures[pou] = body.signature
            if pou in emitter.housed:
                continue  # no POU calls a program
            called = tuple(faces[callee] for callee in body.callees)
            faces[pou] = _face(emitter.names[pou], pou, body, writes[pou], called)
            depends = (
                emitter.names[pou],
                body.same,
                pou.frame_offset,
                pou.called_at,
                sizes,
                called,
                body.key,
                pou.recursive,
            )
            known = self._emitted.get(pou)
            if known is None or known.depends != depends:
                unit = emitter.pou(pou)
                known = _Emitted(depends, Part(unit.module.text(), unit.scratch))
            emitted[pou] = known
        self._bodies, self._emitted = bodies, emitted
        ends = [Part(unit.module.text(), unit.scratch) for unit in (emitter.scan(), emitter.numbers())]
        return _fitting([*(each.part for each in emitted.values()), *ends])

    def _body(self, pou: Pou, flavour: Flavour) -> _Body:
        known, key = self._bodies.get(pou), flavour.key(pou)
        if known is not None and known.same.body is pou.body and known.key == key:
            return known
        writes, callees = touched(pou.body)
        how = signature(pou, registers(pou, flavour.looks(pou))) if pou.kind == "function" else None
        return _Body(_Same(pou.body), frozenset(writes), tuple(callees), inlining.shared(pou), how, key)


def _face(name: str, pou: Pou, body: _Body, writes: frozenset[str], called: object) -> object:
    """Everything that the modules of callers may depend on."""
    how = body.signature
    passed = how and tuple((each.member.name, each.member.offset, each.passing) for each in how.all)
    inside = (body.same, called, body.key) if body.shared else None
    return name, pou.frame_offset, pou.called_at, passed, writes, inside, pou.recursive and pou.frame.size


def _fitting(parts: list[Part]) -> list[Part]:
    needed = sum(part.scratch for part in parts)
    if needed > SCRATCH_LIMIT:
        raise TooLarge(
            f"the POUs need {needed} bytes for strings, arrays and structures inside of statements; all together may use "
            f"{SCRATCH_LIMIT}: use smaller types, or make several statements of the largest"
        )
    return parts
