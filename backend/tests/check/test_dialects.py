"""Dialects: what each allows and how it is told, what stays refused, and where a project says which it is."""

from pathlib import Path

import pytest

from scanbench.check.build import Checked, check_sources
from scanbench.check.dialect import Allowance
from scanbench.check.dialect_rules import RULES
from scanbench.check.dialect_table import DIALECTS
from scanbench.check.incremental import Checks
from scanbench.check.typed.condition import BadCondition, Condition, compile_condition
from scanbench.problems import Severity
from scanbench.runtime.header import Mode, fresh_image
from scanbench.runtime.migrate_image import migrate
from scanbench.symbols.symbols import resolve
from scanbench.symbols.values import parse_value, python_value
from scanbench.syntax.language_file import (
    DIALECTS as NAMES,
)
from scanbench.syntax.language_file import (
    LANGUAGE_FILE,
    DialectName,
    Language,
    dialect_of,
    guess_dialect,
    language_of,
    language_text,
    with_dialect,
    with_dialect_by_format,
    with_namespaces,
)
from tests.caseformat import MODELS

MODEL = MODELS["GENERIC-IEC"]
DOCS = Path(__file__).parents[3] / "docs"
HEAD = """TYPE State : (Off, On); END_TYPE
FUNCTION_BLOCK Unit
VAR level : INT; END_VAR
METHOD reset
level := 0;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION Part : STRING
VAR_INPUT text : STRING; count : INT; END_VAR
Part := LEFT(text, count);
END_FUNCTION
PROGRAM Main
VAR
  b : BYTE; w : WORD; dw : DWORD; i, j : INT; u : UINT; d : DINT; r : REAL; l : LREAL; s : STRING; ok : BOOL; state : State; t : TIME;
  c : CHAR; timer : TON;
  unit : Unit; numbers : ARRAY[1..3] OF INT;
END_VAR
"""
LINE = HEAD.count("\n") + 1

