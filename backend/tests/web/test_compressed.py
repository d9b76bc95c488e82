"""Large answers come compressed to who can read that; what is compressed by itself does not."""

import zlib

import httpx

from scanbench.web.compressed import MIN_BYTES
from tests.web.server import Server
from tests.web.test_traces import made, paused, run


def raw(server: Server, path: str, accept: str = "gzip") -> tuple[httpx.Response, bytes]:
    """The answer, and its bytes as they were on the wire."""
    with server.http.stream("GET", path, headers={"Accept-Encoding": accept}) as reply:
        return reply, b"".join(reply.iter_raw())


def test_samples_and_json_are_small_on_the_wire_and_a_run_file_is_sent_as_it_is(server: Server) -> None:
    instance = paused(server, "pressed")
    trace = made(server, instance, scans=4000)["id"]
    run(server, instance, 2000)
    path = f"/api/instances/{instance}/traces/{trace}/samples"
    plain, whole = raw(server, path, "identity")
    pressed, few = raw(server, path)
    assert "Content-Encoding" not in plain.headers
    assert pressed.headers["Content-Encoding"] == "gzip"
    assert zlib.decompress(few, 31) == whole
    assert MIN_BYTES < 4 * len(few) < len(whole)
    assert raw(server, f"/api/instances/{instance}/traces")[0].headers.get("Content-Encoding") is None  # small
    assert raw(server, "/api/openapi.json")[0].headers["Content-Encoding"] == "gzip"
    assert raw(server, f"/api/instances/{instance}/export")[0].headers["Content-Encoding"] == "identity"
