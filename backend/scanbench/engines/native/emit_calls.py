"""Calls of functions and of function block instances."""

from dataclasses import dataclass

from scanbench.engines.native import walk
from scanbench.engines.native.emit_body import Body, Self
from scanbench.engines.native.emit_checks import LIST_TAG, note_call
from scanbench.engines.native.emit_function import UNLIKELY, Value
from scanbench.engines.native.emit_memory import move
from scanbench.engines.native.emit_places import address, reference
from scanbench.engines.native.emit_strings import Piece, as_one, settled
from scanbench.engines.native.emit_types import elementary, stored
from scanbench.engines.native.emit_values import Bytes, Held, put, read, settle
from scanbench.engines.native.registers import Parameter, Passing
from scanbench.program.program import CallBlock, CallFunction, Expr, Load, Place, Pou, Sequence
from scanbench.program.types import Elementary, Kind, StringType

Argument = Expr | Place | None


def scalar(body: Body, call: CallFunction) -> Value:
    """The elementary result of a function."""
    result = _call(body, call)
    assert isinstance(result, Value)
    return result


def text(body: Body, call: CallFunction) -> Piece:
    """The STRING result, in a buffer of its own: the next call of the same function writes over its frame."""
    result = _call(body, call)
    assert isinstance(result, list)
    return settled(body, result)[0]


def run(body: Body, call: CallFunction) -> None:
    """Calls for the effects only."""
    _call(body, call)


def value(body: Body, expr: Expr, disturbed: bool) -> Held:
    """The value of an expression of any type, settled if code runs before it is stored."""
    if isinstance(expr.type, StringType):
        return settle(body, body.pieces(expr), disturbed)
    if isinstance(expr.type, Elementary):
        return body.scalar(expr)
    if isinstance(expr, CallFunction):
        result = _call(body, expr)
        assert result is not None
        return settle(body, result, disturbed)
    if isinstance(expr, Sequence):
        with body.text.inside_expression():
            body.run(expr.body)
        return value(body, expr.value, disturbed)
    assert isinstance(expr, Load), f"not an array or structure: {expr}"
    where = address(body, expr.place)
    body.unit.flavour.read(body, expr.place, where)
    return settle(body, Bytes(where.pointer, expr.place.type.size), disturbed)


# ---- functions ------------------------------------------------------------------------------------------------


def _call(body: Body, call: CallFunction) -> Held | None:
    """Runs the function; gives its result. An aggregate stays in the function's frame until the next call of it."""
    signature = body.unit.signature(call.pou)
    given = [f"ptr {body.image}"]
    outputs: list[tuple[Parameter, str, Place]] = []
    pairs = list(zip(signature.parameters, call.args, strict=True))
    for position, (parameter, argument) in enumerate(pairs):
        if parameter.passing in (Passing.POINTER, Passing.FRAME):
            pointer = _room(body, call, parameter)
            if parameter.passing is Passing.POINTER:
                given.append(f"ptr {pointer}")
            if isinstance(argument, Place):
                outputs.append((parameter, pointer, argument))
        else:
            assert argument is not None
            given.append(_argument(body, parameter, argument, _calls(pairs[position + 1 :])))
    room = ""
    if signature.result is not None:
        room = _room(body, call, signature.result)
        if signature.result.passing is Passing.POINTER:
            given.append(f"ptr {room}")
    body.unit.flavour.calls(body, call.pou)
    kept = _kept(body, call.pou)
    note_call(body, call.pou, call.site)
    status = body.text.op(f"call i32 {body.unit.symbol(call.pou)}({', '.join(given)}){body.swallow(call.pou)}")
    _pass_on(body, status, call.pou, kept)
    # all is read before the first is stored: finding out where may call this function again
    disturbed = kept is not None or any(walk.address_disturbs(place) for _, _, place in outputs)
    values = [(read(body, pointer, each.member.type, disturbed), place) for each, pointer, place in outputs]
    result = read(body, room, signature.result.member.type, disturbed) if signature.result is not None else None
    if kept is not None:
        kept.back(body, call.pou)
    for held, place in values:
        put(body, place, held)
    return result


