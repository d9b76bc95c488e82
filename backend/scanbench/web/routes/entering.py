"""A command that came by REST: made by its name, entered through the one door, and what became of it."""

from collections.abc import Mapping

from fastapi import Request

from scanbench.server.workbench import Workbench
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Wire
from scanbench.web.messages_errors import CommandResult
from scanbench.web.translate_errors import command_result
from scanbench.wire.commands import read_command


async def entered(
    bench: Workbench, request: Request, instance: int, name: str, given: Wire | Mapping[str, object]
) -> CommandResult:
    """`given` has the fields of the command (`wire/commands.py`); `Refused` says why it was not taken."""
    fields = given.model_dump() if isinstance(given, Wire) else given
    command = read_command(name, fields, user_of(request).name)
    return command_result(await bench.session(instance).submit(command))
