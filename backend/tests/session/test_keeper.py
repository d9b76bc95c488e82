"""A session without a database."""

import subprocess
import sys

_LOADED = """
import sys
import scanbench.web.dap.stdio
print(sorted(each for each in sys.modules if each in ("sqlalchemy", "alembic")))
"""


def test_a_debug_adapter_loads_no_database() -> None:
    """It is a third of what its start takes, and somebody waits for that in an editor."""
    assert subprocess.run([sys.executable, "-c", _LOADED], capture_output=True, text=True, check=True).stdout == "[]\n"
