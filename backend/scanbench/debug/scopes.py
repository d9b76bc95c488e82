"""The variables of a frame by their sections, and what is below them."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import islice

from scanbench.check.typed.condition import BadCondition
from scanbench.debug.frames import frame_record, instance_path
from scanbench.debug.scene import NoFrame, Scene, at
from scanbench.debug.shown import ScopeInfo, VariableInfo
from scanbench.debug.variables import Shown, info, tool_path, with_bounds
from scanbench.engines.debug import Frame
from scanbench.engines.interpreter.evaluate import NoValue
from scanbench.program.types import Member, Record, Reference, Section, actual_of
from scanbench.symbols.symbols import Symbol, UnknownPath, children, member_of, resolve, roots, target_of

MOST = 1000
"""Variables in one answer."""
THIS, GLOBAL, RESULT = "THIS", "GLOBAL", "RESULT"
_ORDER = ("VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR", "VAR_TEMP", RESULT, THIS)


def scopes(scene: Scene, index: int | None) -> tuple[ScopeInfo, ...]:
    """Of a frame (None: of the whole program), those that have any variables. Raises NoFrame."""
    frame = scene.frame(index)
    found = [(name, len(each)) for name, each in _of_frame(scene, frame).items()]
    found.append((GLOBAL, _globals(scene, frame)[1]))
    return tuple(ScopeInfo(name, count) for name, count in found if count)


def variables(
    scene: Scene, index: int | None, scope: str, expression: str, start: int = 0, count: int = 0
) -> tuple[tuple[VariableInfo, ...], int]:
    """The variables of a scope, or the parts of an expression; and how many there are in all. Raises NoFrame, NoValue."""
    frame = scene.frame(index)
    most = min(count or MOST, MOST)
    if not expression:
        return _of_scope(scene, frame, scope, start, most)
    parent = named(scene, frame, expression)
    if isinstance(parent, BadCondition):
        raise NoValue(parent.message)
    shown = info(scene, parent)
    below = _below(scene, parent, start, most) if shown.children else []
    return tuple(info(scene, each) for each in below), shown.children


def named(scene: Scene, frame: Frame | None, text: str) -> Shown | BadCondition:
    """The variable, or part of one, that this means in the scope of a frame. Raises NoValue where it is nowhere now."""
    text = text.strip()
    if frame is not None:
        for scope, found in _of_frame(scene, frame).items():
            if scope != GLOBAL and (known := _by_expression(found, text)) is not None:
                return known
    pou, instance = at(frame)
    local = scene.locals.place(pou, text)
    if isinstance(local, BadCondition):
        return local
    offset, bit = scene.evaluator.locate(local, instance)
    constant = local.member is not None and local.member.constant
    symbol = Symbol("", text, local.place.type, "", offset, bit, constant=constant)
    for path in _paths(scene, frame, text):
        try:
            found_symbol = resolve(scene.program, path)
        except UnknownPath:
            continue
        if found_symbol.type == symbol.type and found_symbol.locate(scene.memory) == (offset, bit):
            return Shown(text, replace(symbol, path=found_symbol.path), found_symbol.path)
    return Shown(text, symbol, tool_path(scene, symbol, ""))


def _by_expression(found: Sequence[Shown], text: str) -> Shown | None:
    return next((each for each in found if each.expression.upper() == text.upper()), None)


def _paths(scene: Scene, frame: Frame | None, text: str) -> Iterator[str]:
    """What may be the path of what this expression means."""
    own = text[5:] if text.upper().startswith("THIS.") else text
    if frame is not None and (path := instance_path(scene.program, frame)):
        yield f"{path}.{own}"
    yield text


def _of_frame(scene: Scene, frame: Frame | None) -> dict[str, list[Shown]]:
    found: dict[str, list[Shown]] = {name: [] for name in _ORDER}
    if frame is not None:
        local, record = frame.pou.frame, frame_record(frame)
        hidden = {member.name.upper() for member in local.members.values()}
        if record is not None:
            method = frame.pou.kind == "function"
            owner = _owner(scene, frame, record)
            for member in _visible(record):
                scope = THIS if method else _scope(member)
                name = f"THIS.{member.name}" if method and member.name.upper() in hidden else member.name
                found[scope].append(_shown(owner, member, name, f"{owner.path}.{member.name}" if owner.path else ""))
        base = Symbol("", "", local, "", frame.pou.frame_offset)
        for member in _visible(local):
            shown = _shown(base, member, member.name, "")
            found[_scope(member)].append(replace(shown, path=_passed(scene, shown)))
    return found


def _owner(scene: Scene, frame: Frame, record: Record) -> Symbol:
    """The instance that runs, as one of its own class."""
    path = instance_path(scene.program, frame)
    try:
        known = resolve(scene.program, path)
    except UnknownPath:
        return Symbol("", "", record, "", frame.instance)
    return replace(known, type=record)


def _visible(record: Record) -> Iterator[Member]:
    return (member for member in record.members.values() if not member.hidden)


def _scope(member: Member) -> str:
    return RESULT if member.section is Section.RESULT else member.section.value


def _shown(owner: Symbol, member: Member, expression: str, path: str) -> Shown:
    bound = member_of(owner, member, path)
    if not member.copied or not isinstance(owner.type, Record):
        return Shown(expression, bound, path)
    copy = replace(bound, slots=owner.slots, offset=owner.offset + member.offset)
    slot = owner.offset + actual_of(owner.type, member).offset
    return Shown(expression, copy, path, replace(bound, offset=0, slots=(*owner.slots, slot)))


def _passed(scene: Scene, shown: Shown) -> str:
    """Of an in-out in a frame, the path of what was passed; nothing else there has any."""
    symbol = with_bounds(scene, shown.actual or shown.symbol)
    return tool_path(scene, symbol, "") if symbol.slots and symbol.section == Section.IN_OUT.value else ""


def _of_scope(
    scene: Scene, frame: Frame | None, scope: str, start: int, most: int
) -> tuple[tuple[VariableInfo, ...], int]:
    if scope.upper() == GLOBAL:
        symbols, total = _globals(scene, frame)
        page = [Shown(each.name, each, each.path) for each in islice(symbols, start, start + most)]
        return tuple(info(scene, each) for each in page), total
    found = _of_frame(scene, frame).get(scope.upper())
    if found is None:
        raise NoFrame(f"there is no scope `{scope}` here")
    return tuple(info(scene, each) for each in found[start : start + most]), len(found)


def _globals(scene: Scene, frame: Frame | None) -> tuple[Iterator[Symbol], int]:
    """Global variables, and how many; for the whole program its instances too."""
    program, owner = scene.program, scene.program.layout.globals
    instances = len(program.shown)
    total = instances + sum(not member.hidden for member in (owner.members.values() if owner else ()))
    if frame is None:
        return roots(program), total
    return islice(roots(program), instances, None), total - instances


def _below(scene: Scene, parent: Shown, start: int, count: int) -> list[Shown]:
    symbol, head = with_bounds(scene, parent.symbol), parent.expression
    if isinstance(symbol.type, Reference):
        if not symbol.type.automatic:
            target = target_of(symbol)
            return [Shown(f"{head}^", replace(target, name="^"), f"{parent.path}^" if parent.path else "")]
        symbol = replace(target_of(symbol), path=symbol.path)
    symbol = replace(symbol, path=parent.path)
    found = []
    for each in children(scene.program, symbol, start, count):
        suffix = each.path.removeprefix(parent.path)
        found.append(Shown(f"{head}{suffix}", each, each.path if parent.path else ""))
    return found
