"""Loops, and the budget that ends those that never would."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import reduce
from typing import TypeAlias

from scanbench.engines.native import emit_deferred
from scanbench.engines.native.effects import keeps, plain
from scanbench.engines.native.emit_body import Body, counter_key
from scanbench.engines.native.emit_checks import is_outside, within_bounds
from scanbench.engines.native.emit_function import UNLIKELY, Value
from scanbench.engines.native.emit_memory import store
from scanbench.engines.native.emit_places import address, load, widened
from scanbench.engines.native.emit_strings import pick
from scanbench.engines.native.emit_types import elementary, value_type
from scanbench.engines.native.flavour import RUN
from scanbench.engines.native.ranges import within
from scanbench.program.layout import Layout
from scanbench.program.program import Base, Const, For, Place, Repeat, While
from scanbench.program.types import Elementary
from scanbench.program.untyped import bounds

Round: TypeAlias = "Callable[[Body, For, str, tuple[int, int], tuple[str, str]], None]"
I64 = (-(1 << 63), (1 << 63) - 1)


# ---- budget ---------------------------------------------------------------------------------------------------


def take(body: Body, rounds: str, trap: int) -> None:
    """Takes rounds from the scan's budget; traps where it falls below zero."""
    text, tag = body.text, body.module.tag("#budget")
    where = text.address(body.image, Layout.BUDGET)
    before = text.op(f"load i64, ptr {where}, align 8{tag}")
    left = pick(body, "ssub.sat", before, rounds)
    text.do(f"store i64 {left}, ptr {where}, align 8{tag}")
    text.trap_if(text.op(f"icmp slt i64 {left}, 0"), trap)


def take_all(body: Body, runs: str, further: str, trap: int) -> None:
    """Takes one round and `further` ones (unsigned), if the loop runs at all: up to 2 to the 64th, so it saturates."""
    text, tag = body.text, body.module.tag("#budget")
    where = text.address(body.image, Layout.BUDGET)
    before = text.op(f"load i64, ptr {where}, align 8{tag}")
    enough = text.op(f"icmp ult i64 {further}, {text.op(f'xor i64 {before}, {I64[0]}')}")
    after = text.op(f"sub i64 {text.op(f'sub i64 {before}, {further}')}, 1")
    saturated = text.op(f"select i1 {enough}, i64 {after}, i64 {I64[0]}")
    left = text.op(f"select i1 {runs}, i64 {saturated}, i64 {before}")
    text.do(f"store i64 {left}, ptr {where}, align 8{tag}")
    text.trap_if(text.op(f"icmp slt i64 {left}, 0"), trap)


# ---- WHILE, REPEAT ----------------------------------------------------------------------------------------------


@contextmanager
def _inside(body: Body, after: str, following: str) -> Iterator[None]:
    """EXIT and CONTINUE go to these blocks meanwhile."""
    body.exits.append(after)
    body.rounds.append(following)
    yield
    body.exits.pop()
    body.rounds.pop()


def while_loop(body: Body, loop: While) -> None:
    """WHILE: condition, budget, body."""
    text = body.text
    head, inside, done, after = text.name("while"), text.name("do"), text.name("done"), text.name("after")
    text.go(head)
    text.begin(head)
    text.choose(body.scalar(loop.condition).ssa, inside, done)
    text.begin(inside)
    take(body, "1", loop.trap)
    body.unit.flavour.goes(body, loop, 0)
    with _inside(body, after, head):
        body.run(loop.body)
    text.go(head)
    text.begin(done)
    body.unit.flavour.ends(body, loop)
    text.go(after)
    text.begin(after)


def repeat_loop(body: Body, loop: Repeat) -> None:
    """REPEAT: budget, body, condition."""
    text = body.text
    head, test, after = text.name("repeat"), text.name("until"), text.name("after")
    text.go(head)
    text.begin(head)
    take(body, "1", loop.trap)
    with _inside(body, after, test):
        body.run(loop.body)
    text.go(test)
    text.begin(test)
    text.choose(body.scalar(loop.until).ssa, after, head)
    text.begin(after)


