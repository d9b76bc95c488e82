"""Writes `docs/features.md`."""

from tests.features import PAGE, page

PAGE.write_text(page(), "utf-8")
