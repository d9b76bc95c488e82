"""One POU: a function of LLVM that returns 0 or the number of a trap."""

from scanbench.check.program import Base, Place, Pou
from scanbench.check.types import StringType
from scanbench.engines.native import emit_expressions, emit_statements, inlining, registers
from scanbench.engines.native.emit_body import Body, Unit
from scanbench.engines.native.emit_function import FunctionText, Value
from scanbench.engines.native.emit_places import canonical, move
from scanbench.engines.native.emit_strings import Piece, assign
from scanbench.engines.native.emit_types import elementary, is_real, stored
from scanbench.engines.native.registers import Parameter, Passing

IMAGE = "ptr nonnull noundef align 8 dereferenceable({size}) %img"


def emit(unit: Unit, pou: Pou, image_size: int) -> None:
    """Adds the POU's code to the module."""
    function = pou.kind == "function"
    parameters = [IMAGE.format(size=image_size)]
    if function:
        parameters += [each.declaration for each in unit.signature(pou).all if each.declaration]
    else:
        parameters.append("i64 noundef %self")
    head = f"define internal i32 {unit.symbol(pou)}({', '.join(parameters)})"
    scratch = unit.symbol(pou).replace("p.", "t.", 1)
    text = FunctionText(f"{head}{inlining.attribute(pou)} #0", scratch)
    body = Body(unit, pou, text, emit_expressions.scalar, emit_expressions.pieces)
    _registers(body)
    if function:
        for parameter in unit.signature(pou).all:
            _receive(body, parameter)
    else:
        text.entry.append("  %me = getelementptr inbounds nuw i8, ptr %img, i64 %self")
    emit_statements.run(body, pou.body)
    text.go(body.leave)
    text.begin(body.leave)
    text.do("ret i32 0")
    if text.scratch_size:
        unit.reserve(pou, scratch, text.scratch_size)
    unit.module.add(text.text())


def _registers(body: Body) -> None:
    """Frame variables that live on the stack, until LLVM puts them into registers."""
    given = {}
    if body.pou.kind == "function":
        given = {each.member.offset: f'%"p.{each.member.name.upper()}"'
                 for each in body.unit.signature(body.pou).all if each.passing is Passing.POINTER}  # fmt: skip
    for offset, type in registers.registers(body.pou).items():
        pointer = given.get(offset) or body.text.alloca(type)
        body.registers[offset] = pointer
        zero = "0.0" if type in ("float", "double") else "0"
        body.text.entry.append(f"  store {type} {zero}, ptr {pointer}")


def _receive(body: Body, parameter: Parameter) -> None:
    """Puts an argument where the function's variable lives."""
    member, text = parameter.member, body.text
    name = f'%"p.{member.name.upper()}"'
    register = body.registers.get(member.offset)
    offset = body.pou.frame_offset + member.offset
    match parameter.passing:
        case Passing.VALUE | Passing.REFERENCE:
            type = "i64" if parameter.passing is Passing.REFERENCE else stored(elementary(member.type))
            pointer = register or text.op(f"getelementptr inbounds nuw i8, ptr {body.image}, i64 {offset}")
            in_image = register is None and parameter.passing is Passing.VALUE
            kept = canonical(body, elementary(member.type), Value(name)) if in_image and is_real(member.type) else name
            text.do(f"store {type} {kept}, ptr {pointer}, align 1")
        case Passing.STRING:
            assert isinstance(member.type, StringType)
            # the caller's characters are never more than a STRING can have
            piece = Piece(name, f'%"n.{member.name.upper()}"', 32767, "")
            assign(body, Place(member.type, Base.FRAME, member.offset), [piece])
        case Passing.BYTES:
            pointer = text.op(f"getelementptr inbounds nuw i8, ptr {body.image}, i64 {offset}")
            move(body, pointer, name, member.type.size)
