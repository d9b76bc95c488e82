"""Breakpoints of all kinds: DAP's lists, and one at a time as browsers set them."""

from collections.abc import Sequence
from dataclasses import replace

from scanbench.debug.breakpoint import Breakpoint, BreakpointKind, DataAccess, Verdict
from scanbench.web.dap import shapes
from scanbench.web.dap.debuggee import Debuggee
from scanbench.web.dap.shapes import Body
from scanbench.wire import debugging as host
from scanbench.wire.refused import Refused

_ALL_LINES = 1 << 30
_ACCESS: dict[str, DataAccess] = {"read": "read", "write": "change", "readWrite": "access"}
"""`write` is what clients offer as "break on value change"."""
FILTERS: dict[str, BreakpointKind] = {"trap": "trap", "violation": "violation", "error": "error"}


# ---- of lines ------------------------------------------------------------------------------------------------------


async def on_set_breakpoints(plc: Debuggee, args: shapes.SetBreakpoints) -> Body:
    """All breakpoints of a file."""
    wanted = args.breakpoints or [shapes.SourceBreakpoint(line=line) for line in args.lines or ()]
    try:
        file = plc.paths.file(args.source)
    except Refused as error:
        return {"breakpoints": [{"verified": False, "message": str(error)} for _ in wanted]}
    made = [_line(plc, file, each) for each in wanted]
    functions = plc.functions.get(file, [])
    verdicts = await plc.session.debugging.set_breakpoints(plc.group, "line", file, [*made, *functions])
    return {"breakpoints": [tell(plc, each) for each in verdicts[: len(made)]]}


def _line(plc: Debuggee, file: str, wanted: shapes.SourceBreakpoint) -> Breakpoint:
    extra = wanted.scanbench
    return Breakpoint(
        0, "line", plc.author, plc.group, extra.enabled, file, plc.line_in(wanted.line), plc.column_in(wanted.column),
        condition=wanted.condition, hits=wanted.hit_condition, log=wanted.log_message or extra.log,
        assign=extra.assign, instance=extra.instance, task=extra.task,
    )  # fmt: skip


async def on_set_function_breakpoints(plc: Debuggee, args: shapes.SetFunctionBreakpoints) -> Body:
    """At the first statement of POUs, by name."""
    places = await _first_statements(plc)
    wanted: dict[str, list[Breakpoint]] = {}
    asked: list[tuple[str, int] | str] = []
    for each in args.breakpoints:
        found = places.get(each.name.strip().casefold())
        if found is None:
            asked.append(each.name)
            continue
        file, place = found
        line = shapes.SourceBreakpoint(
            line=place.line - (not plc.client.lines_start_at1),
            condition=each.condition, hit_condition=each.hit_condition, scanbench=each.scanbench,
        )  # fmt: skip
        of_file = wanted.setdefault(file, [])
        asked.append((file, len(of_file)))
        of_file.append(replace(_line(plc, file, line), column=place.column))
    verdicts: dict[str, tuple[Verdict, ...]] = {}
    for file in wanted.keys() | plc.functions.keys():
        verdicts[file] = await _set_functions(plc, file, wanted.get(file, []))
    return {"breakpoints": [_function(plc, each, verdicts, places) for each in asked]}


async def _set_functions(plc: Debuggee, file: str, wanted: Sequence[Breakpoint]) -> tuple[Verdict, ...]:
    """Those of a file in place of earlier ones; the file's other breakpoints stay. A halt may come before the answer, at those
    that go as well: what is a function breakpoint is known by then."""
    gone = plc.functions.pop(file, [])
    ids = {each.id for each in gone}
    others = [each for each in _group(plc) if each.kind == "line" and each.file == file and each.id not in ids]
    debugging = plc.session.debugging
    named = debugging.named(plc.group, "line", file, [*others, *wanted])
    if wanted:
        plc.functions[file] = named[len(others) :]
    plc.leaving += gone
    try:
        return (await debugging.set_breakpoints(plc.group, "line", file, named))[len(others) :]
    finally:
        plc.leaving = [each for each in plc.leaving if each not in gone]


