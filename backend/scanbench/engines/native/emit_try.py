"""__TRY: the statuses of traps go to a block of the function, which asks a table of the program whether they are caught."""

from collections.abc import Iterator
from contextlib import contextmanager

from scanbench.engines.native.emit_body import Body
from scanbench.engines.native.emit_function import UNLIKELY, Value
from scanbench.engines.native.emit_memory import store
from scanbench.engines.native.emit_places import address
from scanbench.program.layout import Layout
from scanbench.program.program import Try
from scanbench.program.types import UDINT

CODES = '@"trap.codes"'
"""i16 for each trap of the program by its number, from 0: what `Try.code` is given, 0 for what is not caught."""
GOES_ON, TRAPS = 0, 1
"""What comes after `Try.final`; further numbers are of the blocks that its statements leave to."""


class _Attempt:
    """One __TRY under way."""

    def __init__(self, body: Body) -> None:
        self.body = body
        self.text = body.text
        self.status = self.text.alloca("i32", 4)
        self.depth_at = self.text.address(body.image, Layout.DEPTH)
        self.tag = body.module.tag("#depth")
        self.depth = self.text.op(f"load i32, ptr {self.depth_at}, align 4{self.tag}")
        self.known = body.unit.flavour.tries(body)

    def caught(self, label: str) -> str:
        """Begins the block to which traps go; what is not caught leaves the function. Gives the code."""
        text = self.text
        look, handle, leave = text.name("look"), text.name("handle"), text.name("leave")
        text.begin(label)
        status = text.op(f"load i32, ptr {self.status}, align 4")
        text.choose(text.op(f"icmp sgt i32 {status}, 0"), look, leave)
        text.begin(leave)
        text.do(f"ret i32 {status}")
        text.begin(look)
        wide = text.op(f"zext nneg i32 {status} to i64")
        code = text.op(f"load i16, ptr {text.op(f'getelementptr i16, ptr {CODES}, i64 {wide}')}, align 2")
        text.choose(text.op(f"icmp eq i16 {code}, 0"), leave, handle, UNLIKELY)
        text.begin(handle)
        where = text.address(self.body.image, Layout.DEPTH)
        text.do(f"store i32 {self.depth}, ptr {where}, align 4{self.tag}")
        self.body.unit.flavour.caught(self.body, self.known)
        return text.op(f"zext i16 {code} to i32")


def run(body: Body, statement: Try) -> None:
    """Emits the statement."""
    text = body.text
    body.module.refer(CODES, "external constant [0 x i16], align 2")
    attempt = _Attempt(body)
    if statement.final:
        _with_final(body, statement, attempt)
        return
    trapped, after = text.name("trapped"), text.name("endtry")
    with text.catching(trapped, attempt.status):
        body.run(statement.body)
    text.go(after)
    _handle(body, statement, attempt, trapped)
    text.go(after)
    text.begin(after)


def _handle(body: Body, statement: Try, attempt: _Attempt, trapped: str) -> None:
    code = attempt.caught(trapped)
    store(body, address(body, statement.code), UDINT, Value(code))
    body.run(statement.handler)


def _with_final(body: Body, statement: Try, attempt: _Attempt) -> None:
    """What leaves the statements, or traps in the handler, is noted in a variable, and goes on after `final`."""
    text = body.text
    trapped, again, final, after = text.name("trapped"), text.name("again"), text.name("finally"), text.name("endtry")
    how = text.alloca("i32", 4)
    text.do(f"store i32 {GOES_ON}, ptr {how}, align 4")
    with _held(body) as ways:
        with text.catching(trapped, attempt.status):
            body.run(statement.body)
        text.go(final)
        with text.catching(again, attempt.status):
            _handle(body, statement, attempt, trapped)
        text.go(final)
    attempt.caught(again)
    text.do(f"store i32 {TRAPS}, ptr {how}, align 4")
    text.go(final)
    for number, (held, _) in enumerate(ways, TRAPS + 1):
        text.begin(held)
        text.do(f"store i32 {number}, ptr {how}, align 4")
        text.go(final)
    text.begin(final)
    body.run(statement.final)
    traps = text.name("traps")
    cases = [f"i32 {number}, label %{label}" for number, (_, label) in enumerate(ways, TRAPS + 1)]
    text.do(f"switch i32 {text.op(f'load i32, ptr {how}, align 4')}, label %{after} "
            f"[ i32 {TRAPS}, label %{traps} {' '.join(cases)} ]")  # fmt: skip
    text.begin(traps)
    text.go(text.fail(text.op(f"load i32, ptr {attempt.status}, align 4")))
    text.begin(after)


@contextmanager
def _held(body: Body) -> Iterator[list[tuple[str, str]]]:
    """Where statements may leave to, they go to blocks of their own meanwhile; gives each of these with where it stands for."""
    ways: list[tuple[str, str]] = []

    def hold(label: str) -> str:
        ways.append((body.text.name("held"), label))
        return ways[-1][0]

    leave, exits, rounds, labels = body.leave, body.exits, body.rounds, body.labels
    body.leave = hold(leave)
    body.exits, body.rounds = ([*each[:-1], *map(hold, each[-1:])] for each in (exits, rounds))
    body.labels = [hold(each) for each in labels]
    yield ways
    body.leave, body.exits, body.rounds, body.labels = leave, exits, rounds, labels
