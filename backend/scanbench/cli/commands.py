"""All commands of `scanbench`. What a command needs is imported when it is the one that is called: that is most of the time it takes to start."""

from collections.abc import Iterator, Mapping
from importlib import import_module
from typing import cast

import typer
from typer.core import TyperCommand, TyperGroup

from scanbench import __version__
from scanbench.cli.junit_begun import begin_junit
from scanbench.garbage import without_collection

_Built = TyperCommand | TyperGroup
_MODULES = {
    "serve": "serve", "check": "check", "format": "format", "run": "run", "verify": "verify", "campaign": "campaign",
    "whatif": "whatif", "replay": "replay", "diff": "diff", "dap": "dap", "lsp": "lsp", "import": "import_file",
    "export": "export_file", "model": "model", "errors": "errors", "library": "library", "scenario": "scenario",
    "vscode": "vscode",
}  # fmt: skip
"""Of each command, in the order of the help: its module in this room, and what it is called there: a function, or an app with commands."""


class _Commands(Mapping[str, _Built]):
    """The commands, each made when it is asked for."""

    def __init__(self) -> None:
        self._built: dict[str, _Built] = {}

    def __getitem__(self, name: str) -> _Built:
        if name not in self._built:
            self._built[name] = _build(name, _MODULES[name])
        return self._built[name]

    def __iter__(self) -> Iterator[str]:
        return iter(_MODULES)

    def __len__(self) -> int:
        return len(_MODULES)


class _Group(TyperGroup):
    """The command itself."""

    def __init__(self, **given: object) -> None:
        super().__init__(**{**given, "commands": _Commands()})  # type: ignore[arg-type]

    def parse_args(self, ctx: object, args: list[str]) -> list[str]:
        """Before anything is refused."""
        begin_junit(args)
        return super().parse_args(cast(typer.Context, ctx), args)

    def list_commands(self, ctx: object) -> list[str]:
        """Their names: to know them is not to import them."""
        return [*self.commands]


def _build(name: str, module: str) -> _Built:
    holder = typer.Typer(rich_markup_mode=None, pretty_exceptions_enable=False)
    with without_collection():
        found = getattr(import_module(f"scanbench.cli.{module}"), module)
    if isinstance(found, typer.Typer):
        holder.add_typer(found, name=name)
    else:
        holder.command(name)(found)
    return cast(_Built, typer.main.get_group(holder).commands[name])


app = typer.Typer(
    cls=_Group,
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="A bench for debugging PLC programs (IEC 61131-3) on virtual PLCs of real models.",
)


@app.callback(invoke_without_command=True)
def version(show: bool = typer.Option(False, "--version", help="Print the version.")) -> None:
    """Options of the command itself."""
    if show:
        typer.echo(f"scanbench {__version__}")
        raise typer.Exit
