from collections.abc import Iterator

import pytest

from tests.web.server import Server


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    """One server for all tests here; each test makes its own project and instance."""
    with Server(tmp_path_factory.mktemp("bench")) as server:
        yield server
