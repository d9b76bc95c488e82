"""The commands that people and tools give a PLC, by name: the WebSocket, REST, DAP and the command line all make them here."""

from collections.abc import Mapping
from dataclasses import dataclass

from scanbench.faults.absent import GenerateAbsent
from scanbench.faults.arm import Arm, Disarm
from scanbench.faults.clear import ClearErrorLog, ClearErrors
from scanbench.faults.disturb.disturb import Calm, Disturb
from scanbench.faults.inject import Generate, Recover
from scanbench.faults.line_faults import BreakLine, MendLine
from scanbench.runtime.clear_violations import ClearViolations
from scanbench.runtime.command import Command
from scanbench.runtime.forces import Force, Release
from scanbench.runtime.modes import SetMode
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from scanbench.typed import BadValue, make
from scanbench.wire.refused import Refused


@dataclass(frozen=True, slots=True)
class Known:
    """A command, and the fields that whoever gives it may give; the others are the PLC's own."""

    cls: type[Command]
    fields: tuple[str, ...]


COMMANDS: dict[str, Known] = {
    "write": Known(Write, ("path", "value", "site")),
    "force": Known(Force, ("path", "value", "site")),
    "release": Known(Release, ("path",)),
    "generate": Known(Generate, ("errors", "again", "anyway")),
    "generate_absent": Known(GenerateAbsent, ("errors",)),
    "recover": Known(Recover, ("ids",)),
    "arm": Known(Arm, ("wanted",)),
    "disarm": Known(Disarm, ("ids",)),
    "clear_errors": Known(ClearErrors, ("what",)),
    "clear_error_log": Known(ClearErrorLog, ()),
    "mode": Known(SetMode, ("mode",)),
    "restart": Known(Restart, ("kind",)),
    "clear_diagnostics": Known(ClearViolations, ()),
    "disturb": Known(Disturb, ("wanted",)),
    "calm": Known(Calm, ("ids",)),
    "break_line": Known(BreakLine, ("server", "fault")),
    "mend_line": Known(MendLine, ("server",)),
}


def read_command(name: str, given: Mapping[str, object], author: str) -> Command:
    """The command of this name; `given` are its fields as plain values. Of one that takes what is `wanted` they are that one's
    fields. `Refused` says what is wrong."""
    known = COMMANDS.get(name)
    if known is None:
        raise Refused(f"there is no command {name}; there are {', '.join(COMMANDS)}")
    fields = {"wanted": given} if known.fields == ("wanted",) else given
    unknown = next((each for each in fields if each not in known.fields), None)
    if unknown is not None:
        raise Refused(f"{unknown} is unknown; {name} has {', '.join(known.fields) or 'no fields'}")
    try:
        return make(known.cls, {"author": author, **fields})
    except BadValue as error:
        raise Refused(str(error)) from None
