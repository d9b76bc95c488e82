"""A PLC of a running server, for scripts and tests in Python.

    from scanbench.client import connect

    plc = connect("http://127.0.0.1:8700/?token=...").plc("line-1")
    plc.write("Main.buffer.level", 3)     # an in-out goes to what it is bound to; the answer says where
    assert plc.read("bufferLevel") == "3"
    with plc.forced("D100", 5):
        plc.run(scans=10)

Everything goes through the server's REST API, and so through the one door: the journal names you. Values come and go as
they are typed in the watch table: `TRUE`, `42`, `T#5s`, `'text'`. Results are dictionaries whose fields are typed and
described in `scanbench.client.shapes`.
"""

from scanbench.client.asking import Json, Refused
from scanbench.client.requests.base import Value
from scanbench.client.requests.traces import Samples
from scanbench.client.requests.verification import verdict
from scanbench.client.requests.watching import Frame
from scanbench.client.waiting import Debugger, Plc, Server, Watch, connect

__all__ = [
    "Debugger", "Frame", "Json", "Plc", "Refused", "Samples", "Server", "Value", "Watch", "connect", "verdict",
]  # fmt: skip
