"""Labels and JMP in Structured Text, where the dialect has them: a jump leads to a label among the statements of the POU itself."""

from scanbench.check.body.allowed import allowed
from scanbench.check.body.catching import leaves
from scanbench.check.body.context import Body
from scanbench.check.dialect import Allowance
from scanbench.program.program import Jump
from scanbench.program.sites import TrapKind
from scanbench.syntax import tree


def parted(body: Body, written: tuple[tree.Statement, ...]) -> list[tuple[tree.Statement, ...]]:
    """The statements from each label to the next one; the first part comes before all labels. Notes the labels."""
    parts: list[list[tree.Statement]] = [[]]
    body.labels, body.block = {}, 0
    for node in written:
        if not isinstance(node, tree.LabelStatement):
            parts[-1].append(node)
            continue
        if Allowance.LABELS not in body.dialect.allows:
            parts[-1].append(node)  # to be refused
            continue
        if node.name.upper() in body.labels:
            body.report.error("D001", f"`{node.name}` is declared already; rename one.", node.span)
        body.labels[node.name.upper()] = len(parts)
        parts.append([])
    return [tuple(each) for each in parts]


def jump(body: Body, node: tree.LabelStatement | tree.JumpStatement) -> Jump:
    """A jump; a label that is met here is not among the statements of the POU itself."""
    if Allowance.LABELS not in body.dialect.allows:
        if isinstance(node, tree.JumpStatement):
            raise body.report.reject("X001", "JMP is not supported; use IF and loops.", node.span)
        message = f"`{node.name}:` is a label to jump to, which is not supported; use IF and loops."
        raise body.report.reject("X001", message, node.span)
    if isinstance(node, tree.LabelStatement):
        raise body.report.reject(
            "X001",
            f"The label `{node.name}` is inside of an IF, CASE, loop or __TRY, and no jump leads into one. Put it before or after that.",
            node.span,
        )
    leaves(body, "JMP", node.span)
    target = body.labels.get(node.name.upper())
    if target is None:
        raise body.report.reject(
            "T001",
            f"There is no label `{node.name}` to jump to: labels are statements of the POU itself, outside of IF, CASE and loops.",
            node.span,
        )
    allowed(body, Allowance.LABELS, node.span, f"This jumps to `{node.name}`")
    trap = body.trap(TrapKind.LOOP, node.span, f"the jumps to {node.name} do not end")
    return Jump(target, target <= body.block, trap, node.span)
