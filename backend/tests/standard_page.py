"""`python -m tests.standard_page` writes `docs/standard-library.md` from the tables of the library."""

from pathlib import Path

from scanbench.check.body import conversions
from scanbench.check.standard.functions import FUNCTIONS
from scanbench.check.standard.library import library
from scanbench.language.describe import said_in_library
from scanbench.language.standard import says, summary, text_of
from scanbench.syntax import tree

PAGE = Path(__file__).parents[2] / "docs" / "standard-library.md"
FIRST_CALLS = (
    "The first call of an `R_TRIG` sets Q when CLK is TRUE. The first call of an `F_TRIG` never sets Q, because there was no edge yet.",
    "The body that IEC 61131-3 prints for F_TRIG sets Q there when CLK is FALSE; a program that relies on it sees one pulse less",
    "here, in its first scan. Inputs with `R_EDGE` and `F_EDGE` do the same.",
)


def page() -> str:
    """The whole page."""
    lines = [
        "# The standard library",
        "",
        "Made by `python -m tests.standard_page` (in `backend/`); do not edit.",
        "",
        "Names may end in a type: `ADD_INT`, `MAX_LREAL`, `SHL_WORD`. Arguments are given in order or by name;",
        "Every function can have EN and ENO. Results wrap at the width of their type; an integer division by zero is a run-time error.",
        "",
        "## Functions",
        "",
        "| function | parameters and result | what it does |",
        "|---|---|---|",
        *(f"| `{name}({', '.join(row.formals)}{', ...' if row.variadic else ''})` | {says(row)} | {summary(text_of(name))} |"
          for name, row in FUNCTIONS.items()),
        "",
        "## Conversions",
        "",
        "`X_TO_Y`, `TO_Y`; `X_TRUNC_Y`, `TRUNC_Y`, `TRUNC`; `X_BCD_TO_Y`, `BCD_TO_Y`, `X_TO_BCD_Y`, `TO_BCD_Y`.",
        "X and Y are elementary types, STRING, WSTRING or enumerations.",
        "",
        (conversions.__doc__ or "").partition("The rules, once:\n")[2].strip(),
        "",
    ]  # fmt: skip
    functions: list[str] = []
    blocks: list[str] = []
    for file in library():
        for pou in file.pous:
            if not pou.name.startswith("__"):
                (functions if pou.kind == "function" else blocks).append(
                    f"| {signature(pou)} | {summary(said_in_library(pou.span))} |"
                )
    lines += ["## Functions in ST", "", "| function | what it does |", "|---|---|", *functions, ""]
    counters = "In `codesys` and `twincat`, PV and CV of CTU, CTD and CTUD are WORD, from 0 to 65535."
    lines += [
        "## Function blocks",
        "",
        counters,
        "",
        "| block | what it does |",
        "|---|---|",
        *blocks,
        "",
        *FIRST_CALLS,
        "",
    ]
    return "\n".join(lines)


def signature(pou: tree.PouDeclaration) -> str:
    """`NAME(inputs => outputs) : result` of a library POU."""
    parts: dict[str, list[str]] = {"VAR_INPUT": [], "VAR_OUTPUT": []}
    for section in pou.sections:
        for variable in section.variables:
            if section.keyword in parts:
                parts[section.keyword].append(f"{variable.name} : {spelled(variable.type)}")
    outputs = f" => {', '.join(parts['VAR_OUTPUT'])}" if parts["VAR_OUTPUT"] else ""
    result = f" : {spelled(pou.result)}" if pou.result is not None else ""
    return f"`{pou.name}({', '.join(parts['VAR_INPUT'])}{outputs}){result}`"


def spelled(type: tree.TypeSpec) -> str:
    """A type as the library writes it."""
    match type:
        case tree.NamedType(name):
            return name
        case tree.StringSpec(length=tree.Literal(value=value)):
            return f"STRING[{value!r}]"
    raise AssertionError(type)


if __name__ == "__main__":
    PAGE.write_text(page(), "utf-8")
