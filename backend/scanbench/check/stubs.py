"""Stubs: POUs without a real body, as they need a device or are not documented enough. Who uses one is told, as nothing else shows it."""

from collections.abc import Iterable

from scanbench.check.context import Report
from scanbench.check.libraries.catalogue import PLACEHOLDERS, UNSET, library_of_file
from scanbench.check.uses import SymbolKind, Use
from scanbench.problems import Span
from scanbench.syntax import tree


def tell_stubs(report: Report, declarations: Iterable[tree.PouDeclaration], files: Iterable[tree.File]) -> None:
    """A warning for each stub and placeholder that is used outside of libraries, at the first of its uses."""
    _tell_placeholders(report, files)
    stubs = {
        f"{each.namespace}.{each.name}".lstrip(".").upper(): each
        for each in declarations
        if each.stub and library_of_file(each.span.file) != PLACEHOLDERS
    }
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


def _tell_placeholders(report: Report, files: Iterable[tree.File]) -> None:
    """A warning for each name of a library that nobody has, at the first of its uses: what it declares is only inferred."""
    kinds: dict[tuple[SymbolKind, str], tuple[str, str]] = {}
    for file in files:
        if library_of_file(file.name) != PLACEHOLDERS:
            continue
        for name in (*(each.name for each in file.types), *(each.name for each in file.pous)):
            kinds["pou", name.upper()] = kinds["type", name.upper()] = name, _INFERRED
        for section in file.globals:
            for each in section.variables:
                said = _INFERRED if each.initial is None else _assumed(each.initial)
                kinds["variable", each.name.upper()] = each.name, said
    if not kinds:
        return
    first: dict[tuple[SymbolKind, str], Span] = {}
    for part in (report, *report.parts.values()):
        for use in part.uses:
            key = use.symbol.kind, use.symbol.name
            own = use.symbol.kind != "variable" or use.symbol.owner == "GLOBAL"
            if key in kinds and own and not library_of_file(use.span.file):
                place = use.place.plain()
                first[key] = min(first.get(key, place), place, key=_order)
    for key, where in first.items():
        name, said = kinds[key]
        report.warn("W008", f"`{name}` is a placeholder, as what declares it is missing: {said}", where)


_INFERRED = "what it has is inferred from its use, and it does nothing. Correct it in libraries/Placeholders.st, or put what declares it there."


def _assumed(number: tree.Initial) -> str:
    value = number.value if isinstance(number, tree.Literal) else "one"
    return f"its number is not known, and {value!s} is assumed. Write the right one in libraries/Placeholders.st."


def _order(span: Span) -> tuple[str, int, int]:
    return span.file, span.line, span.column


def _said(stub: tree.PouDeclaration, places: int) -> str:
    often = "" if places == 1 else f" It is used in {places} places."
    if stub.kind == "function" and stub.result is None:
        return (
            f"`{stub.name}` is a stub, without a real body: it does nothing. Write its body in {stub.span.file}.{often}"
        )
    how = f"`Stub_{stub.name}` is its result" if stub.kind == "function" else "its outputs keep what is written to them"
    return (
        f"`{stub.name}` is a stub, without a real body: {how}. Set that in the watch table, by a force or by a stimulus, "
        f"or write a body in {stub.span.file}.{often}"
    )
