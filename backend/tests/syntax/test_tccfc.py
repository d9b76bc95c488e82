"""Continuous function charts of TwinCAT's files: they run in the order of their list, on both engines; what is not read is refused."""

from dataclasses import dataclass, field

import pytest

from tests.syntax.shown import complaints
from tests.syntax.test_tcnwl import block, ran


@dataclass
class Drawn:
    """An archive as it is written: items in the order of the list, with numbers as they come."""

    items: list[str] = field(default_factory=list)
    last: int = 10

    def number(self) -> int:
        self.last += 1
        return self.last

    def pin(self, member: str = "", negated: bool = False, store: str = "None", more: str = "") -> tuple[str, int]:
        own = self.number()
        name = f' n="{member}" t="CFCPin"' if member else ""
        return (
            f'<o{name}>\n<v n="Negated">{str(negated).lower()}</v>\n<v n="SetReset" t="SetReset">{store}</v>\n'
            f'<v n="SetResetRef" t="SetResetRef">None</v>\n{more}<v n="Id">{own}L</v>\n</o>\n'
        ), own  # fmt: skip

    def text(self, text: str, member: str = "") -> str:
        name = f' n="{member}" t="CFCText"' if member else ""
        return f'<o{name}>\n<v n="Text">"{text}"</v>\n<v n="Id">{self.number()}L</v>\n</o>\n'

    def input(self, text: str, negated: bool = False) -> int:
        """The number of its pin."""
        pin, own = self.pin("Output", negated)
        self.items.append(
            f'<o t="CFCInputElement">\n{pin}{self.text(text, "Text")}<v n="Id">{self.number()}L</v>\n</o>\n'
        )
        return own

    def output(self, text: str, source: int, negated: bool = False, store: str = "None") -> None:
        pin, own = self.pin("Input", negated, store)
        self.items.append(
            f'<o t="CFCOutputElement">\n{pin}{self.text(text, "Text")}<v n="Id">{self.number()}L</v>\n</o>\n'
        )
        self.connect(source, own)

    def connect(self, source: int, target: int) -> None:
        if source:
            made = f'<v n="SourcePinId">{source}L</v>\n<v n="DestPinId">{target}L</v>\n<v n="Id">{self.number()}L</v>\n'
            self.items.append(f'<o t="CFCConnection">\n{made}</o>\n')

    def box(
        self,
        kind: str,
        ins: dict[str, int] | list[int],
        outs: tuple[str, ...] = ("",),
        instance: str = "",
        en: bool = False,
    ) -> list[int]:
        """The numbers of its outputs."""
        named = ins if isinstance(ins, dict) else {f"-{at}": each for at, each in enumerate(ins)}
        pins, numbers = zip(*(self.pin() for _ in named), strict=True)
        given, out_numbers = zip(*(self.pin() for _ in outs), strict=True)
        texts = [name if isinstance(ins, dict) else "" for name in named] + [*outs, kind] + [instance] * bool(instance)
        lists = "".join(
            f'<o n="{name}" t="CFCItemList">\n<l2 n="InnerList" cet="{of}">\n{"".join(found)}</l2>\n</o>\n'
            for name, of, found in (
                ("Inputs", "CFCInputPin", pins),
                ("Outputs", "CFCOutputPin", given),
                ("Texts", "CFCText", [self.text(each) for each in texts]),
            )
        )
        call = "FunctionBlock" if instance else "Operator"
        self.items.append(
            f'<o t="CFCBoxElement">\n{lists}<v n="EnEno">{str(en).lower()}</v>\n<v n="KindOfCall" t="KindOfCall">{call}</v>\n'
            f'<v n="Id">{self.number()}L</v>\n</o>\n'
        )  # fmt: skip
        for source, target in zip(named.values(), numbers, strict=True):
            self.connect(source, target)
        return list(out_numbers)

    def body(self) -> str:
        listed = f'<o n="Items" t="CFCItemList">\n<l2 n="InnerList">\n{"".join(self.items)}</l2>\n</o>\n'
        return f'<CFC>\n<XmlArchive>\n<Data>\n<o xml:space="preserve" t="CFCImplementationObject">\n{listed}</o>\n</Data>\n</XmlArchive>\n</CFC>\n'

    def source(self) -> str:
        """A file with it, of the block that `ran` runs."""
        return block().replace(block()[block().index("<NWL>") : block().index("</NWL>") + 7], self.body())


