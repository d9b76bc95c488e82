"""`scanbench bench`: how fast the native engine is, as a ratio to C compiled in the same run, and what builds take."""

import json
import subprocess
import sys
from typing import TYPE_CHECKING

import typer

from scanbench.cli.inputs import usage

if TYPE_CHECKING:
    from scanbench.bench.run import Result

SUBJECTS = ("instances", "pace", "goto", "watch", "debugging", "trace", "verify")
BUILDING = (
    ("cold", "text to first scan, cold", "ms"),
    ("cached", "text to first scan, from the disk cache", "ms"),
    ("optimised_behind", "until optimised code has taken over", "ms"),
    ("pou_changed", "one POU changed, to running again", "ms"),
    ("keystroke_in_body", "problems after a keystroke in a body", "ms"),
    ("keystroke_in_declaration", "problems after a keystroke in a declaration", "ms"),
    ("host_mb", "peak memory of the host and its worker", "MB"),
    ("checker_mb", "peak memory of the checker", "MB"),
)


def bench(
    context: typer.Context,
    programs: list[str] | None = typer.Argument(
        None, metavar="[PROGRAM|SUBJECT]...", help="Names of programs, all when none is given; or one subject."
    ),
    as_json: bool = typer.Option(False, "--json", help="Print one JSON object."),
) -> None:
    """Measure the bench programs: ns per scan, ratio to hand-written C (gcc -O3), what peers reach, what builds take.

    Or a subject: instances (many PLCs at once), pace (lateness, scans a second), goto (time travel), watch (live values),
    debugging (what breakpoints cost), trace (recording every scan), verify (a second execution,
    time travel, who wrote last);
    `bench SUBJECT --help` explains its own options.
    """
    from scanbench.bench.run import BenchError, run_bench

    if programs and programs[0] in SUBJECTS:
        arguments = [*programs[1:], *context.args, *(["--json"] if as_json else [])]
        raise typer.Exit(subprocess.call([sys.executable, "-m", f"scanbench.bench.{programs[0]}", *arguments]))
    if context.args:
        usage(f"bench has no option {context.args[0]}")
    try:
        result = run_bench(programs or None)
    except BenchError as error:
        usage(str(error))
    if as_json:
        typer.echo(json.dumps(result))
        return
    _programs(result)
    _building(result)
    if result["interpreter_per_second"] is not None:
        typer.echo(f"\nreference interpreter: {result['interpreter_per_second']:,.0f} simple statements a second")


def _programs(result: "Result") -> None:
    names = list(dict.fromkeys(peer for ratios in result["peers"].values() for peer in ratios))
    heads = "".join(f"{name:>10}" for name in names)
    typer.echo(f"{'program':16}{'ns/scan':>12}{'C':>12}{'ratio':>8}{'observed':>10}{heads}   compile ms")
    for name, row in result["programs"].items():
        c_ns, ratio = row["c_ns"], row["ratio"]
        c_text = "-" if c_ns is None else f"{c_ns:.1f}"
        ratio_text = "-" if ratio is None else f"{ratio:.2f}"
        peers = result["peers"].get(name, {})
        others = "".join(f"{peers[peer]:>10,.2f}" if peer in peers else f"{'-':>10}" for peer in names)
        parts = "  ".join(f"{part} {ms:.0f}" for part, ms in result["compile"][name].items())
        typer.echo(
            f"{name:16}{row['ns']:>12.1f}{c_text:>12}{ratio_text:>8}{row['observed_ratio']:>10.2f}{others}   {parts}"
        )
    typer.echo("observed: code that notes statements and reads, as a ratio to the program's own.")
    if names:
        typer.echo("ratio: to the C of this run. Peers: their ratio to the same C, measured on another machine before.")


def _building(result: "Result") -> None:
    if not result["building"]:
        return
    typer.echo("\n" + f"{'10,000 lines':46}" + "".join(f"{name:>14}" for name in result["building"]))
    for key, what, unit in BUILDING:
        typer.echo(f"{what:46}" + "".join(f"{row[key]:>11.1f} {unit}" for row in result["building"].values()))
