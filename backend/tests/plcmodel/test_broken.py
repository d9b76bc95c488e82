"""Every way for a model file to be wrong: `broken/*.xml`, loaded together, each with its line, column and reason."""

from pathlib import Path
from shutil import copy

import pytest

from scanbench.plcmodel.load import load_all, model_directory
from scanbench.plcmodel.model import Model
from scanbench.problems import TABLE, Problem

BROKEN = Path(__file__).parent / "broken"
Loaded = tuple[dict[str, Model], list[Problem]]


@pytest.fixture(scope="module")
def loaded(tmp_path_factory: pytest.TempPathFactory) -> Loaded:
    """All of them, the right ones among them, and every model that ships."""
    directory = tmp_path_factory.mktemp("models")
    copy(model_directory() / "model.xsd", directory)
    (directory / "maker").mkdir()
    for path in [*BROKEN.glob("*.xml"), *model_directory().glob("*/*.xml")]:
        copy(path, directory / "maker")
    models, problems = load_all(directory)
    return {model.name: model for model in models}, problems


@pytest.mark.parametrize(
    ("name", "line", "column", "code", "reason"),
    [
        ("no-such-word", 28, 52, "M003", "the last word is S9"),
        ("no-such-bit", 28, 52, "M003", "bit 16 does not exist"),
        ("no-such-prefix", 28, 52, "M003", "its areas are %M, D, S, X"),
        ("not-hexadecimal", 13, 35, "M003", "the last one is X3F"),
        ("bit-of-a-bit", 13, 35, "M003", "counts in bits"),
        ("word-for-a-bit", 28, 52, "M003", "must be a bit"),
        ("bit-for-a-word", 12, 22, "M003", "must be a word"),
        ("flag-closed-to-the-simulator", 28, 52, "M003", "closed to the simulator"),
        ("code-word-closed-to-the-simulator", 12, 22, "M003", "S6 is outside of the area or closed"),
        ("detail-beyond-the-area", 24, 34, "M003", "S5 is outside"),
        ("unknown-area", 10, 30, "M003", "area 'E' does not exist"),
        ("map-beyond-the-area", 10, 40, "M003", "outside of D"),
        ("outputs-beyond-the-area", 13, 46, "M003", "words 0 to 100 are no range of D"),
        ("log-beyond-the-area", 13, 22, "M003", "S5 is outside"),
        ("error-twice", 28, 16, "M004", "is used in line"),
        ("prefix-twice", 5, 5, "M004", "two areas have the prefix 'D'"),
        ("area-twice", 9, 17, "M004", "Area 'S' is there twice"),
        ("symbol-twice", 14, 47, "M004", "Symbol 'BEAT' is there twice"),
        ("special-twice", 14, 20, "M004", "Special 'a' is there twice"),
        ("instruction-twice", 17, 24, "M004", "Instruction 'Raise' is there twice"),
        ("detail-twice", 20, 5, "M004", "two details are named 'unit'"),
        ("code-and-flag-twice", 28, 35, "M005", "belongs to 'first'"),
        ("access-overlap", 6, 7, "M006", "without gap or overlap"),
        ("access-gap", 6, 7, "M006", "must cover words 0 to 9"),
        ("too-large-for-its-field", 24, 63, "M007", "Max 256 does not fit into 8 bits"),
        ("limits-crossed", 24, 55, "M007", "Min 10 is greater than Max 9"),
        ("default-outside", 24, 75, "M007", "is not in 0 to 9"),
        ("field-beyond-the-word", 24, 11, "M007", "are not in one word"),
        ("code-too-short", 28, 35, "M007", "'20' has 2 digits"),
        ("code-grows-too-large", 20, 34, "M007", "grow to 10007"),
        ("decimal-code-with-letters", 28, 35, "M007", "'00F0' is not decimal"),
        ("instruction-beyond-the-detail", 16, 86, "M007", "more than detail unit takes: 0 to 9"),
        ("clears-what-it-raises", 16, 97, "M007", "both raise the error and clear it"),
        ("wide-place-beyond-the-area", 13, 46, "M007", "no 32 bits at S9"),
        ("number-for-a-bit", 24, 44, "M008", "a Bit has none"),
        ("without-limits", 24, 11, "M008", "needs Min and Max"),
        ("two-addresses", 23, 9, "M008", "exactly one ErrorAddress, here are 2"),
        ("choice-without-id", 24, 11, "M008", "needs an Id"),
        ("address-missing", 24, 11, "M008", "needs an Address"),
        ("also-without-value", 22, 7, "M008", "an Also is a Bit without more"),
        ("unknown-base", 2, 34, "M009", "there is no model 'GODO' to be based on. Did you mean `GOOD`?"),
        ("based-on-itself", 2, 37, "M009", "BASED-ON-ITSELF is based on BASED-ON-ITSELF"),
        ("cycle-one", 2, 31, "M009", "CYCLE-ONE is based on CYCLE-TWO is based on CYCLE-ONE"),
        ("cycle-two", 2, 31, "M009", "CYCLE-TWO is based on CYCLE-ONE is based on CYCLE-TWO"),
        ("heir-of-broken", 2, 36, "M009", "its base NO-SUCH-BIT has errors, the first is maker/no-such-bit.xml:"),
        ("heir-of-unreadable", 2, 40, "M009", "its base NOT-CLOSED cannot be read"),
        (
            "nothing-to-leave-out",
            3,
            20,
            "M009",
            "'frist' cannot be left out: the base has no such thing. Did you mean `first`?",
        ),
        ("base-does-not-fit", 2, 39, "M003", "what it takes from maker/GOOD.xml:"),
        ("no-memory", 2, 1, "M002", "a model needs Memory"),
        ("pulse-without-period", 13, 48, "M010", "role pulse needs a Period"),
        ("pulse-in-a-word", 13, 35, "M010", "role pulse needs a bit, S4 has 16"),
        ("time-in-a-bit", 13, 35, "M010", "needs 16, 32 or 64 bits"),
        ("clock-of-another-size", 13, 61, "M010", "needs Fields for 2 bytes, one each, there are 3"),
        ("period-without-a-pulse", 13, 60, "M010", "Period goes with role pulse only"),
        ("role-closed-to-the-system", 13, 35, "M003", "S7 is outside of the area or closed"),
        ("instruction-of-no-error", 16, 38, "M010", "there is no error 'frist'. Did you mean `first`?"),
        (
            "instruction-of-no-detail",
            16,
            67,
            "M010",
            "no detail 'units' that is a number: it has unit. Did you mean `unit`?",
        ),
        ("also-of-no-detail", 22, 46, "M010", "there is no detail 'rack'"),
        ("unknown-element", 10, 5, "M002", "<Bogus> does not belong here: only <IecMap> is allowed"),
        ("unknown-severity", 28, 69, "M002", "fatal or nonfatal"),
        ("unknown-role", 13, 48, "M002", "it can be on, off, first-cycle"),
        ("bad-period", 13, 63, "M002", "as `0.1s`"),
        ("bad-id", 28, 16, "M002", "write small letters and digits"),
        ("bad-symbol", 13, 50, "M002", "as `P_Ready`"),
        ("words-missing", 4, 5, "M002", "<Area> has no Words: write Words="),
        ("words-too-many", 4, 27, "M002", "65536"),
        ("fields-overlap", 20, 5, "M007", "detail more writes bits of S2 that detail unit writes too"),
        ("units-overlap-a-field", 20, 5, "M007", "detail more writes bits of S1 that detail unit writes too"),
        ("also-overlaps-a-detail", 20, 5, "M007", "Also S2.03 writes bits of S2.03 that detail unit writes too"),
        ("detail-on-the-flag", 20, 5, "M007", "detail unit writes bits of S1 that the flag writes too"),
        ("detail-bit-16", 24, 41, "M003", "'S2.16': bit 16 does not exist"),
        ("choice-without-value", 24, 11, "M008", "writes or adds a number and needs a Value"),
        ("default-of-no-choice", 23, 56, "M008", "Default 'b' is none of the choices: a"),
        ("choice-twice", 24, 29, "M004", "Id 'a' is used by two choices of this List"),
        ("value-of-a-spin", 24, 73, "M008", "a Spin writes what is entered: it has no Value"),
        ("units-beyond-the-area", 24, 34, "M003", "S5 is outside of the area or closed"),
        ("bcd-too-large", 24, 62, "M007", "Max 10000 does not fit into 16 bits as BCD"),
        ("nibble-too-large", 24, 65, "M007", "Max 16 does not fit into 4 bits as Nibble"),
        ("text-in-a-spin", 24, 56, "M008", "a text belongs into an Edit"),
        ("text-without-length", 27, 11, "M008", "a text needs Max, its most characters: 1 to 64"),
        ("text-with-a-minimum", 27, 67, "M008", "a text has no Min"),
        ("text-beyond-the-area", 27, 34, "M003", "S5 is outside of the area or closed"),
        ("text-in-the-code", 27, 11, "M008", "a text cannot be added to the error code"),
        ("unknown-cause", 28, 99, "M002", "passing or lasting"),
        ("reset-in-a-word", 13, 22, "M003", "'D1' must be a bit"),
        ("time-of-three", 13, 35, "M010", "two Fields fill a word, here are 3"),
        ("time-closed-to-the-simulator", 13, 23, "M003", "S5 is outside of the area or closed"),
        ("standby-for-a-nonfatal", 13, 72, "M010", "second is nonfatal: nobody takes over"),
        ("standby-for-no-error", 13, 72, "M010", "there is no error 'fist'. Did you mean `first`?"),
        ("standby-time-of-three", 13, 48, "M010", "Time goes with Fields, two of which fill a word, here are 3"),
        ("standby-closed-to-the-simulator", 13, 35, "M003", "S6 is outside of the area or closed"),
        ("no-code-that-grows", 20, 5, "M008", "without an ErrorCode has nothing that a detail could add to"),
        ("reset-of-a-bit", 17, 32, "M003", "'S1.00' must be a word"),
        ("system-errors-without-code", 16, 114, "M010", "SystemErrors needs the parameters Selector"),
        ("parameters-of-one-name", 16, 5, "M004", "two parameters of RAISE have one name"),
        ("NOT-CLOSED", 31, 11, "M001", "mismatch"),
        ("with-a-doctype", 2, 1, "M001", "DOCTYPE"),
    ],
)
def test_each_is_told_with_its_place(loaded: Loaded, name: str, line: int, column: int, code: str, reason: str) -> None:
    found = [problem for problem in loaded[1] if problem.span.file == f"maker/{name}.xml"]
    told = [problem for problem in found if problem.code == code and reason in problem.message]
    assert (line, column) in [(each.span.line, each.span.column) for each in told], [str(each) for each in found]


def test_the_table_has_them_all_and_the_right_ones_are_usable(loaded: Loaded) -> None:
    models, problems = loaded
    wrong = {problem.span.file for problem in problems}
    assert wrong == {f"maker/{path.name}" for path in BROKEN.glob("*.xml")} - {"maker/GOOD.xml"}
    shipped = {path.stem for path in model_directory().glob("*/*.xml")}
    assert models.keys() == shipped | {"GOOD"}
    of_models = {code for code in TABLE if code.startswith("M")} - {"M011"}  # that is of `hardware.json`
    assert {problem.code for problem in problems} == of_models
