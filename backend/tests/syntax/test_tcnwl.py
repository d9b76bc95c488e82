"""Networks of TwinCAT's files: what runs is what their box trees say, on both engines; what is not read is refused."""

from xml.sax.saxutils import escape

import pytest

from scanbench.check.build import check_sources
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.write import Write
from tests.caseformat import MODELS
from tests.runtime.bench import ENGINES, value
from tests.syntax.shown import complaints

NEGATED, SET, JUMP, RETURN, RISING, FALLING = 1, 2, 4, 8, 16, 32


def flags(bits: int) -> str:
    return f'<o n="Flags" t="Flags">\n<v n="Flags">{bits}</v>\n<v n="Fixed">false</v>\n</o>'


def operand(text: str, bits: int = 0, attributes: str = "") -> str:
    """As a target, or inside of a leaf."""
    value = f'<v n="Operand">"{escape(text)}"</v>' if text else '<n n="Operand" />'
    return f'<o{attributes}>\n{value}\n<v n="Type">"BOOL"</v>\n{flags(bits)}\n<v n="LValue">false</v>\n</o>\n'


def leaf(text: str, bits: int = 0, member: str = "") -> str:
    return f'<o t="BoxTreeOperand"{member}>\n{operand(text, bits, chr(32) + "n=" + chr(34) + "Operand" + chr(34) + " t=" + chr(34) + "Operand" + chr(34))}<v n="Id">4L</v>\n</o>\n'


def targets(*written: str) -> str:
    return (
        f'<o n="OutputItems" t="OutputItemList">\n<l2 n="OutputItems" cet="Operand">\n{"".join(written)}</l2>\n</o>\n'
    )


def member(tree: str, name: str) -> str:
    """A tree as a member of an object."""
    return tree.replace("<o ", f'<o n="{name}" ', 1)


def assign(value: str, *written: str, bits: int = 0) -> str:
    return f'<o t="BoxTreeAssign">\n{targets(*written)}{flags(bits)}\n{member(value, "RValue")}<v n="Id">2L</v>\n</o>\n'


def names(of: str, *pins: str) -> str:
    each = "".join(f"<v>{pin}</v>\n" for pin in pins)
    return f'<o n="{of}" t="ParamList">\n<l2 n="Names" cet="String">\n{each}</l2>\n</o>\n'


def box(
    kind: str,
    *inputs: str,
    instance: str = "",
    pins: tuple[str, ...] = (),
    outs: tuple[str, ...] = (),
    to: tuple[str, ...] = (),
    bits: tuple[int, ...] = (),
    more: str = "",
) -> str:
    own = operand(instance, 0, ' n="Instance" t="Operand"')
    input_flags = "".join(f'<o>\n<v n="Flags">{each}</v>\n</o>\n' for each in bits)
    return (
        f'<o t="BoxTreeBox">\n<v n="BoxType">"{kind}"</v>\n{own}{targets(*to)}<l2 n="InputItems">\n{"".join(inputs)}</l2>\n'
        f'<l2 n="InputFlags" cet="Flags">\n{input_flags}</l2>\n{names("InputParam", *pins)}{names("OutputParam", *outs)}{more}</o>\n'
    )  # fmt: skip


def demux(number: int, value: str = "") -> str:
    return f'<o t="BoxTreeDemux">\n<v n="VarId">{number}</v>\n{member(value, "Input") if value else ""}</o>\n'


def parallel(feed: str, *trees: str, mode: str = "BoxShortCircuit") -> str:
    """Branches in a ladder that `feed` leads to."""
    fed = member(feed, "Input") if feed else ""
    return f'<o t="BoxTreeParallel">\n<v n="Mode" t="ParallelMode">{mode}</v>\n{fed}<l2 n="Trees">\n{"".join(trees)}</l2>\n</o>\n'


RESULT = '<v n="MainOutputIndex">1</v>\n'
MAIN_OUTPUT = '<v n="EN">true</v>\n'


def enabled(
    kind: str,
    *inputs: str,
    pins: tuple[str, ...] = (),
    outs: tuple[str, ...] = ("ENO", ""),
    instance: str = "",
    to: str = "",
    more: str = MAIN_OUTPUT,
) -> str:
    """A box whose first input is EN and its first output ENO, the second its result; `to`: a target of the result."""
    targets = (operand(""), operand(to)) if to else ()
    return box(kind, *inputs, instance=instance, pins=("EN", *pins), outs=outs, to=targets, more=more)


END = '<o t="BoxTreeTerminator">\n<n n="Input" />\n</o>\n'


TIMER = box("TON", leaf("a"), leaf("T#0s"), instance="t", pins=("IN", "PT"), outs=("Q", "ET"))