@dataclass(frozen=True, slots=True)
class Kept:
    """What a POU had that may run already; empty for what it has not."""

    frame: str
    caller: str

    def back(self, body: Body, callee: Pou) -> None:
        """Puts it back."""
        text = body.text
        if self.frame:
            move(body, text.address(body.image, callee.frame_offset), self.frame, callee.frame.size)
        if self.caller:
            where = text.address(body.image, callee.called_at)
            text.do(f"store i64 {self.caller}, ptr {where}, align 8{body.module.tag(LIST_TAG)}")


def _kept(body: Body, callee: Pou) -> Kept | None:
    """A copy of the frame of what may run already, and who called that."""
    if not callee.recursive or not (callee.frame.size or callee.called_at):
        return None
    text, frame, caller = body.text, "", ""
    if callee.frame.size:
        room = text.room(body.unit.symbol(callee), callee.frame.size)  # in use during one call at a time
        frame = move(body, room, text.address(body.image, callee.frame_offset), callee.frame.size)
    if callee.called_at:
        where = text.address(body.image, callee.called_at)
        caller = text.op(f"load i64, ptr {where}, align 8{body.module.tag(LIST_TAG)}")
    return Kept(frame, caller)


def _pass_on(body: Body, status: str, callee: Pou, kept: Kept | None) -> None:
    """Passes on the trap of a callee; what is in its frame may be in use by who catches that."""
    if kept is None:
        body.text.check_status(status)
        return
    text = body.text
    failed, on = text.name("failed"), text.name("on")
    text.choose(text.op(f"icmp ne i32 {status}, 0"), failed, on, UNLIKELY)
    text.begin(failed)
    kept.back(body, callee)
    text.go(text.fail(status))
    text.begin(on)


def _room(body: Body, call: CallFunction, parameter: Parameter) -> str:
    """Where an output or the result comes back."""
    if parameter.passing is Passing.POINTER:
        return body.text.alloca(stored(elementary(parameter.member.type)))
    offset = call.pou.frame_offset + parameter.member.offset
    return body.text.address(body.image, offset)


def _calls(later: list[tuple[Parameter, Argument]]) -> bool:
    """Whether evaluating these arguments runs code. An output's place is evaluated after the call."""
    for parameter, argument in later:
        if isinstance(argument, Place):
            if parameter.passing is Passing.REFERENCE and walk.address_disturbs(argument):
                return True
        elif argument is not None and walk.disturbs(argument):
            return True
    return False


def _argument(body: Body, parameter: Parameter, argument: Expr | Place, disturbed: bool) -> str:
    if isinstance(argument, Place):
        return f"i64 {reference(body, argument, parameter.member.type.size)}"
    held = value(body, argument, disturbed)
    if isinstance(held, Bytes):
        return f"ptr {held.pointer}"
    if isinstance(held, list):
        one = as_one(body, held)
        return f"ptr {one.pointer}, i64 {one.length}"
    type = elementary(parameter.member.type)
    ssa = body.text.op(f"zext i1 {held.ssa} to i8") if type.kind is Kind.BOOL else held.ssa
    return f"{stored(type)} {ssa}"


# ---- blocks ---------------------------------------------------------------------------------------------------


def block(body: Body, call: CallBlock) -> None:
    """Runs an instance: inputs, references, body, outputs."""
    offset = reference(body, call.instance, call.pou.instance.size)
    pointer = body.text.op(f"getelementptr inbounds nuw i8, ptr {body.image}, i64 {offset}")
    inner = Self(pointer, offset)
    for place, expr in call.inputs:
        held = value(body, expr, walk.address_disturbs(place))
        with body.instance(inner):
            put(body, place, held)
    for slot, bound in call.in_outs:
        number = reference(body, bound)
        with body.instance(inner):
            where = address(body, slot)
        body.text.do(f"store i64 {number}, ptr {where.pointer}, align 1{where.tag}")
    body.unit.flavour.calls(body, call.pou)
    note_call(body, call.pou, call.site)
    status = body.text.op(
        f"call i32 {body.unit.symbol(call.pou)}(ptr {body.image}, i64 {offset}){body.swallow(call.pou)}"
    )
    body.text.check_status(status)
    for expr, target in call.outputs:
        with body.instance(inner):
            held = value(body, expr, walk.address_disturbs(target))
        put(body, target, held)