USES = [
    (Allowance.BIT_NUMBERS, "ok := b > u;", "BYTE_TO_USINT"),
    (Allowance.BIT_NUMBERS, "i := numbers[b];", "BYTE_TO_USINT"),
    (Allowance.BIT_NUMBERS, "s := LEFT(s, b);", "BYTE_TO_USINT"),
    (Allowance.BIT_NUMBERS, "FOR b := 1 TO 3 DO i := i + 1; END_FOR", "b : USINT"),
    (Allowance.BIT_NUMBERS, "t := t * w;", "WORD_TO_UINT"),
    (Allowance.STRING_FROM_ZERO, "ok := s[i] = 65;", "i + 1"),
    (Allowance.STRING_BYTES, "s[i] := 65;", "REPLACE"),
    (Allowance.BIT_CONVERSION, "i := w;", "WORD_TO_INT(...)"),
    (Allowance.BIT_CONVERSION, "w := i;", "INT_TO_WORD(...)"),
    (Allowance.SIGNED_BITS, "dw := i;", "INT_TO_DWORD(...)"),
    (Allowance.NARROWING, "i := d;", "DINT_TO_INT(...)"),
    (Allowance.NARROWING, "u := i;", "INT_TO_UINT(...)"),
    (Allowance.NARROWING, "b := w;", "WORD_TO_BYTE(...)"),
    (Allowance.REAL_CONVERSION, "r := l;", "LREAL_TO_REAL(...)"),
    (Allowance.REAL_FUNCTIONS, "l := SQRT(i);", "SQRT(INT_TO_LREAL(...))"),
    (Allowance.REAL_CONVERSION, "r := d;", "DINT_TO_REAL(...)"),
    (Allowance.BITS_AS_REALS, "r := dw;", "UDINT_TO_REAL(DWORD_TO_UDINT(...))"),
    (Allowance.TIME_NUMBERS, "t := d;", "DINT_TO_TIME(...)"),
    (Allowance.TIME_NUMBERS, "dw := t;", "TIME_TO_DWORD(...)"),
    (Allowance.TIME_NUMBERS, "t := t + i;", "DINT_TO_TIME"),
    (Allowance.CHAR_NUMBERS, "i := c;", "CHAR_TO_INT(...)"),
    (Allowance.CHAR_NUMBERS, "c := b;", "BYTE_TO_CHAR(...)"),
    (Allowance.INSTRUCTION_CALLS, "timer.TON(IN := ok, PT := t);", "timer(...)"),
    (Allowance.INTEGER_BITS, "i := i AND j;", "INT_TO_WORD(...)"),
    (Allowance.INTEGER_BITS, "i := NOT i;", "WORD_TO_INT(NOT INT_TO_WORD(...))"),
    (Allowance.INTEGER_BITS, "u := u XOR 2;", "WORD_TO_UINT("),
    (Allowance.INTEGER_SHIFTS, "i := SHR(i, 1);", "WORD_TO_INT(SHL(INT_TO_WORD(i), 2))"),
    (Allowance.ENUM_NUMBERS, "state := 1;", "State#On"),
    (Allowance.ENUM_NUMBERS, "state := i;", "State#Off"),
    (Allowance.ARGUMENT_NAMES, "s := LEFT(IN := s, SIZE := 3);", "LEFT(L := ...)"),
    (Allowance.CHAINED_ASSIGNMENT, "i := j := 5;", "j := 5; i := j;"),
    (Allowance.ASSIGNED_VALUES, "IF ok := (i = 3) THEN j := 1; END_IF", "`ok := ...;` before it"),
    (Allowance.RETURN_CONDITION, "RETURN(ok);", "IF ok THEN RETURN; END_IF"),
    (Allowance.VENDOR_OPERATORS, "s := __POUNAME();", "'Main'"),
    (Allowance.VENDOR_OPERATORS, "i := XSIZEOF(d);", "SIZEOF(...)"),
    (Allowance.VENDOR_OPERATORS, "i := SIZEOF(POINTER TO INT);", "`8`"),
    (Allowance.VENDOR_OPERATORS, "i := ANY_TO_INT(d);", "TO_INT(...)"),
    (Allowance.COUNTER_WRITES, "FOR i := 1 TO 3 DO i := j; END_FOR", "WHILE"),
    (Allowance.MIXED_ARGUMENTS, "s := Part(count := 2, s);", "level := 3"),
    (Allowance.LITERAL_VALUES, "numbers := [i, 2];", "numbers[1] := 1;"),
    (Allowance.ADDRESS_OPERATOR, "ok := &i <> NULL;", "REF(i)"),
    (Allowance.LABELS, "again: IF i < j THEN i := j; JMP again; END_IF", "IF and loops"),
    (Allowance.REAL_MOD, "r := r MOD 2;", "TRUNC(r / s)"),
    (Allowance.LITERAL_SIZES, "w := b XOR 16#1FF;", "`WORD#511`"),
    (Allowance.LITERAL_SIZES, "ok := w <> 16#1_0000;", "`DWORD#65536`"),
    (Allowance.ROUNDING, "d := r;", "REAL_TO_DINT(...)"),
    (Allowance.ROUNDING, "d := 2.5;", "`2`"),
    (Allowance.BLOCK_VARIABLES, "i := unit.level;", "VAR_OUTPUT"),
    (Allowance.TRY, "__TRY i := i / j; __CATCH() i := 0; __ENDTRY", "IF divisor <> 0 THEN"),
]
"""What the strict language refuses, and a dialect allows; and what the warning says to write."""
DIFFERENT = [
    (Allowance.BARE_CALLS, "unit.reset;", "unit.reset();"),
    (Allowance.NUMBER_OF_BITS, "r := DWORD_TO_REAL(dw);", "UDINT_TO_REAL(DWORD_TO_UDINT(...))"),
]
"""What the strict language warns of, as it means something different."""

REFUSED = [
    "ok := i;",
    "i := ok;",
    "ok := dw > d;",  # a negative d
    "dw := dw / d;",
    "i := i AND u;",  # a negative i
    "state := 300.0;",
    "w := -w;",
    "d := MAX(dw, d);",  # a negative d
    "__TRY i := 1; __CATCH() i := 2; __FINALLY RETURN; __ENDTRY",
    "WHILE ok DO __TRY i := 1; __CATCH() i := 2; __FINALLY EXIT; __ENDTRY END_WHILE",
    "i := __VARINFO(i);",
    "__TRY i := 1; __CATCH(i) i := 2; __ENDTRY",
]
"""What no dialect allows, as no documentation says what it computes."""


def checked(body: str, dialect: DialectName) -> Checked:
    return check_sources(with_dialect({"a.st": f"{HEAD}{body}\nEND_PROGRAM\n"}, dialect), MODEL)


@pytest.mark.parametrize(
    ("allowance", "body", "instead"), [*USES, *DIFFERENT], ids=[each[1] for each in [*USES, *DIFFERENT]]
)
def test_what_a_dialect_allows_is_told(allowance: Allowance, body: str, instead: str) -> None:
    strict = checked(body, "iec").problems
    assert strict, "the strict language says something"
    if (allowance, body, instead) in USES:
        assert any(problem.severity is Severity.ERROR for problem in strict)
    for dialect in DIALECTS.values():
        found = checked(body, dialect.name).problems
        if allowance not in dialect.allows:
            assert [each.code for each in found] == [each.code for each in strict]
            continue
        assert [(each.code, each.span.line, each.severity) for each in found] == [("W006", LINE, Severity.WARNING)]
        assert dialect.title in found[0].message
        assert RULES[allowance].strict in found[0].message
        assert instead in found[0].message


