"""What a call runs: a FUNCTION, a method, a standard function."""

from dataclasses import replace

from scanbench.check.body.allowed import may
from scanbench.check.body.arguments import Invocation, invoke
from scanbench.check.body.context import Body
from scanbench.check.body.generic import instantiated, of_chosen_type
from scanbench.check.body.methods import send
from scanbench.check.body.objects import dotted, own_class
from scanbench.check.body.overloads import method_overload, of_types, overload
from scanbench.check.body.receivers import Receiver, is_qualified, method_called
from scanbench.check.body.standard_calls import standard_call
from scanbench.check.body.variables import is_broken
from scanbench.check.context import Rejected
from scanbench.check.declare.classes import Method
from scanbench.check.declare.names import Names
from scanbench.check.dialect import Allowance
from scanbench.check.standard.functions import FUNCTIONS
from scanbench.check.uses import Symbol
from scanbench.program.origin import in_library
from scanbench.program.program import Expr, Place, Pou
from scanbench.program.types import ELEMENTARY, Record, Reference, Section, Type
from scanbench.syntax import tree
from scanbench.syntax.lexer import GLOBAL_MARK, NOTHING

_OF_LADDERS = {
    **dict.fromkeys(("TON", "TOF", "RTO"), "In Structured Text call TONR, TOFR or RTOR with a tag of type FBD_TIMER."),
    **dict.fromkeys(("CTU", "CTD"), "In Structured Text call CTUD with a tag of type FBD_COUNTER."),
    **dict.fromkeys(("ONS", "OSR", "OSF"), "In Structured Text call OSRI or OSFI with a tag of type FBD_ONESHOT."),
}
"""Instructions that Structured Text of Logix does not have, and what it has (1756-RM003)."""
_TEXTS = {
    "STRING_TO_BOOL": Allowance.TRUE_TEXTS, "STRING_TO_ULINT": Allowance.TEXT_NUMBERS,
    "STRING_TO_LWORD": Allowance.TEXT_NUMBERS, "TIME_TO_STRING": Allowance.SHORT_TIMES,
    "TIME_OF_DAY_TO_STRING": Allowance.SHORT_TIMES,
}  # fmt: skip


def called(body: Body, callee: tree.Expression) -> Pou | None:
    """The FUNCTION or method that a call would run; None for instances and standard functions."""
    found = callee_of(body, callee)
    return found if found is None or isinstance(found, Pou) else found[1].pou


def called_by(body: Body, node: tree.Call) -> Pou | None:
    """The same for a call with these arguments, before it is checked."""
    mark = body.report.mark()
    found = callee_of(body, node.callee, node)
    body.report.undo(mark)
    return found if found is None or isinstance(found, Pou) else found[1].pou


def callee_of(
    body: Body, callee: tree.Expression, node: tree.Call | None = None
) -> Pou | tuple[Receiver, Method] | None:
    """The FUNCTION or method that is called; None for instances and standard functions.

    Of a generic FUNCTION it is the one for the arguments of `node`.
    """
    method = None if means_function(body, callee) else method_called(body, callee)
    if method is not None:
        return method if node is None else (method[0], method_overload(body, *method, node))
    name = dotted(callee)
    if name is None:
        return None
    name, _, chosen = name.partition("<")  # `f<DINT>(...)`
    if hides(body, name):
        return None
    name = name.removeprefix(GLOBAL_MARK)
    names: Names = body.declarations.names
    key = names.find(name, callee.span, body.pous.functions, body.pous.generic)
    if key in body.pous.overloads and node is not None:
        key = overload(body, key, node)
    found = body.pous.functions.get(key) if key is not None else None
    if in_library(callee.span) and (found is None or not found.inline):
        return None  # the library means its own, which is no POU
    if found is not None and in_library(found.span) and _is_vendors(body, found.name):
        return None  # a conversion
    if key is not None:
        body.report.use(callee.span, name, Symbol("pou", "", key.partition("(")[0]))
    if key is not None and chosen:
        return of_chosen_type(body, key, chosen.rstrip(">"), node, callee.span)
    if key in body.pous.generic:
        typed = of_types(body, key, node)
        if typed is not None:
            return typed
        return instantiated(body, body.pous.generic[key], node or tree.Call(callee, (), callee.span))
    return found


def means_function(body: Body, callee: tree.Expression) -> bool:
    """Whether a name alone is that of a FUNCTION, also in a class that has such a method: SIMATIC AX calls that by `THIS.name`."""
    if not isinstance(callee, tree.Name) or not may(body, Allowance.OVERLOADS) or own_class(body) is None:
        return False
    name = callee.name.removeprefix(GLOBAL_MARK)
    names: Names = body.declarations.names
    return (
        name.upper() in FUNCTIONS or names.find(name, callee.span, body.pous.functions, body.pous.generic) is not None
    )


def _is_vendors(body: Body, name: str) -> bool:
    """Whether the dialect converts texts otherwise than this function of the library."""
    allowance = _TEXTS.get(name.upper())
    return allowance is not None and may(body, allowance)


