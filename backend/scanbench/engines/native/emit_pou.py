"""One POU: a function of LLVM that returns 0 or the number of a trap."""

from scanbench.engines.native import emit_expressions, emit_statements, inlining
from scanbench.engines.native.emit_body import Body, TooLarge, Unit
from scanbench.engines.native.emit_function import FunctionText, Value
from scanbench.engines.native.emit_memory import canonical, move
from scanbench.engines.native.emit_strings import Piece, assign
from scanbench.engines.native.emit_types import elementary, is_real, stored
from scanbench.engines.native.registers import Parameter, Passing
from scanbench.program.program import Base, Place, Pou
from scanbench.program.types import MAX_STRING, StringType

MOST_BUFFERED = 4096
"""Bytes on the stack for each call of what may be called while it runs."""
IMAGE = "ptr nonnull noundef align 8 dereferenceable({size}) %img"


def head(unit: Unit, pou: Pou, image_size: int) -> str:
    """What the POU's function takes and gives, as a definition or declaration says it."""
    parameters = [IMAGE.format(size=image_size)]
    if pou.kind == "function":
        parameters += [each.declaration for each in unit.signature(pou).all if each.declaration]
    else:
        parameters.append("i64 noundef %self")
    return f"i32 {unit.symbol(pou)}({', '.join(parameters)})"


def emit(unit: Unit, pou: Pou, image_size: int, linkage: str = "internal ") -> None:
    """Adds the POU's code to the module."""
    function = pou.kind == "function"
    symbol = unit.symbol(pou)
    scratch, first_trap = symbol.replace("p.", "t.", 1), symbol.replace("p.", "trap.", 1)
    start = f"define {linkage}{head(unit, pou, image_size)}{inlining.attribute(pou)} #0"
    if pou.recursive:
        scratch = "%scratch"
    text = FunctionText(start, scratch, first_trap)
    body = Body(unit, pou, text, emit_expressions.scalar, emit_expressions.pieces, emit_statements.run)
    unit.flavour.enter(body)
    _registers(body)
    if function:
        for parameter in unit.signature(pou).all:
            _receive(body, parameter)
    else:
        text.entry.append("  %me = getelementptr inbounds nuw i8, ptr %img, i64 %self")
    emit_statements.run(body, pou.body)
    text.go(body.leave)
    text.begin(body.leave)
    unit.flavour.leave(body)
    text.do("ret i32 0")
    if text.scratch_size and pou.recursive:  # each of its calls has buffers of its own
        _check_buffers(pou, text.scratch_size)
        text.entry.insert(0, f"  {scratch} = alloca [{text.scratch_size} x i8], align 16")
    elif text.scratch_size:
        unit.reserve(pou, scratch, text.scratch_size)
    unit.module.add(text.text())


def _check_buffers(pou: Pou, size: int) -> None:
    if size > MOST_BUFFERED:
        raise TooLarge(
            f"`{pou.name}` may be called while it runs, and needs {size} bytes for strings, arrays and structures inside of "
            f"one statement; at most {MOST_BUFFERED}: use smaller types, or several statements"
        )


def _registers(body: Body) -> None:
    """Frame variables that live on the stack, until LLVM puts them into registers."""
    given = {}
    if body.pou.kind == "function":
        signature = body.unit.signature(body.pou)
        free = signature.registers
        given = {each.member.offset: f'%"p.{each.member.name.upper()}"'
                 for each in signature.all if each.passing is Passing.POINTER}  # fmt: skip
    else:
        free = body.unit.registers(body.pou)
    for offset, type in free.items():
        pointer = given.get(offset) or body.text.alloca(type)
        body.registers[offset] = pointer
        zero = "0.0" if type in ("float", "double") else "0"
        body.text.entry.append(f"  store {type} {zero}, ptr {pointer}")


def _receive(body: Body, parameter: Parameter) -> None:
    """Puts an argument where the function's variable lives."""
    member, text = parameter.member, body.text
    name = f'%"p.{member.name.upper()}"'
    register = body.registers.get(member.offset)
    if register is not None and parameter.passing is Passing.REFERENCE:
        body.bound.add(member.offset)
    offset = body.pou.frame_offset + member.offset
    match parameter.passing:
        case Passing.VALUE | Passing.REFERENCE:
            type = "i64" if parameter.passing is Passing.REFERENCE else stored(elementary(member.type))
            pointer = register or text.address(body.image, offset)
            in_image = register is None and parameter.passing is Passing.VALUE
            kept = canonical(body, elementary(member.type), Value(name)) if in_image and is_real(member.type) else name
            text.do(f"store {type} {kept}, ptr {pointer}, align 1")
        case Passing.STRING:
            assert isinstance(member.type, StringType)
            # the caller's characters are never more than a STRING can have
            piece = Piece(name, f'%"n.{member.name.upper()}"', MAX_STRING, "", width=member.type.width)
            assign(body, Place(member.type, Base.FRAME, member.offset), [piece])
        case Passing.BYTES:
            pointer = text.address(body.image, offset)
            move(body, pointer, name, member.type.size)
