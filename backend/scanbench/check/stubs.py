"""Stubs: POUs without a real body, as they need a device or are not documented enough. Who uses one is told, as nothing else shows it."""

from collections.abc import Iterable

from scanbench.check.context import Report
from scanbench.check.libraries.catalogue import UNSET, library_of_file
from scanbench.check.uses import Use
from scanbench.problems import Span
from scanbench.syntax import tree


def tell_stubs(report: Report, declarations: Iterable[tree.PouDeclaration]) -> None:
    """A warning for each stub that is used outside of libraries, at the first of its uses."""
    stubs = {f"{each.namespace}.{each.name}".lstrip(".").upper(): each for each in declarations if each.stub}
    used: dict[str, list[Use]] = {}
    unset: dict[str, Span] = {}
    for user, part in (("", report), *((pou.name.upper(), part) for pou, part in report.parts.items())):
        for use in part.uses:
            name = use.symbol.name
            if name in UNSET and use.symbol.kind == "variable" and not library_of_file(use.span.file):
                unset.setdefault(name, use.place.plain())
            # a function names itself where it gives its result
            if use.symbol.kind == "pou" and name in stubs and name != user and not library_of_file(use.span.file):
                used.setdefault(name, []).append(use)
    for name, uses in used.items():
        first = min((use.place.plain() for use in uses), key=_order)
        report.warn("W008", _said(stubs[name], len({use.place.plain() for use in uses})), first)
    for name, where in unset.items():
        report.warn(
            "W008",
            f"`{UNSET[name]}` is set by the vendor's controller, and by nothing here: it keeps what you write to it in the watch "
            "table, by a force or by a stimulus.",
            where,
        )


def _order(span: Span) -> tuple[str, int, int]:
    return span.file, span.line, span.column


def _said(stub: tree.PouDeclaration, places: int) -> str:
    often = "" if places == 1 else f" It is used in {places} places."
    how = f"`Stub_{stub.name}` is its result" if stub.kind == "function" else "its outputs keep what is written to them"
    return (
        f"`{stub.name}` is a stub, without a real body: {how}. Set that in the watch table, by a force or by a stimulus, "
        f"or write a body in {stub.span.file}.{often}"
    )
