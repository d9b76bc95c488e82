"""The calls of a text: where they are, what they call, and the parameters of that. What a name means the checks noted."""

import re
from collections.abc import Iterator, Sequence

from scanbench.check.body.arguments import by_position
from scanbench.check.uses import Symbol
from scanbench.language.declared import member_of
from scanbench.language.describe import library_declared
from scanbench.language.reading import Reading
from scanbench.language.standard import row_of
from scanbench.program.types import ArrayType, OpenArray, Record, Reference, Section
from scanbench.syntax import tree
from scanbench.syntax.chart import Chart
from scanbench.syntax.chunks import Chunk
from scanbench.syntax.networks import Box, Contact, Diagram, Function, NetworkBody, Pin, Rung, elements
from scanbench.syntax.source import Stretch

_NUMBERED = re.compile(r"([A-Z]+)(\d+)")
_GIVEN = (Section.INPUT, Section.IN_OUT, Section.OUTPUT)


def calls(chunk: Chunk, start: int, end: int) -> Iterator[tree.Call]:
    """The calls of the statements that reach into a stretch of a chunk."""
    for pou in chunk.file.pous:
        for each in (pou, *pou.methods):
            yield from calls_of(each, start, end)


def calls_of(pou: tree.PouDeclaration, start: int, end: int) -> Iterator[tree.Call]:
    """Those of one body. In IL a call is a CAL; the functions that are operators there have one operand or named arguments."""
    if isinstance(pou.body, tree.IlBody):
        for each in pou.body.instructions:
            if each.operator == "CAL" and each.operand is not None and start <= _end(each.span) and _start(each) < end:
                yield tree.Call(each.operand, each.arguments, each.span)
        return
    if isinstance(pou.body, NetworkBody):
        for network in pou.body.networks:
            yield from _in_rung(network, start, end) if isinstance(network, Rung) else _in_diagram(network, start, end)
        return
    if isinstance(pou.body, Chart):
        yield from _in_chart(pou.body, start, end)
        return
    lists: list[Sequence[tree.Statement]] = [pou.body]
    while lists:
        for statement in _reaching(lists.pop(), start, end):
            expressions, inner = parts(statement)
            lists += inner
            yield from _in_expressions(expressions)


def _in_chart(chart: Chart, start: int, end: int) -> Iterator[tree.Call]:
    yield from _in_expressions(
        [each.duration for step in chart.steps for each in step.actions if each.duration is not None]
    )
    for transition in chart.transitions:
        if isinstance(transition.condition, Rung):
            yield from _in_rung(transition.condition, start, end)
        elif transition.condition is not None:
            yield from _in_expressions([transition.condition])


def _in_rung(rung: Rung, start: int, end: int) -> Iterator[tree.Call]:
    for each in elements(rung.path):
        if isinstance(each, Box):
            arguments = tuple(one for one in each.arguments if isinstance(one, tree.Argument))
            if start <= _end(each.span) and _start(each) < end:
                yield tree.Call(each.callee, arguments, each.span)
                yield from _in_expressions([one.value for one in arguments if one.value is not None])
        elif isinstance(each, Contact):
            yield from _in_expressions([each.operand])


def _in_diagram(diagram: Diagram, start: int, end: int) -> Iterator[tree.Call]:
    for item in diagram.items:
        value = item.value
        if isinstance(value, Function):
            arguments = tuple(one for one in value.arguments if isinstance(one, tree.Argument))
            if start <= _end(value.span) and _start(value) < end:
                yield tree.Call(value.callee, arguments, value.span)
                yield from _in_expressions([one.value for one in arguments if one.value is not None])
        elif value is not None and not isinstance(value, Pin):
            yield from _in_expressions([value])


def _reaching(statements: Sequence[tree.Statement], start: int, end: int) -> Iterator[tree.Statement]:
    """Those that reach into a stretch: each goes on to where the next one begins."""
    for at, each in enumerate(statements):
        if _start(each) >= end:
            return
        if at + 1 == len(statements) or _start(statements[at + 1]) > start:
            yield each


