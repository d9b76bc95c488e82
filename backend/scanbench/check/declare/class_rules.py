"""What the standard asks of classes, interfaces and methods beyond their names and types."""

from collections.abc import Iterable

from scanbench.check.context import Report
from scanbench.check.declare.classes import Class, Classes, Method
from scanbench.check.declare.creations import FB_INIT, LIFE_CYCLE
from scanbench.check.declare.life_rules import check_life_method
from scanbench.check.dialect import Allowance, Dialect
from scanbench.check.dialect_rules import said
from scanbench.problems import Span
from scanbench.program.types import ArrayType, Member, Record, Section, Type

OPEN_TO = {"PRIVATE": 0, "INTERNAL": 1, "PROTECTED": 1, "PUBLIC": 2}
ENABLE = ("EN", "ENO")


def check_classes(classes: Classes, report: Report, dialect: Dialect) -> None:
    """Reports everything that a class or method may not be."""
    for each in classes.by_key.values():
        _check_form(each, report)
        for method in each.methods.values():
            _check_method(method, report, dialect)
        if not each.abstract:
            _check_complete(each, report)


def _check_form(owner: Class, report: Report) -> None:
    declaration = owner.declaration
    if owner.kind == "interface" and declaration.sections:
        report.error("D014", f"The interface `{owner.name}` has no variables, only methods and properties.",
                     declaration.sections[0].span)  # fmt: skip
    if {"ABSTRACT", "FINAL"} <= set(declaration.modifiers):
        report.error("D014", f"`{owner.name}` cannot be both ABSTRACT and FINAL.", declaration.span)
    if owner.kind == "class":
        for section in declaration.sections:
            if section.keyword in (Section.INPUT, Section.OUTPUT, Section.IN_OUT, Section.TEMP):
                report.error("D008", f"A CLASS has no {section.keyword}; use VAR PUBLIC or a method.", section.span)
        if declaration.body:
            report.error("D014", f"The class `{owner.name}` has no body; write a method.", declaration.span)


def _check_method(method: Method, report: Report, dialect: Dialect) -> None:
    declaration, owner = method.declaration, method.owner
    modifiers = set(declaration.modifiers)
    if Allowance.LIFE in dialect.allows and owner.kind != "interface":
        check_life_method(method, report, dialect)
    elif declaration.name.upper() in LIFE_CYCLE:
        report.error("X001", f"{declaration.name} would never be called: instances start with the initial values of "
                     "their variables; use those, or call a method of another name.", declaration.span)  # fmt: skip
    if {"ABSTRACT", "FINAL"} <= modifiers:
        report.error("D014", f"`{method.name}` cannot be both ABSTRACT and FINAL.", declaration.span)
    if "ABSTRACT" in modifiers and not owner.abstract:
        report.error(
            "D014", f"`{method.name}` is ABSTRACT, so `{owner.name}` must be declared ABSTRACT as well.",
            declaration.span,
        )  # fmt: skip
    if method.abstract and declaration.body:
        what = "belongs to an interface" if owner.kind == "interface" else "is ABSTRACT"
        report.error("D014", f"`{method.name}` {what} and has no body.", declaration.span)
    key = method.key
    above = next((found for each in owner.ancestors() if (found := each.methods.get(key))), None)
    if above is None:
        if "OVERRIDE" in modifiers and not owner.open:
            hint = report.near(declaration.name, owner.inherited_names, f"inherited:{owner.name}")
            report.error("D014", f"`{method.name}` has nothing to OVERRIDE.{hint}", declaration.span)
        return
    if "FINAL" in above.declaration.modifiers and above.owner.kind == "interface" and in_interfaces(dialect):
        used = f"`{above.name}` is FINAL, but of an INTERFACE"
        report.warn("W006", said(dialect, Allowance.FINAL_INTERFACES, used), above.declaration.span)
    elif "FINAL" in above.declaration.modifiers:
        report.error("D014", f"`{above.name}` is FINAL and cannot be overridden.", declaration.span)
    if above.declaration.access == "PRIVATE":
        report.error("D014", f"`{above.name}` is PRIVATE; use another name for this one.", declaration.span)
    # SIMATIC AX and the standard have PROTECTED where no word is written, which is PUBLIC here
    unsaid = Allowance.OVERLOADS in dialect.allows and declaration.access == "PROTECTED"
    if OPEN_TO[declaration.access] < OPEN_TO[above.declaration.access] and not unsaid:
        report.error(
            "D014", f"`{method.name}` is {declaration.access}, but `{above.name}` is {above.declaration.access}.",
            declaration.span,
        )  # fmt: skip
    if Allowance.LIFE not in dialect.allows or declaration.name.upper() != FB_INIT:
        _check_signature(method, above, report, declaration.span)


