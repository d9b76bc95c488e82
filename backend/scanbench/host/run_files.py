"""Run files on this server, and what can be said of one that comes from elsewhere."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

from scanbench.plcmodel.model import Model
from scanbench.program.program import Program
from scanbench.recording.blocks import KeptProgram, about_of
from scanbench.recording.fingerprints import model_fingerprint
from scanbench.recording.format import RunFileError
from scanbench.recording.programs import Make, ProgramsOf, programs_of
from scanbench.recording.reader import RunReader, Unreadable, no_programs
from scanbench.recording.recording import DEFAULT_LIMIT
from scanbench.runtime.clock import fresh_token
from scanbench.wire.codec import ENTRIES, BadMessage, unpack
from scanbench.wire.host import Sources

RUN_SUFFIX = ".run"
_MIB = 1 << 20
ProgramOf = Callable[[Sources], Program]
"""Builds a program; `NoProgram` says why it cannot be built."""


def run_path(directory: Path, instance: int) -> Path:
    """The run file of an instance."""
    return directory / f"{instance}{RUN_SUFFIX}"


def fresh_path(directory: Path, purpose: str) -> Path:
    """A name that no file has, for a run that comes or goes."""
    return directory / f"{purpose}-{fresh_token()}{RUN_SUFFIX}"


def set_aside(path: Path) -> None:
    """Renames the run file before a new run begins; it replaces the one that was set aside before."""
    if path.exists():
        path.replace(path.with_name(f"{path.name}.previous"))


def bring_back(path: Path) -> None:
    """A run that could not begin leaves the one before it as it was."""
    previous = path.with_name(f"{path.name}.previous")
    if not path.exists() and previous.exists():
        previous.replace(path)


def sweep(directory: Path) -> None:
    """Removes what a server that was killed left half done."""
    for pattern in (f"export-*{RUN_SUFFIX}", f"import-*{RUN_SUFFIX}", "*.part"):
        for path in directory.glob(pattern):
            discard(path)


def discard(path: Path) -> None:
    """Removes a file, if it is there."""
    path.unlink(missing_ok=True)


def discard_all(directory: Path, instance: int) -> None:
    """Removes the run file of an instance, and what was kept aside of earlier ones."""
    for path in directory.glob(f"{instance}{RUN_SUFFIX}*"):
        discard(path)


def sources_of(path: Path, models: Mapping[str, Model]) -> Sources:
    """What the program that runs at the end of a run file is made of, numbered after every other in it; `Unreadable`
    when it is no run file, or cannot be used here."""
    return sources_and_damage(path, models)[0]


def sources_and_damage(path: Path, models: Mapping[str, Model]) -> tuple[Sources, str]:
    """The same, and what is damaged in the file."""
    with RunReader(path, no_programs, ENTRIES) as reader:
        reader.follow()
        recording = reader.recording
        model = models.get(recording.about.model)
        if model is None:
            raise Unreadable(f"there is no model {recording.about.model} here: the run was recorded on one")
        if model_fingerprint(model) != recording.about.model_fingerprint:
            raise Unreadable(
                f"the run was recorded with a different description of the model {model.name} than the one here"
            )
        with reader.reading():
            sources = sources_in(recording.programs[reader.versions()[-1]])
        return replace(sources, version=max(recording.programs)), recording.damage


def sources_in(kept: KeptProgram) -> Sources:
    """What a program in a run file was made of."""
    try:
        sources = unpack(kept.sources)
    except BadMessage as error:
        raise RunFileError(
            f"program version {kept.version} of the run file cannot be read: {error}. "
            "Open it with the version of scanbench that wrote it"
        ) from error
    if not isinstance(sources, Sources) or not _is_right(sources):
        raise RunFileError(f"program version {kept.version} of the run file has no sources")
    return sources


def created(path: Path) -> str:
    """When the run in this file was begun: another run of the same name has a different time. Empty where it cannot be read."""
    try:
        about = about_of(path)
    except (OSError, RunFileError):
        return ""
    return about.created if about is not None else ""


def texts_in(kept: KeptProgram) -> Mapping[str, str]:
    """Its source files, by name."""
    return sources_in(kept).files


def programs_by(program_of: ProgramOf, make: Make) -> ProgramsOf:
    """The programs of run files."""
    return programs_of(lambda kept: program_of(sources_in(kept)), make)


def _is_right(sources: Sources) -> bool:
    """The file may come from anywhere."""
    files: object = sources.files
    if not isinstance(files, dict):
        return False
    texts: list[object] = [sources.model, *files.keys(), *files.values()]
    numbers: list[object] = [sources.interval_ns, sources.version]
    return all(isinstance(each, str) for each in texts) and all(isinstance(each, int) and each > 0 for each in numbers)


def run_limit(mib: int | None) -> int:
    """The bound of a run file in bytes."""
    return DEFAULT_LIMIT if mib is None else mib * _MIB