def _function(
    plc: Debuggee, asked: tuple[str, int] | str, verdicts: dict[str, tuple[Verdict, ...]],
    places: dict[str, tuple[str, host.PlaceInfo]],
) -> Body:  # fmt: skip
    if isinstance(asked, tuple):
        file, number = asked
        return tell(plc, verdicts[file][number])
    names = ", ".join(sorted(place.pou for _, place in places.values())[:20])
    return {"verified": False, "message": f"there is no POU {asked} with a statement; there are {names or 'none'}"}


async def _first_statements(plc: Debuggee) -> dict[str, tuple[str, host.PlaceInfo]]:
    """POU in small letters -> the file and place of its first statement."""
    found: dict[str, tuple[str, host.PlaceInfo]] = {}
    for file in plc.session.instance.sources.files:
        for place in await _places(plc, file, 1, _ALL_LINES):
            found.setdefault(place.pou.casefold(), (file, place))
    return found


async def _places(plc: Debuggee, file: str, first: int, last: int) -> tuple[host.PlaceInfo, ...]:
    return (await plc.ask(host.Places, lambda ref: host.WantPlaces(ref, file, first, last))).places


async def on_breakpoint_locations(plc: Debuggee, args: shapes.BreakpointLocations) -> Body:
    """Where breakpoints can be."""
    file = plc.paths.file(args.source)
    first = plc.line_in(args.line)
    last = first if args.end_line is None else plc.line_in(args.end_line)
    found = await _places(plc, file, first, last)
    return {"breakpoints": [plc.span(each.line, each.column, each.end_line, each.end_column) for each in found]}


# ---- of data and of what goes wrong --------------------------------------------------------------------------------


async def on_set_data_breakpoints(plc: Debuggee, args: shapes.SetDataBreakpoints) -> Body:
    """All breakpoints at data."""
    made = [_data(plc, each) for each in args.breakpoints]
    verdicts = await plc.session.debugging.set_breakpoints(plc.group, "data", None, made)
    return {"breakpoints": [tell(plc, each) for each in verdicts]}


def _data(plc: Debuggee, wanted: shapes.DataBreakpoint) -> Breakpoint:
    extra = wanted.scanbench
    return Breakpoint(
        0, "data", plc.author, plc.group, extra.enabled, path=wanted.data_id,
        access=extra.access or _ACCESS[wanted.access_type], condition=wanted.condition, hits=wanted.hit_condition,
        log=extra.log, assign=extra.assign, instance=extra.instance, task=extra.task,
    )  # fmt: skip


async def on_set_exception_breakpoints(plc: Debuggee, args: shapes.SetExceptionBreakpoints) -> Body:
    """Traps, subrange violations, errors raised: of errors, the condition names which."""
    options = [*(shapes.FilterOptions(filter_id=each) for each in args.filters), *args.filter_options]
    wanted: dict[BreakpointKind, list[Breakpoint]] = {kind: [] for kind in FILTERS.values()}
    asked: list[tuple[BreakpointKind, int]] = []
    for each in options:
        kind = FILTERS.get(each.filter_id)
        if kind is None:
            raise Refused(f"there is no filter {each.filter_id}; there are {', '.join(FILTERS)}", tuple(FILTERS))
        condition = each.condition.strip()
        made = Breakpoint(0, kind, plc.author, plc.group)
        made = replace(made, error=condition) if kind == "error" else replace(made, condition=condition)
        asked.append((kind, len(wanted[kind])))
        wanted[kind].append(made)
    verdicts = {
        kind: await plc.session.debugging.set_breakpoints(plc.group, kind, None, made) for kind, made in wanted.items()
    }
    return {"breakpoints": [tell(plc, verdicts[kind][number]) for kind, number in asked]}


# ---- one at a time, so that those who share a list do not undo each other's ----------------------------------------


