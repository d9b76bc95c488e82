"""Sequential function charts of TwinCAT's files: what runs is what the archive says, on both engines; what is not read is refused."""

from xml.sax.saxutils import escape

import pytest

from scanbench.check.build import check_sources
from scanbench.syntax import tcsfc
from tests.caseformat import MODELS
from tests.syntax.shown import complaints
from tests.syntax.test_tcnwl import block, ran


def attributes(**values: str) -> str:
    """Values by the names that `tcsfc` has for their GUIDs."""
    each = "".join(
        f'<o>\n<v n="AttributeId">{{{getattr(tcsfc, name)}}}</v>\n<o n="Value" t="StringValue">\n<v n="Value">"{escape(value)}"</v>\n'
        f'<v n="DefaultValue">""</v>\n</o>\n<v n="Id">1L</v>\n</o>\n'
        for name, value in values.items()
    )
    return f'<l2 n="Attributes" cet="SFCAttribute">\n{each}</l2>\n'


def elements(*items: str, of: str = "") -> str:
    listed = f' cet="{of}"' if of else ""
    return f'<o n="ElementList" t="SFCElementList">\n<l2 n="InnerList"{listed}>\n{"".join(items)}</l2>\n</o>\n'


def step(name: str, *actions: str, main: str = "", first: bool = False, more: str = "", **others: str) -> str:
    made = attributes(NAME=name, INITIAL=str(first).upper(), EXCLUDED="FALSE", MINIMUM="", MAIN=main, **others)
    return f'<o t="SFCStep">\n<n n="EmbeddedMainAction" />\n{more}{elements(*actions)}{made}</o>\n'


def action(name: str, qualifier: str) -> str:
    return f'<o t="SFCAction">\n{attributes(NAME=name, QUALIFIER=qualifier)}</o>\n'


def to(condition: str) -> str:
    """A transition."""
    return f'<o t="SFCTransition">\n<n n="EmbeddedTransition" />\n{attributes(NAME=condition, EXCLUDED="FALSE")}</o>\n'


def jump(name: str) -> str:
    return f'<o t="SFCJump">\n{attributes(NAME=name)}</o>\n'


def branch(*legs: tuple[str, ...], parallel: bool = False) -> str:
    made = "".join(f"<o>\n{elements(*leg)}{attributes(NAME='')}</o>\n" for leg in legs)
    return f'<o t="SFCBranch">\n{elements(made, of="SFCSegment")}{attributes(PARALLEL=str(parallel).upper())}</o>\n'


def act(name: str, text: str) -> str:
    return f'<Action Name="{name}" Id="{{2}}">\n<Implementation>\n<ST><![CDATA[{text}]]></ST>\n</Implementation>\n</Action>\n'


def named(name: str, text: str) -> str:
    return act(name, text).replace("Action", "Transition")


def source(*items: str, more: str = "") -> str:
    """A file with this chart, of the block that `ran` runs."""
    empty = block(more=more)
    at, end = empty.index("<NWL>"), empty.index("</NWL>") + 7
    root = f'<o n="Root" t="SFCSegment">\n{elements(*items)}</o>\n'
    archive = f'<o xml:space="preserve" t="SFCImplementationObject">\n{root}</o>\n'
    return f"{empty[:at]}<SFC>\n<XmlArchive>\n<Data>\n{archive}</Data>\n</XmlArchive>\n</SFC>\n{empty[end:]}"


def test_steps_their_actions_and_a_jump() -> None:
    """A main action runs in each scan of its step, and not once more."""
    actions = act("Count", "y := y + 1;") + act("In", "z := z + 1;") + act("Out", "z := z + 10;")
    chart = source(
        step("One", main="Count", first=True, ENTRY="In", EXIT="Out"), to("a"), step("Two"), to("b"), jump("One"), more=actions
    )  # fmt: skip
    assert ran(chart, "", "", "a", "", "", "b", "") == ["1 1", "2 1", "3 1", "3 11", "3 11", "3 11", "4 12"]


def test_actions_of_the_standard_with_qualifiers() -> None:
    chart = source(
        step("One", action("q", "N"), action("r", "S"), action("s", "L T#15ms"), first=True),
        to("a"), step("Two", action("r", "R")), to("b"), jump("One"),
    )  # fmt: skip
    assert ran(chart, "", "", "", "a", "", "") == ["qrs 0 0", "qrs 0 0", "qr 0 0", "qr 0 0", "0 0", "0 0"]


def test_the_first_alternative_that_is_true_goes_on() -> None:
    legs = (
        (to("a"), step("Left", action("q", "N")), to("x = 1")),
        (to("b"), step("Right", action("r", "N")), to("x = 2")),
    )
    chart = source(step("One", first=True), branch(*legs), step("Two", action("s", "N")), to("c"), jump("One"))
    assert ran(chart, "ab", "", " 2", " 1", "", "c", "b", "", " 2", "") == [
        "0 0", "q 0 0", "q 0 0", "q 0 0", "s 0 0", "s 0 0", "0 0", "r 0 0", "r 0 0", "s 0 0"
    ]  # fmt: skip


