"""Sentences as they come out of Scanbench, and what a reader of Japanese gets."""

import re

import pytest

from scanbench.check.build import check_sources
from scanbench.translation.catalogue import catalogue
from scanbench.translation.inside import at_paths, in_shapes, paragraphs, wanted
from scanbench.translation.said import MOST_TRIED, Language, Work, say, template
from tests.caseformat import MODELS
from tests.check.test_problems import BODIES, FILES, MAIN


@pytest.mark.parametrize(
    ("english", "japanese"),
    [
        ("`vlave` is not declared. Did you mean `valve` or `valves`?", "`vlave` は宣言されていません。`valve`、`valves` ではありませんか。"),
        ("The value wanted here is INT, but this is REAL. Convert it with REAL_TO_INT.",
         "ここで必要な値は INT ですが、これは REAL です。REAL_TO_INT で変換してください。"),
        ("`;` expected after the name of the task, found `x`.", "タスク名の後に`;` が必要です（`x` があります）。"),
        ("`END_IF` expected to close the IF of line 3, but the file ends here.",
         "3 行の IFを閉じる `END_IF` が必要です（ファイルがここで終わっています）。"),
        ("stopped by a run-time error: Main.st:3:5: division by zero (scan 7)",
         "実行時エラーで停止: Main.st:3:5: 0 による除算（スキャン 7）"),
        ("build refused: 2 errors, the first: Main.st:1:2: T001 `x` is not declared.",
         "ビルドできませんでした: エラー 2 件。最初のエラー: Main.st:1:2: T001 `x` は宣言されていません。"),
        ("Main.n: 40000 is outside of INT (-32768 to 32767)", "Main.n: 40000 は INT（-32768 ～ 32767）の範囲外です"),
        ("2 forces released", "強制を 2 件解除しました"),
    ],
)  # fmt: skip
def test_sentences(english: str, japanese: str) -> None:
    assert say(english, "ja") == japanese
    assert say(english, "en") == english


def test_a_name_is_never_translated() -> None:
    assert say("`comment` is not declared.", "ja") == "`comment` は宣言されていません。"


@pytest.mark.parametrize("text", ["", " ", "x := 1;", "42", "Conveyor of hall 3", "日本語の文。", "a" * 5000])
def test_what_no_template_fits_stays(text: str) -> None:
    assert say(text, "ja") == text


def test_problems_of_programs_have_no_english_left() -> None:
    texts = [MAIN.format(body) for _, body, _ in BODIES] + [text for _, text, _ in FILES]
    left = []
    for text in texts:
        for problem in check_sources({"main.st": text}, MODELS["CJ1M-CPU63"]).problems:
            said = say(problem.message, "ja")
            if re.search(r"\b[a-z]{2,} [a-z]{2,}\b", re.sub("`[^`]*`", "", said)):
                left.append(said)
    assert left == []


@pytest.mark.parametrize(
    ("asked", "language"),
    [
        ("", "en"), ("ja", "ja"), ("ja-JP", "ja"), ("ja-JP,ja;q=0.9,en;q=0.8", "ja"), ("en-US,en;q=0.9,ja;q=0.8", "en"),
        ("de-DE,de;q=0.9,ja;q=0.3", "ja"), ("de", "en"), ("ja;q=.", "ja"), (";;,", "en"), ("xx;q=1.5.2,en", "en"),
    ],
)  # fmt: skip
def test_the_language_that_is_asked_for(asked: str, language: str) -> None:
    assert wanted(asked) == language


def test_only_listed_fields_of_a_known_shape_are_said() -> None:
    told = {
        "rows": [{"message": "nothing was changed", "path": "nothing was changed", "notes": ["switched off"]}],
        "files": {"message": "nothing was changed", "path": "nothing was changed"},
    }
    shapes = {frozenset({"message", "path", "notes"}): frozenset({"message", "notes"})}
    assert in_shapes(told, shapes, "ja") == {
        "rows": [{"message": "何も変更していません", "path": "nothing was changed", "notes": ["OFF にしました"]}],
        "files": {"message": "nothing was changed", "path": "nothing was changed"},
    }


def test_only_listed_places_are_said() -> None:
    told = {"body": {"rows": [{"message": "switched off", "value": "switched off"}]}, "message": "switched off"}
    assert at_paths(told, [("body", "rows", "*", "message"), ("none", "message")], "ja") == {
        "body": {"rows": [{"message": "OFF にしました", "value": "switched off"}]}, "message": "switched off",
    }  # fmt: skip


def test_a_text_for_an_editor_is_said_line_by_line() -> None:
    text = "The sum of all arguments.\n- L: how many characters"
    assert paragraphs(text, "ja") == "すべての引数の和。\n- L: 文字数"


@pytest.mark.parametrize(
    "text",
    [
        "a: " * 1300, "a: " * 100 + "x", "m.st:1:1: " * 30 + "x", "there is no program, " * 19, "is not in a; " * 29,
        "`a` is not b. " * 25, "the program cannot be outside of an instance. " * 8,
    ],
)  # fmt: skip
def test_the_work_for_a_text_is_bounded(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    works: list[Work] = []

    def made() -> Work:
        works.append(Work())
        return works[-1]

    monkeypatch.setattr("scanbench.translation.said.Work", made)
    assert say.__wrapped__(text, "ja")
    assert all(work.tried <= MOST_TRIED + 1 for work in works)
    assert len(works) <= 1


def test_an_unknown_text_is_compared_with_few_templates() -> None:
    work = Work()
    text = "Conveyor of hall 3 has the program of yesterday, and nobody knows which instance it is."
    assert Language(catalogue("ja")).say(text, work) == text
    assert work.tried < 1000


def test_a_place_in_a_file_has_one_reading() -> None:
    """With any text between the colons, what ends otherwise was tried at all of them, for minutes."""
    assert template("{0}:{1}:{2}: {3} (scan {4})", "").pattern.pattern.count("[^:]*?") == 2
    assert say("Main.st:3:5: nothing was changed (scan 7)", "ja").startswith("Main.st:3:5: 何も変更していません")


def test_three_things_at_most_are_said_about() -> None:
    assert say("a: b: c: nothing was changed", "ja") == "a: b: c: 何も変更していません"
    assert say("a: b: c: d: nothing was changed", "ja") == "a: b: c: d: nothing was changed"


@pytest.mark.parametrize("text", ["nothing was changed. " * 30, "nothing was changed.\nnothing was changed."])
def test_what_is_too_long_or_of_several_lines_stays(text: str) -> None:
    assert say(text, "ja") == text


def test_a_fault_leaves_the_text(monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture) -> None:
    def broken(_self: Language, _text: str) -> str:
        raise RecursionError

    monkeypatch.setattr(Language, "say", broken)
    assert say.__wrapped__("nothing was changed", "ja") == "nothing was changed"
    assert "could not be said in ja" in caplog.text
