"""`python -m bench`: how fast the native engine is, as a ratio to C compiled in the same run, and what builds take.

`python -m bench SUBJECT` measures something else; `python -m bench SUBJECT --help` explains its options.
"""

import argparse
import json
import runpy
import sys

from bench.run import PROGRAMS, BenchError, Result, run_bench

SUBJECTS = (
    "checking",
    "instances",
    "lsp",
    "pace",
    "goto",
    "watch",
    "debugging",
    "trace",
    "verify",
    "reverse",
    "sweep",
    "events",
    "pou",
    "graphic",
    "comm",
    "heartbeat",
    "subranges",
    "plugin",
)
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


def main(arguments: list[str]) -> None:
    """Prints the figures of the programs that are named, of all when none is."""
    if arguments and arguments[0] in SUBJECTS:
        sys.argv = arguments
        runpy.run_module(f"bench.{arguments[0]}", run_name="__main__")
        return
    parser = argparse.ArgumentParser(
        prog="python -m bench", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    wanted = f"programs ({', '.join(PROGRAMS)}), all when none is given; or one subject: {', '.join(SUBJECTS)}"
    parser.add_argument("programs", nargs="*", metavar="PROGRAM|SUBJECT", help=wanted)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    given = parser.parse_args(arguments)
    try:
        result = run_bench(given.programs or None)
    except BenchError as error:
        parser.error(str(error))
    sys.stdout.write("\n".join([json.dumps(result)] if given.json else shown(result)) + "\n")


def shown(result: Result) -> list[str]:
    """The figures as lines for people."""
    lines = [*_programs(result), *_building(result)]
    if result["interpreter_per_second"] is not None:
        lines += ["", f"reference interpreter: {result['interpreter_per_second']:,.0f} simple statements a second"]
    return lines


def _programs(result: Result) -> list[str]:
    names = list(dict.fromkeys(peer for ratios in result["peers"].values() for peer in ratios))
    heads = "".join(f"{name:>10}" for name in names)
    lines = [f"{'program':16}{'ns/scan':>12}{'C':>12}{'ratio':>8}{'observed':>10}{heads}   compile ms"]
    for name, row in result["programs"].items():
        c_ns, ratio = row["c_ns"], row["ratio"]
        c_text = "-" if c_ns is None else f"{c_ns:.1f}"
        ratio_text = "-" if ratio is None else f"{ratio:.2f}"
        peers = result["peers"].get(name, {})
        others = "".join(f"{peers[peer]:>10,.2f}" if peer in peers else f"{'-':>10}" for peer in names)
        parts = "  ".join(f"{part} {ms:.0f}" for part, ms in result["compile"][name].items())
        own = f"{row['ns']:>12.1f}{c_text:>12}{ratio_text:>8}{row['observed_ratio']:>10.2f}"
        lines.append(f"{name:16}{own}{others}   {parts}")
    lines.append("observed: code that notes statements and reads, as a ratio to the program's own.")
    if names:
        lines.append(
            "ratio: to the C of this run. Peers: their ratio to the same C, measured on another machine before."
        )
    return lines


def _building(result: Result) -> list[str]:
    if not result["building"]:
        return []
    lines = ["", f"{'10,000 lines':46}" + "".join(f"{name:>14}" for name in result["building"])]
    for key, what, unit in BUILDING:
        lines.append(f"{what:46}" + "".join(f"{row[key]:>11.1f} {unit}" for row in result["building"].values()))
    return lines


if __name__ == "__main__":
    main(sys.argv[1:])
