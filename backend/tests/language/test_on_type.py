"""The layout of what is being typed, key by key."""

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from scanbench.language.format import formatted
from scanbench.language.on_type import Change, typed
from scanbench.language.reading import Readings
from tests.amounts import amount
from tests.caseformat import MODELS
from tests.language.reading import FILE
from tests.programs import generate

POU = """\
FUNCTION_BLOCK Valve
VAR_INPUT
  open : BOOL;
  wait : TIME := T#2s; // how long
END_VAR
VAR
  late   : TON;
  isOpen : BOOL;
END_VAR
  late(IN := open AND NOT isOpen,
    PT := wait);
  CASE step OF
    1, 2:
      IF late.Q THEN
        isOpen := TRUE;
      ELSIF NOT open THEN // comment; with a semicolon
        isOpen := FALSE;
      END_IF;
  ELSE
    step := 0;
  END_CASE;
  (* counts;
     in two lines *)
  REPEAT
    step := step + 1;
  UNTIL step > 3
  END_REPEAT;
END_FUNCTION_BLOCK

TYPE
  Phase : (idle, filling, draining);
  Recipe : STRUCT
    name   : STRING[20] := 'water; $'hot$'';
    amount : REAL;
  END_STRUCT;
END_TYPE
"""


class Typist:
    """Types into a text, and has what is finished formatted."""

    def __init__(self, text: str = "") -> None:
        self.readings, self.text, self.caret = Readings(MODELS["GENERIC-IEC"]), text, len(text)

    def type(self, keys: str) -> str:
        """Each key, and what is changed after it; the text afterwards."""
        for key in keys:
            self.text = self.text[: self.caret] + key + self.text[self.caret :]
            self.caret += 1
            line = self.text[: self.caret].rpartition("\n")[2].strip().upper()
            if key in "\n;" or line.startswith("END_"):
                self.take(typed(self.readings.read({FILE: self.text}), FILE, self.caret, key))
        return self.text

    def take(self, changes: list[Change]) -> None:
        """The caret stays between the characters where it is."""
        for each in reversed(changes):
            assert not self.text[each.start : each.end].count("\n")
            assert "\n" not in each.text
            self.text = self.text[: each.start] + each.text + self.text[each.end :]
            if each.end <= self.caret:
                self.caret += len(each.text) - (each.end - each.start)
            else:
                assert self.caret <= each.start, "the caret is in what is changed"


def test_a_text_in_its_layout_is_stored_as_it_is_typed() -> None:
    assert formatted(FILE, POU) == POU
    assert Typist().type(POU) == POU


def test_a_text_without_layout_gets_it_while_it_is_typed() -> None:
    bare = "\n".join(line.strip().replace(" := ", ":=").replace("   :", ":") for line in POU.split("\n"))
    assert Typist().type(bare.replace(",\nPT", ", PT")) == POU.replace(",\n    PT", ", PT").replace(
        "     in two", "in two"
    )
    lines = Typist().type(
        "program Main\nvar\nn:int;\nlonger:BOOL;\nend_var\nif n>1 then\nn:=0;\nend_if;\nend_program\n"
    )
    assert lines == (
        "PROGRAM Main\nVAR\n  n      : INT;\n  longer : BOOL;\nEND_VAR\n"
        "  IF n > 1 THEN\n    n := 0;\n  END_IF;\nEND_PROGRAM\n"
    )


@pytest.mark.parametrize(
    ("before", "key", "after"),
    [
        ("PROGRAM P\n  a:=1|", ";", "PROGRAM P\n  a := 1;"),
        ("PROGRAM P\n  a:=1|+b", ";", "PROGRAM P\n  a:=1;+b"),  # in the middle of something
        ("PROGRAM P\n  // a:=1|", ";", "PROGRAM P\n  // a:=1;"),
        ("PROGRAM P\n  s := 'a:=1|", ";", "PROGRAM P\n  s := 'a:=1;"),
        ("PROGRAM P\n  IF a THEN\n    b:=1;\n    END_I|", "F", "PROGRAM P\n  IF a THEN\n    b:=1;\n  END_IF"),
        ("PROGRAM P\n    END_I|", "F", "PROGRAM P\n    END_IF"),  # it ends nothing
        ("PROGRAM P\n  a :=\n    bEND_I|", "F", "PROGRAM P\n  a :=\n    bEND_IF"),
        ("PROGRAM P\n  a:=1;|", "\n", "PROGRAM P\n  a := 1;\n"),
        ("PROGRAM P\n  x:=1;\n  a:=1;|\n  b:=2;", "\n", "PROGRAM P\n  x:=1;\n  a := 1;\n\n  b:=2;"),  # the others stay
        ("PROGRAM P\n  a:=|b;", "\n", "PROGRAM P\n  a :=\nb;"),
        ("PROGRAM P\n    a := 1;\n    IF a THEN\n        b:=1|", ";", "PROGRAM P\n    a := 1;\n    IF a THEN\n        b := 1;"),
        ("PROGRAM P\nEND_PROGRAM // it:=1;|", "\n", "PROGRAM P\nEND_PROGRAM // it:=1;\n"),
        ("  PROGRAM P\n  END_PROGRAM|  // last", "\n", "  PROGRAM P\nEND_PROGRAM\n  // last"),
        ("|", "\n", "\n"),
    ],
)  # fmt: skip
def test_only_what_is_finished_is_changed(before: str, key: str, after: str) -> None:
    typist = Typist(before.replace("|", ""))
    typist.caret = before.index("|")
    assert typist.type(key) == after


def test_what_ends_a_block_has_the_block_formatted_with_enter() -> None:
    typist = Typist("PROGRAM P\n  x:=1;\nIF a THEN\nb:=1;\nEND_IF;")
    assert typist.type("\n") == "PROGRAM P\n  x:=1;\n  IF a THEN\n    b := 1;\n  END_IF;\n"


def test_a_random_program_is_stored_in_the_layout_in_which_it_is_typed() -> None:
    text = formatted(FILE, generate(0))
    assert text is not None
    assert Typist().type(text) == text


@settings(max_examples=amount(400, 20))
@given(st.text(alphabet="aE_NDIF;:=(*)/'\n\r ,\t{}", max_size=60), st.integers(0, 60), st.sampled_from("\n;F"))
@example("}", 1, ";")
def test_nothing_but_blanks_and_case_ever_changes(text: str, caret: int, key: str) -> None:
    typist = Typist(text)
    typist.caret = min(caret, len(text))
    plain = text[: typist.caret] + key + text[typist.caret :]
    made = typist.type(key)
    assert "".join(made.split()).upper() == "".join(plain.split()).upper()
    assert made.count("\n") == plain.count("\n")
