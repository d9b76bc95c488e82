"""Where a server listens, and where its data are: the command line wins over the environment, that over the settings file."""

import os
import stat
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from scanbench.cli.inputs import usage
from scanbench.testing.said import with_near

HERE = Path("data")
"""The folder of a server that was started here before there was a place for data; it is kept where it is."""
_MARKS = ("scanbench.db", "token")
"""What a server leaves in its folder."""
_LARGEST_PORT = 65535


@dataclass(frozen=True, slots=True)
class Settings:
    """What `scanbench serve` needs to begin."""

    host: str
    port: int | None
    data: Path


def settings(host: str | None, port: int | None, data: Path | None) -> Settings:
    """What was given (on the command line, or by SCANBENCH_HOST, _PORT, _DATA), else what the file says, else the defaults."""
    if host is not None and port is not None and data is not None:
        return Settings(host, port, data)  # a service may have no home
    known = read_config(config_file(os.environ))
    return Settings(
        known.get_text("host", "127.0.0.1") if host is None else host,
        known.get_port() if port is None else port,
        (known.get_folder() or default_data(os.environ)) if data is None else data,
    )


def config_file(environment: Mapping[str, str]) -> Path:
    """`$XDG_CONFIG_HOME/scanbench/config.toml`; the file need not be there."""
    return _base(environment, "XDG_CONFIG_HOME", ".config") / "scanbench" / "config.toml"


def default_data(environment: Mapping[str, str]) -> Path:
    """`$XDG_DATA_HOME/scanbench` for every working directory, unless a server of this user has used `./data`."""
    if any((HERE / mark).exists() for mark in _MARKS) and _is_ours(HERE):
        return HERE
    return _base(environment, "XDG_DATA_HOME", ".local/share") / "scanbench"


def _base(environment: Mapping[str, str], name: str, usual: str) -> Path:
    """A base directory; one that is not absolute does not count (XDG Base Directory Specification)."""
    named = environment.get(name, "")
    return Path(named) if os.path.isabs(named) else _at_home("~") / usual


def _at_home(path: str) -> Path:
    """With the home directory for `~`."""
    try:
        return Path(path).expanduser()
    except RuntimeError:
        usage(f"{path}: there is no such home directory: set HOME, or give --host, --port and --data")


def _is_ours(folder: Path) -> bool:
    """Whether nobody else can write there: its programs are run, and its token opens the door."""
    state = folder.stat()
    return state.st_uid == os.getuid() and not state.st_mode & (stat.S_IWGRP | stat.S_IWOTH)


@dataclass(frozen=True, slots=True)
class Config:
    """The settings file as it was read."""

    path: Path
    values: Mapping[str, object]

    def get_text(self, key: str, default: str) -> str:
        """A text, `default` where the file has none."""
        value = self.values.get(key, default)
        if not isinstance(value, str) or not value:
            usage(f"{self.path}: {key} = {value!r}: write a text in quotation marks")
        return value

    def get_port(self) -> int | None:
        """The port, if one is named."""
        value = self.values.get("port")
        if value is None:
            return None
        if not isinstance(value, int) or isinstance(value, bool) or not 0 <= value <= _LARGEST_PORT:
            usage(f"{self.path}: port = {value!r}: write a number from 0 to {_LARGEST_PORT}")
        return value

    def get_folder(self) -> Path | None:
        """The folder of the data, if one is named."""
        if "data" not in self.values:
            return None
        folder = _at_home(self.get_text("data", ""))
        if not folder.is_absolute():
            usage(f"{self.path}: data = {str(folder)!r}: write a path that begins with / or ~")
        return folder


KEYS = ("data", "host", "port")


def read_config(path: Path) -> Config:
    """An empty one where there is no file."""
    try:
        values = tomllib.loads(path.read_text("utf-8"))
    except FileNotFoundError:
        return Config(path, {})
    except OSError as error:
        usage(f"{path} cannot be read: {error.strerror}")
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        usage(f"{path}: {error}")
    for key in values:
        if key not in KEYS:
            usage(with_near(f"{path}: there is no setting {key}", KEYS))
    return Config(path, values)