@pytest.mark.parametrize("body", REFUSED)
def test_what_no_documentation_tells_stays_refused(body: str) -> None:
    for name in NAMES:
        found = checked(body, name)
        assert found.program is None, name
        assert all(each.span.line == LINE for each in found.problems)


def test_scl_writes_what_is_internal_of_a_block() -> None:
    for dialect in DIALECTS.values():
        found = checked("unit.level := 3;", dialect.name)
        assert (found.program is not None) is (Allowance.BLOCK_WRITES in dialect.allows), dialect.name
    assert "`unit.level` is internal of its block" in found_in("unit.level := 3;", "siemens")


def test_a_combined_assignment_is_of_another_language() -> None:
    for dialect in DIALECTS.values():
        found = checked("i += 1;", dialect.name)
        if Allowance.COMBINED_ASSIGNMENT in dialect.allows:
            assert [(each.code, each.span.column) for each in found.problems] == [("W006", 3)]
        else:
            assert [(each.code, each.span.column, each.message) for each in found.problems] == [
                ("S003", 3, "`+=` is of another language; write `x := x + ...`.")
            ]


@pytest.mark.parametrize(
    "text", ["f : Flags := (b := ok);", "f : Flags; END_VAR f := (b := ok); IF ok THEN RETURN; END_IF"]
)
def test_a_bit_that_shares_its_byte_starts_with_no_computed_value(text: str) -> None:
    head = "TYPE Flags : STRUCT a, b : BIT; END_STRUCT END_TYPE\nPROGRAM Main\nVAR ok : BOOL; "
    end = "" if "END_VAR" in text else " END_VAR"
    found = check_sources(with_dialect({"a.st": f"{head}{text}{end}\nEND_PROGRAM\n"}, "codesys"), MODEL)
    assert [each.code for each in found.problems if each.severity is Severity.ERROR] == ["D004"]
    assert found.program is None


def test_where_a_program_sees_that_times_have_more_bytes_here_is_told() -> None:
    head = HEAD.replace("PROGRAM Main\nVAR\n", "TYPE Both : UNION t : TIME; w : DWORD; END_UNION END_TYPE\nTYPE Two : STRUCT n : INT; d : DATE; END_STRUCT END_TYPE\nPROGRAM Main\nVAR\n"
        "  both : Both; two : Two; pt : POINTER TO TIME; pw : POINTER TO DWORD; "
    )  # fmt: skip
    body = "i := SIZEOF(two);\ni := SIZEOF(DT);\npw := ADR(t);\npt := ADR(t);\ni := SIZEOF(i);\n"
    for dialect in DIALECTS.values():
        sources = with_dialect({"a.st": f"{head}{body}END_PROGRAM\n"}, dialect.name)
        found = [each for each in check_sources(sources, MODEL).problems if each.code == "W004"]
        first = LINE + 2
        lines = [12, first, first + 1, first + 2] if dialect.name in ("codesys", "twincat") else []
        assert [each.span.line for each in found] == lines, dialect.name
        assert all("four bytes" in each.message and "_TO_DWORD" in each.message for each in found)


def found_in(body: str, dialect: DialectName) -> str:
    return " ".join(each.message for each in checked(body, dialect).problems)


@pytest.mark.parametrize("body", ["i := u := 5;", "i := numbers[i] := 2;"])
def test_several_assignments_of_different_types_are_those_that_tia_documents(body: str) -> None:
    for dialect in DIALECTS.values():
        allows = Allowance.CHAINED_APART in dialect.allows
        assert (checked(body, dialect.name).program is not None) is allows, dialect.name


def test_a_sum_of_bit_strings_is_one_where_no_more_bits_are_wanted() -> None:
    for body, runs in (
        ("w := w + 1;", True),
        ("b := w - b;", True),
        ("dw := w + 1;", False),
        ("ok := w + 1 > 5;", False),
    ):
        assert (checked(body, "siemens").program is not None) is runs, body


def test_the_type_of_an_instruction_that_nothing_tells_is_asked_for() -> None:
    for body, told in (
        ("ok := SCALE_X(MIN := 0, VALUE := r, MAX := 27648) > 5;", "T004"),
        ("r := SCALE_X(MIN := 0.0, VALUE := r, MAX := 100.0);", "T001"),  # without the library
    ):
        found = [each for each in checked(body, "siemens").problems if each.severity is Severity.ERROR]
        assert [each.code for each in found] == [told]
        assert "SCALE_X_REAL" in found[0].message


