"""Machine code in a process that has made none yet."""

import subprocess
import sys

import pytest

from bench import graphic
from scanbench.engines.native import jit
from scanbench.engines.native.emit_program import emit_program

AT_ONCE = """
import sys
from threading import Barrier, Thread
from scanbench.engines.native.engine import NativeEngine
from tests.engines.native.plc import check

sys.setswitchinterval(1e-6)
program = check("PROGRAM Main VAR n : INT; END_VAR n := n + 1; END_PROGRAM")
together, ended = Barrier(4), []

def first():
    together.wait()
    engine = NativeEngine(program, bytearray(program.layout.size), opt_level=0)
    ended.append(engine.run(3).reason.name)

threads = [Thread(target=first) for _ in range(4)]
for each in threads:
    each.start()
for each in threads:
    each.join()
print(ended)
"""


def test_several_threads_may_be_the_first() -> None:
    done = subprocess.run([sys.executable, "-c", AT_ONCE], capture_output=True, text=True, check=False)
    assert done.stdout.strip() == str(["DONE"] * 4), done.stderr


def test_logic_of_bools_is_not_joined_into_vectors(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(graphic, "RUNGS", 40)
    rungs, _ = graphic.programs()
    assert " x i1>" not in jit.optimised_text(emit_program(graphic.checked(rungs)))
