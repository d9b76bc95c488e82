"""What `make coverage` prints."""

import pytest

from tests.covered import lines


def test_files_that_the_tests_reach_less_are_named() -> None:
    files = {"a.py": 100.0, "b.py": 79.9, "c.py": 12, "d.py": 80.0}
    told = {
        "totals": {"percent_covered": 91.27},
        "files": {name: {"summary": {"percent_covered": share}} for name, share in files.items()},
    }
    assert list(lines(told)) == ["The tests run 91.3 % of the backend's lines.", " 12.0 %  c.py", " 79.9 %  b.py"]


def test_anything_else_is_refused() -> None:
    with pytest.raises(ValueError, match="no report"):
        list(lines({}))
