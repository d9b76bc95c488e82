"""A golden project folder: what was written once still builds to the same program. See docs/formats.md."""

from pathlib import Path

from scanbench.check.build import check_sources
from scanbench.plcmodel.load import model_named
from scanbench.recording.fingerprints import program_digest
from scanbench.server.from_disk import program_files, project_model, read_text

GOLDEN = Path(__file__).with_name("golden") / "project"
DIGEST = "bbd97680df5d8e7a758e822fb079bd37d525d99362f5f47607c4338668a0f15b"
"""Of layout and first image; a run file of the project needs the same ones."""


def test_a_golden_project_still_builds_to_the_same_program() -> None:
    model = project_model(GOLDEN)
    assert model == "GENERIC-IEC"
    texts = {path.relative_to(GOLDEN).as_posix(): read_text(path) for path in program_files(GOLDEN)}
    assert set(texts) == {
        "Main.st", "blocks/Counter.iecst", "blocks/Double.exp", "blocks/Lamp.TcPOU", "errors.xml", "plant/Tank.st",
        "plant/inputs.csv",
    }  # fmt: skip
    built = check_sources(texts, model_named(model))
    assert built.program is not None
    assert built.problems == ()
    assert "pump-hot" in [each.id for each in built.program.layout.model.errors()]
    assert program_digest(built.program) == DIGEST
