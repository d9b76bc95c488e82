"""The commands (`wire/commands.py`) as a browser says them on the WebSocket, and a script in `POST /instances/{instance}/commands`."""

from typing import Annotated, Literal

from pydantic import Field, RootModel

from scanbench.faults.line_faults import LineFault, LineKind
from scanbench.web.messages import Mode, RestartKind
from scanbench.web.messages_base import Id, Wire
from scanbench.web.messages_errors import ArmFaults, ClearErrors, DisarmFaults, GenerateErrors, GenerateOne
from scanbench.web.messages_verify import NewDisturbance


class Numbered(Wire):
    """What is answered under a number."""

    ref: int = Field(default=0, description="on the WebSocket: comes back in `Done`; by REST it means nothing")


class WriteValue(Wire):
    """Write a variable or an address, with the rights of a tool."""

    path: str
    value: str = Field(description="as typed: TRUE, 42, 16#FF, T#5s, 1.5, 'text'")
    site: str = Field(
        default="", description="of an in-out: what this call (file:line) passes, instead of the last one"
    )


class Write(Numbered, WriteValue):
    """Writes a variable or an address, with the rights of a tool."""

    type: Literal["write"] = "write"


class Force(Numbered, WriteValue):
    """Holds it at the value until it is released."""

    type: Literal["force"] = "force"


class Release(Numbered):
    """Ends a force, or all."""

    type: Literal["release"] = "release"
    path: str | None = Field(description="null releases all")


class Generate(Numbered, GenerateErrors):
    """Raises errors, all between the same two scans, or none of them."""

    type: Literal["generate"] = "generate"


class GenerateAbsent(Numbered):
    """Raises those of the errors that are not present, all between the same two scans; the others stay as they are."""

    type: Literal["generate_absent"] = "generate_absent"
    errors: list[GenerateOne] = Field(min_length=1)


class Recover(Numbered):
    """Recovers errors that were raised."""

    type: Literal["recover"] = "recover"
    ids: list[str] | None = Field(
        description="all instances (`fal`), or one (`fal:number=5`); null recovers every error that is generated"
    )


class Arm(Numbered, ArmFaults):
    """Errors that begin later, or come and go."""

    type: Literal["arm"] = "arm"


class Disarm(Numbered, DisarmFaults):
    """Disarms faults; what they raised is recovered."""

    type: Literal["disarm"] = "disarm"


class Clear(Numbered, ClearErrors):
    """Clears errors as a tool does it on the device (FINS 2101)."""

    type: Literal["clear_errors"] = "clear_errors"


class ClearErrorLog(Numbered):
    """Empties the PLC's own error log, as a tool does it on the device (FINS 2103)."""

    type: Literal["clear_error_log"] = "clear_error_log"


class SetMode(Numbered):
    """Changes the mode. MONITOR and RUN are refused while a fatal error is present."""

    type: Literal["mode"] = "mode"
    mode: Mode


class Restart(Numbered):
    """Restarts the program, in every mode; afterwards it runs."""

    type: Literal["restart"] = "restart"
    kind: RestartKind


class ClearDiagnostics(Numbered):
    """Forgets the subrange violations that were counted."""

    type: Literal["clear_diagnostics"] = "clear_diagnostics"


class Disturb(Numbered, NewDisturbance):
    """Disturbs the PLC, now or later."""

    type: Literal["disturb"] = "disturb"


class Calm(Numbered):
    """Withdraws disturbances."""

    type: Literal["calm"] = "calm"
    ids: list[Id] | None = Field(default=None, description="null is all of them")


class BreakLine(Numbered):
    """Lets something be wrong with the line between a server of the communication unit and its clients."""

    type: Literal["break_line"] = "break_line"
    server: LineKind
    fault: LineFault


class MendLine(Numbered):
    """Nothing is wrong with a line any more."""

    type: Literal["mend_line"] = "mend_line"
    server: LineKind


Command = (
    Write
    | Force
    | Release
    | Generate
    | GenerateAbsent
    | Recover
    | Arm
    | Disarm
    | Clear
    | ClearErrorLog
    | SetMode
    | Restart
    | ClearDiagnostics
    | Disturb
    | Calm
    | BreakLine
    | MendLine
)


class PlcCommand(RootModel[Annotated[Command, Field(discriminator="type")]]):
    """A command by its `type`."""
