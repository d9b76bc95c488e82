"""`python -m tests.covered FILE`: what `coverage json` wrote, in a few lines: the share of all, and the files that the tests reach less."""

import json
import sys
from collections.abc import Iterator
from pathlib import Path

WANTED = 80.0
"""Per cent of a file's lines."""


def lines(told: dict[str, object]) -> Iterator[str]:
    """The report; files with the smallest share come first."""
    match told:
        case {"totals": {"percent_covered": float(share) | int(share)}, "files": dict(files)}:
            yield f"The tests run {share:.1f} % of the backend's lines."
            shares = sorted((each["summary"]["percent_covered"], name) for name, each in files.items())
            yield from (f"{share:5.1f} %  {name}" for share, name in shares if share < WANTED)
        case _:
            raise ValueError("this is no report of `coverage json`")


if __name__ == "__main__":
    print("\n".join(lines(json.loads(Path(sys.argv[1]).read_text("utf-8")))))