def test_how_a_real_is_written_is_not_documented() -> None:
    assert [each.code for each in checked("s := REAL_TO_STRING(r);", "siemens").problems] == ["T002"]


def test_a_bit_string_and_a_number_have_the_type_of_both_as_arguments() -> None:
    found = checked("d := MAX(w, d);", "codesys").problems
    assert [each.code for each in found] == ["W006"]
    assert "WORD_TO_DINT" in found[0].message


def test_a_project_keeps_the_strings_that_it_was_laid_out_with() -> None:
    for body, code in (("s[0] := 65;", "T003"), ("p := ADR(s);", "T013")):
        text = HEAD.replace("ok : BOOL;", "ok : BOOL; p : POINTER TO BYTE;")
        sources = {"a.st": f"{text}{body}\nEND_PROGRAM\n", LANGUAGE_FILE: language_text("codesys", (), 1)}
        found = [each for each in check_sources(sources, MODEL).problems if each.severity is Severity.ERROR]
        assert [each.code for each in found] == [code]
        assert '"version": 3' in found[0].message
        same = with_namespaces(with_dialect(sources, "codesys"), ["MyLib"])
        assert language_of(same)[0] == Language("codesys", ("MyLib",), 2)
        assert check_sources(same, MODEL).program is None
        assert check_sources(with_dialect(sources, "twincat"), MODEL).program is not None


def test_a_change_of_the_dialect_carries_strings_over() -> None:
    text = """TYPE Line : STRUCT name : STRING(10); n : INT; END_STRUCT END_TYPE
PROGRAM Main
VAR s : STRING := 'pump'; l : ARRAY[1..2] OF Line := [(name := 'a'), (name := 'full length')]; t : ARRAY[0..1] OF STRING(4) := ['ab', 'cd']; END_VAR
END_PROGRAM
"""
    programs = [
        check_sources({"a.st": text, LANGUAGE_FILE: language_text("codesys", (), version)}, MODEL).program
        for version in (1, 3)
    ]
    for old, new in (programs, programs[::-1]):
        assert old is not None
        assert new is not None
        before, after = fresh_image(old, Mode.RUN), fresh_image(new, Mode.RUN)
        for name, value in (("s", "valve"), ("l[1].name", "1234567890"), ("t[1]", "")):
            place = resolve(old, f"Main.{name}")
            data = parse_value(place.type, f"'{value}'")
            before[place.offset : place.offset + len(data)] = data
        assert not migrate(old, bytes(before), new, after).lost
        for name, value in (
            ("s", "valve"),
            ("l[1].name", "1234567890"),
            ("l[2].name", "full lengt"),
            ("t[0]", "ab"),
            ("t[1]", ""),
        ):
            place = resolve(new, f"Main.{name}")
            assert python_value(place.type, bytes(after[place.offset : place.offset + place.type.size])) == value


APART = {
    Allowance.WIDE_RESULTS, Allowance.LIFE, Allowance.KEPT_VARIABLES, Allowance.BLOCK_TEMPORARIES, Allowance.VENDOR_TYPES,
    Allowance.FINAL_INTERFACES, Allowance.DINT_RESULTS, Allowance.LOCAL_ADDRESSES, Allowance.DIRECT_REFERENCES,
    Allowance.WRAPPED_REALS, Allowance.CHAINED_APART, Allowance.BIT_SUMS, Allowance.INSTRUCTION_TYPES,
    Allowance.SIGNED_TEXTS, Allowance.TRUE_TEXTS, Allowance.TEXT_NUMBERS, Allowance.BLOCK_MOVES, Allowance.VARIANTS,
    Allowance.POINTER_NUMBERS, Allowance.ANY_INPUTS, Allowance.INSTANCE_COPIES, Allowance.PROGRAM_CALLS, Allowance.HEAP,
    Allowance.GENERIC_CONSTANTS, Allowance.HALVES_AWAY, Allowance.FOR_ENDS,
    Allowance.UNLINKED_ADDRESSES, Allowance.SHORTER_STRINGS, Allowance.OVERLOADS, Allowance.START_EXPRESSIONS,
    Allowance.COMBINED_ASSIGNMENT, Allowance.BLOCK_WRITES, Allowance.TEXT_STRUCTURES, Allowance.ACTION_ARGUMENTS,
    Allowance.OUTSIDE_PARTS, Allowance.TEXT_CASES, Allowance.RECURSION, Allowance.OPEN_REFERENCES,
    Allowance.OPEN_INPUTS, Allowance.SETTING_LISTS, Allowance.WORD_COUNTERS, Allowance.SHORT_TIMES,
    Allowance.ALIKE_STRUCTURES,
}  # fmt: skip
"""Those that are about more than one statement: `test_life.py`, and the cases."""


