"""What the project itself says of values outside of subranges: `subranges` in its `language.json`.

Where a pragma says something, that counts: the project's word is taken in its place where there is none.
"""

from collections.abc import Iterable

from scanbench.check.context import Report
from scanbench.check.declare.declarations import Declarations
from scanbench.check.declare.names import qualified
from scanbench.check.dialect import Dialect
from scanbench.problems import Span
from scanbench.program.origin import in_library, is_system
from scanbench.syntax import tree
from scanbench.syntax.language_file import WHOLE_PROJECT


def project_policy(declared: Declarations, name: str, span: Span) -> str:
    """What the project says of the variable or type of this name; '' where that is none of its own, or it says nothing."""
    if not declared.dialect.subranges:
        return ""
    declared.policed.add(name.upper())
    return _of(declared.dialect, name, span)


def pou_policy(dialect: Dialect, declaration: tree.PouDeclaration, around: tree.PouDeclaration | None) -> str:
    """What is said of the statements of a POU, or of a method in the block `around`: by a pragma, else by the project."""
    own = declaration.policy or _of(dialect, _name(declaration, around), declaration.span)
    block = "" if around is None else around.policy or _of(dialect, _name(around), around.span)
    return own or block or _of(dialect, WHOLE_PROJECT, declaration.span)


def check_policies(report: Report, declared: Declarations, files: Iterable[tree.File]) -> None:
    """Tells of names that nothing in the project has."""
    if not declared.dialect.subranges:
        return
    pous = {_name(each) for file in files for each in file.pous}
    methods = {_name(each, around) for file in files for around in file.pous for each in around.methods}
    known = {*declared.policed, *pous, *methods, WHOLE_PROJECT}
    for name, said in declared.dialect.subranges.items():
        if name not in known:
            report.error(
                "S003", f"There is no variable, type or POU `{name}` in this project, of which `subranges` says '{said.word}'. "
                "Variables are written with their POU, as Main.speed.", said.span,
            )  # fmt: skip


def _of(dialect: Dialect, name: str, span: Span) -> str:
    return "" if is_system(span) or in_library(span) else dialect.policy(name)


def _name(declaration: tree.PouDeclaration, around: tree.PouDeclaration | None = None) -> str:
    name = qualified(declaration.namespace, declaration.name)
    return (name if around is None else f"{qualified(around.namespace, around.name)}.{declaration.name}").upper()
