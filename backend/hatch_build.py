"""What the package is built with: its dependencies are those of requirements.in, models and the built page go into it."""

import re
import sys
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.config import BuilderConfig
from hatchling.builders.hooks.plugin.interface import BuildHookInterface
from hatchling.metadata.plugin.interface import MetadataHookInterface

SHARE = "scanbench/share"
"""Where the package looks for what stands beside `backend` in a checkout."""
BUILDS = "hatchling"
"""Needed to build, and not to run."""
BROUGHT = (
    ("models", "models", "model.xsd"),
    ("frontend/dist", "frontend", "index.html"),
    ("frontend/dist/.vite/license.md", "NOTICES.md", ""),
    ("LICENSE", "LICENSE", ""),
    ("CHANGELOG.md", "CHANGELOG.md", ""),
)
"""Place in the checkout, name in the package, and a file in it without which it is not there."""


class Dependencies(MetadataHookInterface):
    """Listed in requirements.in only, so that two lists cannot disagree."""

    PLUGIN_NAME = "custom"

    def update(self, metadata: dict[str, Any]) -> None:
        """See hatchling."""
        lines = (line.partition("#")[0].strip() for line in Path(self.root, "requirements.in").read_text().splitlines())
        metadata["dependencies"] = [line for line in lines if line and re.split(r"\W", line)[0] != BUILDS]


class Share(BuildHookInterface[BuilderConfig]):
    """Not in an editable install: that looks into the checkout."""

    PLUGIN_NAME = "custom"
    _packed: "tempfile.TemporaryDirectory[str] | None" = None

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """See hatchling."""
        if version == "editable":
            return
        checkout = Path(self.root).parent
        for path, name, mark in BROUGHT:
            if (checkout / path / mark).exists():  # a source distribution has them in their place already
                build_data["force_include"][str(checkout / path)] = f"{SHARE}/{name}"
        if (checkout / "vscode" / "package.json").exists():
            sys.path.insert(0, self.root)
            from scanbench.cli.vsix import NAME, pack

            self._packed = tempfile.TemporaryDirectory()
            path = Path(self._packed.name, NAME)
            path.write_bytes(pack(checkout / "vscode"))
            build_data["force_include"][str(path)] = f"{SHARE}/{NAME}"

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """See hatchling."""
        if self._packed is not None:
            self._packed.cleanup()