WRITES = """FUNCTION Fill
VAR_INPUT row : ARRAY[*] OF INT; END_VAR
row[1] := 2;
END_FUNCTION
FUNCTION Passes
VAR_INPUT row : ARRAY[*] OF INT; END_VAR
Fill(row);
END_FUNCTION
FUNCTION Reads : INT
VAR_INPUT row : ARRAY[*] OF INT; END_VAR
Reads := row[1];
END_FUNCTION
PROGRAM Main
VAR CONSTANT K : ARRAY[1..2] OF INT := [4, 5]; END_VAR
VAR x : INT; END_VAR
%s
END_PROGRAM
"""


@pytest.mark.parametrize("body", ["Fill(K);", "Passes(K);"])
def test_a_constant_is_no_array_for_an_input_that_is_written(body: str) -> None:
    found = check_sources(with_dialect({"a.st": WRITES % body}, "codesys"), MODEL).problems
    refused = [(each.code, each.span.line) for each in found if each.severity is Severity.ERROR]
    assert refused == [("T003", 16)]
    assert check_sources(with_dialect({"a.st": WRITES % "x := Reads(K);"}, "codesys"), MODEL).program is not None


def test_a_number_beside_a_smaller_signed_integer_needs_a_type() -> None:
    found = [each for each in checked("d := i OR 16#1_0000;", "codesys").problems if each.severity is Severity.ERROR]
    assert [(each.code, each.span.line) for each in found] == [("T002", LINE)]
    assert "`DINT#65536`" in found[0].message
    assert checked("d := i OR DINT#65536;", "codesys").program is not None
    assert checked("d := i OR 16#1_0000;", "rockwell").program is not None


def test_an_end_value_that_the_loop_changes_is_told_where_it_is_computed_again() -> None:
    for body in ("FOR i := 1 TO j DO j := j - 1; END_FOR", "FOR i := 1 TO 10 - i DO d := d + 1; END_FOR"):
        assert checked(body, "iec").problems == ()
        for name in ("codesys", "twincat"):
            found = checked(body, name).problems
            assert [(each.code, each.span.line, each.severity) for each in found] == [("W006", LINE, Severity.WARNING)]
            assert "`last := n; FOR i := 1 TO last`" in found[0].message
    assert checked("FOR i := 1 TO j DO d := d + 1; unit.reset(); END_FOR", "codesys").problems == ()
    text = "PROGRAM Main\nVAR i, n : LINT; END_VAR\nFOR i := 1 TO n DO n := n - 1; END_FOR\nEND_PROGRAM\n"
    wide = check_sources(with_dialect({"a.st": text}, "codesys"), MODEL).problems
    assert [(each.code, each.span.line) for each in wide] == [("X001", 3)]


def test_what_zeros_are_put_before_is_not_guessed() -> None:
    text = "PROGRAM Main\nVAR l : LINT; END_VAR\nl := l AND -2;\nEND_PROGRAM\n"
    found = check_sources(with_dialect({"a.st": text}, "rockwell"), MODEL).problems
    assert [(each.code, each.span.line) for each in found if each.severity is Severity.ERROR] == [("T002", 3)]


def test_an_array_of_any_size_that_is_constant_is_never_written() -> None:
    text = "FUNCTION F\nVAR_IN_OUT CONSTANT a : ARRAY[*] OF INT; END_VAR\na[1] := 2;\nEND_FUNCTION\nPROGRAM Main\nEND_PROGRAM"
    found = check_sources(with_dialect({"a.st": text}, "codesys"), MODEL).problems
    assert [(each.code, each.span.line) for each in found if each.severity is Severity.ERROR] == [("T003", 3)]


def test_every_allowance_has_a_rule_and_a_test() -> None:
    assert set(RULES) == set(Allowance)
    assert {each for each, _, _ in [*USES, *DIFFERENT]} == set(Allowance) - APART


def test_the_library_is_strict_in_every_dialect() -> None:
    body = "s := TIME_TO_STRING(T#1s500ms); w := INT_TO_WORD(FIND(s, 'a')); r := STRING_TO_REAL(s);"
    assert {checked(body, name).problems for name in NAMES} == {()}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{", "This is no JSON"),
        ("[]", "This does not name a dialect"),
        ('{"version": 1, "dialect": "codesis"}', "There is no dialect `codesis`"),
        ('{"version": 5, "dialect": "codesys"}', "which a newer Scanbench reads"),
        ('{"version": "3", "dialect": "codesys"}', "`version` is a number"),
        ('{"version": 3, "dialect": "codesys", "defines": "Fast"}', "`defines` is a list of names"),
        ('{"version": 2, "dialect": "codesys", "defines": ["Fast"]}', '`defines` needs "version": 3'),
        ('{"version": 3, "dialect": "codesys", "subranges": {}}', '`subranges` needs "version": 4'),
        ('{"version": 4, "subranges": ["off"]}', "`subranges` has names of variables"),
        ('{"dialekt": "codesys"}', "There is no setting `dialekt`"),
    ],
)
def test_a_broken_language_file_is_told(text: str, message: str) -> None:
    found = check_sources({"a.st": "PROGRAM Main\nEND_PROGRAM\n", LANGUAGE_FILE: text}, MODEL)
    assert found.program is None
    assert [(each.code, each.span.file) for each in found.problems] == [("S003", LANGUAGE_FILE)]
    assert message in found.problems[0].message


