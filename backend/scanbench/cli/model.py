"""`scanbench model`: what is wrong with a model file, what is in it, its facts with their sources, and which models there are."""

import json
from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

import typer

from scanbench.cli.inputs import usage
from scanbench.plcmodel.document import SCHEMA
from scanbench.plcmodel.facts import Fact, share
from scanbench.plcmodel.load import NoModels, NoSuchModel, load_all, load_file, model_directory, model_named
from scanbench.plcmodel.model import (
    Instruction,
    MessageInstruction,
    Model,
    QueryInstruction,
    ResetInstruction,
    WordRange,
)

_WIDEST = 40
"""Characters of a value in the table of facts."""
model = typer.Typer(
    no_args_is_help=True,
    rich_markup_mode=None,
    help="PLC models: check a model file, list the models, and their facts with sources.",
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
    rows = [("MODEL", "VENDOR", "ERRORS", "FACTS", "VERIFIED", "DESCRIPTION")]
    for each in sorted(models, key=lambda one: (one.vendor, one.name)):
        verified, facts = share(each.facts)
        percent = f"{100 * verified // max(facts, 1)} %"
        rows.append((each.name, each.vendor, str(len(list(each.errors()))), str(facts), percent, each.description))
    typer.echo("\n".join(_table(rows)))
    for problem in problems:
        typer.echo(str(problem), err=True)
    raise typer.Exit(1 if problems else 0)


@model.command("facts")
def facts(
    name: str = typer.Argument(metavar="MODEL", help="The name of a model, or a model file (.xml)."),
    error: str | None = typer.Option(None, metavar="ID", help="Only the facts of this error."),
    unverified: bool = typer.Option(False, "--unverified", help="Only what nobody has looked up."),
    as_json: bool = typer.Option(False, "--json", help="Print one JSON object."),
) -> None:
    """Every fact that a model states about the device: where it comes from, and whether it was looked up on a page.

    A source in brackets is that of the whole element: the fact has none of its own.
    """
    found = _model(name)
    if error is not None and found.error(error) is None:
        usage(f"{found.name} has no error {error}")
    verified, count = share(found.facts)
    shown = [fact for fact in found.facts if error is None or (fact.kind, fact.subject) == ("error", error)]
    shown = [fact for fact in shown if not (unverified and fact.verified)]
    if as_json:
        head = {"model": found.name, "facts": count, "verified": verified}
        typer.echo(json.dumps({**head, "list": [asdict(fact) for fact in shown]}, ensure_ascii=False, indent=2))
        return
    rows = [("WHAT", "FACT", "VALUE", "VERIFIED", "SOURCE"), *map(_fact_row, shown)]
    typer.echo("\n".join(_table(rows)))
    typer.echo(f"{found.name}: {verified} of {count} facts verified ({100 * verified // max(count, 1)} %)")


def _fact_row(fact: Fact) -> tuple[str, ...]:
    source = f"({fact.source or 'none'})" if fact.inherited else fact.source
    value = fact.value if len(fact.value) <= _WIDEST else f"{fact.value[: _WIDEST - 3]}..."
    return f"{fact.kind} {fact.subject}", fact.of, value, "yes" if fact.verified else "no", source


def _model(name: str) -> Model:
    path = Path(name)
    if path.suffix == ".xml":
        if not path.is_file():
            usage(f"{name} does not exist")
        found, problems = load_file(path, _directory(path))
        if found is None:
            usage("\n".join(map(str, problems)))
        return found
    try:
        return model_named(name)
    except (NoModels, NoSuchModel) as error:
        usage(str(error))


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
    raising = [each for each in model.instructions if not each.part]
    made: list[Instruction | ResetInstruction | QueryInstruction | MessageInstruction] = [
        *raising, *model.resets, *model.queries, *model.messages,
    ]  # fmt: skip
    verified, count = share(model.facts)
    return [
        f"{model.name} ({model.vendor}): {model.description}",
        *_table(rows),
        f"specials      {len(model.specials)}: {', '.join(f'{count} {role}' for role, count in roles.items()) or 'none'}",
        f"instructions  {len(made)}: {', '.join(each.name for each in made) or 'none'}",
        f"errors        {len(errors)}: {severities['fatal']} fatal, {severities['nonfatal']} nonfatal, {details} details",
        f"verified      {verified} of {count} facts ({100 * verified // max(count, 1)} %)",
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
