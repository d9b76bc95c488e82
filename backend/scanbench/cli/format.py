"""`scanbench format`: the layout of program files."""

from pathlib import Path

import typer

from scanbench.check.build import program_files
from scanbench.cli.inputs import ARCHIVE, read_sources, usage
from scanbench.language.format import formatted
from scanbench.syntax.parse_file import is_exported, is_stimulus
from scanbench.syntax.scl import is_scl
from scanbench.syntax.source import encoded


def format(
    paths: list[Path] = typer.Argument(metavar="FILE|DIR...", help="Program files in text form; a folder gives all below it."),
    check: bool = typer.Option(False, help="Change nothing; name the files that would change, and exit with 1 if there are any."),
) -> None:  # fmt: skip
    """Lay program files out: indentation, blanks, aligned declarations, keywords in capitals. Comments and lines stay.

    Exit 0 when all is well, 1 with --check when a file would change, 2 for wrong usage or a file that cannot be read as a program.
    """
    packed = next((each for each in paths if each.suffix.lower() == ARCHIVE), None)
    if packed is not None:
        usage(f"{packed} is packed: unpack it, and format the folder")
    unread = changed = 0
    for name, text in program_files(read_sources(paths, libraries=False).texts).items():
        if is_stimulus(name) or is_exported(name, text) or is_scl(name):
            continue
        made = formatted(name, text)
        if made is None:
            unread += 1
            typer.echo(f"{name}: left as it is: it cannot be read, see scanbench check", err=True)
        elif made != text:
            changed += 1
            typer.echo(name)
            if not check:
                write(Path(name), made)
    raise typer.Exit(2 if unread else int(check and changed > 0))


def write(path: Path, text: str) -> None:
    """Replaces a file as a whole, in its encoding: half a program is worse than a badly laid out one."""
    beside = path.with_name(f".{path.name}.new")
    try:
        beside.write_bytes(encoded(text, path.read_bytes()))
        beside.chmod(path.stat().st_mode)
        beside.replace(path)
    except OSError as error:
        beside.unlink(missing_ok=True)
        usage(f"{path} cannot be written: {error.strerror}")
