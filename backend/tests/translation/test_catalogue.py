"""Every sentence of the source has its Japanese, and nothing in the catalogue is about a sentence that is gone."""

import re
from importlib.resources import files
from pathlib import Path

import pytest

from scanbench.translation.catalogue import LANGUAGES, PLACE, BadCatalogue, catalogue, read
from scanbench.translation.said import say
from tests.translation.templates import sentences

ENGLISH = [
    line
    for line in (Path(__file__).parent / "english.txt").read_text("utf-8").splitlines()
    if line and not line.startswith("# ")
]
AT_MOST = 39
"""So many sentences stay in English. Whoever translates one makes the number smaller."""
JAPANESE = re.compile("[\u3040-\u30ff\u4e00-\u9fff]")


@pytest.fixture(scope="module", name="found")
def _found() -> dict[str, str]:
    return sentences()


def test_it_is_of_use_to_look_at_the_source(found: dict[str, str]) -> None:
    assert len(found) > 1500
    assert "`{0}` is not declared.{1}" in found


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_sentence_is_translated(language: str, found: dict[str, str]) -> None:
    pairs = catalogue(language)
    missing = [
        f"{where}: {english}" for english, where in found.items() if english not in pairs and english not in ENGLISH
    ]
    assert missing == [], f"write these into backend/scanbench/translation/{language}"


@pytest.mark.parametrize("language", LANGUAGES)
def test_what_stays_in_english_gets_less(language: str, found: dict[str, str]) -> None:
    assert len(ENGLISH) <= AT_MOST
    assert [english for english in ENGLISH if english not in found or english in catalogue(language)] == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_nothing_is_translated_that_nobody_says(language: str, found: dict[str, str]) -> None:
    words = files("scanbench.translation").joinpath(language, "words.txt")
    composed = read("words.txt", words.read_text("utf-8"))
    assert [english for english in catalogue(language) if english not in found and english not in composed] == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_arguments_are_the_same(language: str) -> None:
    wrong = [
        english
        for english, said in catalogue(language).items()
        if sorted({place[1] for place in PLACE.finditer(english)})
        != sorted({place[1] for place in PLACE.finditer(said)})
    ]
    assert wrong == []


def test_japanese_is_japanese() -> None:
    english_words = re.compile("[a-z]{2,}")
    wrong = [
        said
        for said in catalogue("ja").values()
        if english_words.search(PLACE.sub("", said)) and not JAPANESE.search(said)
    ]
    assert wrong == []


def test_every_template_is_found_again() -> None:
    """With a name for each argument, the sentence that comes out is that of its own template."""
    wrong = []
    for english, said in catalogue("ja").items():
        values = {place[1]: _value(english, place) for place in PLACE.finditer(english)}
        asked, expected = say(_filled(english, values), "ja"), _filled(said, values)
        if _bare(asked) != _bare(expected):
            wrong.append((english, asked, expected))
    assert wrong == []


def _value(english: str, place: re.Match[str]) -> str:
    """What follows another argument at once is an addition, such as one in brackets."""
    follows = english[: place.start()].endswith("}") and not english[: place.start()].endswith("}}")
    return f" (Q{place[1]}x)" if follows else f"Q{place[1]}x"


def _filled(text: str, values: dict[str, str]) -> str:
    return PLACE.sub(lambda place: "" if place[2] else values[place[1]], text).replace("{{", "{").replace("}}", "}")


def _bare(text: str) -> str:
    return text.replace(" ", "")


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("One.\nTwo.\n    二。\n", "x.txt:2: the line above has no translation"),
        ("One.\n    一。\n    二。\n", "x.txt:3: this translates nothing"),
        ("One.\n    一。\nOne.\n    二。\n", "x.txt:3: this is translated twice"),
        ("One.\n", "x.txt: the last line has no translation"),
    ],
)
def test_a_file_that_is_wrong_is_refused(text: str, fault: str) -> None:
    with pytest.raises(BadCatalogue) as caught:
        read("x.txt", text)
    assert str(caught.value) == fault
