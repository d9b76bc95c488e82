"""A project's own errors: read on a model, every way to be wrong, and what a form writes is what is read again."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scanbench.plcmodel.catalogue import path_text
from scanbench.plcmodel.check_drafts import check_drafts
from scanbench.plcmodel.document import Document
from scanbench.plcmodel.drafts import (
    DraftAddress,
    DraftAlso,
    DraftDetail,
    DraftError,
    DraftGroup,
    Drafts,
    DraftText,
    read_drafts,
)
from scanbench.plcmodel.model import Model
from scanbench.plcmodel.user_errors import device_of, document_of, extended, model_for, with_user_errors
from scanbench.plcmodel.write_catalogue import write_catalogue
from scanbench.problems import TABLE
from scanbench.recording.fingerprints import model_fingerprint

BROKEN = Path(__file__).parent / "broken_user_errors"
GOOD = (BROKEN / "GOOD.xml").read_text("utf-8")


def test_the_model_has_them_like_its_own(cj1m: Model) -> None:
    model, problems = with_user_errors(cj1m, GOOD)
    assert problems == []
    assert model is not None
    assert model.catalogue[:-1] == cj1m.catalogue
    group = model.catalogue[-1]
    assert (group.name, group.wordings[0].language, group.wordings[0].name) == ("User-defined", "ja", "ユーザー定義")
    error = model.error("pump-hot")
    assert error is not None
    assert (error.user, error.code_text, error.flag_text, error.priority) == (True, "4101", "W10.00", 300)
    assert error.description == "Too hot & too long."
    assert error.wordings[0].name == "ポンプ過熱"
    assert [detail.name for detail in error.details] == ["pump", "degrees"]
    assert not any(each.user for each in cj1m.errors())
    assert device_of(model) == cj1m
    assert model_fingerprint(model) == model_fingerprint(cj1m)  # the same device
    assert with_user_errors(model, GOOD)[0] == model  # they are not added to themselves


def test_among_the_files_of_a_project(cj1m: Model) -> None:
    assert model_for(cj1m, {"main.st": ""}) is cj1m
    assert model_for(cj1m, {"main.st": "", "errors.xml": GOOD}).error("pump-hot") is not None
    assert model_for(cj1m, {"/home/somebody/line/errors.xml": GOOD}).error("pump-hot") is not None
    assert model_for(cj1m, {"other-errors.xml": GOOD}) is cj1m
    model, problems = extended(cj1m, {"errors.xml": GOOD.replace("W10.00", "W999.00")})
    assert model is cj1m
    assert [(each.code, each.span.file, each.span.line) for each in problems] == [("M003", "errors.xml", 5)]
    _, problems = extended(cj1m, {"a/errors.xml": GOOD, "b/errors.xml": GOOD})
    assert [(each.code, each.span.file) for each in problems] == [("M004", "b/errors.xml")]


def test_the_same_text_on_a_different_model_is_a_different_catalogue(cj1m: Model, models: dict[str, Model]) -> None:
    assert with_user_errors(cj1m, GOOD)[0] is not None
    found, problems = with_user_errors(models["GENERIC-IEC"], GOOD)
    assert found is None
    assert problems
    assert with_user_errors(cj1m, GOOD)[0] is not None


@pytest.mark.parametrize(
    ("name", "line", "column", "code", "reason"),
    [
        ("flag-outside", 5, 54, "M003", "the last word is W511"),
        ("flag-bit-16", 5, 54, "M003", "bit 16 does not exist"),
        ("flag-no-area", 5, 54, "M003", "its areas are %I, %Q, %M, CIO"),
        ("flag-a-word", 5, 54, "M003", "must be a bit"),
        ("id-of-the-device", 5, 16, "M004", "CJ1M-CPU63 has an error 'memory-error' itself"),
        ("id-twice", 8, 16, "M004", "is used in line 5"),
        ("pair-of-the-device", 5, 37, "M005", "is 'memory-error' of the CJ1M-CPU63 itself"),
        ("pair-twice", 8, 38, "M005", "belongs to 'pump-hot'"),
        ("code-short", 5, 37, "M007", "have 4"),
        ("bad-id", 5, 16, "M002", "'Pump Hot'"),
        ("no-priority", 5, 5, "M002", "<Error> has no Priority"),
        ("bad-severity", 5, 72, "M002", "fatal or nonfatal"),
        ("no-name", 5, 5, "M002", "<Error> lacks <Name>"),
        ("list-choice-without-id", 9, 11, "M008", "needs an Id"),
        ("spin-without-limits", 9, 11, "M008", "needs Min and Max"),
        ("limits-crossed", 9, 56, "M007", "greater than Max"),
        ("detail-outside", 9, 52, "M003", "the last word is W511"),
        ("default-of-no-choice", 8, 56, "M008", "none of the choices: a"),
        ("too-wide", 9, 64, "M007", "does not fit into 8 bits"),
        ("unknown-element", 7, 7, "M002", "<Cause> does not belong here"),
        ("group-without-name", 4, 5, "M002", "only <Name> is allowed"),
        ("error-outside-of-a-group", 2, 5, "M002", "only <ErrorGroup> is allowed"),
        ("a-model", 1, 1, "M002", "here belongs <UserErrors>"),
        ("not-closed", 8, 1, "M001", "Premature end of data"),
        ("doctype", 2, 1, "M001", "DOCTYPE"),
        ("entity-bomb", 1, 1, "M001", "DOCTYPE"),
        ("empty", 1, 1, "M001", "Document is empty"),
    ],
)
def test_every_way_to_be_wrong(cj1m: Model, name: str, line: int, column: int, code: str, reason: str) -> None:
    model, problems = with_user_errors(cj1m, (BROKEN / f"{name}.xml").read_text("utf-8"), f"{name}.xml")
    assert model is None
    first = problems[0]
    assert (first.span.file, first.span.line, first.span.column, first.code) == (f"{name}.xml", line, column, code)
    assert reason in first.message
    assert first.code in TABLE


SYSTEM = [
    ("CJ1M-CPU63", "A400.00", "the error code"),
    ("CJ1M-CPU63", "A100.00", "in the error log"),
    ("CJ1M-CPU63", "A199.15", "in the error log"),
    ("CJ1M-CPU63", "A300.00", "the counter of the error log"),
    ("CJ1M-CPU63", "A200.11", "first-cycle of the system"),
    ("CJ1M-CPU63", "CF102", "pulse-1s of the system"),
    ("CJ1M-CPU63", "A265.15", "present-cycle-time of the system"),
    ("CJ1M-CPU63", "A351.00", "clock-second-minute of the system"),
    ("CJ1M-CPU63", "A354.15", "clock-weekday of the system"),
    ("CJ1M-CPU63", "A500.12", "the hold bit"),
    ("CJ1M-CPU63", "A500.13", "forced-hold-bit of the system"),
    ("CJ1M-CPU63", "A500.14", "log-reset of the system"),
    ("CJ1M-CPU63", "A500.15", "output-off of the system"),
    ("CJ1M-CPU63", "A529.00", "the number that makes FAL raise errors of the device"),
    ("CJ1M-CPU63", "A402.12", "the flag of 'basic-io-error'"),
    ("CJ1M-CPU63", "A401.15", "the flag of 'memory-error'"),
    ("CJ1M-CPU63", "A403.01", "in a word that 'memory-error' writes its detail location to"),
    ("CJ1M-CPU63", "A391.15", "in a word that 'fal' writes its detail number to"),
    ("CP1H-XA40D", "A315.14", "what 'built-in-analog-error' writes too"),
    ("GENERIC-IEC", "%MX8600.0", "clock of the system"),
    ("GENERIC-IEC", "%MX8607.7", "clock of the system"),
    ("Q03UD", "SM50", "the bit that clears errors"),
    ("Q03UD", "SD50.0", "the code of the error to clear"),
    ("Q03UD", "SD3.F", "the time of the latest error"),
    ("NJ501-1300", "SV21.15", "the error code"),
    ("NJ501-1300", "_PLC_ErrSta.07", "the flag of 'user-program-transfer-error'"),
]
FREE = [
    ("CJ1M-CPU63", "CIO 0.00"),
    ("CJ1M-CPU63", "CIO 100.00"),
    ("CJ1M-CPU63", "A200.10"),
    ("CJ1M-CPU63", "A402.11"),
    ("CJ1M-CPU63", "A448.00"),
    ("CJ1M-CPU63", "D0.00"),
    ("CP1H-XA40D", "A315.12"),
    ("NJ501-1300", "_PLC_ErrSta.03"),
]
CODES = {"NJ501-1300": "77770000", "Q03UD": "7777"}


def one_error(model: str, flag: str, inside: str = "") -> str:
    return f"""\
