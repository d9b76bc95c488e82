"""`scanbench export`: a project as a PLCopen file."""

from pathlib import Path

import typer

from scanbench.cli.inputs import read_sources, usage
from scanbench.syntax.plcopen.write import Form, write_project


def export_file(
    folder: Path = typer.Argument(metavar="DIR", help="The folder, file or zip file with the program."),
    file: Path = typer.Argument(metavar="FILE", help="The file to write; one that is there is not replaced."),
    form: Form = typer.Option(Form.TC6, "--form", help="tc6: PLCopen XML, TC6 2.01; iec61131-10: the file of IEC 61131-10, which Sysmac Studio and others take."),
) -> None:  # fmt: skip
    """Write a program as PLCopen XML, and tell what the format has no place for.

    Exit 0 when all of it is written, 1 when something is left out, 2 for wrong usage.
    """
    if file.exists():
        usage(f"{file} is there already: give a new name")
    made = write_project(folder.stem, read_sources([folder], libraries=False).texts, form)
    try:
        file.write_bytes(made.data)
    except OSError as error:
        usage(f"{file} cannot be written: {error.strerror}")
    for each in made.left_out:
        typer.echo(f"left out: {each}")
    raise typer.Exit(int(bool(made.left_out)))