def test_a_shorter_string_is_passed_where_it_is_only_read() -> None:
    text = """FUNCTION Size : INT VAR_IN_OUT s : STRING(20); END_VAR Size := LEN(s);{} END_FUNCTION
FUNCTION_BLOCK Keeper VAR_IN_OUT s : STRING(20); END_VAR VAR n : INT; END_VAR n := LEN(s); END_FUNCTION_BLOCK
PROGRAM Main VAR n : INT; short : STRING(5); long : STRING(30); k : Keeper; END_VAR {} END_PROGRAM"""
    for inside, call, dialect, codes in (
        ("", "n := Size(short);", "twincat", []),
        ("", "n := Size(short);", "codesys", ["T005"]),
        ("", "n := Size(long);", "twincat", ["T005"]),
        ("", "k(s := short);", "twincat", ["T005"]),
        (" s := 'x';", "n := Size(short);", "twincat", ["T005"]),
        (" s[0] := 0;", "n := Size(short);", "twincat", ["T005"]),
    ):
        name = next(each for each in NAMES if each == dialect)
        found = check_sources(with_dialect({"a.st": text.format(inside, call)}, name), MODEL)
        assert [each.code for each in found.problems if each.severity is Severity.ERROR] == codes, (inside, call)


def test_a_change_of_what_is_defined_reads_the_files_again() -> None:
    sources = {
        "a.st": "PROGRAM Main\nVAR x : INT; END_VAR\n{IF defined (fast)} x := 1; {ELSE} x := nothing; {END_IF}\nEND_PROGRAM\n"
    }
    checks = Checks()
    for defines, runs in (((), False), (("Fast",), True), ((), False)):
        text = language_text("iec", defines=defines)
        assert (checks.check({**sources, LANGUAGE_FILE: text}, MODEL, 10_000_000).program is not None) is runs


def test_a_change_of_the_dialect_checks_everything_again() -> None:
    sources = {"a.st": f"{HEAD}w := w + 1;\nEND_PROGRAM\n"}
    checks = Checks()
    assert checks.check(sources, MODEL, 10_000_000).program is None
    assert checks.check(with_dialect(sources, "twincat"), MODEL, 10_000_000).program is not None
    assert checks.check(with_dialect(sources, "iec"), MODEL, 10_000_000).program is None


def test_a_program_that_others_call_does_not_run_by_itself() -> None:
    sub = "PROGRAM Sub\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n"
    checks = Checks()
    for call, running in (
        ("", ["Sub", "Main"]),
        ("Sub();", ["Main"]),
        ("Sub.Nothing();", []),
        ("i := Sub.n;", ["Sub", "Main"]),
    ):
        sources = with_dialect({"a.st": f"{sub}PROGRAM Main\nVAR i : INT; END_VAR\n{call}\nEND_PROGRAM\n"}, "codesys")
        whole = check_sources(sources, MODEL).program
        edited = checks.check(sources, MODEL, 10_000_000).program
        for program in (whole, edited):
            assert (program is None) == (running == [])
            if program is not None:
                assert [each.name for each in program.tasks[0].programs] == running
                assert [each.name for each in program.called] == [each for each in ("Sub",) if each not in running]


def test_dead_code_and_the_plant_keep_no_program_from_running() -> None:
    main = "PROGRAM Main\nVAR x : INT; END_VAR\nx := x + 1;\nEND_PROGRAM\n"
    for name, text in (
        ("a.st", "FUNCTION_BLOCK Never\nMain();\nEND_FUNCTION_BLOCK\n"),
        ("plant/p.st", "PROGRAM P\nIF FALSE THEN Main(); END_IF\nEND_PROGRAM\n"),
    ):
        program = check_sources(with_dialect({"main.st": main, name: text}, "twincat"), MODEL).program
        assert program is not None
        assert [each.name for each in program.tasks[0].programs] == ["Main"]