def test_an_alternative_may_jump_and_another_hold_simultaneous_steps() -> None:
    both = branch(
        (step("L", action("q", "N")),), (step("Rt", action("r", "N")), to("x = 1"), step("R2")), parallel=True
    )
    legs = (to("a"), both), (to("b"), jump("One"))
    chart = source(
        step("One", first=True), branch(*legs), to("x = 2"), step("End", action("s", "N")), to("c"), jump("One")
    )  # fmt: skip
    assert ran(chart, "b", "a", "", " 2", " 1", " 2", "") == [
        "0 0", "0 0", "qr 0 0", "qr 0 0", "qr 0 0", "q 0 0", "s 0 0"
    ]  # fmt: skip


def test_simultaneous_branches_begin_and_end_together() -> None:
    legs = (step("L", action("q", "N")), to("b"), step("L2")), (step("Rt", action("r", "N")),)
    chart = source(
        step("One", first=True), to("a"), branch(*legs, parallel=True), to("c"), step("Two", action("s", "N")), to("FALSE"), jump("One")
    )  # fmt: skip
    assert ran(chart, "a", "c", "bc", "c", "", "") == ["0 0", "qr 0 0", "qr 0 0", "r 0 0", "s 0 0", "s 0 0"]


def test_a_transition_may_be_a_part_of_the_pou() -> None:
    more = named("Ready", "Ready := a AND x > 3;") + named("Back", "b")
    chart = source(
        step("One", first=True), to("Ready"), step("Two", action("q", "N")), to("back"), jump("One"), more=more
    )
    assert ran(chart, "a 3", " 4", "a 4", "", "b", "") == ["0 0", "0 0", "0 0", "q 0 0", "q 0 0", "0 0"]


def test_places_are_those_of_the_archive() -> None:
    text = source(step("One", first=True), to("a AND nope"), jump("One"))
    problems = check_sources({"FB.TcPOU": text}, MODELS["GENERIC-IEC"]).problems
    (complaint,) = [each for each in problems if "nope" in each.message]
    line = text.split("\n")[complaint.span.line - 1]
    assert line[complaint.span.column - 1 :].startswith('nope"')


ONE = step("One", first=True)
REFUSED = [
    ((ONE, '<o t="SFCMacro">\n</o>\n'), "This chart has a SFCMacro, which is not read"),
    ((ONE, to("a")), "The last transition of this chart leads nowhere"),
    ((ONE, step("Two")), "No transition leads to the step Two of this chart"),
    ((ONE, to("a"), to("b")), "No step is before the transition b of this chart"),
    ((ONE, jump("One")), "No transition is before the jump to One of this chart"),
    ((ONE, to("")), "A part of this chart has no name"),
    ((ONE, branch((to("a"), step("L")), (to("b"), step("Rt"))), to("c")), "An alternative branch of this chart ends with steps, which is not read"),
    ((ONE, to("a"), branch((step("L"), to("b")), (step("Rt"),), parallel=True)), "A simultaneous branch of this chart does not begin and end with steps"),
    ((step("One", action("q", "X"), first=True),), "A step of this chart has a SFCAction, which is not read"),
    ((step("One", action("q", "L"), first=True),), "A step of this chart has a SFCAction, which is not read"),
    ((step("One", first=True).replace('n="Value">""', 'n="Value">"T#1s"', 1),), "The step One of this chart has a minimal time, which is not read"),
    ((step("One", first=True, more='<o n="EmbeddedEntryAction">\n</o>\n'),), "A step of this chart has an action inside of it, which is not read"),
    ((step("One", first=True).replace('"FALSE"', '"TRUE"', 1),), "A part of this chart is excluded from the build, which is not read"),
]  # fmt: skip


@pytest.mark.parametrize(("items", "message"), REFUSED, ids=[str(at) for at, _ in enumerate(REFUSED)])
def test_what_is_not_read_is_refused_by_its_name(items: tuple[str, ...], message: str) -> None:
    (complaint,) = complaints(source(*items), "FB.TcPOU")
    assert complaint.split(" ", 2)[2].split("; in TwinCAT")[0] == message


def test_a_transition_with_more_than_an_expression_is_refused() -> None:
    more = named("Ready", "Ready := a; y := 1;")
    (complaint,) = complaints(source(ONE, to("Ready"), jump("One"), more=more), "FB.TcPOU")
    assert "The transition Ready is more than one expression, which is not read" in complaint


def test_flags_that_drive_a_chart_are_refused() -> None:
    text = source(ONE, to("a"), jump("One")).replace("VAR t :", "VAR SFCReset : BOOL; t :")
    (complaint,) = complaints(text, "FB.TcPOU")
    assert "This POU has SFCReset, with which a chart is driven in TwinCAT, which is not read" in complaint


def test_every_cut_of_a_file_is_answered() -> None:
    text = source(
        ONE, branch((to("a"), jump("One")), (to("b"), step("Two"), to("c"))), step("Three"), to("a"), jump("One")
    )
    for end in range(text.index("<SFC>"), len(text), 37):
        complaints(text[:end] + text[end + 29 :], "FB.TcPOU")
