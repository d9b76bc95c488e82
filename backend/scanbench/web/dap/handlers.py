"""Which request is served by what. Those that begin and end a session are in `conversation.py`."""

from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass
from typing import Generic, TypeVar

from scanbench.web.dap import breakpoints, run, shapes, sources, values
from scanbench.web.dap.debuggee import Debuggee
from scanbench.web.dap.shapes import Args, Body

A = TypeVar("A", bound=Args)


@dataclass(frozen=True, slots=True)
class Handler(Generic[A]):
    """A request's arguments, and what answers it."""

    arguments: type[A]
    serve: Callable[[Debuggee, A], Awaitable[Body]]
    moves: bool = False
    """It makes the PLC go on: what it does then is told after the response."""

    async def __call__(self, plc: Debuggee, arguments: Body) -> Body:
        """The body of the response; pydantic's error for arguments that are wrong."""
        return await self.serve(plc, self.arguments.model_validate(arguments))


HANDLERS: Mapping[str, Handler] = {  # type: ignore[type-arg]  # each has arguments of its own
    "threads": Handler(shapes.Nothing, values.on_threads),
    "stackTrace": Handler(shapes.StackTrace, values.on_stack_trace),
    "scopes": Handler(shapes.Scopes, values.on_scopes),
    "variables": Handler(shapes.Variables, values.on_variables),
    "evaluate": Handler(shapes.Evaluate, values.on_evaluate),
    "setVariable": Handler(shapes.SetVariable, values.on_set_variable),
    "setExpression": Handler(shapes.SetExpression, values.on_set_expression),
    "completions": Handler(shapes.Completions, values.on_completions),
    "exceptionInfo": Handler(shapes.ExceptionInfo, values.on_exception_info),
    "dataBreakpointInfo": Handler(shapes.DataBreakpointInfo, values.on_data_breakpoint_info),
    "loadedSources": Handler(shapes.Nothing, sources.on_loaded_sources),
    "source": Handler(shapes.SourceText, sources.on_source),
    "breakpointLocations": Handler(shapes.BreakpointLocations, breakpoints.on_breakpoint_locations),
    "setBreakpoints": Handler(shapes.SetBreakpoints, breakpoints.on_set_breakpoints),
    "setFunctionBreakpoints": Handler(shapes.SetFunctionBreakpoints, breakpoints.on_set_function_breakpoints),
    "setDataBreakpoints": Handler(shapes.SetDataBreakpoints, breakpoints.on_set_data_breakpoints),
    "setExceptionBreakpoints": Handler(shapes.SetExceptionBreakpoints, breakpoints.on_set_exception_breakpoints),
    "continue": Handler(shapes.Nothing, run.on_continue, moves=True),
    "pause": Handler(shapes.Nothing, run.on_pause, moves=True),
    "next": Handler(shapes.Nothing, run.on_next, moves=True),
    "stepIn": Handler(shapes.Nothing, run.on_step_in, moves=True),
    "stepOut": Handler(shapes.Nothing, run.on_step_out, moves=True),
    "stepBack": Handler(shapes.Nothing, run.on_step_back, moves=True),
    "reverseContinue": Handler(shapes.Nothing, run.on_reverse_continue, moves=True),
    "scanbench/setBreakpoint": Handler(shapes.SetBreakpoint, breakpoints.on_set_breakpoint),
    "scanbench/removeBreakpoints": Handler(shapes.RemoveBreakpoints, breakpoints.on_remove_breakpoints),
    "scanbench/enableBreakpoints": Handler(shapes.EnableBreakpoints, breakpoints.on_enable_breakpoints),
    "scanbench/runTo": Handler(shapes.RunTo, run.on_run_to, moves=True),
    "scanbench/reverseTo": Handler(shapes.Path, run.on_reverse_to, moves=True),
    "scanbench/step": Handler(shapes.Step, run.on_step, moves=True),
    "scanbench/singleScan": Handler(shapes.Nothing, run.on_single_scan, moves=True),
    "scanbench/force": Handler(shapes.Force, run.on_force),
    "scanbench/release": Handler(shapes.Release, run.on_release),
    "scanbench/raise": Handler(shapes.Raise, run.on_raise),
    "scanbench/inOutBinding": Handler(shapes.Path, run.on_in_out_binding),
    "scanbench/coverage": Handler(shapes.Coverage, run.on_coverage),
}

CAPABILITIES: Body = {
    "supportsConfigurationDoneRequest": True,
    "supportsFunctionBreakpoints": True,
    "supportsConditionalBreakpoints": True,
    "supportsHitConditionalBreakpoints": True,
    "supportsLogPoints": True,
    "supportsDataBreakpoints": True,
    "supportsBreakpointLocationsRequest": True,
    "supportsEvaluateForHovers": True,
    "supportsStepBack": True,
    "supportsSetVariable": True,
    "supportsSetExpression": True,
    "supportsCompletionsRequest": True,
    "completionTriggerCharacters": ["."],
    "supportsLoadedSourcesRequest": True,
    "supportsExceptionInfoRequest": True,
    "supportsExceptionFilterOptions": True,
    "supportsDelayedStackTraceLoading": True,
    "supportsTerminateRequest": True,
    "supportsRestartRequest": True,
    "supportTerminateDebuggee": False,
    "supportsCancelRequest": True,
    "exceptionBreakpointFilters": [
        {
            "filter": "trap", "label": "Traps", "default": True,
            "description": "The program did what no PLC survives: an index out of bounds, a division by zero, an endless loop.",
            "supportsCondition": True, "conditionDescription": "a BOOL expression over instance paths",
        },
        {
            "filter": "violation", "label": "Subrange violations", "default": False,
            "description": "A value left the subrange of its type.",
            "supportsCondition": True, "conditionDescription": "a BOOL expression over instance paths",
        },
        {
            "filter": "error", "label": "Errors raised", "default": False,
            "description": "An error of the model was raised.",
            "supportsCondition": True, "conditionDescription": "errors by id, with commas between; empty: any",
        },
    ],
}  # fmt: skip
