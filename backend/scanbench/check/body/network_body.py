"""A body of networks, rungs and function block diagrams, -> checked statements."""

from scanbench.check.body.context import Body
from scanbench.check.body.diagram import FunctionBlocks
from scanbench.check.body.ladder import Ladder
from scanbench.check.body.network_code import NetworkCode
from scanbench.program.program import Stmt
from scanbench.syntax import networks


def network_statements(body: Body, written: networks.NetworkBody) -> tuple[Stmt, ...]:
    """The networks from top to bottom."""
    code = NetworkCode(body, written)
    ladder, diagrams = Ladder(code), FunctionBlocks(code)
    for each in written.networks:
        code.begin(each)
        if each.off:
            continue
        if isinstance(each, networks.Rung):
            ladder.rung(each)
        else:
            diagrams.diagram(each)
        code.end()
    return code.whole()