def test_operators_and_their_wires() -> None:
    drawn = Drawn()
    a, b, x, two = drawn.input("a"), drawn.input("b", negated=True), drawn.input("x"), drawn.input("2")
    (both,) = drawn.box("AND", [a, b])
    drawn.output("q", both)
    drawn.output("r", both, negated=True)
    (twice,) = drawn.box("MUL", [x, two])
    (more,) = drawn.box("ADD", [twice, x])
    drawn.output("y", twice)
    drawn.output("z", more)
    assert ran(drawn.source(), "a 1", "ab 2", " 3") == ["q 2 3", "r 4 6", "r 6 9"]


def test_the_list_is_the_order_of_execution() -> None:
    """What is read above the box it comes from has the value of the scan before."""
    drawn = Drawn()
    y = drawn.input("y")
    drawn.output("z", y)
    drawn.output("y", drawn.input("x"))
    assert ran(drawn.source(), " 4", " 5", " 6") == ["4 0", "5 4", "6 5"]


def test_blocks_set_and_reset() -> None:
    drawn = Drawn()
    done, _ = drawn.box("TON", {"IN": drawn.input("a"), "PT": drawn.input("T#0s")}, ("Q", "ET"), "t")
    drawn.output("q", done)
    drawn.output("r", done, store="Set")
    drawn.output("r", drawn.input("c"), store="Reset")
    full, count = drawn.box("CTU", {"CU": done, "R": 0, "PV": drawn.input("2")}, ("Q", "CV"), "u")
    drawn.output("s", full)
    drawn.output("y", count)
    assert ran(drawn.source(), "a", "", "a", "c") == ["qr 1 0", "r 1 0", "qrs 2 0", "s 2 0"]


def test_a_block_with_en_is_called_with_power_only() -> None:
    drawn = Drawn()
    en = {"EN": drawn.input("b"), "IN": drawn.input("a"), "PT": drawn.input("T#0s")}
    eno, done, _ = drawn.box("TON", en, ("ENO", "Q", "ET"), "t", en=True)
    drawn.output("q", eno)
    drawn.output("r", done)
    assert ran(drawn.source(), "a", "ab", "", "b") == ["0 0", "qr 0 0", "r 0 0", "q 0 0"]


def test_a_loop_of_a_wire_keeps_what_it_had() -> None:
    drawn = Drawn()
    later = drawn.last + 40
    (kept,) = drawn.box("OR", [drawn.input("a"), later])
    drawn.last = later - 3
    (given,) = drawn.box("AND", [kept, drawn.input("b", negated=True)])
    drawn.output("q", given)
    source = drawn.source().replace(f"{later}L", f"{given}L")
    assert ran(source, "a", "", "b", "") == ["q 0 0", "q 0 0", "0 0", "0 0"]


def refused(drawn: Drawn) -> str:
    (complaint,) = complaints(drawn.source(), "FB.TcPOU")
    return complaint.split(" ", 2)[2].split("; in TwinCAT")[0]


def test_what_is_not_read_is_refused_by_its_name() -> None:
    drawn = Drawn(['<o t="CFCJumpElement">\n</o>\n'])
    assert refused(drawn) == "This CFC has a CFCJumpElement, which is not read"
    drawn = Drawn()
    drawn.output("q", 0)
    assert refused(drawn) == "Nothing is connected to the output q of this CFC"
    drawn = Drawn()
    drawn.output("q", 999)
    assert refused(drawn) == "A connection of this CFC begins at a pin that there is not"
    drawn = Drawn()
    drawn.box("ADD", [drawn.input("x"), 0])
    assert refused(drawn) == "Input 2 of the box ADD in this CFC is not connected"
    drawn = Drawn()
    (sum_,) = drawn.box("ADD", {"EN": drawn.input("a"), "": drawn.input("x"), " ": drawn.input("x")}, en=True)
    drawn.output("y", sum_)
    assert refused(drawn) == "The box ADD of this CFC has EN and keeps its result, which is not read"
    drawn = Drawn()
    drawn.output("???", drawn.input("a"))
    assert refused(drawn) == "An input or output of this CFC has no variable"


@pytest.mark.parametrize("step", [17, 31])
def test_every_cut_of_a_file_is_answered(step: int) -> None:
    drawn = Drawn()
    (both,) = drawn.box("AND", [drawn.input("a"), drawn.input("b")])
    drawn.output("q", both)
    source = drawn.source()
    for end in range(source.index("<CFC>"), len(source), step):
        complaints(source[:end] + source[end + 29 :], "FB.TcPOU")
