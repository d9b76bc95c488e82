"""The wheel: what it needs, what it brings, and that it runs by itself."""

import json
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import venv
import zipfile
from collections.abc import Callable
from email import message_from_bytes
from pathlib import Path

import pytest

from scanbench import __version__
from tests.amounts import slow

ROOT = Path(__file__).parents[3]
BUILD = "from hatchling.build import build_wheel; import sys; print(build_wheel(sys.argv[1]))"
LOOK = """
from pathlib import Path
import scanbench
from scanbench.plcmodel.load import model_directory, model_named
from scanbench.web.pages import frontend_directory
package = Path(scanbench.__file__).parent
page = (frontend_directory() / "index.html").read_text()
print(package, model_directory(), model_named("CJ1M-CPU63").name, page, package / "samples" / "conveyor", sep="|")
"""
SERVE = """
import re, signal, subprocess, urllib.request
browser = urllib.request.build_opener(urllib.request.HTTPCookieProcessor())
command = ["scanbench", "serve", "--port", "0"]
with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as server:
    try:
        data = server.stderr.readline().strip()
        address = re.search("http://[^ ]+", server.stdout.readline().strip())[0]
        with browser.open(address) as reply:
            page = reply.read().decode()
    finally:
        server.send_signal(signal.SIGINT)
print(page, data, sep="|")
"""


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Of a copy of the checkout, as the page need not be built here. Nothing is fetched."""
    checkout = tmp_path_factory.mktemp("checkout")
    backend = checkout / "backend"
    ignored = shutil.ignore_patterns("__pycache__", "tests", ".*", "bench")
    shutil.copytree(ROOT / "backend", backend, ignore=ignored)
    shutil.copytree(ROOT / "models", checkout / "models")
    shutil.copytree(ROOT / "vscode", checkout / "vscode", ignore=shutil.ignore_patterns("node_modules"))
    for name in ("LICENSE", "CHANGELOG.md"):
        shutil.copy(ROOT / name, checkout)
    (checkout / "frontend" / "dist" / ".vite").mkdir(parents=True)
    (checkout / "frontend" / "dist" / ".vite" / "license.md").write_text("the licences")
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
    assert metadata["Version"] == __version__
    assert {
        "scanbench/share/LICENSE",
        "scanbench/share/NOTICES.md",
        "scanbench/share/CHANGELOG.md",
        f"scanbench/share/scanbench-{__version__}.vsix",
        "scanbench/samples/conveyor/Main.st",
        "scanbench/share/models/model.xsd",
        "scanbench/share/frontend/index.html",
    } <= set(names)
    assert not [each for each in names if each.startswith(("tests/", "hatch_build"))]


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The commands of a fresh environment with the wheel; what it needs comes from this one. Nothing is fetched."""
    environment = tmp_path_factory.mktemp("fresh")
    venv.create(environment, with_pip=False)
    scheme = {"base": str(environment), "platbase": str(environment)}
    site = Path(sysconfig.get_path("purelib", "venv", scheme))
    (site / "needs.pth").write_text(
        sysconfig.get_path("purelib") + "\n"
    )  # its own .pth files, such as our checkout's, do not count
    python = environment / "bin" / "python"
    pip = [sys.executable, "-m", "pip", "--python", str(python), "--quiet", "--disable-pip-version-check"]
    subprocess.run([*pip, "install", "--no-deps", "--no-index", str(wheel)], check=True)
    return environment / "bin"


@pytest.fixture
def run(installed: Path, tmp_path: Path) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Runs a command in an empty folder, with an empty home."""
    work = tmp_path / "empty"
    work.mkdir()
    inherited = {
        name: each for name, each in os.environ.items() if not name.startswith(("SCANBENCH_", "XDG_", "PYTHON"))
    }
    environment = inherited | {"HOME": str(tmp_path), "PATH": f"{tmp_path}:{installed}:/usr/bin:/bin"}

    def call(*arguments: str) -> subprocess.CompletedProcess[str]:
        command = [str(installed / arguments[0]), *arguments[1:]]
        return subprocess.run(command, cwd=work, env=environment, capture_output=True, text=True, check=False)

    return call


@slow
def test_it_runs_with_its_own_models_page_and_samples(
    run: Callable[..., subprocess.CompletedProcess[str]], installed: Path
) -> None:
    looked = run("python", "-c", LOOK)
    assert looked.returncode == 0, looked.stderr
    package, models, model, text, sample = looked.stdout.strip().split("|")
    assert Path(package).is_relative_to(installed.parent), "it is the wheel that runs, not the checkout"
    assert (models, model, text) == (f"{package}/share/models", "CJ1M-CPU63", "the page")
    assert run("scanbench", "--version").stdout == f"scanbench {__version__}\n"
    said = run("scanbench", "run", sample, "--scans", "10", "--json")
    assert json.loads(said.stdout)["scans"] == 10, said.stderr


@slow
def test_it_serves_from_an_empty_folder(run: Callable[..., subprocess.CompletedProcess[str]], tmp_path: Path) -> None:
    served = run("python", "-c", SERVE)
    assert served.returncode == 0, served.stderr
    page, data = served.stdout.strip().split("|")
    assert page == "the page"
    assert data == f"data in {tmp_path}/.local/share/scanbench"
    assert list((tmp_path / "empty").iterdir()) == [], "nothing is left in the working directory"


@slow
def test_it_puts_the_extension_into_vs_code(
    run: Callable[..., subprocess.CompletedProcess[str]], tmp_path: Path
) -> None:
    missing = run("scanbench", "vscode", "install")
    assert missing.returncode == 2
    assert "there is no command code on the PATH" in missing.stderr
    path = Path(missing.stderr.strip().rpartition(" ")[2])
    assert path.name == f"scanbench-{__version__}.vsix"
    assert path.is_file()
    code = tmp_path / "code"
    code.write_text('#!/bin/sh\necho "$@" > "$HOME/called"\n')
    code.chmod(0o755)
    done = run("scanbench", "vscode", "install")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "called").read_text() == f"--install-extension {path} --force\n"
