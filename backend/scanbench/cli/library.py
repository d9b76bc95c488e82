"""`scanbench library`: the libraries of vendors that Scanbench has, and their texts for a project."""

from pathlib import Path

import typer

from scanbench.check.libraries.catalogue import Library, catalogue, library_named
from scanbench.cli.inputs import usage
from scanbench.cli.outputs import write_text
from scanbench.syntax import tree

library = typer.Typer(
    no_args_is_help=True,
    rich_markup_mode=None,
    help="Libraries of vendors: which there are, what they declare, and their texts for a project.",
)


@library.command(name="list")
def list_() -> None:
    """Name every library, its dialects, how much it declares, and how much of that needs a device (stubs)."""
    width = max(len(each.name) for each in catalogue())
    for each in catalogue():
        pous = [one for one in each.declared if isinstance(one, tree.PouDeclaration)]
        types = len(each.declared) - len(pous)
        typer.echo(
            f"{each.name:{width}}  {', '.join(each.dialects):16}  {len(pous):3} POUs, {len(each.stubs):3} of them stubs, "
            f"{types:3} types"
        )


@library.command()
def show(
    name: str = typer.Argument(metavar="NAME", help="A library, as `scanbench library list` names it."),
    text: bool = typer.Option(False, help="Print the whole text instead."),
) -> None:
    """Say what a library is, and what it declares; a stub is marked."""
    found = _named(name)
    if text:
        typer.echo(found.text, nl=False)
        return
    typer.echo(f"{found.about} From {found.source}")
    for each in found.declared:
        kind = "type" if isinstance(each, tree.TypeDeclaration) else each.kind.replace("_", " ")
        stub = "  stub" if each.name in found.stubs else ""
        typer.echo(f"  {kind:14}  {each.name}{stub}")


@library.command()
def add(
    name: str = typer.Argument(metavar="NAME", help="A library, as `scanbench library list` names it."),
    folder: Path = typer.Argument(Path(), metavar="DIR", help="The folder of the project."),
) -> None:
    """Write the text of a library into a project, as libraries/NAME.st. A file that is there already is kept."""
    found = _named(name)
    if not folder.is_dir():
        usage(f"{folder} is no folder")
    path = folder / found.path
    if path.exists():
        usage(f"{path} is there already: remove it first, if what is changed in it is not needed")
    try:
        path.parent.mkdir(exist_ok=True)
    except OSError as error:
        usage(f"{path.parent} cannot be made: {error.strerror}")
    write_text(path, found.text)
    typer.echo(str(path))


def _named(name: str) -> Library:
    found = library_named(name)
    if found is None:
        names = ", ".join(each.name for each in catalogue())
        usage(f"there is no library {name}: there are {names}")
    return found
