"""The list of features of the standard and the cases that claim to show them agree."""

from collections import Counter

from tests.features import PAGE, all_cases, page, read_reasons, read_tables, shown_by


def test_features_are_listed_once() -> None:
    tables = read_tables()
    assert len({table.number for table in tables}) == len(tables)
    numbers = Counter(number for table in tables for number in table.features)
    assert not [number for number, times in numbers.items() if times > 1]
    assert all(number.startswith(f"{table.number}.") for table in tables for number in table.features)


def test_every_feature_of_a_case_exists() -> None:
    known = {number for table in read_tables() for number in table.features}
    wrong = {f"{case.name}: {number}" for case in all_cases() for number in case.features if number not in known}
    assert not wrong, "numbers that tests/features does not list"


def test_reasons_are_for_features_without_a_case() -> None:
    known = {number for table in read_tables() for number in table.features}
    shown = shown_by(all_cases())
    refused, elsewhere = read_reasons("refused"), read_reasons("not_applicable")
    assert not set(refused) & set(elsewhere)
    for number in {**refused, **elsewhere}:
        assert number in known, number
        assert number not in shown, f"{number} has a reason for not being shown, and is shown by {shown[number]}"


def test_the_page_is_up_to_date() -> None:
    assert PAGE.read_text("utf-8") == page(), "docs/features.md is out of date: make features"


def test_every_feature_is_accounted_for() -> None:
    """Shown by a case, refused with a reason, or not applicable."""
    accounted = {*shown_by(all_cases()), *read_reasons("refused"), *read_reasons("not_applicable")}
    assert not [number for table in read_tables() for number in table.features if number not in accounted]
