"""A large body in pieces: LLVM takes more than linear time for a function of many thousand statements.

A piece is a function of its own that runs some statements of a list, and returns 0 or the number of a trap like the POU. It
needs nothing of the function around it, because no variable of a divided POU is a register (`registers`).
"""

from collections.abc import Iterator

from scanbench.engines.native import inlining
from scanbench.engines.native.emit_body import Body
from scanbench.engines.native.emit_function import FunctionText
from scanbench.program.bodies import every
from scanbench.program.program import Continue, Exit, For, Jump, Repeat, Return, Stmt, While

_IMAGE = "ptr nonnull noundef align 8 %img"
_FEW = 8
"""What has less than such a part of a piece's statements is not worth a call."""


def pieces(statements: tuple[Stmt, ...]) -> Iterator[tuple[tuple[Stmt, ...], bool]]:
    """The statements in order, in groups; and whether a group is to be a piece."""
    group: list[Stmt] = []
    size = 0
    for statement in statements:
        own = inlining.size((statement,))
        if own > inlining.PIECE or _goes_elsewhere(statement):
            yield tuple(group), size * _FEW >= inlining.PIECE
            yield (statement,), False
            group, size = [], 0
            continue
        if size + own > inlining.PIECE:
            yield tuple(group), True
            group, size = [], 0
        group.append(statement)
        size += own
    yield tuple(group), size * _FEW >= inlining.PIECE


def _goes_elsewhere(statement: Stmt) -> bool:
    """Whether it may go on outside of itself, other than by a trap."""
    if isinstance(statement, For | While | Repeat):
        # EXIT and CONTINUE inside are of this loop, or of one inside of it
        return any(isinstance(each, Return | Jump) for each in every((statement,)))
    return any(isinstance(each, Return | Jump | Exit | Continue) for each in every((statement,)))


def call(body: Body, statements: tuple[Stmt, ...]) -> None:
    """Emits the statements as a piece, and its call."""
    unit, pou, text = body.unit, body.pou, body.text
    unit.pieces += 1
    name = unit.symbol(pou).replace('@"p.', f'@"piece{unit.pieces}.', 1)
    own = pou.kind != "function"
    inner = FunctionText(
        f"define internal i32 {name}({_IMAGE}{', i64 noundef %self' if own else ''}) noinline #0",
        text.scratch,
        text.first_trap,
    )
    piece = body.inside(inner)
    if own:
        inner.entry.append("  %me = getelementptr inbounds nuw i8, ptr %img, i64 %self")
    piece.run(statements)
    inner.do("ret i32 0")
    text.scratch_size = max(text.scratch_size, inner.scratch_size)
    unit.module.add(inner.text())
    text.check_status(text.op(f"call i32 {name}(ptr {body.image}{', i64 %self' if own else ''})"))
