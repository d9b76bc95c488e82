"""The libraries of vendors: every text checks, what they compute is what their documentation says, and a name may have theirs before it."""

import re
from pathlib import Path

import pytest

from scanbench.check.build import Checked, check_sources
from scanbench.check.libraries.catalogue import Library, catalogue, library_named, library_of_file, used_libraries
from scanbench.syntax.language_file import DialectName, with_dialect, with_namespaces
from scanbench.syntax.tree import PouDeclaration
from tests.caseformat import MODELS

MODEL = MODELS["GENERIC-IEC"]
PAGE = Path(__file__).parents[3] / "docs" / "libraries.md"
HELPERS = {"Tc2_Utilities_Digits", "Passed", "LADDER_PASSED", "Ready", "Take", "Give", "Pack", "Unpack", "S7_Byte"}
HELPERS |= {"S5_Base", "S5_Begin", "S5_Digits", "S5_Left", "S5_Number"}
HELPERS |= {"STRG_VAL_LREAL", "STRG_VAL_LINT", "VAL_STRG_LREAL", "VAL_STRG_LINT", "S_CONV_LINT"}
HELPERS |= {f"RD_{which}_T_{type}" for which in ("SYS", "LOC") for type in ("DATE_AND_TIME", "LDATE_AND_TIME")}
"""What the libraries themselves need; cases of what uses them try these."""
ARGUMENTS = {f"F_{each}" for each in "BYTE WORD DWORD LWORD SINT DINT LINT USINT UINT UDINT ULINT REAL BOOL".split()}
"""Like F_INT, F_LREAL and F_STRING, which have a case."""


def check(text: str, dialect: DialectName = "twincat", **more: str) -> Checked:
    sources = with_dialect({"Main.st": text, **more}, dialect)
    added = {each.path: each.text for each in used_libraries(sources, dialect)}
    return check_sources(sources | added, MODEL)


def said(checked: Checked) -> list[str]:
    return [f"{each.code} {each.message}" for each in checked.problems if each.code != "W006"]


@pytest.mark.parametrize("library", catalogue(), ids=lambda each: each.name)
def test_every_library_checks_with_those_that_it_uses(library: Library) -> None:
    for dialect in library.dialects:
        sources = with_dialect({library.path: library.text, "Main.st": "PROGRAM Main END_PROGRAM"}, dialect)
        sources |= {each.path: each.text for each in used_libraries(sources, dialect)}
        found = check_sources(sources, MODEL)
        assert found.problems == ()
        assert found.program is not None


def test_no_name_is_declared_by_two_libraries_of_a_dialect() -> None:
    seen: dict[tuple[str, str], str] = {}
    for library in catalogue():
        names = {(dialect, name) for dialect in library.dialects for name in library.names}
        assert {each: seen[each] for each in names if each in seen} == {}
        seen |= dict.fromkeys(names, library.name)


def test_every_pou_that_is_no_stub_has_a_case() -> None:
    cases = Path(__file__).parents[1] / "cases"
    tried = {
        word
        for name in ("libraries.case", "scl.case", "scl_instructions.case", "scl_words.case", "ax.case", "logix.case")
        for word in re.findall(r"\w+", (cases / name).read_text("utf-8"))
    }
    for library in catalogue():
        pous = [each for each in library.declared if isinstance(each, PouDeclaration) and each.kind != "interface"]
        real = {each.name for each in pous if not each.stub}
        assert real - tried - HELPERS - ARGUMENTS == set()


@pytest.mark.parametrize("library", catalogue(), ids=lambda each: each.name)
def test_every_library_says_what_it_is_and_where_it_is_documented(library: Library) -> None:
    assert library.about.startswith(f"{library.name} of ")
    assert library.source.startswith("https://")
    assert library_named(library.name.upper()) is library
    assert library_of_file(library.path) == library.name


@pytest.mark.parametrize("library", catalogue(), ids=lambda each: each.name)
def test_the_page_has_a_row_for_every_library(library: Library) -> None:
    what = library.about.partition(": ")[2].partition(". ")[0].removesuffix(".")
    dialects = ", ".join(f"`{each}`" for each in library.dialects)
    pous = sum(isinstance(each, PouDeclaration) for each in library.declared)
    row = f"| [`{library.name}`]({library.source}) | {dialects} | {what} | {pous} | {len(library.stubs)} |"
    assert row in PAGE.read_text("utf-8").splitlines()


