"""The wheel: what it needs, what it brings, and that it runs by itself."""

import json
import os
import re
import shutil
import subprocess
import sys
import zipfile
from email import message_from_bytes
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
BUILD = "from hatchling.build import build_wheel; import sys; print(build_wheel(sys.argv[1]))"
LOOK = """
from scanbench.plcmodel.load import model_directory, model_named
from scanbench.web.pages import frontend_directory
print(model_directory(), model_named("CJ1M-CPU63").name, (frontend_directory() / "index.html").read_text(), sep="|")
"""


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Of a copy of the checkout, as the page need not be built here. Nothing is fetched."""
    checkout = tmp_path_factory.mktemp("checkout")
    backend = checkout / "backend"
    ignored = shutil.ignore_patterns("__pycache__", "tests", ".*", "bench")
    shutil.copytree(ROOT / "backend", backend, ignore=ignored)
    shutil.copytree(ROOT / "models", checkout / "models")
    shutil.copy(ROOT / "LICENSE", checkout)
    (checkout / "frontend" / "dist").mkdir(parents=True)
    (checkout / "frontend" / "dist" / "index.html").write_text("the page")
    (checkout / ".gitignore").write_text("/frontend/dist/\n")
    out = tmp_path_factory.mktemp("out")
    built = subprocess.run(
        [sys.executable, "-c", BUILD, str(out)], cwd=backend, capture_output=True, text=True, check=False
    )
    assert built.returncode == 0, built.stderr
    return out / built.stdout.splitlines()[-1]


def test_it_names_what_it_needs(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        metadata = message_from_bytes(archive.read(next(each for each in names if each.endswith("/METADATA"))))
    needs = [re.split(r"[^\w.-]", each)[0] for each in metadata.get_all("Requires-Dist", [])]
    lines = (ROOT / "backend" / "requirements.in").read_text().splitlines()
    wanted = {re.split(r"[^\w-]", line)[0] for line in lines if line and not line.startswith("#")} - {"hatchling"}
    assert set(needs) == wanted
    assert {
        "scanbench/share/LICENSE",
        "scanbench/share/models/model.xsd",
        "scanbench/share/frontend/index.html",
    } <= set(names)
    assert not [each for each in names if each.startswith(("tests/", "hatch_build"))]


def test_it_runs_with_its_own_models_and_page(wheel: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path)
    inherited = {name: each for name, each in os.environ.items() if not name.startswith("SCANBENCH_")}
    environment = inherited | {"PYTHONPATH": str(tmp_path)}

    def run(*args: str) -> str:
        done = subprocess.run(
            [sys.executable, *args], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
        return done.stdout.strip()

    assert run("-c", LOOK) == f"{tmp_path}/scanbench/share/models|CJ1M-CPU63|the page"
    sample = str(tmp_path / "scanbench" / "samples" / "conveyor")
    said = run("-c", "from scanbench.cli import main; main()", "run", sample, "--scans", "10", "--json")
    assert json.loads(said)["scans"] == 10
