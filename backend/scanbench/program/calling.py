"""Who calls: what an image keeps of the calls that lead to a violation, see `Layout.PATH_LIMIT`."""

from scanbench.program.program import Program


def callers(program: Program) -> list[int]:
    """Of each call of `Program.calls`, where it is noted who called the POU that has it: its `Pou.called_at`."""
    ends = [*(pou.first_call for pou in program.pous[1:]), len(program.calls)]
    found = [0] * len(program.calls)
    for pou, end in zip(program.pous, ends, strict=True):
        found[pou.first_call : end] = [pou.called_at] * (end - pou.first_call)
    return found
