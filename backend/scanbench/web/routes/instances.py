"""REST: instances, their symbols and error histories; and the WebSocket of each."""

import asyncio
from typing import Annotated

from fastapi import APIRouter, Query, Request, WebSocket
from fastapi.responses import FileResponse
from starlette.background import BackgroundTask

from scanbench import __version__
from scanbench.server.workbench import Workbench
from scanbench.session.session import Session
from scanbench.store.records import Limits, NotFound
from scanbench.symbols.rack import INPUT, OUTPUT
from scanbench.web import messages as wire
from scanbench.web import messages_values, translate
from scanbench.web.auth import user_of
from scanbench.web.compressed import AS_IT_IS
from scanbench.web.messages_base import Id, Scan, Version
from scanbench.web.messages_errors import ErrorHistoryRow
from scanbench.web.reach import Bench, SocketBench
from scanbench.web.socket.socket import Client
from scanbench.wire.host import MarkKind as LogKind
from scanbench.wire.log import LogPage
from scanbench.wire.refused import Refused
from scanbench.wire.symbols import SymbolInfo

router = APIRouter(prefix="/api", tags=["instances"])
LARGEST_IMPORT = 1 << 30
MOST_LOG_LINES = 1000
LAST_LOG_LINE = 2**53
"""No database keeps as many."""


@router.get("")
async def on_app(bench: Bench, request: Request) -> wire.AppInfo:
    """What there is, and who you are."""
    projects = {row.id: row for row in await bench.projects.all()}
    return wire.AppInfo(
        version=__version__,
        public_url=request.app.state.public_url,
        you=translate.user(user_of(request)),
        projects=[translate.project(row) for row in projects.values()],
        instances=[translate.instance(session, projects[session.project_id]) for session in bench.sessions],
    )


@router.get("/instances")
async def on_instances(bench: Bench) -> list[wire.Instance]:
    """Every instance, with what it costs."""
    await bench.look()
    return [await _instance(bench, session) for session in bench.sessions]


@router.post("/instances", status_code=201)
async def on_new_instance(bench: Bench, new: wire.NewInstance) -> wire.Instance:
    """A new PLC that runs a project's last accepted build."""
    return await _instance(bench, await bench.create_instance(new.project, new.name.strip()))


@router.get("/instances/{instance}")
async def on_instance(bench: Bench, instance: Id) -> wire.Instance:
    """One instance."""
    return await _instance(bench, bench.session(instance))


@router.patch("/instances/{instance}")
async def on_change_instance(
    bench: Bench, request: Request, instance: Id, change: wire.ChangeInstance
) -> wire.Instance:
    """Renames it, switches it on or off, limits what it may cost."""
    limits = None if change.limits is None else Limits(**change.limits.model_dump())
    name = None if change.name is None else change.name.strip()
    session = await bench.change_instance(instance, user_of(request).name, name, change.power, limits)
    return await _instance(bench, session)


@router.post("/instances/{instance}/branch", status_code=201)
async def on_branch(bench: Bench, request: Request, instance: Id, branch: wire.Branch) -> wire.Instance:
    """A new PLC that begins as this one was before a scan, or is now."""
    session = await bench.branch(instance, branch.name.strip(), branch.scan, user_of(request).name, branch.look)
    return await _instance(bench, session)


@router.get("/instances/{instance}/export", response_class=FileResponse)
async def on_export(bench: Bench, request: Request, instance: Id, scan: Scan | None = None) -> FileResponse:
    """The run as one file, which replays byte for byte elsewhere; it ends before `scan`, or now."""
    name = f"{bench.session(instance).name}.scanrun"
    path = await bench.export(instance, scan, user_of(request).name)
    return FileResponse(
        path, media_type="application/octet-stream", filename=name, headers=AS_IT_IS,
        background=BackgroundTask(path.unlink),
    )  # fmt: skip


@router.post("/instances/import", status_code=201)
async def on_import(bench: Bench, request: Request, name: str) -> wire.ImportedInstance:
    """A new PLC, with a project of the same name, that goes on with an exported run; the body is the file. Of a damaged file
    all that can be read is taken, and `damage` says what is lost."""
    if not 0 < len(name.strip()) <= 100:
        raise Refused("the name of the new PLC must have 1 to 100 characters")
    path, size = bench.fresh_path(), 0
    file = await asyncio.to_thread(path.open, "wb")
    try:
        async for chunk in request.stream():
            size += len(chunk)
            if size > LARGEST_IMPORT:
                raise Refused(f"the file is larger than {LARGEST_IMPORT >> 20} MiB")
            await asyncio.to_thread(file.write, chunk)
    except BaseException as error:
        await asyncio.to_thread(path.unlink)
        if isinstance(error, OSError):
            raise Refused(f"the file cannot be taken: {error.strerror}") from error
        raise
    finally:
        await asyncio.to_thread(file.close)
    session, damage = await bench.bring_in(path, name.strip(), user_of(request).name)
    return wire.ImportedInstance(**dict(await _instance(bench, session)), damage=damage)


