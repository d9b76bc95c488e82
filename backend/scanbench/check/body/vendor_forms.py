"""Operators of vendors that look like calls: `__POUNAME()`, `__QUERYINTERFACE(source, target)`, `XSIZEOF(x)` and others."""

from scanbench.check.body import fold
from scanbench.check.body.allowed import may, used
from scanbench.check.body.context import Body
from scanbench.check.body.interfaces import attempt
from scanbench.check.body.var_info import var_info
from scanbench.check.context import Rejected
from scanbench.check.dialect import Allowance
from scanbench.program.program import Const, Expr, Load, Sequence
from scanbench.program.types import BOOL, NULL
from scanbench.syntax import tree

WHY = {
    "__QUERYINTERFACE": "use `?=`",
    "__QUERYPOINTER": "use `?=`",
    "__VARINFO": "there is no information about variables at run time",
    "__POUNAME": "there is no information about POUs at run time",
    "__POSITION": "there is no information about positions at run time",
}
"""Why the strict language has none of these."""
UNSUPPORTED = {
    "INI": "initialise the variables with assignments",
    "BITADR": "write a bit of a variable, as `x.3`",
    "INDEXOF": "give the POUs numbers of their own",
    "__CURRENTTASK": "give the task a number of its own",
    "__XADD": "write `old := x; x := x + step;`, as tasks do not interrupt each other here",
    "__COMPARE_AND_SWAP": "write an IF and an assignment, as tasks do not interrupt each other here",
    "TEST_AND_SET": "write an IF and an assignment, as tasks do not interrupt each other here",
}
"""Operators of CODESYS and TwinCAT that no dialect has here, and what to do instead."""


def vendor_form(body: Body, node: tree.Call, name: str) -> Expr | None:
    """One of `WHY`, or what is not supported at all; None where the user declared something of that name."""
    if name in body.pous.functions or body.scope.find(name) is not None:
        return None
    if name in UNSUPPORTED:
        raise body.report.reject(
            "X001", f"`{name}` is an operator of CODESYS and TwinCAT that is not supported: {UNSUPPORTED[name]}.",
            node.callee.span,
        )  # fmt: skip
    if not may(body, Allowance.VENDOR_OPERATORS):
        raise body.report.reject("X001", f"`{name}` is not supported: {WHY[name]}.", node.callee.span)
    if name == "__VARINFO":
        return var_info(body, node)
    if name == "__POSITION":
        return _position(body, node)
    return _pou_name(body, node) if name == "__POUNAME" else _query(body, node, name)


def _position(body: Body, node: tree.Call) -> Expr:
    """`Line 3, Column 9 (Impl)`, `Line 3 (Decl)`."""
    if node.arguments:
        raise body.report.reject("T004", "`__POSITION` takes no arguments.", node.span)
    line, column = node.span.line, node.span.column
    words = ("Line", str(line), "(Decl)") if body.pou is None else ("Line", f"{line},", "Column", str(column), "(Impl)")
    where = " ".join(words)
    told = "`__POSITION()` is the place in this file, where the vendor's tool counts in the declaration or the implementation"
    used(body, Allowance.VENDOR_OPERATORS, node.span, told, f"`'{where}'`")
    return body.expression(tree.Literal("string", where.encode("latin-1"), None, node.span))


def _pou_name(body: Body, node: tree.Call) -> Expr:
    if node.arguments:
        raise body.report.reject("T004", "`__POUNAME` takes no arguments.", node.span)
    name = body.scope.pou or next((each.name for each in body.scope.constants), "")
    if not name or "$" in name or name.endswith((".get", ".set")):
        raise body.report.reject(
            "X001", "`__POUNAME` has a name in programs, blocks, functions and methods only.", node.span
        )
    used(body, Allowance.VENDOR_OPERATORS, node.span, "`__POUNAME()` is the name of this POU", f"`'{name}'`")
    return body.expression(tree.Literal("string", name.encode("latin-1", "replace"), None, node.span))


def _query(body: Body, node: tree.Call, name: str) -> Expr:
    values = [each.value for each in node.arguments if each.name is None and each.value is not None]
    if len(values) != 2 or len(node.arguments) != 2:
        raise body.report.reject(
            "T004", f"`{name}` takes two arguments, what is looked at and what is to refer to it.", node.span
        )
    source, target = values
    if body.pou is None:
        raise (
            Rejected
            if body.scope.constants
            else body.report.reject("X001", f"`{name}` assigns, so it is no constant.", node.span)
        )
    used(
        body,
        Allowance.VENDOR_OPERATORS,
        node.span,
        f"`{name}` assigns what it finds",
        "`?=` and a comparison with NULL",
    )
    tried = attempt(body, tree.Assignment(target, source, node.span, "?="))
    place, _ = body.place(target)
    return Sequence((tried,), fold.compare("ne", BOOL, Load(place), Const(NULL, 0)))
