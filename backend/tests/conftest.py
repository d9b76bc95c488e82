"""What every test shares: how hypothesis searches, that Ctrl-C reaches it, and that what takes long begins first."""

import gc
import os
import re
import signal
import time
from collections.abc import Callable, Iterator
from zlib import crc32

import pytest
from hypothesis import HealthCheck, settings

from scanbench.engines.native import jit
from scanbench.host.zygote import zygote
from tests.amounts import NIGHTLY, amount, slow

# The same examples on every run: a red test stays red until it is fixed. SCANBENCH_EXPLORE=1 goes looking for new ones.
settings.register_profile(
    "steady", max_examples=amount(300, 40), derandomize=True, deadline=None, database=None,
    suppress_health_check=[HealthCheck.too_slow],
)  # fmt: skip
settings.register_profile("explore", deadline=None, max_examples=1000, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("explore" if os.environ.get("SCANBENCH_EXPLORE") else "steady")

# A shell starts what it runs in the background with Ctrl-C ignored, and the tests of Ctrl-C would wait for ever.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

gc.disable()  # until everything is collected: looking for garbage among ten thousand tests finds none

LONG = ("tests/web/", "tests/test_", "tests/engines/")
"""Files of minutes: begun last, they would keep one worker at work alone."""


ENGINES = re.compile(r"(?<=[\[-])(native|reference)(?=[\]-])")


def of_the_other_engine(items: list[pytest.Item]) -> Iterator[pytest.Item]:
    """Of tests that run once on each engine the one or the other, by chance of the name: by day, one engine shows the fact. That the
    engines agree is for `tests/engines` and the cases."""
    pairs: dict[str, list[pytest.Item]] = {}
    for item in items:
        if not item.nodeid.startswith(OPTIMISED) and ENGINES.search(item.nodeid):
            pairs.setdefault(ENGINES.sub("engine", item.nodeid), []).append(item)
    for name, pair in pairs.items():
        if len(pair) == 2:
            yield pair[crc32(name.encode()) % 2]


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """The workers take whole files in this order, and end together. Slow tests are left out by day, unless one names them (`-m slow`)."""
    for item in of_the_other_engine(items):
        item.add_marker(slow)
    if not NIGHTLY and not config.option.markexpr:
        left_out = [item for item in items if item.get_closest_marker("slow") is not None]
        config.hook.pytest_deselected(items=left_out)
        items[:] = [item for item in items if item.get_closest_marker("slow") is None]
    items.sort(key=lambda item: not item.nodeid.startswith(LONG))


def pytest_collection_finish() -> None:
    """What there is now stays to the end: no search for garbage looks at it again."""
    gc.freeze()
    gc.enable()


OPTIMISED = ("tests/engines/", "tests/bench/", "tests/test_random", "tests/test_samples")
"""Whose programs LLVM optimises by day, too. Elsewhere a test runs the quick code that each PLC begins with: a third of what a case took was
the optimiser. By night all of those marked `nightly` or `slow`, the cases among them, run optimised code."""
_optimise = True


UNTIL = float(os.environ.get("SCANBENCH_UNTIL", "inf"))
"""Seconds since 1970, after which no test begins: CI has a limit, and would lose all that was found."""


def pytest_runtest_setup(item: pytest.Item) -> None:
    """Says what is compiled in this test, or that there is no time for it."""
    global _optimise
    if time.time() > UNTIL:
        pytest.skip("no time was left for it (SCANBENCH_UNTIL)")
    _optimise = NIGHTLY or item.nodeid.startswith(OPTIMISED)


Compile = Callable[[str, int, jit.Timings], bytes]


@pytest.fixture(scope="session", autouse=True)
def compiled_once() -> Iterator[Compile]:
    """LLVM makes the same code of the same text, and half of the texts come again: the samples, the cases, a program in a loop of
    tests. What always compiles is given to the tests of what the product keeps itself."""
    always, made = jit.compile_object, dict[str, bytes]()

    def once(ir: str, opt_level: int, timings: jit.Timings) -> bytes:
        level = opt_level if _optimise else 0
        key = jit.object_key(ir, level)
        if key not in made:
            made[key] = always(ir, level, timings)
        return made[key]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(jit, "compile_object", once)
        yield always


@pytest.fixture(scope="session", autouse=True)
def nothing_left_running() -> Iterator[None]:
    """Sessions that a test starts in this process fork from a process of its own."""
    yield
    zygote().close()
