"""REST: named states of a program, and sweeps: every error alone from every state."""

from fastapi import APIRouter, Request

from scanbench.faults.reaction.reaction import Reaction
from scanbench.store.records import StateRow
from scanbench.web import messages as wire
from scanbench.web import messages_errors, translate, translate_sweeps
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Id
from scanbench.web.reach import Bench

router = APIRouter(prefix="/api", tags=["sweeps"])


@router.get("/projects/{project}/states")
async def on_states(bench: Bench, project: Id) -> list[StateRow]:
    """The states that somebody kept."""
    return await bench.states.of_project(project)


@router.post("/instances/{instance}/states", status_code=201)
async def on_new_state(bench: Bench, request: Request, instance: Id, new: messages_errors.NewProgramState) -> StateRow:
    """Keeps the PLC as it was before a scan, or is now."""
    session = bench.session(instance)
    return await bench.states.keep(session, new.name.strip(), new.scan, user_of(request).name)


@router.delete("/states/{state}", status_code=204)
async def on_delete_state(bench: Bench, state: Id) -> None:
    """Deletes a state; sweeps that began there keep their results."""
    await bench.states.delete(state)


@router.get("/projects/{project}/sweeps")
async def on_sweeps(bench: Bench, project: Id) -> list[messages_errors.SweepSummary]:
    """The sweeps of a project, the newest first."""
    return list(map(translate_sweeps.summary, await bench.sweeps.of_project(project)))


@router.post("/instances/{instance}/sweeps", status_code=201)
async def on_new_sweep(
    bench: Bench, request: Request, instance: Id, new: messages_errors.NewSweep
) -> messages_errors.SweepSummary:
    """Begins a sweep; progress comes by the WebSockets of the project's PLCs."""
    session = bench.session(instance)
    made = await bench.sweeps.begin(session, new.errors, new.states, new.window, user_of(request).name)
    return translate_sweeps.summary(made)


@router.get("/sweeps/{sweep}")
async def on_sweep(bench: Bench, sweep: Id) -> messages_errors.Sweep:
    """A sweep with all its cells."""
    return translate_sweeps.whole(await bench.sweeps.whole(sweep))


@router.delete("/sweeps/{sweep}", status_code=204)
async def on_delete_sweep(bench: Bench, sweep: Id) -> None:
    """Deletes a sweep; one that is running is cancelled."""
    await bench.sweeps.delete(sweep)


@router.post("/sweeps/{sweep}/cancel")
async def on_cancel(bench: Bench, sweep: Id) -> messages_errors.SweepSummary:
    """Stops a sweep; what it found is kept, and it can be resumed."""
    return translate_sweeps.summary(await bench.sweeps.cancel(sweep))


@router.post("/sweeps/{sweep}/resume")
async def on_resume(bench: Bench, sweep: Id) -> messages_errors.SweepSummary:
    """Continues with the cells that are missing."""
    return translate_sweeps.summary(await bench.sweeps.resume(sweep))


@router.post("/sweeps/{sweep}/reaction")
async def on_cell(bench: Bench, sweep: Id, cell: messages_errors.CellRef) -> Reaction:
    """The whole result of one cell."""
    return await bench.sweeps.reaction(sweep, cell.error, cell.state)


@router.post("/sweeps/{sweep}/accept")
async def on_accept(
    bench: Bench, request: Request, sweep: Id, finding: messages_errors.AcceptFinding
) -> messages_errors.Accepted:
    """Accepts a finding with a reason, for this and later sweeps of the project; the test record lists it."""
    made = await bench.sweeps.accept(sweep, finding.error, finding.state, finding.reason, user_of(request).name)
    return translate_sweeps.accepted(made)


@router.post("/sweeps/{sweep}/withdraw", status_code=204)
async def on_withdraw(bench: Bench, sweep: Id, cell: messages_errors.CellRef) -> None:
    """Withdraws the acceptance of a finding."""
    await bench.sweeps.withdraw(sweep, cell.error, cell.state)


@router.post("/sweeps/{sweep}/open", status_code=201)
async def on_open(bench: Bench, request: Request, sweep: Id, cell: messages_errors.OpenCell) -> wire.Instance:
    """A new PLC in this state with this error raised, paused: to look at what the sweep saw."""
    session = await bench.sweeps.open(sweep, cell.error, cell.state, cell.name.strip(), user_of(request).name)
    return translate.instance(session, await bench.projects.get(session.project_id))


@router.get("/sweeps/{before}/compare/{after}")
async def on_compare(bench: Bench, before: Id, after: Id) -> messages_errors.SweepComparison:
    """What became better or worse from one sweep to the next: of two versions, or of two models."""
    return translate_sweeps.comparison(await bench.sweeps.compare(before, after))