def network(*items: str, label: str = "", off: bool = False) -> str:
    return (
        f'<o>\n<v n="ILActive">false</v>\n<l2 n="ILLines" />\n<v n="Title">"A title"</v>\n<v n="Label">"{label}"</v>\n'
        f'<v n="OutCommented">{str(off).lower()}</v>\n<l2 n="NetworkItems">\n{"".join(items)}</l2>\n</o>\n'
    )  # fmt: skip


def body(*networks: str) -> str:
    listed = f'<l2 n="NetworkList" cet="Network">\n{"".join(networks)}</l2>\n'
    return f'<Implementation>\n<NWL>\n<XmlArchive>\n<Data>\n<o xml:space="preserve" t="NWLImplementationObject">\n{listed}</o>\n</Data>\n</XmlArchive>\n</NWL>\n</Implementation>\n'


def block(*networks: str, more: str = "") -> str:
    declared = """FUNCTION_BLOCK FB
VAR_INPUT a, b, c : BOOL; x : INT; END_VAR VAR_OUTPUT q, r, s : BOOL; y, z : INT; END_VAR VAR t : TON; u : CTU; END_VAR
"""
    return f'<TcPlcObject>\n<POU Name="FB" Id="{{1}}">\n<Declaration><![CDATA[{declared}]]></Declaration>\n{body(*networks)}{more}</POU>\n</TcPlcObject>\n'


MAIN = "PROGRAM Main\nVAR fb : FB; a, b, c, q, r, s : BOOL; x, y, z : INT; END_VAR\nfb(a := a, b := b, c := c, x := x, q => q, r => r, s => s, y => y, z => z);\nEND_PROGRAM\n"


def ran(source: str, *scans: str) -> list[str]:
    """What is TRUE of q, r, s after each scan, and y and z; of `scans` the variables that are TRUE, and x: `ab 5`."""
    made = check_sources({"FB.TcPOU": source, "Main.st": MAIN}, MODELS["GENERIC-IEC"])
    assert made.program is not None, made.problems
    assert made.problems == ()
    told = []
    for engine in ENGINES:
        resource = Resource(Loaded.make(made.program, engine))
        found = []
        for scan in scans:
            letters, _, number = scan.partition(" ")
            for name in "abc":
                resource.submit(Write("Ada", f"Main.{name}", str(name in letters).upper()))
            resource.submit(Write("Ada", "Main.x", number or "0"))
            resource.run(1)
            true = "".join(name for name in "qrs" if value(resource, f"Main.{name}"))
            found.append(f"{true} {value(resource, 'Main.y')} {value(resource, 'Main.z')}".strip())
        told.append(found)
    assert told[0] == told[1]
    return told[0]


def test_contacts_coils_and_their_kinds() -> None:
    hold = assign(box("AND", box("OR", leaf("a"), leaf("q")), leaf("b", NEGATED)), operand("q"), operand("r", NEGATED))
    stored = assign(leaf("a"), operand("s", SET))
    taken = assign(leaf("c"), operand("s", SET | NEGATED))
    source = block(network(hold), network(stored, taken))
    assert ran(source, "a", "", "b", "c") == ["qs 0 0", "qs 0 0", "rs 0 0", "r 0 0"]


def test_negated_inputs_and_edges() -> None:
    inputs = assign(box("AND", leaf("a"), box("OR", leaf("b"), leaf("c")), bits=(0, NEGATED)), operand("q"))
    edges = [
        assign(leaf("a", RISING), operand("r")),
        assign(box("OR", leaf("b"), leaf("c"), bits=(FALLING, 0)), operand("s")),
    ]
    assert ran(block(network(inputs), network(*edges)), "ab", "a", "a") == ["r 0 0", "qs 0 0", "q 0 0"]


def test_blocks_functions_and_what_they_give_out() -> None:
    count = box("CTU", leaf("a"), leaf("b"), leaf("2"), instance="u", pins=("CU", "RESET", "PV"), outs=("Q", "CV"))
    count = count.replace("RESET", "R")
    timer = box(
        "TON", leaf("a"), leaf("T#0s"), instance="t", pins=("IN", "PT"), outs=("Q", "ET"), to=(operand("r"), "<n />\n")
    )
    source = block(
        network(assign(count, operand("q"))),
        network(timer),
        network(box("ADD", box("MUL", leaf("x"), leaf("2")), leaf("1"), to=(operand("y"),))),
        network(assign(box("GT", leaf("y"), leaf("x + 3")), operand("s"))),
    )  # fmt: skip
    assert ran(source, "a 1", " 3", "a 3", "b 0") == ["r 3 0", "s 7 0", "qrs 7 0", "1 0"]


def test_wires_that_several_read_run_once() -> None:
    made = demux(1, box("ADD", leaf("y"), leaf("1")))
    source = block(network(made, assign(demux(1), operand("y")), assign(demux(1), operand("z"))))
    assert ran(source, "", "", "") == ["1 1", "2 2", "3 3"]


