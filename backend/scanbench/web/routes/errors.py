"""REST: what can be done to one PLC from a script: raise and recover errors; and how its program reacted."""

from fastapi import APIRouter, Request

from scanbench.faults.arm import ArmedInfo
from scanbench.faults.device_shapes import DeviceErrors
from scanbench.faults.reaction.reaction import Reaction
from scanbench.faults.reference import ErrorRef
from scanbench.typed import make
from scanbench.web import messages_errors, messages_models, translate
from scanbench.web.messages_base import Id
from scanbench.web.reach import Bench
from scanbench.web.routes.entering import entered
from scanbench.wire.host import ErrorsPreviewed, PreviewedErrors, PreviewErrors
from scanbench.wire.refused import Refused

router = APIRouter(prefix="/api/instances/{instance}", tags=["errors"])


@router.get("/model")
async def on_model(bench: Bench, instance: Id) -> messages_models.ModelInfo:
    """The model with the errors that the project added, as the program that runs knows it."""
    return translate.model_info(bench.session(instance).model)


@router.post("/errors/generate")
async def on_generate(
    bench: Bench, request: Request, instance: Id, wanted: messages_errors.GenerateErrors
) -> messages_errors.CommandResult:
    """Raises errors, all between the same two scans, or none of them."""
    return await entered(bench, request, instance, "generate", wanted)


@router.post("/errors/recover")
async def on_recover(
    bench: Bench, request: Request, instance: Id, wanted: messages_errors.RecoverErrors
) -> messages_errors.CommandResult:
    """Recovers these errors, or all that are generated."""
    return await entered(bench, request, instance, "recover", wanted)


@router.get("/errors/device")
async def on_device(bench: Bench, instance: Id) -> DeviceErrors:
    """What a tool reads from the PLC's memory at the scan that is shown: errors that are present, its own error log, messages."""
    return await bench.session(instance).device.now()


@router.post("/errors/clear")
async def on_clear(
    bench: Bench, request: Request, instance: Id, wanted: messages_errors.ClearErrors
) -> messages_errors.CommandResult:
    """Clears errors as a tool does it on the device (FINS 2101)."""
    return await entered(bench, request, instance, "clear_errors", wanted)


@router.post("/errors/log/clear")
async def on_clear_log(bench: Bench, request: Request, instance: Id) -> messages_errors.CommandResult:
    """Empties the PLC's own error log, as a tool does it on the device (FINS 2103)."""
    return await entered(bench, request, instance, "clear_error_log", {})


@router.get("/errors/armed")
async def on_armed(bench: Bench, instance: Id) -> tuple[ArmedInfo, ...]:
    """The faults that are armed and not over."""
    return bench.session(instance).errors.armed


@router.post("/errors/arm")
async def on_arm(
    bench: Bench, request: Request, instance: Id, wanted: messages_errors.ArmFaults
) -> messages_errors.CommandResult:
    """Errors that begin later, or come and go; the message begins with `armed N`, N is what `disarm` takes."""
    return await entered(bench, request, instance, "arm", wanted)


@router.post("/errors/disarm")
async def on_disarm(
    bench: Bench, request: Request, instance: Id, wanted: messages_errors.DisarmFaults
) -> messages_errors.CommandResult:
    """Disarms these faults, or all; what they raised is recovered."""
    return await entered(bench, request, instance, "disarm", wanted)


@router.post("/errors/preview")
async def on_preview(bench: Bench, instance: Id, wanted: messages_errors.PreviewErrors) -> PreviewedErrors:
    """What raising these would write now; nothing is changed."""
    refs = tuple(make(ErrorRef, one.model_dump()) for one in wanted.errors)
    plc = bench.session(instance).instance
    return (await plc.ask(lambda ref: PreviewErrors(ref, refs, wanted.again, wanted.anyway), ErrorsPreviewed)).found


@router.get("/errors/{error}/reaction")
async def on_reaction(bench: Bench, instance: Id, error: str) -> Reaction:
    """How the program reacted to an error the last time it was raised here."""
    found = bench.session(instance).errors.reaction(error)
    if found is None:
        raise Refused(f"nobody has compared yet how the program reacts to {error}: raise it, and wait for the window")
    return found