def in_interfaces(dialect: Dialect) -> bool:
    """Whether FINAL means nothing in an interface."""
    return Allowance.FINAL_INTERFACES in dialect.allows


def _check_complete(owner: Class, report: Report) -> None:
    """A class of which there are instances has a body for every method."""
    missing: dict[str, Method] = {}
    for parent in owner.ancestors():
        for key, method in parent.methods.items() if parent.abstract else ():
            found = owner.find(key)
            if found is not None and found.abstract:
                missing.setdefault(key, method)
            elif found is not None and found.owner is not owner and parent.kind == "interface":
                _check_signature(found, method, report, owner.declaration.span)
    if missing and not owner.open:
        names = ", ".join(f"`{_half(each)}{each.name}`" for each in missing.values())
        report.error("D014", f"`{owner.name}` has no body for {names}; write it, or declare `{owner.name}` ABSTRACT.",
                     owner.declaration.span)  # fmt: skip


def _half(method: Method) -> str:
    kind = method.declaration.kind
    return "" if kind == "method" else f"{kind.upper()} of "


def _check_signature(method: Method, above: Method, report: Report, span: Span) -> None:
    if method.pou is None or above.pou is None:
        return
    own, other = _formals(method), _formals(above)
    for mine, theirs in zip(own, other, strict=False):
        if _described(mine) != _described(theirs):
            report.error(
                "D014", f"`{method.name}` has `{_text(mine)}` where `{above.name}` has `{_text(theirs)}`.", span
            )
            return
    if len(own) != len(other):
        extra = (own if len(own) > len(other) else other)[min(len(own), len(other))]
        where, instead = (method, above) if len(own) > len(other) else (above, method)
        report.error("D014", f"`{where.name}` has `{_text(extra)}`, but `{instead.name}` has not.", span)
    elif method.pou.result != above.pou.result:
        results = [f"a result {each.pou.result}" if each.pou and each.pou.result else "no result"
                   for each in (method, above)]  # fmt: skip
        report.error("D014", f"`{method.name}` has {results[0]}, but `{above.name}` has {results[1]}.", span)


def _formals(method: Method) -> list[Member]:
    pou = method.pou
    members = [pou.frame.members[key] for key in pou.parameters] if pou else []
    return [each for each in members if not each.hidden and each.name.upper() not in ENABLE]


def _described(member: Member) -> tuple[str, Type, Section, bool]:
    return member.name.upper(), member.type, member.section, member.constant


def _text(member: Member) -> str:
    return f"{member.section.value} {member.name} : {member.type}"


def check_instances(classes: Classes, owners: Iterable[Record], report: Report) -> None:
    """Refuses variables of an abstract class."""
    for owner in owners:
        for member in owner.members.values():
            type: Type = member.type
            while isinstance(type, ArrayType):
                type = type.element
            found = classes.of(type)
            if found is None or not found.abstract or member.section is Section.IN_OUT or member.hidden:
                continue
            report.error(
                "D014", f"`{found.name}` is ABSTRACT, so `{member.name}` cannot be an instance of it.", member.span
            )