def test_what_people_type_is_understood_in_the_dialect_of_the_program() -> None:
    text = "DWORD_TO_REAL(Main.dw) = 3.0"
    cases: list[tuple[DialectName, bool]] = [("iec", False), ("codesys", True)]
    for dialect, same in cases:
        program = checked("dw := 3;", dialect).program
        assert program is not None
        made = compile_condition(program, text)
        assert isinstance(made, Condition)
        assert ("BITCAST" in repr(made.expr)) != same
    strict = checked("dw := 3;", "iec").program
    lenient = checked("dw := 3;", "codesys").program
    assert strict is not None
    assert lenient is not None
    assert isinstance(compile_condition(strict, "Main.w + 1 > 5"), BadCondition)
    assert isinstance(compile_condition(lenient, "Main.w + 1 > 5"), Condition)


@pytest.mark.parametrize(
    ("files", "dialect"),
    [
        ({"POUs/Main.TcPOU": ""}, "twincat"),
        ({"a.st": "VAR x : T_MaxString; END_VAR"}, "twincat"),
        ({"a.exp": ""}, "codesys"),
        ({"a.EXP": "(* @PATH := '' *)\nPROGRAM MAIN\nVAR fb : FB_SocketConnect; END_VAR"}, "twincat"),
        ({"a.st": "(* @NESTEDCOMMENTS := 'Yes' *)\nPROGRAM Main"}, "codesys"),
        ({"a.st": "{attribute 'qualified_only'}\nVAR_GLOBAL\nEND_VAR"}, "codesys"),
        ({"a.st": "", "b.scl": ""}, "siemens"),
        ({"a.st": "", "b.L5X": ""}, "rockwell"),
        ({"a.st": "", "b.smc2": ""}, "omron"),
        ({"a.st": "PROGRAM Main\nEND_PROGRAM"}, "iec"),
    ],
)
def test_the_dialect_of_imported_files_is_guessed(files: dict[str, str], dialect: DialectName) -> None:
    assert guess_dialect(files) == dialect


def test_an_export_of_codesys_2_needs_no_name_of_its_dialect() -> None:
    export = "(* @PATH := '' *)\nPROGRAM Main\nVAR b : BYTE; END_VAR\n(* @END_DECLARATION := '0' *)\nb := b + 1;\nEND_PROGRAM\n"
    assert dialect_of(with_dialect_by_format({"a.EXP": export}))[0] == "codesys"
    assert dialect_of(with_dialect_by_format({"a.EXP": export + "(* MEMSET(ADR(b), 0, 1) *)"}))[0] == "twincat"
    assert dialect_of(with_dialect_by_format({"a.exp": "PROGRAM Main\nEND_PROGRAM\n"}))[0] == "iec"
    assert check_sources(with_dialect_by_format({"a.EXP": export}), MODELS["GENERIC-IEC"]).program is not None


def test_the_page_of_the_docs_has_the_table_of_the_code() -> None:
    page = (DOCS / "dialects.md").read_text("utf-8")
    titles = [each.title for each in DIALECTS.values() if each.name != "iec"]
    rows = [f"| allowed | in IEC 61131-3 | strict | {' | '.join(titles)} |"]
    for allowance, rule in RULES.items():
        marks = ["x" if allowance in each.allows else "" for each in DIALECTS.values() if each.name != "iec"]
        rows.append(f"| {rule.allowed} | {rule.strict} | {rule.instead} | {' | '.join(marks)} |")
    missing = [row for row in rows if row not in page]
    assert not missing, "\n".join(missing)


def test_the_text_of_the_language_file_names_the_dialect() -> None:
    for name in NAMES:
        assert check_sources({"a.st": "PROGRAM Main\nEND_PROGRAM\n", LANGUAGE_FILE: language_text(name)}, MODEL).program


def test_the_golden_file_is_read() -> None:
    golden = Path(__file__).parents[1] / "syntax/golden" / LANGUAGE_FILE
    assert dialect_of({LANGUAGE_FILE: golden.read_text("utf-8")}) == ("twincat", [])
    second = golden.parent / "2" / LANGUAGE_FILE
    assert language_of({LANGUAGE_FILE: second.read_text("utf-8")}) == (Language("twincat", ("MyLib",), 2), [])
    third = golden.parent / "3" / LANGUAGE_FILE
    assert language_of({LANGUAGE_FILE: third.read_text("utf-8")}) == (Language("codesys", ("MyLib",), 3), [])
    text = (golden.parent / "4" / LANGUAGE_FILE).read_text("utf-8")
    fourth, problems = language_of({LANGUAGE_FILE: text})
    said = {name: policy.word for name, policy in fourth.subranges.items()}
    assert (said, fourth.defines, problems) == ({"*": "report", "Main.speed": "trap"}, ("WithHeater",), [])
    assert with_dialect({LANGUAGE_FILE: text}, "codesys") == {LANGUAGE_FILE: text}