def parts(statement: tree.Statement) -> tuple[list[tree.Expression], list[Sequence[tree.Statement]]]:
    """The expressions of a statement, and the statements inside of it."""
    match statement:
        case tree.Assignment(target=target, value=value, also=also):
            return [target, *also, value], []
        case tree.ReturnStatement(condition=condition) if condition is not None:
            return [condition], []
        case tree.ExpressionStatement(expression=expression):
            return [expression], []
        case tree.IfStatement(branches=branches, orelse=orelse):
            return [condition for condition, _ in branches], [*(body for _, body in branches), orelse]
        case tree.CaseStatement(selector=selector, branches=cases, orelse=orelse):
            return [selector], [*(body for _, body in cases), orelse]
        case tree.ForStatement(variable=variable, start=first, end=last, step=step, body=body):
            return [each for each in (variable, first, last, step) if each is not None], [body]
        case tree.WhileStatement(condition=condition, body=body) | tree.RepeatStatement(until=condition, body=body):
            return [condition], [body]
        case tree.TryStatement(body=body, caught=caught, handler=handler, final=final):
            return [caught] if caught is not None else [], [body, handler, final]
        case _:
            return [], []


def _in_expressions(open_: list[tree.Expression]) -> Iterator[tree.Call]:
    while open_:
        match open_.pop():
            case tree.Call(callee=callee, arguments=arguments) as call:
                yield call
                open_ += [callee, *(each.value for each in arguments if each.value is not None)]
            case tree.UnaryOp(operand=inner) | tree.MemberOf(owner=inner) | tree.PartialAccess(owner=inner):
                open_.append(inner)
            case tree.Dereference(reference=inner):
                open_.append(inner)
            case tree.BinaryOp(left=left, right=right):
                open_ += [left, right]
            case tree.IndexOf(array=array, indices=indices):
                open_ += [array, *indices]


def _start(node: tree.Statement | tree.IlInstruction | Box | Function) -> int:
    return node.span.start if isinstance(node.span, Stretch) else -1


def _end(span: object) -> int:
    return span.end if isinstance(span, Stretch) else -1


# ---- what is called -------------------------------------------------------------------------------------------------


def named(callee: tree.Expression) -> Stretch | None:
    """The expression that ends in the name of what is called: of `motors[2]` this is `motors`."""
    while not isinstance(callee, tree.Name | tree.MemberOf):
        if isinstance(callee, tree.IndexOf):
            callee = callee.array
        elif isinstance(callee, tree.Dereference):
            callee = callee.reference
        else:
            return None
    return callee.span if isinstance(callee.span, Stretch) else None


def symbol_of(reading: Reading, call: tree.Call) -> Symbol | None:
    """What the name means that is called: a POU, a method, a standard function, or a variable that is an instance."""
    span = named(call.callee)
    return None if span is None else reading.index.ending(span.source, span.end)


def block_of(reading: Reading, symbol: Symbol) -> Record | None:
    """The block or class whose instance a variable is, refers to, or has elements of."""
    member = member_of(reading.project.checker, symbol)
    type = None if member is None else member.type
    while isinstance(type, ArrayType | OpenArray | Reference):
        type = type.target if isinstance(type, Reference) else type.element
    return type if isinstance(type, Record) else None


# ---- its parameters -------------------------------------------------------------------------------------------------


def parameters(reading: Reading, symbol: Symbol, count: int) -> list[str]:
    """The names of what takes so many arguments by position, in order; fewer where it takes fewer."""
    if symbol.kind == "function":
        row = row_of(symbol.name)
        return [] if row is None else _counted(row.formals, count if row.variadic else 0)
    if symbol.kind == "variable":
        record = block_of(reading, symbol)
        members = [] if record is None else list(record.members.values())
    else:
        pou = reading.project.checker.pous.functions.get(symbol.name) if symbol.kind == "pou" else None
        if pou is None:
            return _written(reading, symbol, count)
        members = [pou.frame.members[key] for key in pou.parameters]
    return [each.name for each in by_position(members, count)]


def _counted(formals: tuple[str, ...], count: int) -> list[str]:
    """All formals, and IN3, IN4 as long as there are arguments."""
    last = _NUMBERED.fullmatch(formals[-1]) if len(formals) < count else None
    more = range(1, count - len(formals) + 1) if last is not None else ()
    return [*formals, *(f"{last[1]}{int(last[2]) + each}" for each in more if last is not None)]


def _written(reading: Reading, symbol: Symbol, count: int) -> list[str]:
    """Of a method, or of a FUNCTION that takes several types."""
    found = reading.declared(symbol) or library_declared(reading, symbol)
    pou = found[0].node if found else None
    if not isinstance(pou, tree.PouDeclaration):
        return []
    names = [(part.keyword, each.name) for part in pou.sections if part.keyword in _GIVEN for each in part.variables]
    inward = [name for keyword, name in names if keyword != Section.OUTPUT]
    return [name for _, name in names] if count > len(inward) else inward
