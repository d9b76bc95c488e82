"""A model file as text and tree: the positions of elements, and files that are wrong throughout."""

import threading

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

from scanbench.plcmodel import user_errors
from scanbench.plcmodel.document import TOLD, Document, parse, schema_of, xml_text
from scanbench.plcmodel.load import model_directory
from scanbench.plcmodel.model import Model
from scanbench.plcmodel.user_errors import with_user_errors

SPACE = st.sampled_from([" ", "\n", "\n  "])
VALUE = st.sampled_from(["", "x", "a>b", "'", "Id = '7'", "/>", "<!--", "日本", "a\nb"])
BETWEEN = st.sampled_from(["", "\n", " text > ", "<!-- <a Id='no'> \" -->", "<![CDATA[<a>]]>", "<?pi <a ?>", "日本"])


@st.composite
def elements(draw: st.DrawFn, depth: int = 3) -> str:
    tag = draw(st.sampled_from(["a", "b", "ab"]))
    attributes = "".join(
        f'{draw(SPACE)}{name}{draw(st.sampled_from(["=", " = "]))}"{escaped(draw(VALUE))}"'
        for name in draw(st.lists(st.sampled_from(["Id", "MyId", "Name"]), unique=True))
    )
    if depth == 0 or draw(st.booleans()):
        return f"<{tag}{attributes}{draw(st.sampled_from(['', ' ', chr(10)]))}/>"
    inside = "".join(draw(BETWEEN) + each for each in draw(st.lists(elements(depth - 1), max_size=4)))
    return f"<{tag}{attributes}>{inside}{draw(BETWEEN)}</{tag}\n>"


def escaped(value: str) -> str:
    return value.replace("<", "&lt;")


@given(elements(), st.sampled_from(["", '<?xml version="1.0"?>\n', "<!-- <a> -->"]))
def test_every_element_and_attribute_is_found_at_its_position(element: str, before: str) -> None:
    text = before + element
    root = etree.fromstring(text.encode(), etree.XMLParser(remove_comments=True))
    document = Document("f.xml", text, root)
    lines = text.split("\n")
    last = (0, 0)
    for node in root.iter(etree.Element):
        span = document.span(node)
        assert lines[span.line - 1][span.column - 1 :].startswith(f"<{node.tag}")
        assert (span.line, span.column) > last
        last = span.line, span.column
        for name, value in node.attrib.items():
            found = document.span(node, str(name))
            written = "\n".join(lines[found.line - 1 : found.end_line])
            rest = len(lines[found.end_line - 1]) - found.end_column + 1
            assert written[found.column - 1 : len(written) - rest].replace("\n", " ") == escaped(str(value))
        assert document.span(node, "None") == span


def errors(count: int, code: str = "C001", between: str = "\n") -> str:
    each = (
        '<Error Id="e{}" ErrorCode="{}" ErrorFlag="W10.00" Severity="nonfatal" Priority="50" Source="x" Verified="no">'
        "<Name>Pump</Name><Description>d</Description></Error>"
    )
    inside = between.join(each.format(number, code) for number in range(count))
    return f"<UserErrors>\n<ErrorGroup><Name>P</Name>\n{inside}</ErrorGroup></UserErrors>"


NOTHING = "<UserErrors>\n<ErrorGroup><Name>P</Name>\n" + "<Error/>\n" * 20_000 + "</ErrorGroup></UserErrors>"


@pytest.mark.parametrize(
    ("text", "first"),
    [
        (errors(TOLD + 1, "ZZ"), 3), (errors(5000, "ZZ"), 3), (errors(5000, "ZZ", " "), 3), (errors(5000), 4),
        (NOTHING, 3),
    ],
    ids=["schema", "long", "one line", "reader", "nothing"],
)  # fmt: skip
def test_of_a_file_that_is_wrong_throughout_the_first_problems_are_told(cj1m: Model, text: str, first: int) -> None:
    """To find the place of each took minutes: the last of these took libxml2 alone 20 seconds."""
    made, problems = with_user_errors(cj1m, text)
    assert made is None
    assert problems[0].span.line == first
    assert len(problems) == TOLD + 1
    more = "there are more problems from here on: mend those above first"
    assert [each.message == more for each in problems] == [*[False] * TOLD, True]


@pytest.mark.parametrize("count", [10, 1500])
@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ('Id="e7" ', "", 10),
        ("<Name>P</Name>", "", 3),
        ("</ErrorGroup>", "<Extra/></ErrorGroup>", 0),
        ('Severity="nonfatal"', 'Severity="bad"', 3),
    ],
)
def test_wide_and_narrow_files_follow_the_same_schema(count: int, old: str, new: str, line: int) -> None:
    schema, good = schema_of(model_directory()), errors(count)
    assert isinstance(parse(good, "f.xml", schema, "UserErrors"), Document)
    found = parse(good.replace(old, new, 1), "f.xml", schema, "UserErrors")
    assert isinstance(found, list)
    assert (found[0].code, found[0].span.line) == ("M002", line or count + 2)


def test_a_known_catalogue_does_not_wait_for_one_that_is_read(cj1m: Model, monkeypatch: pytest.MonkeyPatch) -> None:
    known = errors(1)
    first = with_user_errors(cj1m, known)
    reads, go_on = threading.Event(), threading.Event()
    extend = user_errors._extend

    def slow(model: Model, text: str, file: str) -> user_errors.Extended:
        reads.set()
        assert go_on.wait(30)
        return extend(model, text, file)

    monkeypatch.setattr(user_errors, "_extend", slow)
    other = threading.Thread(target=with_user_errors, args=(cj1m, errors(2)))
    other.start()
    assert reads.wait(30)
    answered = threading.Event()

    def ask() -> None:
        if with_user_errors(cj1m, known) == first:
            answered.set()

    asks = threading.Thread(target=ask)
    asks.start()
    told = answered.wait(30)
    go_on.set()
    asks.join(30)
    other.join(30)
    assert told


def test_text_for_xml_keeps_all_that_xml_can_hold() -> None:
    assert xml_text("　日本語\u200b é\t\n") == "　日本語\u200b é\t\n"
    assert xml_text("a\x00b\x1bc\ud800d\uffff") == "a\ufffdb\ufffdc\ufffdd\ufffd"
