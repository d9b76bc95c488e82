"""docker-compose.yml and Dockerfile: valid, and in step with the Makefile, the store and each other."""

import re
import shutil
import subprocess
from pathlib import Path
from typing import cast

import pytest
import yaml
from sqlalchemy.engine import make_url

from scanbench.web.auth import known_hosts

ROOT = Path(__file__).parents[3]
Tree = dict[str, object]


def sub(tree: Tree, *keys: str) -> Tree:
    for key in keys:
        inner = tree[key]
        assert isinstance(inner, dict), key
        tree = cast(Tree, inner)
    return tree


@pytest.fixture(scope="module")
def compose() -> Tree:
    loaded = yaml.safe_load((ROOT / "docker-compose.yml").read_text(encoding="utf-8"))
    assert isinstance(loaded, dict)
    return cast(Tree, loaded)


@pytest.fixture(scope="module")
def dockerfile() -> str:
    return (ROOT / "Dockerfile").read_text(encoding="utf-8")


def test_docker_itself_accepts_it_where_it_is_installed() -> None:
    """Without the compose plugin the tests below check the same file by its keys."""
    docker = shutil.which("docker")
    known = docker and subprocess.run([docker, "compose", "version"], capture_output=True, check=False).returncode == 0
    if not docker or not known:
        pytest.skip("docker with its compose plugin is not installed")
    command = [docker, "compose", "-f", str(ROOT / "docker-compose.yml"), "config", "--quiet"]
    checked = subprocess.run(command, capture_output=True, text=True, check=False)
    assert checked.returncode == 0, checked.stderr


def test_the_keys_are_those_of_the_format(compose: Tree) -> None:
    assert {key for key in compose if not key.startswith("x-")} <= {"name", "services", "volumes"}
    known = {
        "image",
        "build",
        "command",
        "environment",
        "depends_on",
        "ports",
        "volumes",
        "healthcheck",
        "restart",
        "hostname",
        "init",
    }
    for name in sub(compose, "services"):
        assert set(sub(compose, "services", name)) <= known, name


def test_everything_waits_for_a_healthy_database_and_its_migrations(compose: Tree) -> None:
    assert set(sub(compose, "services")) == {"db", "migrate", "web"}
    assert sub(compose, "services", "migrate", "depends_on", "db")["condition"] == "service_healthy"
    assert sub(compose, "services", "web", "depends_on", "migrate")["condition"] == "service_completed_successfully"
    for name in ("db", "web"):
        health = sub(compose, "services", name, "healthcheck")
        assert isinstance(health["test"], list)
        assert health["test"][0] == "CMD"


def test_the_bench_knows_the_name_by_which_a_proxy_in_the_network_asks_for_it(
    compose: Tree, monkeypatch: pytest.MonkeyPatch
) -> None:
    (name,) = (name for name in sub(compose, "services") if sub(compose, "services", name).get("command") == ["serve"])
    monkeypatch.setattr("socket.gethostname", lambda: sub(compose, "services", name).get("hostname", "1c9d0a6b55f2"))
    assert name in known_hosts(["0.0.0.0"])


def test_the_database_is_the_one_that_is_started(compose: Tree) -> None:
    made = sub(compose, "services", "db", "environment")
    for name in ("migrate", "web"):
        text = str(sub(compose, "services", name, "environment")["SCANBENCH_DATABASE"])
        url = make_url(re.sub(r"\$\{\w+:-(\w+)\}", r"\1", text))
        assert (url.drivername, url.host) == ("postgresql+psycopg", "db")
        assert (url.username, url.database) == (made["POSTGRES_USER"], made["POSTGRES_DB"])
        assert str(made["POSTGRES_PASSWORD"]) in text


def test_volumes_are_declared_and_only_this_machine_is_served(compose: Tree, dockerfile: str) -> None:
    declared = set(sub(compose, "volumes"))
    for name in ("db", "web"):
        mounts = sub(compose, "services", name)["volumes"]
        assert isinstance(mounts, list)
        assert {str(mount).split(":")[0] for mount in mounts} <= declared
    ports = sub(compose, "services", "web")["ports"]
    assert isinstance(ports, list)
    assert [str(port).split(":")[0] for port in ports] == ["127.0.0.1"]
    assert f"EXPOSE {str(ports[0]).split(':')[-1]}\n" in dockerfile


def test_the_image_is_built_by_the_makefile(dockerfile: str) -> None:
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    targets = re.findall(r"RUN make (\w+)", dockerfile)
    assert targets == ["setup"]
    assert re.search(r"^setup:", makefile, re.MULTILINE)
    assert "pip install" not in dockerfile
    assert "npm " not in dockerfile
    for line in re.findall(r"^COPY (?!--from)(.+)$", dockerfile, re.MULTILINE):
        for source in line.split()[:-1]:
            assert (ROOT / source).exists(), source


def test_what_the_services_start_is_known(compose: Tree, dockerfile: str) -> None:
    start = (ROOT / "docker" / "start").read_text(encoding="utf-8")
    assert "/app/docker/start" in dockerfile
    for name in ("migrate", "web"):
        command = sub(compose, "services", name)["command"]
        assert isinstance(command, list)
        assert f"  {command[0]}) " in start
    assert subprocess.run(["sh", "-n", str(ROOT / "docker" / "start")], check=False).returncode == 0
    unknown = subprocess.run([str(ROOT / "docker" / "start"), "nonsense"], capture_output=True, text=True, check=False)
    assert (unknown.returncode, unknown.stderr) == (2, "unknown: nonsense (migrate, serve or healthy)\n")