# ---- FOR --------------------------------------------------------------------------------------------------------


def for_loop(body: Body, loop: For) -> None:
    """FOR: in two versions where that saves checks."""
    if not loop.given or body.unit.flavour is not RUN or body.farthest is not None:
        _for(body, loop)
        return
    text = body.text
    outside = reduce(
        lambda one, other: text.op(f"or i1 {one}, {other}"), (is_outside(body, *each) for each in loop.given)
    )
    outside_, inside, on = text.name("outside"), text.name("inside"), text.name("on")
    text.choose(outside, outside_, inside, UNLIKELY)
    for block, version in ((inside, loop.inside), (outside_, loop.body)):
        text.begin(block)
        _for(body, replace(loop, body=version, given=(), inside=()))
        text.go(on)
    text.begin(on)


def _for(body: Body, loop: For) -> None:
    """FOR: counts in 64 bits, so that narrower counters need no care at the ends of their range."""
    type = elementary(loop.variable.type)
    if loop.again:
        _compared(body, loop, type)
        return
    start, end = body.scalar(loop.start), body.scalar(loop.end)
    step = body.scalar(loop.step)
    by = int(loop.step.value) if isinstance(loop.step, Const) and not isinstance(loop.step.value, bytes) else 0
    low, high = min(start.low, end.low), max(start.high, end.high)
    if loop.follows:
        low, high = bounds(type)
    if by and within((low + min(by, 0), high + max(by, 0)), I64):
        _counted(body, loop, (start, end, by))
    else:
        _general(body, loop, (start, end, step), type)


def _counted(body: Body, loop: For, parts: tuple[Value, Value, int]) -> None:
    """The step is constant and the counter cannot leave 64 bits."""
    text, type = body.text, elementary(loop.variable.type)
    start, end, step = parts
    first, last = widened(body, start, type), widened(body, end, type)
    if not loop.exits:
        _take_counted(body, (first, last), parts, loop.trap)
    after, inner = text.name("after"), (start.low, end.high) if step > 0 else (end.low, start.high)
    if loop.follows:
        inner = bounds(type)

    def all_rounds(inside: Round) -> str:
        return _rounds(
            body,
            (first, last, step),
            lambda counter, latch: inside(body, loop, counter, inner, (after, latch)),
            left if loop.follows else None,
        )

    def left() -> str:
        return widened(body, load(body, loop.variable), type)

    counter = None
    if emit_deferred.deferrable(body, loop):
        twice = emit_deferred.repeatable(loop)
        again = _round if twice else _recorded
        counter = emit_deferred.rounds(body, lambda: all_rounds(_round), lambda: all_rounds(again), twice)
    if counter is None:
        counter = all_rounds(_round)
    body.unit.flavour.ends(body, loop)
    _store_counter(body, loop, counter, type)
    text.go(after)
    text.begin(after)


def _rounds(
    body: Body, count: tuple[str, str, int], inside: Callable[[str, str], None], left: Callable[[], str] | None
) -> str:
    """Emits the rounds; `inside` gets the counter and the block of the next round. `left` emits what the round left in the counter, where
    the body writes it, too. Gives the counter that failed the test."""
    text, (first, last, step) = body.text, count
    before, head, do, latch = text.block, text.name("for"), text.name("do"), text.name("next")
    done, next_value = text.name("done"), f"%{text.name('n')}"
    text.go(head)
    text.begin(head)
    counter = text.op(f"phi i64 [ {first}, %{before} ], [ {next_value}, %{latch} ]")
    text.choose(text.op(f"icmp {'sle' if step > 0 else 'sge'} i64 {counter}, {last}"), do, done)
    text.begin(do)
    again = latch if left is None else text.name("left")
    inside(counter, again)
    text.go(again)
    text.begin(again)
    reached = counter if left is None else left()
    if left is not None:  # which may be several blocks, and the head comes from one
        text.go(latch)
        text.begin(latch)
    text.do(f"{next_value} = add nsw i64 {reached}, {step}")
    text.go(head)
    text.begin(done)
    return counter