<UserErrors><ErrorGroup><Name>Pumps</Name>
<Error Id="pump-hot" ErrorCode="{CODES.get(model, "7777")}" ErrorFlag="{flag}" Severity="nonfatal" Priority="300"><Name>Pump hot</Name>
{inside}
</Error></ErrorGroup></UserErrors>"""


@pytest.mark.parametrize(("name", "address", "purpose"), SYSTEM)
def test_the_words_of_the_system_are_not_theirs(
    models: dict[str, Model], name: str, address: str, purpose: str
) -> None:
    model, problems = with_user_errors(models[name], one_error(name, address))
    assert model is None
    (problem,) = problems
    column = one_error(name, address).splitlines()[1].index(address) + 1
    assert (problem.code, problem.span.line, problem.span.column) == ("M003", 2, column)
    assert problem.message.startswith(f"{address} is {purpose} ({name}): ")


@pytest.mark.parametrize(("name", "address"), FREE)
def test_everything_else_is(models: dict[str, Model], name: str, address: str) -> None:
    assert with_user_errors(models[name], one_error(name, address))[1] == []


CONTROL = '<ErrorDetailPattern><ErrorControl Name="d" Type="{}">{}</ErrorControl></ErrorDetailPattern>'


@pytest.mark.parametrize(
    ("inside", "address"),
    [
        ('<Also Address="D1.00" Type="Bit"/><Also Address="A402.04" Type="Bit"/>', "A402.04"),
        ('<Also Address="A401" Type="Word" Value="1"/>', "A401"),
        (CONTROL.format("Spin", '<ErrorAddress Address="A400" Type="Word" Min="0" Max="9"/>'), "A400"),
        (CONTROL.format("Spin", '<ErrorAddress Address="A299" Type="BitArray" Min="0" Max="16"/>'), "A299"),
        (CONTROL.format("Edit", '<ErrorAddress Address="A98" Type="Word" Base="text" Max="5"/>'), "A98"),
        (
            CONTROL.format(
                "List",
                '<ErrorAddress Id="a" Address="D1.00" Type="Bit"/><ErrorAddress Id="b" Address="A351.01" Type="Bit"/>',
            ),
            "A351.01",
        ),
    ],
)
def test_no_part_of_an_error_writes_there(cj1m: Model, inside: str, address: str) -> None:
    text = one_error("CJ1M-CPU63", "D0.00", inside.replace("><", ">\n<"))
    model, problems = with_user_errors(cj1m, text)
    assert model is None
    (line,) = (number for number, each in enumerate(text.splitlines(), 1) if f'"{address}"' in each)
    column = text.splitlines()[line - 1].index(address) + 1
    assert [(each.code, each.span.line, each.span.column) for each in problems] == [("M003", line, column)]
    assert problems[0].message.startswith(f"{address} is ")


def test_next_to_them_is_free(cj1m: Model) -> None:
    inside = CONTROL.format("Spin", '<ErrorAddress Address="A98" Type="BitArray" Min="0" Max="31"/>')
    assert with_user_errors(cj1m, one_error("CJ1M-CPU63", "D0.00", inside))[1] == []


def test_a_form_names_the_field(cj1m: Model) -> None:
    assert [path for path, _ in problems_of(cj1m, replace(PUMP, flag="A400.00"))] == ["errors.0.flag"]
    assert [path for path, _ in problems_of(cj1m, replace(PUMP, also=(DraftAlso("A400.01"),)))] == [
        "errors.0.also.0.address"
    ]


def test_every_broken_file_is_tried() -> None:
    (mark,) = test_every_way_to_be_wrong.pytestmark  # type: ignore[attr-defined]  # pytest puts it there
    assert {path.stem for path in BROKEN.glob("*.xml")} == {row[0] for row in mark.args[1]} | {"GOOD"}


def test_a_file_that_is_too_large_or_holds_half_a_character(cj1m: Model) -> None:
    assert "larger than 4 MiB" in with_user_errors(cj1m, GOOD + " " * (4 << 20))[1][0].message
    found = with_user_errors(cj1m, GOOD.replace("hot<", "hot\ud800<"))[1][0]
    assert (found.span.line, found.span.column) == (6, 21)


# ---- drafts ------------------------------------------------------------------------------------------------------


def drafts_of(text: str) -> Drafts:
    document = document_of(text)
    assert isinstance(document, Document), document
    return read_drafts(document)


WORDS = st.text(st.characters(exclude_categories=["Cs", "Cc"]), max_size=12).map(lambda text: " ".join(text.split()))
NAMED = WORDS.filter(bool)
NUMBERS = st.integers(0, 99).map(str) | st.just("16#0E") | st.just("")
TYPES = st.sampled_from(["Bit", "Word", "Byte", "BCD", "Nibble", "BitArray"])
TEXTS = st.builds(
    lambda en, ja, told: tuple(
        text for text in (DraftText("en", en, told), DraftText("ja", ja, "")) if text.name or text.description
    ),
    NAMED, WORDS, WORDS,
)  # fmt: skip
TOLD = WORDS.map(lambda text: (DraftText("en", "", text),) if text else ())
IDS = st.from_regex(r"[a-z][a-z0-9]{0,5}(-[a-z0-9]{1,5})?", fullmatch=True)
ADDRESSES = st.sampled_from(["W10.03", "W11", "A403.05", "AR40305", "", "D5"])
BOOLEANS = st.sampled_from(["", "true", "false", "1", "0"])
ADDRESS = st.builds(
    DraftAddress, IDS | st.just(""), st.sampled_from(["W10.03", "D5"]), TYPES, NUMBERS, NUMBERS, NUMBERS, NUMBERS,
    NUMBERS, NUMBERS, st.sampled_from(["", "10", "16"]), BOOLEANS, TOLD,
)  # fmt: skip
DETAIL = st.builds(
    DraftDetail, IDS, st.sampled_from(["List", "Spin", "Edit"]), IDS | st.just(""),
    st.lists(ADDRESS, min_size=1, max_size=3).map(tuple), TOLD,
)  # fmt: skip
ALSO = st.builds(DraftAlso, st.just("W3.01"), TYPES, NUMBERS, NUMBERS, NUMBERS, IDS | st.just(""))
ERROR = st.builds(
    DraftError, IDS, st.lists(NAMED, min_size=1, max_size=3).map(tuple), st.sampled_from(["4101", "80F1", "1"]),
    st.sampled_from(["W10.00", "A40115"]), st.sampled_from(["fatal", "nonfatal"]), st.sampled_from(["1", "300"]),
    st.sampled_from(["", "passing", "lasting"]), st.sampled_from(["", "keep"]), WORDS, st.sampled_from(["", "yes", "no"]), BOOLEANS, TEXTS,
    st.lists(DETAIL, max_size=3).map(tuple), st.lists(ALSO, max_size=2).map(tuple),
)  # fmt: skip
DRAFTS = st.lists(ERROR, max_size=5).map(lambda errors: Drafts(tuple(errors)))


@given(DRAFTS)
def test_what_is_written_is_read_again(drafts: Drafts) -> None:
    text = write_catalogue(drafts).text
    again = drafts_of(text)
    assert sorted(again.errors, key=repr) == sorted(drafts.errors, key=repr)
    assert write_catalogue(again).text == text  # stable


def test_names_of_groups_survive() -> None:
    errors = (DraftError("a", ("Pumps", "North"), "1", "W1.00", "fatal", "1", texts=(DraftText("en", "A"),)),)
    groups = (
        DraftGroup(("Pumps",), (DraftText("ja", "ポンプ"),)),
        DraftGroup(("Pumps", "North"), (DraftText("de", "Nord"), DraftText("ja", "北"))),
    )
    assert drafts_of(write_catalogue(Drafts(errors, groups)).text) == Drafts(errors, groups)


def test_more_details_than_fit_into_one_pattern() -> None:
    details = tuple(DraftDetail(f"d{n}", "List", "", (DraftAddress("a", "W1.00"),)) for n in range(40))
    errors = (DraftError("a", ("G",), "1", "W1.00", "fatal", "1", texts=(DraftText("en", "A"),), details=details),)
    assert drafts_of(write_catalogue(Drafts(errors)).text) == Drafts(errors)


def test_a_catalogue_that_ships_survives_as_a_users(models: dict[str, Model]) -> None:
    """The errors of each model, as a project on that model without errors would define them."""
    for model in models.values():
        path = next(
            (
                path
                for path in (Path(__file__).parents[3] / "models").glob("*/*.xml")
                if f'Name="{model.name}"' in path.read_text("utf-8") and "Base=" not in path.read_text("utf-8")
            ),
            None,
        )
        if path is None:
            continue
        text = path.read_text("utf-8")
        first = text.index("<ErrorGroup>")
        groups = re.sub(r"\s*<Fact [^>]*/>", "", text[first : text.rindex("</Model>")])  # what a project has as a whole
        own = f"<UserErrors>{groups}</UserErrors>"
        written = write_catalogue(drafts_of(own)).text
        bare = replace(model, catalogue=())
        before, problems = with_user_errors(bare, own)
        assert (model.name, problems) == (model.name, [])
        after, problems = with_user_errors(bare, written)
        assert (model.name, problems) == (model.name, [])
        assert before is not None
        assert after is not None
        assert before.catalogue == after.catalogue
        assert len(list(after.errors())) == len(list(model.errors()))


# ---- problems at the fields of a form ----------------------------------------------------------------------------

PUMP = DraftError(
    "pump-hot", ("Pumps",), "4101", "W10.00", "nonfatal", "300", texts=(DraftText("en", "Pump hot"),),
    details=(DraftDetail("pump", "List", "", (DraftAddress("north", "W12.03"), DraftAddress("south", "W12.04"))),),
)  # fmt: skip


def problems_of(model: Model, *errors: DraftError) -> list[tuple[str, str]]:
    return [(each.path, each.problem.message) for each in check_drafts(model, Drafts(errors))[1]]


@pytest.mark.parametrize(
    ("error", "path", "message"),
    [
        (replace(PUMP, flag="W600.00"), "errors.1.flag", "the last word is W511"),
        (replace(PUMP, flag="W10"), "errors.1.flag", "must be a bit"),
        (replace(PUMP, flag=""), "errors.1.flag", "is missing"),
        (replace(PUMP, id="Pump Hot"), "errors.1.id", "small letters"),
        (replace(PUMP, id="memory-error"), "errors.1.id", "itself"),
        (replace(PUMP, id="first"), "errors.1.id", "is used in line"),
        (replace(PUMP, code="xyz"), "errors.1.code", "four hexadecimal digits"),
        (replace(PUMP, code="12"), "errors.1.code", "have 4"),
        (replace(PUMP, priority="0"), "errors.1.priority", "a whole number from 1"),
        (replace(PUMP, priority="high"), "errors.1.priority", "a whole number from 1"),
        (replace(PUMP, texts=()), "errors.1.texts.0.name", "a name in English"),
        (replace(PUMP, texts=(DraftText("ja", "ポンプ"),)), "errors.1.texts.0.name", "a name in English"),
        (replace(PUMP, group=()), "errors.1.group", "which group"),
        (replace(PUMP, details=(DraftDetail("pump", "List", "", (DraftAddress("n", "W999.01"),)),)),
         "errors.1.details.0.addresses.0.address", "the last word is W511"),
        (replace(PUMP, details=(DraftDetail("pump", "Spin", "", (DraftAddress("", "W1", "Byte", min="0", max="300"),)),)),
         "errors.1.details.0.addresses.0.max", "does not fit into 8 bits"),
        (replace(PUMP, details=(DraftDetail("pump", "Spin", "", (DraftAddress("", "W1", "Byte", min="x", max="3"),)),)),
         "errors.1.details.0.addresses.0.min", "a number"),
        (replace(PUMP, details=(DraftDetail("Pump", "List", "", (DraftAddress("n", "W9.01"),)),)),
         "errors.1.details.0.name", "small letters"),
        (replace(PUMP, details=(DraftDetail("pump", "List", "x", (DraftAddress("n", "W9.01"),)),)),
         "errors.1.details.0.default", "none of the choices"),
        (replace(PUMP, details=(DraftDetail("pump", "List", "", (DraftAddress("n"),)),)),
         "errors.1.details.0.addresses.0.address", "give it an address"),
        (replace(PUMP, details=(DraftDetail("pump", "List", "", (DraftAddress("", "W9.01"),)),)),
         "errors.1.details.0.addresses.0.id", "give the choice an id"),
        (replace(PUMP, details=(DraftDetail("pump", "Spin", "", (DraftAddress("", "W1", "Byte"),)),)),
         "errors.1.details.0.addresses.0.min", "from where to where"),
        (replace(PUMP, also=(DraftAlso("W999.01"),)), "errors.1.also.0.address", "the last word is W511"),
    ],
)  # fmt: skip
def test_a_problem_is_at_its_field(cj1m: Model, error: DraftError, path: str, message: str) -> None:
    first = DraftError("first", ("Pumps",), "4102", "W10.01", "fatal", "5", texts=(DraftText("en", "First"),))
    assert problems_of(cj1m, first, PUMP) == []
    (found,) = problems_of(cj1m, first, error)
    assert found[0] == path
    assert message in found[1]


def test_errors_are_in_the_order_of_the_tree_inner_groups_first(cj1m: Model) -> None:
    """As the browser shows them: sweeps, records and lists of one catalogue have one order."""
    error = (
        '<Error Id="{}" ErrorCode="{}" ErrorFlag="W10.00" Severity="nonfatal" Priority="9" Source="x" Verified="no">'
        "<Name>Pump</Name></Error>"
    )
    text = (
        f"<UserErrors><ErrorGroup><Name>Pumps</Name>{error.format('outer', 'C001')}"
        f"<ErrorSubGroup><Name>Hot</Name>{error.format('inner', 'C002')}</ErrorSubGroup></ErrorGroup></UserErrors>"
    )
    model, problems = with_user_errors(cj1m, text)
    assert model is not None, problems
    found = [(path_text(group.name for group in groups), each.id) for groups, each in model.errors_with_groups()]
    assert found[-2:] == [("User-defined / Pumps / Hot", "inner"), ("User-defined / Pumps", "outer")]
    assert [id for _, id in found] == [each.id for each in model.errors()]
    assert [each.id for each in model.catalogue[-1].walk()] == ["inner", "outer"]
