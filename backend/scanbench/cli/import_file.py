"""`scanbench import`: the program files of a PLCopen or L5X file."""

from pathlib import Path

import typer

from scanbench.cli.inputs import usage
from scanbench.server.foreign_archive import notes, read_foreign, summary
from scanbench.wire.refused import Refused


def import_file(
    file: Path = typer.Argument(
        metavar="FILE", help="A PLCopen file (TC6 XML 1.01, 2.0 or 2.01, or IEC 61131-10), or one of Studio 5000 (L5X)."
    ),
    folder: Path = typer.Argument(metavar="DIR", help="The folder for the program files; made where it is missing."),
) -> None:
    """Write the POUs of a file of another tool as text, and tell what could not be kept as it was.

    No file is replaced. Exit 0 when all of it is kept, 1 when something is not as it was, 2 for wrong usage or a file that cannot be read.
    """
    try:
        made = read_foreign(file.read_bytes())
    except (OSError, Refused) as error:
        usage(f"{file}: {error}")
    there = [name for name in made.files if (folder / name).exists()]
    if there:
        usage(f"{folder} has {', '.join(there[:3])} already: give an empty folder")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in made.files.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(text, "utf-8")
    except OSError as error:
        usage(f"{folder} cannot be written: {error.strerror}")
    whole, changed, refused = summary(made.pous)
    for note in notes(made):
        typer.echo(note)
    typer.echo(f"{len(made.files)} files. POUs: {whole} as they were, {changed} nearly, {refused} without their body.")
    raise typer.Exit(int(changed + refused > 0))
