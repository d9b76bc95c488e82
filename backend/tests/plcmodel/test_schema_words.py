"""What a schema finds wrong, said to people: what, where, what to do; never as libxml2 says it."""

import re

import pytest

from scanbench.plcmodel.document import Document, parse, schema_of
from scanbench.plcmodel.load import model_directory
from scanbench.plcmodel.schema_words import in_words

GOOD = """<UserErrors>
<ErrorGroup><Name>Lift</Name>
<Error Id="lift" ErrorCode="4F02" ErrorFlag="W10.05" Severity="nonfatal" Priority="1000"><Name>Lift blocked</Name></Error>
</ErrorGroup></UserErrors>"""


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ('"nonfatal"', '"non-fatal"', "Severity of <Error> is 'non-fatal', it can be fatal or nonfatal. Did you mean `nonfatal`?"),
        ('"nonfatal"', '"mild"', "Severity of <Error> is 'mild', it can be fatal or nonfatal"),
        ('Id="lift"', 'Id="Lift Up"', "Id of <Error> is 'Lift Up': write small letters and digits, with hyphens between"),
        ('Id="lift"', f'Id="{"a" * 70}"', "Id of <Error> has 70 characters: write 64 at most"),
        ('"4F02"', '"ZZ"', "ErrorCode of <Error> is 'ZZ': write the code's digits, as `4F02`"),
        ('"W10.05"', '"W10;05"', "ErrorFlag of <Error> is 'W10;05': write an address of the model, as `W10.05`"),
        (' Priority="1000"', "", '<Error> has no Priority: write Priority="..." into it'),
        ('"1000"', '"first"', "Priority of <Error> is 'first'"),
        (' Priority="1000"', ' Priority="1000" Colour="red"', "<Error> takes no Colour: remove it"),
        ("<Name>Lift blocked</Name>", "", "<Error> lacks <Name>: write one inside of it"),
        ("<Name>Lift blocked</Name>", "<Nam>x</Nam>", "<Nam> does not belong here: only <Name> is allowed"),
        ("<ErrorGroup>", "<ErrorGroup>Lift", "there is text in <ErrorGroup>, where none belongs: remove it"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said_in_words(old: str, new: str, says: str) -> None:
    schema = schema_of(model_directory())
    assert isinstance(parse(GOOD, "errors.xml", schema, "UserErrors"), Document)
    assert old in GOOD
    found = parse(GOOD.replace(old, new, 1), "errors.xml", schema, "UserErrors")
    assert isinstance(found, list)
    assert found[0].message.startswith(says), found[0].message
    assert not any(re.search(r"facet|key-sequence|Element '|atomic type", each.message) for each in found)
    assert found[0].span.line in (2, 3)


def test_what_is_not_known_stays() -> None:
    assert in_words("something else") == "something else"
    assert in_words("Element 'Error': Something new.") == "<Error>: Something new"
