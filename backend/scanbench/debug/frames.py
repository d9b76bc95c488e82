"""The call stack: open calls as people name them."""

from scanbench.debug.scene import Scene
from scanbench.debug.shown import FrameInfo
from scanbench.engines.debug import Frame
from scanbench.program.program import Program
from scanbench.program.types import Record
from scanbench.symbols.instances import owner_of
from scanbench.symbols.names import names_of


def stack(scene: Scene) -> tuple[FrameInfo, ...]:
    """All frames, innermost first."""
    task = task_of(scene.program, scene.frames)
    made = []
    for index, frame in enumerate(scene.frames):
        span = scene.sites.statements[frame.site].span
        made.append(
            FrameInfo(
                index=index,
                name=frame_name(scene.program, frame),
                pou=frame.pou.name,
                instance=instance_path(scene.program, frame),
                task=task,
                file=span.file,
                line=span.line,
                column=span.column,
                end_line=span.end_line,
                end_column=span.end_column,
            )
        )
    return tuple(made)


def frame_record(frame: Frame) -> Record | None:
    """The variables of the instance that runs; None in a FUNCTION."""
    return owner_of(frame.pou)


def instance_path(program: Program, frame: Frame) -> str:
    """`Main.line.station`; empty in a FUNCTION."""
    record = frame_record(frame)
    return "" if record is None else names_of(program).instance(frame.instance, record.name)


def frame_name(program: Program, frame: Frame) -> str:
    """`Main.line.station (Station)`, with the method that runs after the path; of a FUNCTION its name."""
    path, record = instance_path(program, frame), frame_record(frame)
    if record is None:
        return frame.pou.name
    if frame.pou.kind == "function":
        return f"{path}.{frame.pou.name.removeprefix(f'{record.name}.')} ({record.name})"
    return path if path == frame.pou.name else f"{path} ({frame.pou.name})"


def task_of(program: Program, frames: tuple[Frame, ...]) -> str:
    """The task that runs, by the outermost frame."""
    if not frames:
        return ""
    root = frames[-1]
    for task in program.tasks:
        if any(each.pou is root.pou and each.offset == root.instance for each in task.programs):
            return task.name
    return ""
