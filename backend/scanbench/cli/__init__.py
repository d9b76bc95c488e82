"""`scanbench`: the command line."""

import typer

from scanbench import __version__
from scanbench.cli.bench import bench
from scanbench.cli.check import check
from scanbench.cli.run import run
from scanbench.cli.serve import serve

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    help="A bench for debugging PLC programs (IEC 61131-3) on virtual PLCs of real models.",
)
for command in (serve, check, run, bench):
    app.command()(command)


@app.callback(invoke_without_command=True)
def version(show: bool = typer.Option(False, "--version", help="Print the version.")) -> None:
    """Options of the command itself."""
    if show:
        typer.echo(f"scanbench {__version__}")
        raise typer.Exit


def main() -> None:
    """Entry point of the installed command."""
    app()
