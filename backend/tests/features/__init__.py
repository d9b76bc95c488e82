"""The numbered features of the tables of IEC 61131-3, edition 3, and the cases that show them.

`<topic>.txt` lists them (`table.number<TAB>description` below `# Table n: title`), `refused.txt` and
`not_applicable.txt` say why one has no case. `python -m tests.features` writes `docs/features.md`.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from tests.caseformat import Case, read_cases

HERE = Path(__file__).parent
PAGE = HERE.parents[2] / "docs" / "features.md"
TITLE = re.compile(r"# Table (\d+): (.+)")
WITHOUT_CASES = ("refused", "not_applicable")


@dataclass(slots=True)
class Table:
    """One table of the standard: its features by number, in their order."""

    number: int
    title: str
    features: dict[str, str] = field(default_factory=dict)


def read_tables() -> list[Table]:
    """All tables, in the order of the standard."""
    tables: list[Table] = []
    for path in HERE.glob("*.txt"):
        if path.stem in WITHOUT_CASES:
            continue
        for line in filter(None, path.read_text("utf-8").splitlines()):
            if title := TITLE.fullmatch(line):
                tables.append(Table(int(title[1]), title[2]))
            else:
                number, description = line.split("\t")
                tables[-1].features[number] = description
    return sorted(tables, key=lambda table: table.number)


def read_reasons(name: str) -> dict[str, str]:
    """Of features without a case: `refused` or `not_applicable`, by number."""
    lines = (HERE / f"{name}.txt").read_text("utf-8").splitlines()
    return dict(line.split("\t", 1) for line in lines if line)


def all_cases() -> list[Case]:
    """Every case of `tests/cases`."""
    return [case for path in sorted((HERE.parent / "cases").glob("*.case")) for case in read_cases(path)]


def shown_by(cases: Iterable[Case]) -> dict[str, list[str]]:
    """The names of the cases that show a feature, by its number."""
    shown: dict[str, list[str]] = {}
    for case in cases:
        for number in case.features:
            shown.setdefault(number, []).append(case.name)
    return shown


def page() -> str:
    """`docs/features.md`: every feature, whether it is supported, and what shows it."""
    tables, shown = read_tables(), shown_by(all_cases())
    refused, elsewhere = read_reasons("refused"), read_reasons("not_applicable")
    numbers = [number for table in tables for number in table.features]
    supported = sum(number in shown for number in numbers)
    lines = [
        "# Features of IEC 61131-3, edition 3",
        "",
        "Table by table of the standard. A feature is *supported* when at least one case of `backend/tests/cases` shows it; "
        "each case runs on both engines.",
        "Written by `make features` from `backend/tests/features` and the cases; do not edit.",
        "",
        f"{len(numbers)} features: {supported} supported, {len(refused)} refused, {len(elsewhere)} not applicable.",
    ]
    for table in tables:
        lines += [
            "",
            f"## Table {table.number}: {table.title}",
            "",
            "| No. | Feature | | Shown by |",
            "|---|---|---|---|",
        ]
        for number, description in table.features.items():
            if number in shown:
                status, note = "supported", ", ".join(shown[number])
            elif number in refused:
                status, note = "refused", refused[number]
            elif number in elsewhere:
                status, note = "not applicable", elsewhere[number]
            else:
                status, note = "no case yet", ""
            lines.append(f"| {number} | {_cell(description)} | {status} | {_cell(note)} |")
    return "\n".join(lines) + "\n"


def _cell(text: str) -> str:
    for sign in "\\|*<":
        text = text.replace(sign, f"\\{sign}")
    return text
