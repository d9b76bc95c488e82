"""`scanbench vscode`: the extension for Visual Studio Code, which a wheel brings and a checkout packs."""

import shutil
import subprocess
import sys
from pathlib import Path

import typer

from scanbench.cli.inputs import usage
from scanbench.cli.vsix import NAME, pack

vscode = typer.Typer(no_args_is_help=True, rich_markup_mode=None, help="The extension for Visual Studio Code.")


@vscode.callback()
def group() -> None:
    """Keeps the name of its one command."""


@vscode.command()
def install(
    code: str = typer.Option("code", metavar="COMMAND", help="VS Code's own command; also code-insiders, codium."),
) -> None:
    """Install the extension, or say where its file is if VS Code's command is not on the PATH."""
    path = extension()
    found = shutil.which(code)
    if found is None:
        usage(
            f"there is no command {code} on the PATH. In VS Code choose Extensions: Install from VSIX..., and the file {path}"
        )
    done = subprocess.run([found, "--install-extension", str(path), "--force"], check=False)
    if done.returncode:
        usage(f"{code} could not install {path} (exit code {done.returncode})")
    if shutil.which("scanbench") is None:
        command = Path(sys.executable).with_name("scanbench")
        typer.echo(f"scanbench is not on the PATH: set scanbench.command in VS Code to {command}", err=True)


def extension() -> Path:
    """The file that a wheel brings; in a checkout it is packed first."""
    here = Path(__file__).resolve()
    brought = here.parents[1] / "share" / NAME
    folder = here.parents[3] / "vscode"
    if brought.is_file():
        return brought
    if not (folder / "package.json").is_file():
        usage(f"this installation has no extension for VS Code: {brought} is missing")
    path = folder / NAME
    try:
        path.write_bytes(pack(folder))
    except OSError as error:
        usage(f"the extension cannot be packed: {path}: {error.strerror}")
    return path