@router.delete("/instances/{instance}", status_code=204)
async def on_delete_instance(bench: Bench, request: Request, instance: Id) -> None:
    """Ends a PLC and deletes it."""
    await bench.delete_instance(instance, user_of(request).name)


@router.get("/instances/{instance}/symbols")
async def on_symbols(bench: Bench, instance: Id, path: str = "", offer: bool = False) -> tuple[SymbolInfo, ...]:
    """The members below a path; programs and globals below ''. With `offer` a path that is no variable (it is being typed)
    has none, instead of being refused."""
    found = await bench.session(instance).instance.look_up("members", path)
    if found.message and not offer:
        raise Refused(found.message, found.near)
    return found.symbols


@router.get("/instances/{instance}/complete")
async def on_complete(bench: Bench, instance: Id, text: str = "") -> tuple[SymbolInfo, ...]:
    """At most 50 symbols whose path begins with the text."""
    found = await bench.session(instance).instance.look_up("complete", text)
    return found.symbols


@router.get("/instances/{instance}/instances-of")
async def on_instances_of(bench: Bench, instance: Id, pou: str) -> tuple[SymbolInfo, ...]:
    """The instances of a POU in the running program, at most 1,000."""
    found = await bench.session(instance).instance.look_up("instances", pou)
    return found.symbols


@router.get("/instances/{instance}/rack")
async def on_rack(bench: Bench, instance: Id) -> list[messages_values.Channel]:
    """The words of inputs and outputs in which the running program declares a variable, at most 32 of each, bit by bit, with the
    units that `hardware.json` says they lead to."""
    session = bench.session(instance)
    found = await session.instance.look_up("terminals", "")
    units = {word: translate.channel_unit(each) for each in session.model.fitted or () for word in each.words}
    channels: list[messages_values.Channel] = []
    for symbol in found.symbols:
        if symbol.section in (INPUT, OUTPUT):
            channels.append(
                messages_values.Channel(
                    address=symbol.path,
                    side="input" if symbol.section == INPUT else "output",
                    terminals=[],
                    unit=units.get(symbol.path),
                )
            )
        else:
            channels[-1].terminals.append(symbol)
    return channels


@router.get("/instances/{instance}/program")
async def on_program(bench: Bench, instance: Id, version: Version) -> wire.ProgramText:
    """The text of a program version that ran here: in the past the text is that of the scan."""
    sources = await bench.session(instance).instance.sources_of(version)
    found = await bench.projects.declared(sources)
    return wire.ProgramText(version=version, files=sources.files, pous=found.pous)


@router.get("/instances/{instance}/errors")
async def on_errors(bench: Bench, instance: Id) -> list[ErrorHistoryRow]:
    """The error history, in the order of the catalogue."""
    return list(map(translate.error_row, bench.session(instance).errors.rows))


@router.get("/instances/{instance}/log")
async def on_log(
    bench: Bench, instance: Id, first: Annotated[int, Query(ge=0, le=LAST_LOG_LINE)] | None = None,
    count: Annotated[int, Query(ge=1, le=MOST_LOG_LINES)] = MOST_LOG_LINES, kind: LogKind | None = None,
) -> LogPage:  # fmt: skip
    """Lines of the event log, oldest first: `count` of them from the number `first` on (counted from 0, of those of this
    `kind`), or the last ones."""
    return await bench.log_page(bench.session(instance), first, count, kind)


@router.websocket("/instances/{instance}/socket")
async def on_socket(bench: SocketBench, socket: WebSocket, instance: Id) -> None:
    """Live values, events and commands."""
    try:
        session = bench.session(instance)
        project = await bench.projects.get(session.project_id)
    except NotFound as error:
        await socket.close(1008, str(error))
        return
    client = Client(socket, session, user_of(socket), bench.projects.drafts, bench.people)
    bench.looks.came(session)
    try:
        await client.serve(project, bench.verifications.of)
    finally:
        bench.looks.left(session)


async def _instance(bench: Workbench, session: Session) -> wire.Instance:
    return translate.instance(session, await bench.projects.get(session.project_id))
