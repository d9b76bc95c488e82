"""A program that gives no text to an instruction has a model without texts: it lies in memory as it always did."""

import pytest

from scanbench.check.build import check_sources
from scanbench.plcmodel.as_used import as_used, plain
from scanbench.recording.fingerprints import model_fingerprint, program_digest
from tests.runtime.bench import model

SAYING = (
    "FAL(N := 7, S := 'HOT');",
    "IF FALS(S := 'HOT', N := 7) THEN ; END_IF;",
    "FAL(N := ABS(x), s := 'A;)B');",
    "ok := fal(EN := TRUE, N := 7, S := said);",
    "MSG(3, 'x');",
    "url := 'http://plc'; FAL(N := 7, S := 'HOT');",
    "s := 'a (* b'; FAL(N := 7, S := 'HOT'); t := '*)';",
    's := "it$" //"; FAL(N := 7, S := \'HOT\');',
    "FAL(N := 7, (* ' *) S := 'HOT');",
    "FAL(N := LEN('it$'s ('), S := 'HOT');",
)
SILENT = (
    "FAL(7);",
    "IF FAL(7) THEN S := 5; END_IF;",
    "(* FAL(7, S := 'HOT') *) FAL(7);",
    "// MSG(1, 'x')\nFAL(7);",
    "/* MSG(1, 'x') */ FAL(7);",
    "FAL(N := Pick(S := 3));",
    "box.MSG(3);",
    "VAR msg : Printer; END_VAR msg(3);",
    "VAR first, msg : Printer; END_VAR msg(3);",
    "FUNCTION MSG : INT END_FUNCTION x := MSG(3);",
)


@pytest.mark.parametrize("text", SAYING)
def test_a_text_that_is_given_brings_its_memory(text: str) -> None:
    assert as_used(model(), [text]).area("MSGTEXT") is not None


@pytest.mark.parametrize("text", SILENT)
def test_what_gives_no_text_needs_no_memory(text: str) -> None:
    used = as_used(model(), [text])
    assert used.area("MSGTEXT") is None
    assert used is as_used(model(), ["n := n + 1;"])
    assert used.messages == ()


def test_the_device_is_the_same_with_texts_and_without() -> None:
    assert {model_fingerprint(each) for each in (model(), plain(model()), as_used(model(), ()))} == {
        model_fingerprint(model())
    }


def test_only_the_program_that_says_something_lies_otherwise() -> None:
    def digest(body: str) -> str:
        program = check_sources({"main.st": f"PROGRAM Main\n{body}\nEND_PROGRAM\n"}, model()).program
        assert program is not None
        return program_digest(program)

    assert digest("FAL(N := 7, S := 'HOT');") != digest("FAL(7);")


def test_a_code_for_the_reset_of_alarms_is_there_for_who_gives_one() -> None:
    nj = model("NJ501-1300")
    reset = {name: [each.code for each in as_used(nj, [name]).resets if each.name == "ResetAlarm"] for name in (
        "ResetAlarm();", "ResetAlarm(5);", "ResetAlarm(Code := 5);", "x := ResetAlarm( );",
    )}  # fmt: skip
    assert list(reset.values()) == [[""], ["Code"], ["Code"], [""]]
