"""What some compilers have beyond the standard at a FUNCTION: `Twice<T: ANY_NUM>`, `args : {sized} INT...`, and `{external}`."""

from dataclasses import replace

from scanbench.syntax import tree
from scanbench.syntax.cursor import NAME, Cursor

TYPE_PARAMETERS = "typed"
"""Among the modifiers of a FUNCTION: it has type parameters, and `Twice__INT` is what runs for INT, if there is one."""
ELEMENTARY = frozenset(
    "BOOL BYTE WORD DWORD LWORD SINT INT DINT LINT USINT UINT UDINT ULINT REAL LREAL STRING WSTRING CHAR WCHAR TIME LTIME DATE LDATE "
    "TOD LTOD DT LDT TIME_OF_DAY DATE_AND_TIME".split()
)
VARIADIC = "variadic"
"""Among the modifiers of a FUNCTION: a call may have more arguments than it names."""


def type_parameters(c: Cursor) -> dict[str, str]:
    """`<T: ANY_NUM, U: ANY_STRING>`: the group of each, by its name in upper case."""
    found: dict[str, str] = {}
    if not c.accept("<"):
        return found
    while True:
        name = c.name("the name of a type parameter")
        c.expect(":", "after the name of a type parameter, then its group")
        group = c.name("a group of types, as ANY_NUM,")
        if c.texts[group].upper() in found.values():
            c.report(
                "X001",
                f"`{c.texts[group]}` is one type here, whatever its name is; two type parameters of it are not supported.",
                c.span_of(name),
            )
        found[c.texts[name].upper()] = c.texts[group]
        if not c.accept(","):
            break
    c.expect(">", "to close the type parameters")
    return found


def grouped(
    parameters: dict[str, str], sections: list[tree.VariableSection], result: tree.TypeSpec | None
) -> tuple[list[tree.VariableSection], tree.TypeSpec | None]:
    """The same declarations with the group of types in place of each type parameter."""

    def settled(spec: tree.TypeSpec) -> tree.TypeSpec:
        if isinstance(spec, tree.NamedType) and spec.name.upper() in parameters:
            return tree.NamedType(parameters[spec.name.upper()], spec.span)
        return spec

    if not parameters:
        return sections, result
    made = [
        replace(section, variables=tuple(replace(each, type=settled(each.type)) for each in section.variables))
        for section in sections
    ]
    return made, None if result is None else settled(result)


def chosen_type(c: Cursor) -> str:
    """The type in `f<DINT>(...)`, which comes next and is taken; '' where a comparison does. No variable is named as a type."""
    type = c.texts[c.at + 1].upper()
    if c.texts[c.at + 2 : c.at + 4] != [">", "("] or type not in ELEMENTARY:
        return ""
    c.at += 3
    return type


def any_number_follows(c: Cursor) -> bool:
    """Whether `...` comes next: as many arguments as a call has. It is taken."""
    if c.texts[c.at] == ".." and c.texts[c.at + 1] == "." and c.end_of(c.at) == c.starts[c.at + 1]:
        c.at += 2
        c.variadic = True
        return True
    return False


def external(c: Cursor, pou: tree.PouDeclaration) -> tuple[tree.PouDeclaration, tree.VariableSection | None]:
    """A POU whose body is in another language: a stub, and the variable that is the result of a FUNCTION."""
    if pou.body or pou.kind != "function" or pou.result is None or TYPE_PARAMETERS in pou.modifiers:
        return replace(pou, stub=pou.stub or not pou.body), None
    span = pou.span
    given = f"Stub_{pou.name}"
    body = (tree.Assignment(tree.Name(pou.name, span), tree.Name(given, span), span),)
    variable = tree.Variable(given, pou.result, None, None, span)
    section = tree.VariableSection("VAR_GLOBAL", (), (variable,), span, namespace=pou.namespace, using=pou.using)
    return replace(pou, body=body, stub=True), section


def named_apart(c: Cursor) -> str | None:
    """The owner in `ACTION Pump.Fill`, which some exports write beside the POU; it is taken, the name of the action is not."""
    if c.kinds[c.at + 1] is NAME and c.texts[c.at + 2] == "." and c.kinds[c.at + 3] is NAME:
        owner = c.texts[c.at + 1]
        del c.kinds[c.at + 1 : c.at + 3], c.texts[c.at + 1 : c.at + 3], c.starts[c.at + 1 : c.at + 3]
        return owner
    return None
