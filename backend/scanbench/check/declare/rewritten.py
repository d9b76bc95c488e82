"""What a dialect changes in a declaration before anything is declared: methods of one name."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import replace

from scanbench.check.context import Report
from scanbench.check.dialect import Allowance, Dialect
from scanbench.check.dialect_rules import said
from scanbench.check.libraries.catalogue import library_of_file
from scanbench.syntax import tree


def inputs_of(pou: tree.PouDeclaration) -> list[object]:
    """What tells FUNCTIONs or methods of one name apart: the types of their inputs and in-outs."""
    return _types_of(pou, ("VAR_INPUT", "VAR_IN_OUT"))


def _types_of(pou: tree.PouDeclaration, keywords: tuple[str, ...]) -> list[object]:
    return [_told(each.type) for section in pou.sections if section.keyword in keywords for each in section.variables]


def _told(spec: tree.TypeSpec) -> object:
    """A type by which an input differs from another; strings of any length, and arrays with bounds, are one."""
    if isinstance(spec, tree.NamedType):
        return spec.name.rpartition(".")[2].upper()
    if isinstance(spec, tree.ReferenceSpec) and isinstance(inner := _told(spec.target), str):
        return f"REF_TO {inner}"
    if isinstance(spec, tree.OpenArraySpec):
        return tree.OpenArraySpec, spec.dimensions, _told(spec.element)
    return type(spec)


def signature_of(pou: tree.PouDeclaration) -> tuple[list[object], list[object]]:
    """The same with the types of the outputs, by which FUNCTIONs are told apart, too."""
    return inputs_of(pou), _types_of(pou, ("VAR_OUTPUT",))


def overloaded_in(files: Iterable[tree.File]) -> frozenset[str]:
    """Names, in upper case, that some class or interface has several methods of, its own or with those that it inherits."""
    found: set[str] = set()
    pous = {pou.name.upper(): pou for file in files for pou in file.pous if pou.methods}
    for pou in pous.values():
        counted = Counter(each.name.upper() for each in pou.methods if each.kind == "method")
        found |= {name for name, count in counted.items() if count > 1}
        fresh = [each for each in pou.methods if "OVERRIDE" not in each.modifiers and each.kind == "method"]
        for above in _above(pou, pous) if fresh else ():
            inherited = {each.name.upper(): inputs_of(each) for each in above.methods}
            found |= {
                name for each in fresh if inherited.get(name := each.name.upper(), wanted := inputs_of(each)) != wanted
            }
    return frozenset(found)


def _above(pou: tree.PouDeclaration, pous: dict[str, tree.PouDeclaration]) -> Iterable[tree.PouDeclaration]:
    """What a class extends, and what that extends, by their names without a namespace."""
    seen = {pou.name.upper()}
    while pou.extends:
        name = pou.extends[0].name.rpartition(".")[2].upper()
        if name in seen or name not in pous:
            return
        seen.add(name)
        pou = pous[name]
        yield pou


def rewritten(
    pou: tree.PouDeclaration, overloaded: frozenset[str], dialect: Dialect, report: Report
) -> tree.PouDeclaration:
    """The declaration as the rules of the standard would have it."""
    if overloaded and Allowance.OVERLOADS in dialect.allows:
        pou = _told_apart(pou, overloaded, dialect, report)
    return pou


def _told_apart(
    pou: tree.PouDeclaration, overloaded: frozenset[str], dialect: Dialect, report: Report
) -> tree.PouDeclaration:
    """Methods of these names with the types of their inputs, by which a class and an interface agree on which is which."""
    methods, seen = [], set()
    for method in pou.methods:
        if method.kind == "method" and method.name.upper() in overloaded:
            types = (each if isinstance(each, str) else "..." for each in inputs_of(method))
            method = replace(method, overload=f"({', '.join(types)})")
            if method.name.upper() in seen and library_of_file(method.span.file) is None:
                used = f"`{pou.name}` has several methods `{method.name}`"
                report.warn("W006", said(dialect, Allowance.OVERLOADS, used), method.span)
            seen.add(method.name.upper())
        methods.append(method)
    return replace(pou, methods=tuple(methods)) if seen else pou
