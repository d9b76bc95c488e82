"""Stack, scopes, variables, expressions: what a client shows of a PLC that is halted, and changes."""

import re

from scanbench.web.dap import shapes
from scanbench.web.dap.debuggee import Debuggee
from scanbench.web.dap.handles import Below
from scanbench.web.dap.shapes import Body
from scanbench.wire import debugging as host
from scanbench.wire.debugging import VariableInfo
from scanbench.wire.refused import Refused

_PAGE, _MOST = 1000, 10_000
"""Variables that are asked for at once, and those that a client gets that wants all."""
_EFFECTS = "!"
"""What an expression of the console begins with that may change something."""
_WORD = re.compile(r"[\w.\[\]^%]*\Z")


async def on_threads(plc: Debuggee, _args: shapes.Nothing) -> Body:
    """A thread for each task."""
    try:
        tasks = (await plc.ask(host.Tasks, host.WantTasks)).names
    except Refused:  # it is away for a moment, or for good: who debugs it still wants to know what there was
        tasks = ()
    return plc.threads.listed(tasks)


async def on_stack_trace(plc: Debuggee, args: shapes.StackTrace) -> Body:
    """The frames, innermost first; none in the seam, and none of a task that does not run just now."""
    stack = await plc.ask(host.Stack, host.WantStack)
    frames = stack.frames
    if frames and plc.threads.is_other(args.thread_id, frames[-1].task):
        frames = ()
    end = args.start_frame + args.levels if args.levels else None
    shown = frames[args.start_frame : end]
    return {"stackFrames": [_frame(plc, each) for each in shown], "totalFrames": len(frames)}


def _frame(plc: Debuggee, frame: host.FrameInfo) -> Body:
    return {
        "id": plc.handles.frame_id(frame.index), "name": frame.name, "source": plc.paths.source(frame.file),
        **plc.span(frame.line, frame.column, frame.end_line, frame.end_column),
        "scanbench": {"pou": frame.pou, "instance": frame.instance, "task": frame.task},
    }  # fmt: skip


async def on_scopes(plc: Debuggee, args: shapes.Scopes) -> Body:
    """The sections of a frame's POU, and the globals."""
    frame = plc.handles.frame(args.frame_id)
    assert frame is not None
    found = await plc.ask(host.Scopes, lambda ref: host.WantScopes(ref, frame))
    return {"scopes": [_scope(plc, frame, each) for each in found.scopes]}


def _scope(plc: Debuggee, frame: int, scope: host.ScopeInfo) -> Body:
    body: Body = {
        "name": scope.name, "variablesReference": plc.handles.reference(Below(frame, scope.name, "")),
        "namedVariables": scope.count, "expensive": scope.name == "GLOBAL",
    }  # fmt: skip
    hint = {"VAR_INPUT": "arguments", "VAR": "locals", "VAR_TEMP": "locals", "RESULT": "returnValue"}.get(scope.name)
    return body if hint is None else body | {"presentationHint": hint}


async def on_variables(plc: Debuggee, args: shapes.Variables) -> Body:
    """What is below a reference, or a page of it."""
    below = plc.handles.below(args.variables_reference)
    found = await _below(plc, below, args.start, args.count)
    if args.filter == "indexed" and not below.expression:
        found = []
    return {"variables": [_variable(plc, below.frame, each) for each in found]}


async def _below(plc: Debuggee, below: Below, start: int = 0, count: int = 0) -> list[VariableInfo]:
    """Variables of a scope or an expression; `count` 0: all, within reason."""
    found: list[VariableInfo] = []
    wanted = count or _MOST
    while len(found) < wanted:
        page = min(_PAGE, wanted - len(found))
        at = start + len(found)
        answer = await _page(plc, below, at, page)
        found += answer.variables
        if not answer.variables or at + len(answer.variables) >= answer.total:
            break
    return found


async def _page(plc: Debuggee, below: Below, start: int, count: int) -> host.Variables:
    frame, scope, expression = below.frame, below.scope, below.expression
    return await plc.ask(
        host.Variables, lambda ref: host.WantVariables(ref, frame, scope, expression, start, count)
    )  # fmt: skip


def _variable(plc: Debuggee, frame: int | None, info: VariableInfo) -> Body:
    return {"name": info.name, "value": info.value, "evaluateName": info.expression, **_rest(plc, frame, info)}


def _rest(plc: Debuggee, frame: int | None, info: VariableInfo) -> Body:
    """What variables and results have in common."""
    reference = plc.handles.reference(Below(frame, "", info.expression)) if info.children else 0
    body: Body = {
        # an alias is part of the type, not of the value: that is what people begin to edit with
        "type": f"{info.type} {info.alias}".rstrip(), "variablesReference": reference,
        "scanbench": {
            "path": info.path, "alias": info.alias, "address": info.address, "writable": info.writable,
            "type": info.type, "expression": info.expression,
        },
    }  # fmt: skip
    if info.children:
        body["indexedVariables" if info.indexed else "namedVariables"] = info.children
    if not info.writable:
        body["presentationHint"] = {"attributes": ["readOnly"]}
    return body


# ---- expressions ---------------------------------------------------------------------------------------------------


