"""REST: values of one PLC, for scripts: read, write, force, and how it runs. The same door as the browser's."""

from typing import Annotated

from fastapi import APIRouter, Query, Request

from scanbench.runtime.forces import ForcedValue
from scanbench.web import messages_commands, messages_values
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Id
from scanbench.web.messages_errors import CommandResult
from scanbench.web.reach import Bench
from scanbench.web.routes.entering import entered
from scanbench.web.translate_errors import command_result
from scanbench.wire.debugging import Evaluate, Evaluated
from scanbench.wire.refused import Refused

router = APIRouter(prefix="/api/instances/{instance}", tags=["values"])


@router.get("/value")
async def on_read(
    bench: Bench, request: Request, instance: Id, path: Annotated[str, Query(max_length=2000)]
) -> messages_values.Value:
    """The value of a variable, an address or an expression: `Main.level`, `D100`, `Main.level > 3 AND motor`."""
    author = user_of(request).name
    answer = await bench.session(instance).debug(lambda ref: Evaluate(ref, None, path, author), Evaluated)
    if answer.variable is None:
        raise Refused(answer.message, answer.near)
    found = answer.variable
    return messages_values.Value(
        path=found.path, value=found.value, type=found.type, address=found.address, alias=found.alias
    )


@router.post("/commands")
async def on_command(
    bench: Bench, request: Request, instance: Id, wanted: messages_commands.PlcCommand
) -> CommandResult:
    """Any command, by its `type`: write, force, generate, arm, disturb and so on. The routes of single commands do the same."""
    command = wanted.root
    return await entered(bench, request, instance, command.type, command.model_dump(exclude={"type", "ref"}))


@router.post("/write")
async def on_write(bench: Bench, request: Request, instance: Id, wanted: messages_commands.WriteValue) -> CommandResult:
    """Writes a variable or an address, with the rights of a tool: error memory is read-only here."""
    return await entered(bench, request, instance, "write", wanted)


@router.get("/forces")
async def on_forces(bench: Bench, instance: Id) -> tuple[ForcedValue, ...]:
    """The forces that hold."""
    return await bench.session(instance).forces.now()


@router.post("/force")
async def on_force(bench: Bench, request: Request, instance: Id, wanted: messages_commands.WriteValue) -> CommandResult:
    """Holds a variable or an address at a value until it is released."""
    return await entered(bench, request, instance, "force", wanted)


@router.post("/release")
async def on_release(
    bench: Bench, request: Request, instance: Id, wanted: messages_values.ReleaseForces
) -> CommandResult:
    """Ends a force, or all."""
    return await entered(bench, request, instance, "release", wanted)


@router.post("/run")
async def on_run(bench: Bench, request: Request, instance: Id, wanted: messages_values.Drive) -> CommandResult:
    """Lets the PLC run, pauses it, runs one scan. The answer comes when it is under way, not when it is done."""
    session, author = bench.session(instance), user_of(request).name
    return command_result(await session.drive(wanted.action, wanted.speed, author, wanted.scans, wanted.until))


@router.post("/travel")
async def on_travel(bench: Bench, request: Request, instance: Id, to: messages_values.TravelTo) -> CommandResult:
    """Shows everybody the PLC as it was before a scan, while it waits at its live one; or live again."""
    return command_result(await bench.session(instance).travel(to.scan, user_of(request).name, to.count))


@router.post("/new-run")
async def on_new_run(bench: Bench, request: Request, instance: Id) -> CommandResult:
    """Begins at scan 0, with an empty timeline; the old run file is kept aside on the server."""
    return command_result(await bench.session(instance).new_run(user_of(request).name))


@router.post("/roll-back")
async def on_roll_back(bench: Bench, request: Request, instance: Id) -> CommandResult:
    """Swaps the program back in that ran before the last change."""
    return command_result(await bench.session(instance).roll_back(user_of(request).name))


@router.post("/mode")
async def on_mode(bench: Bench, request: Request, instance: Id, wanted: messages_values.ChangeMode) -> CommandResult:
    """Changes the mode. MONITOR and RUN are refused while a fatal error is present."""
    return await entered(bench, request, instance, "mode", wanted)


@router.post("/restart")
async def on_restart(
    bench: Bench, request: Request, instance: Id, wanted: messages_values.RestartRequest
) -> CommandResult:
    """Restarts the program, in every mode; afterwards it runs."""
    return await entered(bench, request, instance, "restart", wanted)
