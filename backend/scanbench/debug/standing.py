"""Where a PLC is halted, for people: statement, instance and task."""

from scanbench.debug.halt import Halt
from scanbench.debug.listener import Found
from scanbench.debug.placed import Placing
from scanbench.runtime.resource import Resource
from scanbench.symbols.symbols import instance_at


def halt_of(resource: Resource, placing: Placing, found: Found, number: int, past: bool) -> Halt:
    """The halt of a resource as it stands now."""
    scan, inside = resource.header.scan, resource.listening.inside
    if inside is None or not inside.frames:
        return Halt(
            number, found.reason, found.text, found.by, found.breakpoints, scan, 0, None, "", "", "", past
        )  # fmt: skip
    frame, root = inside.frames[0], inside.frames[-1]
    span = placing.sites.statements[frame.site].span
    instance = instance_at(resource.program, frame.instance, frame.pou.name) if frame.instance else ""
    task = placing.task_of.get(root.instance, "")
    return Halt(
        number, found.reason, found.text, found.by, found.breakpoints, scan, inside.count, span, frame.pou.name, instance,
        task, past,
    )  # fmt: skip