def _take_counted(body: Body, ends: tuple[str, str], parts: tuple[Value, Value, int], trap: int) -> None:
    start, end, step = parts
    if start.low == start.high and end.low == end.high:
        distance = (end.low - start.low) if step > 0 else (start.low - end.low)
        if distance // abs(step) < I64[1]:
            take(body, str(distance // abs(step) + 1 if distance >= 0 else 0), trap)
            return
    text = body.text
    a, b = ends if step > 0 else (ends[1], ends[0])
    distance_name = text.op(f"sub i64 {b}, {a}")
    runs = text.op(f"icmp sle i64 {a}, {b}")
    further = text.op(f"udiv i64 {distance_name}, {abs(step)}") if abs(step) > 1 else distance_name
    take_all(body, runs, further, trap)


def _round(body: Body, loop: For, counter: str, inner: tuple[int, int], leave: tuple[str, str]) -> None:
    """Stores the counter and runs the body, which may know the variable's value."""
    type, place = elementary(loop.variable.type), loop.variable
    value = _counter(body, loop, counter, inner)
    if loop.exits:
        take(body, "1", loop.trap)
    if not loop.again:
        _put(body, place, type, value)
    body.unit.flavour.goes(body, loop, 0)
    outer = body.counters
    written = body.unit.effects.written(loop.body)
    body.counters = {key: known for key, known in outer.items() if key[:2] != (place.base, place.offset)}
    stays = keeps(written, place) or _keeps_register(body, written, place)
    if stays and not body.unit.flavour.whole_image:
        body.counters[counter_key(place)] = value
    with _inside(body, *leave):
        body.run(loop.body)
    body.counters = outer


def _recorded(body: Body, loop: For, counter: str, inner: tuple[int, int], _leave: tuple[str, str]) -> None:
    """What the checks of a round record: see `emit_deferred`."""
    outer = body.counters
    body.counters = {**outer, counter_key(loop.variable): _counter(body, loop, counter, inner)}
    emit_deferred.record(body, loop)
    body.counters = outer


def _counter(body: Body, loop: For, counter: str, inner: tuple[int, int]) -> Value:
    type = elementary(loop.variable.type)
    low, high = max(inner[0], bounds(type)[0]), min(inner[1], bounds(type)[1])
    # a loop without rounds has no range; any will do then
    return _narrow(body, counter, type, "nsw " if type.signed else "nuw ", (min(low, high), max(low, high)))


def _put(body: Body, place: Place, type: Elementary, value: Value) -> None:
    where = address(body, place)
    store(body, where, type, value)
    body.unit.flavour.written(body, place, where)


def _keeps_register(body: Body, written: frozenset[str], place: Place) -> bool:
    """Whether it is a register that the code does not name: no reference leads to one."""
    own = plain(place) and place.base is Base.FRAME and place.offset in body.registers
    return own and place.variable not in ("", *written)


def _narrow(body: Body, counter: str, type: Elementary, flag: str, known: tuple[int, int]) -> Value:
    if type.bits == 64:
        return Value(counter, *known)
    ssa = body.text.op(f"trunc {flag}i64 {counter} to {value_type(type)}")
    return Value(ssa, *known, wide=counter)


def _store_counter(body: Body, loop: For, counter: str, type: Elementary) -> None:
    value = _narrow(body, counter, type, "", bounds(type))
    if loop.bounds is not None:
        value = within_bounds(body, value, type, loop.bounds)
    _put(body, loop.variable, type, value)


def _general(body: Body, loop: For, parts: tuple[Value, Value, Value], type: Elementary) -> None:
    """Any step, any width: the rounds are counted beforehand, so the counter may wrap."""
    text = body.text
    first, last, step = (widened(body, each, type) for each in parts)
    sign = "s" if type.signed else "u"
    up = text.op(f"icmp {sign}gt i64 {step}, 0")
    down = text.op(f"icmp slt i64 {step}, 0") if type.signed else "false"
    reachable_up = text.op(f"and i1 {up}, {text.op(f'icmp {sign}le i64 {first}, {last}')}")
    reachable_down = text.op(f"and i1 {down}, {text.op(f'icmp {sign}ge i64 {first}, {last}')}")
    runs = text.op(f"or i1 {reachable_up}, {reachable_down}")
    distance = text.op(f"select i1 {up}, i64 {text.op(f'sub i64 {last}, {first}')}, "
                       f"i64 {text.op(f'sub i64 {first}, {last}')}")  # fmt: skip
    size = text.op(f"select i1 {up}, i64 {step}, i64 {text.op(f'sub i64 0, {step}')}")
    divisor = pick(body, "umax", size, "1")
    further = text.op(f"udiv i64 {distance}, {divisor}")
    if not loop.exits:
        take_all(body, runs, further, loop.trap)
    _count_down(body, loop, (first, step, further, runs))


def _count_down(body: Body, loop: For, parts: tuple[str, str, str, str]) -> None:
    text, type = body.text, elementary(loop.variable.type)
    first, step, further, runs = parts
    before, head, latch = text.block, text.name("for"), text.name("next")
    done, after = text.name("done"), text.name("after")
    next_value, next_left = f"%{text.name('n')}", f"%{text.name('n')}"
    text.choose(runs, head, done)
    text.begin(head)
    counter = text.op(f"phi i64 [ {first}, %{before} ], [ {next_value}, %{latch} ]")
    left = text.op(f"phi i64 [ {further}, %{before} ], [ {next_left}, %{latch} ]")
    _round(body, loop, counter, bounds(type), (after, latch))
    text.go(latch)
    text.begin(latch)
    text.do(f"{next_value} = add i64 {counter}, {step}")
    text.do(f"{next_left} = sub i64 {left}, 1")
    text.choose(text.op(f"icmp eq i64 {left}, 0"), done, head)
    text.begin(done)
    final = text.op(f"phi i64 [ {first}, %{before} ], [ {next_value}, %{latch} ]")
    body.unit.flavour.ends(body, loop)
    _store_counter(body, loop, final, type)
    text.go(after)
    text.begin(after)


def _compared(body: Body, loop: For, type: Elementary) -> None:
    """End and step are computed for each round: a counter of up to 32 bits."""
    text = body.text
    first = widened(body, body.scalar(loop.start), type)
    before, head, do, left, latch = text.block, text.name("for"), text.name("do"), text.name("left"), text.name("next")
    done, after, next_value = text.name("done"), text.name("after"), f"%{text.name('n')}"
    text.go(head)
    text.begin(head)
    counter = text.op(f"phi i64 [ {first}, %{before} ], [ {next_value}, %{latch} ]")
    _put(body, loop.variable, type, _narrow(body, counter, type, "", bounds(type)))
    last, step = (widened(body, body.scalar(each), type) for each in (loop.end, loop.step))
    up, moves = text.op(f"icmp sgt i64 {step}, 0"), text.op(f"icmp ne i64 {step}, 0")
    upward, downward = (text.op(f"icmp {order} i64 {counter}, {last}") for order in ("sle", "sge"))
    within_end = text.op(f"select i1 {up}, i1 {upward}, i1 {downward}")
    text.choose(text.op(f"and i1 {moves}, {within_end}"), do, done)
    text.begin(do)
    _round(body, loop, counter, bounds(type), (after, left))
    text.go(left)
    text.begin(left)
    more = widened(body, body.scalar(loop.step), type)
    reached = widened(body, load(body, loop.variable), type) if loop.follows else counter
    text.go(latch)
    text.begin(latch)
    text.do(f"{next_value} = add nsw i64 {reached}, {more}")
    text.go(head)
    text.begin(done)
    body.unit.flavour.ends(body, loop)
    _store_counter(body, loop, counter, type)
    text.go(after)
    text.begin(after)
