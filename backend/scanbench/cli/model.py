"""`scanbench model`: what is wrong with a model file, what is in it, and which models there are."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import typer

from scanbench.cli.inputs import usage
from scanbench.plcmodel.document import SCHEMA
from scanbench.plcmodel.load import NoModels, load_all, load_file, model_directory
from scanbench.plcmodel.model import Instruction, Model, ResetInstruction, WordRange

model = typer.Typer(
    no_args_is_help=True, rich_markup_mode=None, help="PLC models: check a model file, list the models."
)


@model.command("check")
def check(
    files: list[Path] = typer.Argument(metavar="FILE...", help="Model files (.xml), from anywhere."),
) -> None:
    """Check model files. Exit 0 when all are right, 1 with `file:line:column: code message` when not, 2 for wrong usage.

    The schema, and a model that a file is based on, come from the directory of the models, or from the file's own.
    """
    wrong = False
    for file in files:
        if not file.is_file():
            usage(f"{file} {'is a folder: name the model files in it' if file.is_dir() else 'does not exist'}")
        found, problems = load_file(file, _directory(file))
        for problem in problems:
            typer.echo(str(problem))
        wrong = wrong or found is None
        if found is not None:
            typer.echo("\n".join(summary(found)))
    raise typer.Exit(1 if wrong else 0)


@model.command("list")
def list_models() -> None:
    """List the models that the bench can use. Exit 1 when a file of the directory is wrong."""
    try:
        models, problems = load_all(model_directory())
    except NoModels as error:
        usage(str(error))
    rows = [("MODEL", "VENDOR", "ERRORS", "VERIFIED", "DESCRIPTION")]
    for each in sorted(models, key=lambda one: (one.vendor, one.name)):
        errors = list(each.errors())
        verified = sum(error.verified for error in errors)
        rows.append((each.name, each.vendor, str(len(errors)), str(verified), each.description))
    typer.echo("\n".join(_table(rows)))
    for problem in problems:
        typer.echo(str(problem), err=True)
    raise typer.Exit(1 if problems else 0)


def summary(model: Model) -> list[str]:
    """What is in a model, for people."""
    errors = list(model.errors())
    rows = [("AREA", "FIRST", "LAST", "PROGRAM", "TOOL", "ENGINE", "RETAINED")]
    for area in model.areas:
        for part in area.ranges:
            first, last = model.range_text(WordRange(area, part.first, part.last))
            rows.append((area.name, first, last, part.program, part.tool, part.engine, "yes" if area.retain else "no"))
    roles = Counter(special.role or "no role" for special in model.specials)
    severities = Counter(error.severity for error in errors)
    details = sum(len(error.details) for error in errors)
    facts = [area.verified for area in model.areas] + [error.verified for error in errors]
    made: list[Instruction | ResetInstruction] = [*model.instructions, *model.resets]
    facts += [special.verified for special in model.specials] + [each.verified for each in made]
    return [
        f"{model.name} ({model.vendor}): {model.description}",
        *_table(rows),
        f"specials      {len(model.specials)}: {', '.join(f'{count} {role}' for role, count in roles.items()) or 'none'}",
        f"instructions  {len(made)}: {', '.join(each.name for each in made) or 'none'}",
        f"errors        {len(errors)}: {severities['fatal']} fatal, {severities['nonfatal']} nonfatal, {details} details",
        f"verified      {sum(facts)} of {len(facts)} facts ({100 * sum(facts) // len(facts)} %)",
    ]


def _directory(file: Path) -> Path:
    """The directory of models that the file lies in, else the installed one."""
    parent = file.resolve().parent.parent
    if (parent / SCHEMA).is_file():
        return parent
    try:
        return model_directory()
    except NoModels as error:
        usage(str(error))


def _table(rows: Sequence[tuple[str, ...]]) -> list[str]:
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    return ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
