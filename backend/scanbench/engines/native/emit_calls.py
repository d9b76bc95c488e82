"""Calls of functions and of function block instances."""

from scanbench.check.program import CallBlock, CallFunction, Expr, Load, Place
from scanbench.check.types import BOOL, Elementary, StringType
from scanbench.engines.native import walk
from scanbench.engines.native.emit_body import Body, Self
from scanbench.engines.native.emit_function import Value
from scanbench.engines.native.emit_places import Address, address, load_at, move, reference, store
from scanbench.engines.native.emit_strings import Piece, as_one, assign, copied, of_pointer, settled
from scanbench.engines.native.emit_types import elementary, stored
from scanbench.engines.native.registers import Parameter, Passing

Later = tuple[Expr | Place | None, ...]


def scalar(body: Body, call: CallFunction) -> Value:
    """The elementary result of a function."""
    type = elementary(call.type)
    result = _call(body, call)
    return load_at(body, Address(result), type)


def text(body: Body, call: CallFunction) -> Piece:
    """The STRING result, in a buffer of its own: the next call of the same function writes over its frame."""
    result = _call(body, call)
    assert isinstance(call.type, StringType)
    return copied(body, [of_pointer(body, result, call.type.capacity)])


def run(body: Body, call: CallFunction) -> None:
    """Calls for the effects only."""
    _call(body, call)


def aggregate(body: Body, expr: Expr) -> str:
    """Where an array or a structure stands; that of a function, until it is called again."""
    if isinstance(expr, CallFunction):
        return _call(body, expr)
    assert isinstance(expr, Load), f"not an array or structure: {expr}"
    return address(body, expr.place).pointer


# ---- functions ------------------------------------------------------------------------------------------------


def _call(body: Body, call: CallFunction) -> str:
    """Runs the function; gives a pointer to its result."""
    signature = body.unit.signature(call.pou)
    given = [f"ptr {body.image}"]
    outputs: list[tuple[Parameter, str, Place]] = []
    for position, (parameter, argument) in enumerate(zip(signature.parameters, call.args, strict=True)):
        if parameter.passing in (Passing.POINTER, Passing.FRAME):
            pointer = _room(body, call, parameter)
            if parameter.passing is Passing.POINTER:
                given.append(f"ptr {pointer}")
            if isinstance(argument, Place):
                outputs.append((parameter, pointer, argument))
        else:
            assert argument is not None
            given.append(_argument(body, parameter, argument, call.args[position + 1 :]))
    result = ""
    if signature.result is not None:
        result = _room(body, call, signature.result)
        if signature.result.passing is Passing.POINTER:
            given.append(f"ptr {result}")
    status = body.text.op(f"call i32 {body.unit.symbol(call.pou)}({', '.join(given)})")
    body.text.check_status(status)
    for parameter, pointer, place in outputs:
        _copy_out(body, parameter, pointer, place)
    return result


def _room(body: Body, call: CallFunction, parameter: Parameter) -> str:
    """Where an output or the result comes back."""
    if parameter.passing is Passing.POINTER:
        return body.text.alloca(stored(elementary(parameter.member.type)))
    offset = call.pou.frame_offset + parameter.member.offset
    return body.text.op(f"getelementptr inbounds nuw i8, ptr {body.image}, i64 {offset}")


def _argument(body: Body, parameter: Parameter, argument: Expr | Place, later: Later) -> str:
    if isinstance(argument, Place):
        return f"i64 {reference(body, argument)}"
    disturbed = any(each is not None and not isinstance(each, Place) and walk.calls_functions(each) for each in later)
    match parameter.passing:
        case Passing.STRING:
            pieces = body.pieces(argument)
            one = as_one(body, settled(body, pieces) if disturbed else pieces)
            return f"ptr {one.pointer}, i64 {one.length}"
        case Passing.BYTES:
            pointer = aggregate(body, argument)
            if disturbed or isinstance(argument, CallFunction):
                size = parameter.member.type.size
                pointer = move(body, body.text.buffer(size), pointer, size)
            return f"ptr {pointer}"
    type = elementary(parameter.member.type)
    ssa = body.scalar(argument).ssa
    if type == BOOL:
        ssa = body.text.op(f"zext i1 {ssa} to i8")
    return f"{stored(type)} {ssa}"


def _copy_out(body: Body, parameter: Parameter, pointer: str, place: Place) -> None:
    type = parameter.member.type
    if isinstance(type, StringType):
        assign(body, place, [of_pointer(body, pointer, type.capacity)])
    elif isinstance(type, Elementary):
        store(body, address(body, place), type, load_at(body, Address(pointer), type))
    else:
        move(body, address(body, place).pointer, pointer, type.size)


# ---- blocks ---------------------------------------------------------------------------------------------------


def block(body: Body, call: CallBlock) -> None:
    """Runs an instance: inputs, references, body, outputs."""
    offset = reference(body, call.instance)
    pointer = body.text.op(f"getelementptr inbounds nuw i8, ptr {body.image}, i64 {offset}")
    inner = Self(pointer, offset)
    for place, expr in call.inputs:
        _input(body, inner, place, expr)
    for slot, bound in call.in_outs:
        value = reference(body, bound)
        with body.instance(inner):
            where = address(body, slot)
        body.text.do(f"store i64 {value}, ptr {where.pointer}, align 1{where.tag}")
    status = body.text.op(f"call i32 {body.unit.symbol(call.pou)}(ptr {body.image}, i64 {offset})")
    body.text.check_status(status)
    for expr, target in call.outputs:
        _output(body, inner, expr, target)


def _input(body: Body, inner: Self, place: Place, expr: Expr) -> None:
    if isinstance(place.type, StringType):
        pieces = body.pieces(expr)
        with body.instance(inner):
            assign(body, place, pieces)
    elif isinstance(place.type, Elementary):
        value = body.scalar(expr)
        with body.instance(inner):
            store(body, address(body, place), place.type, value)
    else:
        source = aggregate(body, expr)
        with body.instance(inner):
            move(body, address(body, place).pointer, source, place.type.size)


def _output(body: Body, inner: Self, expr: Expr, target: Place) -> None:
    if isinstance(target.type, StringType):
        with body.instance(inner):
            pieces = body.pieces(expr)
        assign(body, target, pieces)
    elif isinstance(target.type, Elementary):
        with body.instance(inner):
            value = body.scalar(expr)
        store(body, address(body, target), target.type, value)
    else:
        with body.instance(inner):
            source = aggregate(body, expr)
        move(body, address(body, target).pointer, source, target.type.size)