async def on_evaluate(plc: Debuggee, args: shapes.Evaluate) -> Body:
    """An expression in a frame, or of the whole program. Nothing is changed unless that is asked for."""
    frame, text = plc.handles.frame(args.frame_id), args.expression.strip()
    effects = args.scanbench.effects
    if args.context == "repl" and text.startswith(_EFFECTS):
        text, effects = text[len(_EFFECTS) :].strip(), True
    found = await plc.ask(host.Evaluated, lambda ref: host.Evaluate(ref, frame, text, plc.author, effects))
    if not found.ok:
        raise Refused(found.message, found.near)
    if found.variable is None:
        return {"result": found.message, "variablesReference": 0}
    return {"result": found.variable.value, **_rest(plc, frame, found.variable)}


async def on_set_expression(plc: Debuggee, args: shapes.SetExpression) -> Body:
    """Writes through the one door."""
    return await _set(plc, plc.handles.frame(args.frame_id), args.expression, args.value)


async def on_set_variable(plc: Debuggee, args: shapes.SetVariable) -> Body:
    """Writes through the one door."""
    below = plc.handles.below(args.variables_reference)
    return await _set(plc, below.frame, (await _named(plc, below, args.name)).expression, args.value)


async def _set(plc: Debuggee, frame: int | None, target: str, value: str) -> Body:
    found = await plc.ask(host.Evaluated, lambda ref: host.SetExpression(ref, frame, target, value, plc.author))
    if not found.ok:
        raise Refused(found.message, found.near)
    if found.variable is None:
        return {"value": value}
    return {"value": found.variable.value, **_rest(plc, frame, found.variable)}


async def _named(plc: Debuggee, below: Below, name: str) -> VariableInfo:
    variables = await _below(plc, below)
    found = next((each for each in variables if each.name == name), None)
    if found is None:
        raise Refused(f"there is no {name} in {below.expression or below.scope}")
    return found


async def on_data_breakpoint_info(plc: Debuggee, args: shapes.DataBreakpointInfo) -> Body:
    """The path by which a variable is listened to; null for what has none."""
    if args.variables_reference:
        info = await _named(plc, plc.handles.below(args.variables_reference), args.name)
    else:
        frame = plc.handles.frame(args.frame_id)
        found = await plc.ask(host.Evaluated, lambda ref: host.Evaluate(ref, frame, args.name, plc.author))
        if not found.ok or found.variable is None:
            return {"dataId": None, "description": found.message or f"{args.name} is no variable"}
        info = found.variable
    if not info.path:
        return {"dataId": None, "description": f"{info.name} lives in one call only: it has no path to listen to"}
    shown = f"{info.path} ({info.address})" if info.address else info.path
    return {
        "dataId": info.path, "description": shown, "accessTypes": ["read", "write", "readWrite"], "canPersist": True,
    }  # fmt: skip


# ---- what could be typed -------------------------------------------------------------------------------------------


async def on_completions(plc: Debuggee, args: shapes.Completions) -> Body:
    """Members after a point; else the frame's variables, instance paths and addresses."""
    line = args.text.split("\n")[max(0, plc.line_in(args.line) - 1) if args.line is not None else 0]
    column = plc.column_in(args.column) - 1
    match = _WORD.search(line[:column])
    word = match.group() if match else ""
    stem, dot, begun = word.rpartition(".")
    frame = plc.handles.frame(args.frame_id)
    found: dict[str, Body] = {}
    if frame is not None:
        for below in [Below(frame, "", stem)] if dot else await _scopes_of(plc, frame):
            for each in await _quietly(plc, below):
                if each.name.casefold().startswith(begun.casefold()):
                    found.setdefault(each.name, {"label": each.name, "type": "variable", "detail": each.type})
    for symbol in (await plc.session.instance.look_up("complete", word)).symbols:
        label = symbol.path[len(stem) + 1 :] if dot else symbol.path
        found.setdefault(label, {"label": label, "type": "variable", "detail": symbol.type})
    place: Body = {"start": column - len(begun), "length": len(begun)}
    return {"targets": [each | place for each in found.values()]}


async def _scopes_of(plc: Debuggee, frame: int) -> list[Below]:
    scopes = await plc.ask(host.Scopes, lambda ref: host.WantScopes(ref, frame))
    return [Below(frame, scope.name, "") for scope in scopes.scopes]


async def _quietly(plc: Debuggee, below: Below) -> list[VariableInfo]:
    """What is below, or nothing: half a word need not be an expression."""
    try:
        return await _below(plc, below, count=_PAGE)
    except Refused:
        return []


async def on_exception_info(plc: Debuggee, _args: shapes.ExceptionInfo) -> Body:
    """Why the PLC is halted."""
    halt = plc.session.state.halt
    if halt is None:
        raise Refused("the PLC is not halted")
    info: Body = {"exceptionId": halt.reason, "description": halt.text, "breakMode": "always"}
    left = halt.left
    if left is not None:
        info["details"] = {
            "message": halt.text, "typeName": f"{left.low}..{left.high}", "evaluateName": left.target or left.variable,
            "stackTrace": "\n".join(left.calls), "variable": left.variable, "instance": left.instance,
            "target": left.target, "value": left.value, "low": left.low, "high": left.high, "place": left.place,
        }  # fmt: skip
    return info