def test_a_name_may_have_its_library_before_it() -> None:
    found = check(
        """PROGRAM Main
        VAR t : Tc2_Standard.TON; s : Tc2_System.T_MaxString; b : BOOL; END_VAR
        t(IN := TRUE, PT := Tc2_System.DEFAULT_ADS_TIMEOUT);
        s := Tc2_Standard.CONCAT('a', 'b');
        b := Util.EXTRACT(16#10, 4);
        END_PROGRAM"""
    )
    assert said(found) == []
    assert found.program is not None


def test_the_names_of_libraries_whose_texts_are_in_the_project_are_its_own_choice() -> None:
    text = "FUNCTION Twice : INT VAR_INPUT x : INT; END_VAR Twice := 2 * x; END_FUNCTION\n"
    text += "PROGRAM Main VAR x : INT; END_VAR x := MyLib.Twice(x); END_PROGRAM"
    assert [each[:4] for each in said(check(text))] == ["T001"]
    named = with_namespaces(with_dialect({"Main.st": text}, "twincat"), ["MyLib"])
    assert check_sources(named, MODEL).problems == ()


def test_what_the_project_declares_itself_goes_before_the_library() -> None:
    own = "TYPE T_AmsPort : DINT; END_TYPE\nPROGRAM Main VAR p : T_AmsPort := 100_000; s : T_MaxString; END_VAR END_PROGRAM"
    assert said(check(own)) == []


def test_who_uses_a_stub_is_told_once() -> None:
    found = check(
        "PROGRAM Main VAR d : DINT; END_VAR d := ADSLOGSTR(1, 'a', 'b') + ADSLOGSTR(2, 'a', 'b'); END_PROGRAM"
    )
    assert len(said(found)) == 1
    assert said(found)[0].startswith("W008 `ADSLOGSTR` is a stub")
    assert "in 2 places" in said(found)[0]


@pytest.mark.parametrize(
    ("passed", "why"),
    [
        ("Size(3)", "needs a variable"),
        ("Size(s)", "WSTRING[80] cannot be passed"),
        ("Size(t)", "TIME cannot be passed"),
        ("Size(pair)", "Pair cannot be passed"),
        ("Size(w)", "which class WCHAR has in TwinCAT"),
        ("Number(b)", "is ANY_NUM, and this is BOOL"),
    ],
)
def test_what_an_input_of_the_type_any_cannot_be_given_is_told(passed: str, why: str) -> None:
    found = check(
        f"""FUNCTION Size : DINT VAR_INPUT x : ANY; END_VAR Size := x.diSize; END_FUNCTION
        FUNCTION Number : DINT VAR_INPUT x : ANY_NUM; END_VAR Number := Size(x); END_FUNCTION
        TYPE Pair : STRUCT a : INT; s : WSTRING; END_STRUCT; END_TYPE
        PROGRAM Main VAR d : DINT; s : WSTRING; t : TIME; b : BOOL; w : WCHAR; pair : Pair; END_VAR d := {passed}; END_PROGRAM"""
    )
    assert [why in each for each in said(found)] == [True]


def test_a_library_may_be_a_namespace() -> None:
    text = """PROGRAM Main
        VAR open : FILE.Open; size : CAA.SIZE; b : BOOL; s : STRING; END_VAR
        open(xExecute := TRUE, sFileName := 'a.txt', eFileMode := FILE.MODE.MREAD);
        b := open.eError = FILE.ERROR.NO_ERROR;
        s := DELETE(s, 1, 1);
        END_PROGRAM"""
    assert [each[:4] for each in said(check(text, "codesys"))] == ["W008"]
    assert [each.name for each in used_libraries({"a.st": text}, "codesys")] == ["CAA", "FILE"]
    assert used_libraries({"a.st": "(* FILE.Open *) size := count; // CAA.SIZE\nname := 'CAA.SIZE';"}, "codesys") == []


