"""Golden model files: what was written once is read as the same model for ever. See docs/formats.md."""

import json
import re
from pathlib import Path

import pytest

from scanbench.plcmodel.load import load_all, model_directory
from scanbench.plcmodel.model import Model
from scanbench.recording.fingerprints import model_fingerprint

GOLDEN = Path(__file__).with_name("golden")
FINGERPRINTS: dict[str, str] = json.loads((GOLDEN / "fingerprints.json").read_text("utf-8"))


@pytest.fixture(scope="module")
def golden(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Model]:
    """With today's schema."""
    directory = tmp_path_factory.mktemp("models")
    (directory / "model.xsd").write_bytes((model_directory() / "model.xsd").read_bytes())
    (directory / "golden").symlink_to(GOLDEN)
    models, problems = load_all(directory)
    assert problems == []
    return {model.name: model for model in models}


@pytest.mark.parametrize("name", FINGERPRINTS)
def test_a_golden_model_is_still_the_same(golden: dict[str, Model], name: str) -> None:
    assert model_fingerprint(golden[name]) == FINGERPRINTS[name]


def test_every_element_of_the_format_is_in_them() -> None:
    schema = (model_directory() / "model.xsd").read_text("utf-8")
    texts = "".join(path.read_text("utf-8") for path in GOLDEN.glob("*.xml"))
    elements = set(re.findall(r'<xs:element name="(\w+)"', schema)) - {"UserErrors"}  # those are a project's
    assert elements <= set(re.findall(r"<(\w+)", texts))
