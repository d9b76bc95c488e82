"""REST: what can be done to one PLC from a script: raise and recover errors; and how its program reacted."""

from fastapi import APIRouter, Request

from scanbench.faults.arm import Arm, Disarm
from scanbench.faults.clear import ClearErrorLog, ClearErrors
from scanbench.faults.inject import Generate, Recover
from scanbench.web import messages as wire
from scanbench.web import messages_errors, translate, translate_errors
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Id
from scanbench.web.reach import Bench
from scanbench.web.translate_errors import command_result
from scanbench.wire.host import PreviewedErrors, PreviewErrors
from scanbench.wire.refused import Refused

router = APIRouter(prefix="/api/instances/{instance}", tags=["errors"])


@router.get("/model")
async def on_model(bench: Bench, instance: Id) -> wire.ModelInfo:
    """The model with the errors that the project added, as the program that runs knows it."""
    return translate.model_info(bench.session(instance).model)


@router.post("/errors/generate")
async def on_generate(
    bench: Bench, request: Request, instance: Id, wanted: messages_errors.GenerateErrors
) -> messages_errors.CommandResult:
    """Raises errors, all in one seam, or none of them."""
    refs = translate_errors.refs(wanted.errors)
    return command_result(
        await bench.session(instance).submit(Generate(user_of(request).name, refs, again=wanted.again))
    )


@router.post("/errors/recover")
async def on_recover(
    bench: Bench, request: Request, instance: Id, wanted: messages_errors.RecoverErrors
) -> messages_errors.CommandResult:
    """Recovers these errors, or all that are generated."""
    ids = None if wanted.ids is None else tuple(wanted.ids)
    return command_result(await bench.session(instance).submit(Recover(user_of(request).name, ids)))


@router.post("/errors/clear")
async def on_clear(
    bench: Bench, request: Request, instance: Id, wanted: messages_errors.ClearErrors
) -> messages_errors.CommandResult:
    """Clears errors as a tool does it on the device (FINS 2101)."""
    return command_result(await bench.session(instance).submit(ClearErrors(user_of(request).name, wanted.what)))


@router.post("/errors/log/clear")
async def on_clear_log(bench: Bench, request: Request, instance: Id) -> messages_errors.CommandResult:
    """Empties the PLC's own error log, as a tool does it on the device (FINS 2103)."""
    return command_result(await bench.session(instance).submit(ClearErrorLog(user_of(request).name)))


@router.get("/errors/armed")
async def on_armed(bench: Bench, instance: Id) -> list[messages_errors.ArmedFault]:
    """The faults that are armed and not over."""
    return list(map(translate_errors.armed, bench.session(instance).errors.armed))


@router.post("/errors/arm")
async def on_arm(
    bench: Bench, request: Request, instance: Id, wanted: messages_errors.ArmFaults
) -> messages_errors.CommandResult:
    """Errors that begin later, or come and go; the message begins with `armed N`, N is what `disarm` takes."""
    command = Arm(user_of(request).name, translate_errors.wanted(wanted))
    return command_result(await bench.session(instance).submit(command))


@router.post("/errors/disarm")
async def on_disarm(
    bench: Bench, request: Request, instance: Id, wanted: messages_errors.DisarmFaults
) -> messages_errors.CommandResult:
    """Disarms these faults, or all; what they raised is recovered."""
    ids = None if wanted.ids is None else tuple(wanted.ids)
    return command_result(await bench.session(instance).submit(Disarm(user_of(request).name, ids)))


@router.post("/errors/preview")
async def on_preview(
    bench: Bench, instance: Id, wanted: messages_errors.PreviewErrors
) -> messages_errors.PreviewedErrors:
    """What raising these would write now; nothing is changed."""
    refs, instance_of = translate_errors.refs(wanted.errors), bench.session(instance).instance
    preview = await instance_of.ask(lambda ref: PreviewErrors(ref, refs, wanted.again), PreviewedErrors)
    return translate_errors.previewed(preview)


@router.get("/errors/{error}/reaction")
async def on_reaction(bench: Bench, instance: Id, error: str) -> messages_errors.Reaction:
    """How the program reacted to an error the last time it was raised here."""
    found = bench.session(instance).errors.reaction(error)
    if found is None:
        raise Refused(f"nobody has compared yet how the program reacts to {error}: raise it, and wait for the window")
    return translate_errors.reaction(found)