def test_a_name_that_is_missing_names_its_library_also_of_a_namespace() -> None:
    sources = {"Main.st": "PROGRAM Main VAR f : FILE.Open; x : AXIS_REF; END_VAR END_PROGRAM"}
    dialects: dict[DialectName, str] = {"codesys": "FILE", "twincat": "Tc2_MC2"}
    for dialect, library in dialects.items():
        found = check_sources(with_dialect(sources, dialect), MODEL)
        assert any(f"It is in the library {library}" in each.message for each in found.problems)


def test_an_axis_is_moved_by_blocks() -> None:
    found = check(
        """PROGRAM Main
        VAR axis : AXIS_REF; power : MC_Power; move : MC_MoveAbsolute; moving : BOOL; END_VAR
        axis.ReadStatus();
        power(Axis := axis, Enable := TRUE, Override := 50.0);
        move(Axis := axis, Execute := power.Status, Position := 10.0, Velocity := 5.0, BufferMode := MC_Buffered);
        axis.PlcToNc.Override := 5;
        moving := axis.Status.Moving AND axis.Status.MotionState = MC_AXISSTATE_DISCRETEMOTION AND axis.NcToPlc.ActPos > 1.0;
        END_PROGRAM"""
    )
    assert {each[:4] for each in said(found)} == {"W008"}


def test_files_are_opened_with_the_names_of_the_library() -> None:
    found = check(
        """PROGRAM Main
        VAR open : FB_FileOpen; handle : UINT; END_VAR
        open(sPathName := 'a', nMode := FOPEN_MODEREAD OR FOPEN_MODETEXT, ePath := PATH_BOOTPATH, bExecute := TRUE, hFile => handle);
        END_PROGRAM"""
    )
    assert [each[:4] for each in said(found)] == ["W008"]


def test_only_what_is_named_is_added() -> None:
    assert [each.name for each in used_libraries({"a.st": "x := PACK(TRUE);"}, "codesys")] == ["Util"]
    assert used_libraries({"a.st": "x := PACK(TRUE);"}, "iec") == []
    assert used_libraries({"a.st": "x := ADD(1, 2);"}, "twincat") == []


def test_a_name_of_a_library_that_the_project_does_not_have_is_told_with_the_library() -> None:
    text = (
        "PROGRAM Main VAR s : T_MaxString; b : BOOL; t : Tc2_System.T_AmsPort; END_VAR b := EXTRACT(1, 2); END_PROGRAM"
    )
    found = check_sources(with_dialect({"Main.st": text}, "twincat"), MODEL).problems
    libraries = ["Tc2_System" if "library Tc2_System" in each.message else "Util" in each.message for each in found]
    assert libraries == ["Tc2_System", "Tc2_System", True], found
    strict = check_sources({"Main.st": text}, MODEL).problems
    assert not any("library" in each.message for each in strict)


def test_a_prefix_does_not_reach_a_variable_of_the_pou() -> None:
    found = check("PROGRAM Main VAR lr, a : LREAL; END_VAR a := Tc2_Math.lr + Tc2_Math.FRAC(2.5); END_PROGRAM")
    assert [each[:4] for each in said(found)] == ["T001"]


def test_what_the_vendors_controller_sets_is_told() -> None:
    text = """PROGRAM Main
        VAR count : UDINT; name : STRING[63]; END_VAR
        count := _TaskInfo[1].CycleCount + TwinCAT_SystemInfoVarList._TaskInfo[2].CycleCount;
        name := TwinCAT_SystemInfoVarList._AppInfo.ProjectName;
        END_PROGRAM"""
    assert [each[:15] for each in said(check(text))] == ["W008 `_TaskInfo", "W008 `_AppInfo`"]


def test_the_name_of_a_library_before_what_the_standard_has_adds_the_library() -> None:
    text = "PROGRAM Main VAR s : STRING; END_VAR s := Tc2_Utilities.CONCAT(s, 'x'); END_PROGRAM"
    assert said(check(text)) == []
    assert [each.name for each in used_libraries({"a.st": text}, "twincat")][:1] == ["Tc2_Utilities"]
    assert used_libraries({"a.st": text.replace("Tc2_Utilities.", "")}, "twincat") == []