def test_jumps_returns_and_networks_that_are_commented_out() -> None:
    source = block(
        network(assign(leaf("a"), operand("done", JUMP))),
        network(assign(leaf("x"), operand("y"))),
        network(assign(leaf("9"), operand("z")), off=True),
        network(assign(leaf("b"), operand("", RETURN)), label="done"),
        network(assign(END, operand("q"))),
    )
    assert ran(source, " 4", "a 5", "b 6") == ["q 4 0", "q 4 0", "q 6 0"]


def test_actions_and_methods_may_be_drawn() -> None:
    action = f'<Action Name="Act" Id="{{2}}">\n{body(network(assign(leaf("a"), operand("q"))))}</Action>\n'
    source = block(network(box("Act")), more=action)
    assert ran(source, "a", "") == ["q 0 0", "0 0"]


def test_boxes_with_en() -> None:
    """Without EN nothing is called, and the variable keeps its value; ENO goes on in the ladder."""
    source = block(
        network(assign(enabled("ADD", leaf("a"), leaf("y"), leaf("2"), to="y"), operand("q"))),
        network(assign(enabled("TON", leaf("b"), leaf("c"), leaf("T#0s"), pins=("IN", "PT"), outs=("ENO", "Q", "ET"), instance="t"), operand("r"))),
        network(assign(leaf("t.Q"), operand("s"))),
        network(enabled("SEL", END, leaf("a"), leaf("x"), leaf("y"), to="z")),
    )  # fmt: skip
    assert ran(source, "", "a", "c", "bc", "", "b") == ["0 0", "q 2 2", "2 0", "rs 2 0", "s 2 0", "r 2 0"]


def test_parallel_branches_of_a_ladder() -> None:
    source = block(
        network(assign(parallel(leaf("a"), leaf("b"), leaf("c", NEGATED)), operand("q"))),
        network(assign(parallel("", box("AND", leaf("a"), leaf("b")), leaf("c")), operand("r"))),
        network(assign(parallel("", leaf("b"), TIMER, mode="Sequential"), operand("s"))),
    )
    assert ran(source, "", "a", "ab", "ac", "c") == ["0 0", "qs 0 0", "qrs 0 0", "rs 0 0", "r 0 0"]


def test_places_are_those_of_the_operands() -> None:
    source = block(network(assign(box("AND", leaf("a"), leaf("nope")), operand("q"))))
    made = check_sources({"FB.TcPOU": source, "Main.st": MAIN}, MODELS["GENERIC-IEC"])
    (problem,) = [each for each in made.problems if "nope" in each.message]
    line = source.split("\n")[problem.span.line - 1]
    assert line[problem.span.column - 1 :].startswith('nope"')


REFUSED = [
    (box("ADD", leaf("x"), leaf("1"), to=(operand("y"),), more='<v n="EN">true</v>\n'), "The box ADD in network 1 has EN, but its first input is not EN"),
    (assign(enabled("ADD", leaf("a"), leaf("x"), leaf("1"), more=f"{MAIN_OUTPUT}{RESULT}"), operand("y")), "The result of the box ADD in network 1, which has EN, goes to more than a variable, which is not read"),
    (assign(parallel("", leaf("a"), TIMER), operand("q")), "Network 1 calls a block in a branch with short circuit, which is not read"),
    (box("EXECUTE", more='<v n="ProvidesSTSnippet">true</v>\n'), "Network 1 has a box with statements (EXECUTE), which is not read"),
    ('<o t="BoxTreeParallel">\n</o>\n', "A parallel branch in network 1 has nothing in it"),
    ('<o t="BoxTreeOther">\n</o>\n', "Network 1 has a BoxTreeOther, which is not read"),
    (assign(box("AND", leaf("a"), leaf("???")), operand("q")), "Input 2 of the box AND in network 1 is not connected"),
    (assign(leaf("a"), operand("???")), "In network 1 a coil or assignment has no variable"),
    (assign(leaf(""), operand("q")), "In network 1 nothing is connected to a coil or assignment"),
]  # fmt: skip


@pytest.mark.parametrize(("item", "message"), REFUSED, ids=[str(at) for at, _ in enumerate(REFUSED)])
def test_what_is_not_read_is_refused_by_its_name(item: str, message: str) -> None:
    (complaint,) = complaints(block(network(item)), "FB.TcPOU")
    assert complaint.endswith(
        f" {message}; in TwinCAT export this POU as PLCopen XML and import that, or write the body as Structured Text."
    )


def test_every_cut_of_a_file_is_answered() -> None:
    source = block(network(assign(box("AND", leaf("a"), leaf("b")), operand("q"))))
    for end in range(source.index("<NWL>"), len(source), 13):
        complaints(source[:end] + source[end + 31 :], "FB.TcPOU")
