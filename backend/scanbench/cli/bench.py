"""`scanbench bench`: how fast the native engine is, as a ratio to C compiled in the same run."""

import json

import typer

from scanbench.cli.inputs import usage


def bench(
    programs: list[str] | None = typer.Argument(None, metavar="[PROGRAM]...", help="Names; all when none is given."),
    as_json: bool = typer.Option(False, "--json", help="Print one JSON object."),
) -> None:
    """Measure the bench programs: ns per scan, ratio to hand-written C (gcc -O3), compile times."""
    from scanbench.bench.run import BenchError, run_bench

    try:
        result = run_bench(programs or None)
    except BenchError as error:
        usage(str(error))
    if as_json:
        typer.echo(json.dumps(result))
        return
    typer.echo(f"{'program':16}{'ns/scan':>12}{'C':>12}{'ratio':>8}   compile ms")
    for name, row in result["programs"].items():
        c_ns, ratio = row["c_ns"], row["ratio"]
        c_text = "-" if c_ns is None else f"{c_ns:.1f}"
        ratio_text = "-" if ratio is None else f"{ratio:.2f}"
        parts = "  ".join(f"{part} {ms:.0f}" for part, ms in result["compile"][name].items())
        typer.echo(f"{name:16}{row['ns']:>12.1f}{c_text:>12}{ratio_text:>8}   {parts}")
