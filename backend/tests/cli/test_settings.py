"""Where a server listens and keeps its data: command line over environment over file over default."""

from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner

from scanbench.cli.commands import app
from scanbench.cli.settings import Settings, config_file, default_data, settings


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty home, which is the working directory."""
    for name in ("SCANBENCH_HOST", "SCANBENCH_PORT", "SCANBENCH_DATA", "XDG_CONFIG_HOME", "XDG_DATA_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def write(home: Path, text: str) -> Path:
    path = home / ".config" / "scanbench" / "config.toml"
    path.parent.mkdir(parents=True)
    path.write_text(text, "utf-8")
    return path


def test_without_anything_the_data_lie_at_one_place(home: Path) -> None:
    assert settings(None, None, None) == Settings("127.0.0.1", None, home / ".local/share/scanbench")


def test_the_base_directories_can_be_others(home: Path) -> None:
    assert config_file({"XDG_CONFIG_HOME": "/etc/xdg"}) == Path("/etc/xdg/scanbench/config.toml")
    assert default_data({"XDG_DATA_HOME": "/srv"}) == Path("/srv/scanbench")
    assert default_data({"XDG_DATA_HOME": "not/absolute"}) == home / ".local/share/scanbench"


@pytest.mark.parametrize(("mark", "kept"), [("scanbench.db", True), ("token", True), ("measured.csv", False)])
def test_a_folder_that_a_server_has_used_is_kept(home: Path, mark: str, kept: bool) -> None:
    (home / "data").mkdir()
    (home / "data" / mark).touch()
    assert (settings(None, None, None).data == Path("data")) is kept


def test_the_file_gives_what_is_not_given(home: Path) -> None:
    write(home, 'host = "0.0.0.0"\nport = 9000\ndata = "~/bench"\n')
    assert settings(None, None, None) == Settings("0.0.0.0", 9000, home / "bench")
    assert settings("::1", 0, Path("here")) == Settings("::1", 0, Path("here"))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("prt = 9000", "there is no setting prt. Near: data, host, port."),
        ('port = "9000"', "port = '9000': write a number from 0 to 65535"),
        ("port = 70000", "port = 70000: write a number"),
        ("host = 7", "host = 7: write a text in quotation marks"),
        ('data = "bench"', "data = 'bench': write a path that begins with / or ~"),
        ("port = = 1", "Invalid value (at line 1"),
    ],
)
def test_what_is_wrong_in_the_file_is_said(
    home: Path, capsys: pytest.CaptureFixture[str], text: str, message: str
) -> None:
    path = write(home, text)
    with pytest.raises(typer.Exit) as ended:
        settings(None, None, None)
    assert ended.value.exit_code == 2
    assert f"scanbench: {path}: {message}" in capsys.readouterr().err


def test_the_command_line_wins_over_the_environment_and_that_over_the_file(
    home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(home, 'host = "0.0.0.0"\nport = 9000\ndata = "~/bench"\n')
    served: list[tuple[object, ...]] = []
    monkeypatch.setattr("scanbench.web.serve.serve", lambda *given, public: served.append(given[:3]))
    environment = {"SCANBENCH_PORT": "9001", "SCANBENCH_DATA": str(home / "other")}
    said = CliRunner().invoke(app, ["serve", "--port", "9002"], env=environment)
    assert said.exit_code == 0, said.output
    assert served == [("0.0.0.0", 9002, home / "other")]
    assert f"data in {home / 'other'}" in said.stderr
    wrong = CliRunner().invoke(app, ["serve"], env={"SCANBENCH_PORT": "many"})
    assert wrong.exit_code == 2
    assert "SCANBENCH_PORT" in wrong.stderr


def test_a_folder_in_which_others_can_write_is_not_taken_for_ours(home: Path) -> None:
    folder = home / "data"
    folder.mkdir()
    (folder / "token").touch()
    folder.chmod(0o777)
    assert settings(None, None, None).data == home / ".local/share/scanbench"


def test_who_says_everything_needs_no_home(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def homeless(_: Path) -> Path:
        raise RuntimeError

    monkeypatch.setattr(Path, "expanduser", homeless)
    assert settings("::1", 0, Path("/srv")) == Settings("::1", 0, Path("/srv"))
    with pytest.raises(typer.Exit):
        settings("::1", 0, None)
    assert "set HOME, or give --host, --port and --data" in capsys.readouterr().err
