"""Which keywords belong to the one at the caret: in a text they are marked by brackets."""

import pytest

from scanbench.language.matching import keywords_at
from tests.language.reading import FILE, marked

IF = "PROGRAM Main {0}\nIF a THEN\n  IF b THEN c := 1; ELSE c := 2; END_IF;\nELSIF c THEN (* ELSE *)\n  s := 'ELSE';\nELSE\n  x := 1;\nEND_IF;\nEND_PROGRAM\n"


def shown(text: str) -> list[str]:
    """The lines with the keywords that belong together, those in brackets."""
    reading, position = marked(text)
    whole = reading.text(FILE)
    for start, end in reversed(keywords_at(reading, FILE, position)):
        whole = f"{whole[:start]}[{whole[start:end]}]{whole[end:]}"
    return [line.strip() for line in whole.splitlines() if "[" in line]


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        ("IF a", "|IF a", ["[IF] a THEN", "[ELSIF] c THEN (* ELSE *)", "[ELSE]", "[END_IF];"]),
        ("ELSE\n", "EL|SE\n", ["[IF] a THEN", "[ELSIF] c THEN (* ELSE *)", "[ELSE]", "[END_IF];"]),
        ("END_IF;\nEND", "END_IF|;\nEND", ["[IF] a THEN", "[ELSIF] c THEN (* ELSE *)", "[ELSE]", "[END_IF];"]),
        ("ELSE c", "ELSE| c", ["[IF] b THEN c := 1; [ELSE] c := 2; [END_IF];"]),
        ("PROGRAM M", "|PROGRAM M", ["[PROGRAM] Main {0}", "[END_PROGRAM]"]),
        ("c := 1", "|c := 1", []),
        ("(* ELSE", "(* E|LSE", []),
    ],
)
def test_the_keywords_of_a_block_belong_together(before: str, after: str, expected: list[str]) -> None:
    assert shown(IF.replace(before, after, 1)) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            "PROGRAM p\n__TRY\na := 1;\n__CAT|CH(e)\n__FINALLY\n__ENDTRY\nEND_PROGRAM",
            ["[__TRY]", "[__CATCH](e)", "[__FINALLY]", "[__ENDTRY]"],
        ),
        ("PROGRAM p\n|VAR\na : INT;\nEND_VAR\nEND_PROGRAM", ["[VAR]", "[END_VAR]"]),
        (
            "PROGRAM p\nCASE a OF\n1: b := 1;\nELSE\nb := 2;\nEND_CA|SE;\nEND_PROGRAM",
            ["[CASE] a OF", "[ELSE]", "[END_CASE];"],
        ),
        (
            "PROGRAM p\nREPEAT\na := 1;\n|UNTIL a > 1 END_REPEAT;\nEND_PROGRAM",
            ["[REPEAT]", "[UNTIL] a > 1 [END_REPEAT];"],
        ),
        ("TYPE t : STRUCT\na : INT;\nEND_STRUCT;\nEND_TY|PE", ["[TYPE] t : STRUCT", "[END_TYPE]"]),
        ("PROGRAM p\n|FOR i := 1 TO 2 DO\na := 1;\nEND_PROGRAM", ["[FOR] i := 1 TO 2 DO"]),
    ],
)
def test_of_other_blocks_too_also_while_the_end_is_missing(text: str, expected: list[str]) -> None:
    assert shown(text) == expected
