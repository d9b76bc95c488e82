"""Where LLVM is missing the reference engine runs the program, and says so."""

import subprocess
import sys

_WITHOUT_LLVM = """
import sys
sys.modules["llvmlite"] = None
from scanbench.host.build import find_engines
engines = find_engines(None)
print(engines.tiers, "|", engines.message)
"""


def test_fallback_without_llvm() -> None:
    said = subprocess.run([sys.executable, "-c", _WITHOUT_LLVM], capture_output=True, text=True, check=True).stdout
    assert said.startswith("None |")
    assert "LLVM is missing" in said
