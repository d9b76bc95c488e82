from collections.abc import Iterator

import pytest

from tests.web.server import Server


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    """One server for all tests here; each test makes its own project and instance."""
    with Server(tmp_path_factory.mktemp("bench")) as server:
        yield server


@pytest.fixture(autouse=True)
def _switched_off(request: pytest.FixtureRequest) -> Iterator[None]:
    """Switches off what a test let run, so that it does not slow down later tests."""
    yield
    if "server" in request.fixturenames:
        server = request.getfixturevalue("server")
        while server.made:
            instance = server.made.pop()
            reply = server.http.get(f"/api/instances/{instance}/verifications")
            for each in reply.json() if reply.is_success else []:  # a test may have deleted it
                server.http.delete(f"/api/verifications/{each['id']}")
            server.http.patch(f"/api/instances/{instance}", json={"power": False})
