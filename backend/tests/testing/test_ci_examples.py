"""The examples for CI: their commands are run, as far as no runner of GitHub or GitLab is needed."""

import subprocess
import sys
from pathlib import Path
from shutil import copytree
from typing import Any

import pytest
import yaml
from lxml import etree

import scanbench
from tests.amounts import slow

ROOT = Path(__file__).parents[3]
BIN = Path(sys.executable).parent
TEST = "def test_it(plc):\n    plc.run(5)\n    plc.raise_error('basic-io-error')\n    plc.within_scans(2, 'lamp')\n"


def commands(name: str) -> list[str]:
    content: dict[str, Any] = yaml.safe_load((ROOT / "ci" / name).read_text())
    if name.startswith("gitlab"):
        return list(content["plc"]["script"])
    return [
        each["run"] for each in content["jobs"]["test"]["steps"] if each.get("name") in ("check", "test", "campaign")
    ]


def run(command: str, folder: Path) -> subprocess.CompletedProcess[str]:
    path = {"PATH": f"{BIN}:/usr/bin:/bin"}
    return subprocess.run(command, shell=True, cwd=folder, capture_output=True, text=True, check=False, env=path)


@slow
@pytest.mark.parametrize("name", ["gitlab-ci.yml", "github-actions.yml"])
def test_its_commands_do_what_it_says(name: str, tmp_path: Path) -> None:
    copytree(Path(scanbench.__file__).parent / "samples" / "conveyor", tmp_path / "plc")
    (tmp_path / "tests").mkdir()
    (tmp_path / "tests" / "test_it.py").write_text(TEST)
    assert [each.split()[:2] for each in commands(name)] == [
        ["scanbench", "check"], ["pytest", "--scanbench-project"], ["scanbench", "campaign"]
    ]  # fmt: skip
    for command in commands(name):
        done = run(command, tmp_path)
        assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"
    assert 'failures="0"' in (tmp_path / "report.xml").read_text()
    campaign = etree.parse(tmp_path / "campaign.xml").getroot()
    assert (campaign.get("tests"), campaign.get("failures"), campaign.get("errors")) == ("100", "0", "0")
    allowed = [each for each in campaign.findall(".//skipped") if "are allowed" in str(each.get("message"))]
    assert 0 < len(allowed) <= 20
    stricter = commands(name)[2].replace("--allow 20", f"--allow {len(allowed) - 1}")
    assert run(stricter, tmp_path).returncode == 1
