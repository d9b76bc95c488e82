"""Continue, pause, step; and what enters the PLC through the one door."""

from pydantic_core import to_jsonable_python

from scanbench.debug.bound_to import Bound
from scanbench.faults.reference import parse_reference
from scanbench.runtime.command import Command, Refusal
from scanbench.web.dap import shapes
from scanbench.web.dap.debuggee import Debuggee
from scanbench.web.dap.shapes import Body
from scanbench.wire import debugging as host
from scanbench.wire.commands import read_command
from scanbench.wire.debugging import Coverage, StepAction
from scanbench.wire.host import Ack
from scanbench.wire.refused import Refused


async def on_continue(plc: Debuggee, _args: shapes.Nothing) -> Body:
    """Goes on; a PLC that somebody paused goes on too."""
    await proceed(plc)
    return {"allThreadsContinued": True}


async def on_pause(plc: Debuggee, _args: shapes.Nothing) -> Body:
    """Halts at the next statement."""
    return await _moved(plc, "pause")


async def on_next(plc: Debuggee, _args: shapes.Nothing) -> Body:
    """To the next statement of this frame or one further out."""
    return await _moved(plc, "over")


async def on_step_in(plc: Debuggee, _args: shapes.Nothing) -> Body:
    """To the next statement anywhere."""
    return await _moved(plc, "in")


async def on_step_out(plc: Debuggee, _args: shapes.Nothing) -> Body:
    """Out of this frame."""
    return await _moved(plc, "out")


async def on_step_back(plc: Debuggee, _args: shapes.Nothing) -> Body:
    """To the statement before."""
    return await _moved(plc, "back")


async def on_reverse_continue(plc: Debuggee, _args: shapes.Nothing) -> Body:
    """Back to where a breakpoint would have halted last."""
    return await _moved(plc, "reverse")


async def on_single_scan(plc: Debuggee, _args: shapes.Nothing) -> Body:
    """To the first statement of the next scan."""
    return await _moved(plc, "scan")


async def on_step(plc: Debuggee, args: shapes.Step) -> Body:
    """Any step by its name."""
    if args.action == "to":
        raise Refused("for a line there is scanbench/runTo")
    return await _moved(plc, args.action)


async def on_run_to(plc: Debuggee, args: shapes.RunTo) -> Body:
    """To a line."""
    file, line = plc.paths.file(args.source), plc.line_in(args.line)
    await plc.ask(Ack, lambda ref: host.Step(ref, "to", plc.author, file, line))
    return {}


async def on_reverse_to(plc: Debuggee, args: shapes.Path) -> Body:
    """Back to the last write of a variable."""
    await plc.ask(Ack, lambda ref: host.Step(ref, "reverse", plc.author, path=args.path))
    return {}


async def _moved(plc: Debuggee, action: StepAction) -> Body:
    await move(plc, action)
    return {}


async def proceed(plc: Debuggee) -> None:
    """Continues a PLC that is halted or paused, whoever did that."""
    state = plc.session.state
    if state.halt is None and state.state == "paused":
        plc.done(await plc.session.drive("continue", None, plc.author))
    else:
        await move(plc, "continue")


async def move(plc: Debuggee, action: StepAction) -> None:
    """Steps; `Refused` says why it cannot."""
    await plc.ask(Ack, lambda ref: host.Step(ref, action, plc.author))


# ---- through the one door ------------------------------------------------------------------------------------------


async def on_force(plc: Debuggee, args: shapes.Force) -> Body:
    """Keeps a variable at a value."""
    return await _entered(plc, read_command("force", {"path": args.path, "value": args.value}, plc.author))


async def on_release(plc: Debuggee, args: shapes.Release) -> Body:
    """Ends a force, or all."""
    return await _entered(plc, read_command("release", {"path": args.path}, plc.author))


async def on_raise(plc: Debuggee, args: shapes.Raise) -> Body:
    """Raises an error of the model: `battery-error`, `io-bus-error:rack=1,slot=3`."""
    error = parse_reference(plc.session.model, args.error)
    if isinstance(error, Refusal):
        raise Refused(error.message, error.near)
    return await _entered(plc, read_command("generate", {"errors": [error]}, plc.author))


async def _entered(plc: Debuggee, command: Command) -> Body:
    ack = plc.done(await plc.session.submit(command))
    return {"message": ack.message, "scan": ack.scan}


# ---- what was bound, what was reached ------------------------------------------------------------------------------


async def on_in_out_binding(plc: Debuggee, args: shapes.Path) -> Body:
    """What an in-out is bound to."""
    return _plain(await plc.session.debugging.binding(args.path))


async def on_coverage(plc: Debuggee, args: shapes.Coverage) -> Body:
    """Switches coverage, if that is asked for; what was reached."""
    if args.on is not None or args.reset:
        now = plc.session.debugging.coverage
        on = args.on if args.on is not None else now is not None and now.on
        plc.done(await plc.session.debugging.cover(on, args.reset, plc.author))
    return _plain(await plc.session.debugging.reached())


def _plain(told: Bound | Coverage) -> Body:
    """As by REST."""
    plain: Body = to_jsonable_python(told)
    return plain
