"""All commands of `scanbench`."""

import typer

from scanbench import __version__
from scanbench.cli.campaign import campaign
from scanbench.cli.check import check
from scanbench.cli.dap import dap
from scanbench.cli.device import clear, log, present
from scanbench.cli.diff import diff
from scanbench.cli.errors import errors
from scanbench.cli.export_file import export_file
from scanbench.cli.format import format
from scanbench.cli.import_file import import_file
from scanbench.cli.library import library
from scanbench.cli.lsp import lsp
from scanbench.cli.model import model
from scanbench.cli.replay import replay
from scanbench.cli.run import run
from scanbench.cli.scenario import scenario
from scanbench.cli.serve import serve
from scanbench.cli.verify import verify
from scanbench.cli.vscode import vscode
from scanbench.cli.whatif import whatif

app = typer.Typer(
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="A bench for debugging PLC programs (IEC 61131-3) on virtual PLCs of real models.",
)
for command in (serve, check, format, run, verify, campaign, whatif, replay, diff, dap, lsp):
    app.command()(command)
app.command("import")(import_file)
app.command("export")(export_file)
for command in (present, log, clear):
    errors.command()(command)
app.add_typer(model, name="model")
app.add_typer(errors, name="errors")
app.add_typer(library, name="library")
app.add_typer(scenario, name="scenario")
app.add_typer(vscode, name="vscode")


@app.callback(invoke_without_command=True)
def version(show: bool = typer.Option(False, "--version", help="Print the version.")) -> None:
    """Options of the command itself."""
    if show:
        typer.echo(f"scanbench {__version__}")
        raise typer.Exit