def test_the_first_uses_of_a_rule_in_a_file_are_told_and_the_others_counted() -> None:
    lines = "w := w + 1;\n" * 9
    text = f"PROGRAM Main\nVAR w : WORD; i : INT; d : DINT; END_VAR\n{lines}i := d;\nEND_PROGRAM\n"
    found = check_sources(with_dialect({"a.st": text}, "codesys"), MODEL)
    assert found.program is not None
    assert [each.span.line for each in found.problems] == [3, 4, 5, 6, 7, 8, 12]
    assert found.problems[5].message.startswith(
        "The same in 4 more places of this file, from here on: in IEC 61131-3 a bit"
    )
    assert "more place" not in found.problems[6].message


CALLED = "PROGRAM Move\nVAR_IN_OUT n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n"
TYPED = "FUNCTION Twice<T: ANY_INT> : T\nVAR_INPUT x : T; END_VAR\nTwice := x + x;\nEND_FUNCTION\n"


@pytest.mark.parametrize(
    ("before", "body", "says"),
    [
        ("", "VAR i : LINT; END_VAR\nFOR i := 1 TO 3 DO i := 3; END_FOR", "only counters of up to 32 bits"),
        ("", "VAR i : INT (0..9); END_VAR\nFOR i := 1 TO 3 DO i := 3; END_FOR", "without a subrange"),
        ("", "VAR i, j : INT; END_VAR\nFOR i := 1 TO 3 BY j DO i := 3; END_FOR", "is a constant"),
        (CALLED, "VAR i : INT; END_VAR\ni := 1;", "nothing would connect"),
        (CALLED, "VAR i : INT; END_VAR\nMove();", "must be connected at every call"),
        (TYPED, "VAR i : INT; END_VAR\ni := Twice<REAL>(i);", "takes ANY_INT, not REAL"),
        (TYPED, "VAR i : INT; END_VAR\ni := Twice<STRING>(i);", "is not supported"),
        ("", "VAR i : INT; END_VAR\ni := LIMIT<INT>(1, i, 2);", "There is no function"),
    ],
)
def test_what_a_dialect_does_not_compute_is_refused(before: str, body: str, says: str) -> None:
    found = check_sources(with_dialect({"a.st": f"{before}PROGRAM Main\n{body}\nEND_PROGRAM\n"}, "codesys"), MODEL)
    assert found.program is None
    assert [says in each.message for each in found.problems if each.severity is Severity.ERROR] == [True]


def test_the_strict_language_has_no_in_outs_of_programs() -> None:
    found = check_sources(with_dialect({"a.st": CALLED}, "iec"), MODEL).problems
    assert found[0].code == "D008"


@pytest.mark.parametrize("text", ["T#-1ms", "T#1ms500us", "T#50d", "LTIME#-5s"])
def test_a_tool_writes_no_time_that_32_bits_do_not_have(text: str) -> None:
    program = checked("timer();", "codesys").program
    assert program is not None
    for path in ("Main.t", "Main.timer.PT"):
        type = resolve(program, path).type
        with pytest.raises(ValueError, match="steps of 1 ms from T#0s to T#49d17h2m47s295ms"):
            parse_value(type, text)
        assert parse_value(type, "T#49d17h2m47s295ms") == (4_294_967_295_000_000).to_bytes(8, "little")
    strict = checked("timer();", "iec").program
    assert strict is not None
    parse_value(resolve(strict, "Main.t").type, text)


def test_a_literal_that_32_bits_do_not_have_is_refused_or_told() -> None:
    for literal, code in (
        ("T#-5s", "S004"),
        ("T#49d17h2m47s296ms", "S004"),
        ("T#1ms1us", "W004"),
        ("T#49d17h2m47s295ms", ""),
    ):
        for dialect in ("codesys", "twincat"):
            found = checked(f"t := {literal};", dialect).problems
            assert [each.code for each in found] == ([code] if code else []), literal
        assert checked(f"t := {literal};", "iec").problems == ()
    for literal in ("DT#1969-12-31-23:59:59", "DT#2106-02-07-06:28:16", "D#2107-01-01"):
        found = checked(f"ok := {literal} > {literal};", "codesys").problems
        assert {each.code for each in found} == {"S004"}, literal


def test_pack_mode_is_one_of_the_vendors() -> None:
    text = "{attribute 'pack_mode' := '3'}\nTYPE S : STRUCT a : BYTE; END_STRUCT; END_TYPE\nPROGRAM Main\nVAR s : S; END_VAR\nEND_PROGRAM"
    found = check_sources(with_dialect({"a.st": text}, "twincat"), MODEL).problems
    assert [(each.code, each.span.line) for each in found if each.severity is Severity.ERROR] == [("S004", 2)]
    assert check_sources({"a.st": text}, MODEL).program is not None