def hides(body: Body, path: str) -> bool:
    """Whether this is a variable, and no function: a plain value of the same name, as a result, hides none."""
    found = body.scope.find(path.split(".")[0])
    if found is not None and found[0].section is Section.RESULT and may(body, Allowance.OVERLOADS):
        return "." in path or isinstance(found[0].type, Record)  # an interface is not called
    return found is not None and ("." in path or isinstance(found[0].type, Record | Reference))


def invoked(body: Body, callee: Pou | tuple[Receiver, Method], node: tree.Call, eno: Place | None = None) -> Invocation:
    """The call of a FUNCTION or method. `eno` receives its ENO, where it has one."""
    if isinstance(callee, Pou):
        if callee.name.upper() in body.pous.variadic:
            node = without_more(body, node, callee)
        return invoke(body, node, callee, callee.name, None, eno)
    return send(body, *callee, node, eno)


def without_more(body: Body, node: tree.Call, callee: Pou) -> tree.Call:
    """The call without the arguments that its FUNCTION does not name, which are only checked: it is a stub."""
    named = sum(each != "ENO" for each in callee.parameters)
    for each in node.arguments[named:]:
        if each.value is not None:
            body.expression(each.value)
    return replace(node, arguments=node.arguments[:named])


def standard_function(body: Body, node: tree.Call, wanted: Type | None, eno: Place | None = None) -> Expr:
    """A function that is no POU; `eno` becomes FALSE where it finds that its result is not right."""
    path = dotted(node.callee)
    plain = None if path is None else body.declarations.names.plain(path)
    if plain != path and plain is not None and "." not in plain:
        node = replace(node, callee=tree.Name(plain, node.callee.span))
    if not isinstance(node.callee, tree.Name):
        if path is not None and _is_qualified_name(body, node.callee):
            hint = body.report.near(path, lambda: [pou.name for pou in body.pous.functions.values()], "path")
            raise body.report.reject("T001", f"There is no function `{path}`.{hint}", node.span)
        _no_value(body, node.callee)
        raise body.report.reject(
            "T010", "Only functions, methods and instances of function blocks can be called.", node.span
        )
    name = node.callee.name.removeprefix(GLOBAL_MARK)
    key = name.upper()
    if name == NOTHING:  # reported
        raise Rejected
    if hides(body, name):
        _no_value(body, node.callee)
    declared = body.declarations.block_trees.get(key)
    if declared is not None and declared.kind == "program" and not in_library(node.span):  # which means its own
        raise body.report.reject(
            "X001",
            f"`{name}` is a PROGRAM, which a task runs and nobody calls. Make it a FUNCTION_BLOCK, and declare an "
            "instance in VAR.",
            node.span,
        )
    if key in FUNCTIONS:  # also when its arguments are refused
        body.report.use(node.callee.span, name, Symbol("function", "", key))
    standard = standard_call(body, node, key, wanted, eno)
    if standard is not None:
        if key not in FUNCTIONS:
            body.report.use(node.callee.span, name, Symbol("function", "", key))
        return standard
    hint = _hint(body, node, name)
    untyped = bool({(body.scope.pou.upper(), key), ("GLOBAL", key)} & body.declarations.broken)
    owner = own_class(body)
    untyped = untyped or (owner is not None and owner.record is not None and is_broken(body, owner.record, name))
    if key in body.pous.broken or untyped or (body.scope.instance is not None and body.scope.instance.open):
        raise Rejected
    if body.scope.find(name) is not None:
        raise body.report.reject("T010", f"`{name}` is a variable; it cannot be called.", node.span)
    action = f"`{name}` is no action and no variable; write ACTION {name}: ... END_ACTION, or declare a BOOL."
    raise body.report.reject("T001", action if body.chart else f"There is no function `{name}`.{hint}", node.span)


def _hint(body: Body, node: tree.Call, name: str) -> str:
    """What a name that is no function probably means."""
    key = name.upper()
    hint = body.declarations.library_hint(name) or body.report.near(name, lambda: _known(body), "function")
    if body.declarations.find_type(name, node.span) in body.declarations.block_trees:
        hint = f" `{name}` is a FUNCTION_BLOCK: declare an instance in VAR and call that."
    if body.dialect.name == "rockwell" and key in _OF_LADDERS:
        hint = f" In Logix `{name}` is for ladders alone. {_OF_LADDERS[key]}"
    if key in ELEMENTARY:
        hint = f" `{name}` is a type; convert a value with TO_{key}(...)."
    return hint


def _known(body: Body) -> list[str]:
    """Names of functions."""
    return [*(pou.name for pou in body.pous.functions.values() if not pou.name.startswith("__")), *FUNCTIONS]


def _is_qualified_name(body: Body, callee: tree.Expression) -> bool:
    return isinstance(callee, tree.MemberOf) and is_qualified(body, callee)


def _no_value(body: Body, callee: tree.Expression) -> None:
    """Refuses an instance of a block that is called for a value."""
    place, _ = body.place(callee)
    if isinstance(place.type, Record):
        raise body.report.reject(
            "T010", f"This is an instance of {place.type}; call it as a statement, then use its outputs.",
            callee.span,
        )  # fmt: skip
