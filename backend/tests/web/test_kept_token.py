"""The token of a data directory."""

from pathlib import Path

import pytest

from scanbench.web.kept_token import FILE, kept_token


def test_it_stays_and_is_nobody_elses(tmp_path: Path) -> None:
    token = kept_token(tmp_path)
    assert kept_token(tmp_path) == token
    assert (tmp_path / FILE).stat().st_mode & 0o777 == 0o600


@pytest.mark.parametrize("spoilt", [b"", b"short\n", b"\xff\xfe" * 20, b"a b" * 20])
def test_a_spoilt_one_is_replaced(tmp_path: Path, spoilt: bytes) -> None:
    (tmp_path / FILE).write_bytes(spoilt)
    token = kept_token(tmp_path)
    assert len(token) >= 20
    assert kept_token(tmp_path) == token


def test_directories_differ(tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
    assert kept_token(tmp_path / "a") != kept_token(tmp_path / "b")
