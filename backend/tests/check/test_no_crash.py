"""Whatever is typed is answered with problems, never with a crash or an endless wait."""

from hypothesis import given, settings
from hypothesis import strategies as st

from scanbench.check.build import check_sources
from tests.amounts import amount
from tests.caseformat import MODELS

WORDS = """PROGRAM Main END_PROGRAM VAR END_VAR VAR_INPUT VAR_IN_OUT VAR_GLOBAL FUNCTION F END_FUNCTION FUNCTION_BLOCK B END_FUNCTION_BLOCK
TYPE END_TYPE STRUCT END_STRUCT METHOD END_METHOD x y a : INT BOOL REAL STRING [ ] ( ) , ; ; ; := => .. . + - * / ** = <> < AND NOT MOD ARRAY OF
IF THEN ELSE ELSIF END_IF CASE END_CASE FOR TO BY DO END_FOR WHILE END_WHILE REPEAT UNTIL END_REPEAT EXIT RETURN 1 2 0 16#FF 1.5 T#5s 'text' TRUE
AT %MW3 %IX0.0 CONFIGURATION RESOURCE TASK WITH END_CONFIGURATION INT#5 TON t ABS CONCAT INT_TO_REAL # ^ ? ' (* *) { } CONSTANT""".split()


@settings(max_examples=amount(600, 100), deadline=None, derandomize=True)
@given(st.lists(st.sampled_from(WORDS), max_size=60).map(" ".join))
def test_any_words(text: str) -> None:
    check_sources({"a.st": text}, MODELS["GENERIC-IEC"])


@settings(max_examples=amount(400, 66), deadline=None, derandomize=True)
@given(st.lists(st.sampled_from(WORDS), max_size=40).map(" ".join))
def test_any_words_in_a_body(text: str) -> None:
    source = f"PROGRAM Main\nVAR x, y : INT; a : ARRAY[1..3] OF INT; t : TON; END_VAR\n{text}\nEND_PROGRAM"
    check_sources({"a.st": source}, MODELS["GENERIC-IEC"])


@settings(max_examples=amount(400, 66), deadline=None, derandomize=True)
@given(st.text(max_size=80))
def test_any_text(text: str) -> None:
    check_sources({"a.st": text, "b.st": f"PROGRAM Main\n{text}\nEND_PROGRAM"}, MODELS["CJ1M-CPU63"])