async def on_set_breakpoint(plc: Debuggee, args: shapes.SetBreakpoint) -> Body:
    """Adds one to the list, or changes it whole."""
    wanted = args.breakpoint
    file, line = "", 0
    if wanted.kind == "line":
        if wanted.source is None:
            raise Refused("a line breakpoint wants a source and a line")
        file, line = plc.paths.file(wanted.source), plc.line_in(wanted.line)
    made = Breakpoint(
        wanted.id or 0, wanted.kind, plc.author, plc.group, wanted.enabled, file, line, plc.column_in(wanted.column),
        wanted.path, wanted.access, wanted.error, wanted.scan, wanted.condition, wanted.hits, wanted.log,
        wanted.assign, wanted.instance, wanted.task,
    )  # fmt: skip
    if wanted.id:
        before = _of_group(plc, [wanted.id])[0]
        if (before.kind, before.file) != (made.kind, made.file):  # the lists that are replaced are others
            await _replace(plc, before, [])
            made = replace(made, id=0)
    verdict = (await _replace(plc, made, [made]))[-1]
    return {"breakpoint": tell(plc, verdict)}


async def _replace(plc: Debuggee, like: Breakpoint, wanted: Sequence[Breakpoint]) -> tuple[Verdict, ...]:
    """Those of the kind and file of `like` without that one, and these."""
    file = like.file if like.kind == "line" else None
    others = [
        each for each in _group(plc) if each.kind == like.kind and file in (None, each.file) and each.id != like.id
    ]
    return await plc.session.debugging.set_breakpoints(plc.group, like.kind, file, [*others, *wanted])


async def on_remove_breakpoints(plc: Debuggee, args: shapes.RemoveBreakpoints) -> Body:
    """These of the list, or all."""
    if args.ids is None:
        gone = _group(plc)
        await plc.session.debugging.set_breakpoints(plc.group, None, None, ())
    else:
        gone = _of_group(plc, args.ids)
        kept = [each for each in _group(plc) if each.id not in args.ids]
        await plc.session.debugging.set_breakpoints(plc.group, None, None, kept)
    for each in gone:
        plc.known.pop(each.id, None)
    return {"removed": len(gone)}


async def on_enable_breakpoints(plc: Debuggee, args: shapes.EnableBreakpoints) -> Body:
    """Switches these, or all, on or off."""
    chosen = {each.id for each in (_group(plc) if args.ids is None else _of_group(plc, args.ids))}
    wanted = [replace(each, enabled=args.enabled) if each.id in chosen else each for each in _group(plc)]
    changed = sum(now != before for now, before in zip(wanted, _group(plc), strict=True))
    await plc.session.debugging.set_breakpoints(plc.group, None, None, wanted)
    return {"changed": changed}


def _group(plc: Debuggee) -> list[Breakpoint]:
    return [each.breakpoint for each in plc.session.debugging.verdicts if each.breakpoint.group == plc.group]


def _of_group(plc: Debuggee, ids: Sequence[int]) -> list[Breakpoint]:
    found = {each.id: each for each in _group(plc)}
    for id in ids:
        if id not in found:
            raise Refused(f"there is no breakpoint {id} in this list: somebody removed it, perhaps")
    return [found[id] for id in ids]


# ---- what became of them -------------------------------------------------------------------------------------------


def tell(plc: Debuggee, verdict: Verdict) -> Body:
    """A breakpoint for the client, which knows it from now on."""
    body = described(plc, verdict)
    plc.known[verdict.breakpoint.id] = body
    return body | {"scanbench": {"hits": verdict.hits, "enabled": verdict.breakpoint.enabled}}


def described(plc: Debuggee, verdict: Verdict) -> Body:
    """A breakpoint as DAP has it."""
    one = verdict.breakpoint
    body: Body = {"id": one.id, "verified": verdict.verified}
    if verdict.message:
        body["message"] = verdict.message
    if one.file:
        body["source"] = plc.paths.source(one.file)
        place = plc.span(verdict.line, verdict.column, verdict.end_line, verdict.end_column) if verdict.line else None
        body |= place or plc.span(one.line, one.column)
    return body
