"""Random bodies of rungs and networks with all that a drawing can have: boxes with EN and contacts of their own, outputs that are negated,
functions with outputs, labels, jumps and returns. They have no evaluation beside them: they are compared with themselves in another form."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from tests.drawings.drawn import Drawn, Values
from tests.drawings.draws import Draws

BOOLS, INTS = tuple("abcd"), tuple("xyz")
SHOWN = (*BOOLS, *INTS, "k.CV", "k.Q", "t.Q")
SCANS = 8
FUNCTION = """FUNCTION Split : INT
VAR_INPUT whole : INT; END_VAR
VAR_OUTPUT out, rest : INT; END_VAR
out := whole / 10; rest := whole MOD 10; Split := whole + 1;
END_FUNCTION
"""


@dataclass(slots=True)
class Maker:
    """Draws one network."""

    draws: Draws
    numbers: Iterator[int]
    ahead: list[str]
    """Labels below."""
    sent: list[str] = field(default_factory=list)
    bools: list[str] = field(default_factory=list)
    ints: list[str] = field(default_factory=list)
    """Wires that can be read."""

    # ---- rungs ------------------------------------------------------------------------------------------------

    def rung(self) -> str:
        path = self.path(2)
        match self.draws.one(["", "", "", "leaves", "branch", "above"]):
            case "leaves":
                return f"{path} {self.leave()}"
            case "branch":
                return f"{path} < {self.path(1)} {self.leave()} | {self.path(1)} >"
            case "above":
                return f"{path} < {self.path(1)} | {self.path(1)} {self.leave()} >"
        return path

    def leave(self) -> str:
        return self.draws.one(["RETURN", *(f"JMP {each}" for each in self.ahead)])

    def path(self, depth: int) -> str:
        return " ".join(self.element(depth) for _ in range(self.draws.integer(1, 3)))

    def element(self, depth: int) -> str:
        kind = self.draws.one(["contact", "coil", "contact", "parallel", "box", "link"])
        name = self.draws.one(BOOLS)
        if kind == "parallel" and depth:
            return self.parallel(depth)
        if kind == "box" and depth:
            return self.box(depth)
        if kind == "link" and self.sent:
            return f"< #{self.draws.one(self.sent)} | [{name}] >" if self.draws.flag() else f"[x > y] ({name})"
        if kind == "coil":
            return f"({self.draws.one(['', '/', 'S ', 'R ', 'P ', 'N '])}{name})"
        return f"[{self.draws.one(['', '/', 'P ', 'N '])}{name}]"

    def parallel(self, depth: int) -> str:
        branches = [self.path(depth - 1) for _ in range(self.draws.integer(1, 3))]
        if len(branches) > 1 and not self.draws.integer(0, 2):
            name = f"s{next(self.numbers)}"
            branches[0] += f" -> #{name}"
            self.sent.append(name)
        return f"< {' | '.join(branches)} >"

    def box(self, depth: int) -> str:
        before = list(self.sent)
        own = f"< {self.path(depth - 1)} >"
        text = self.call(own)
        if own not in text:
            self.sent = before
        return text

    def call(self, own: str) -> str:
        """A box, perhaps with these contacts at an input."""
        x, y, z = (self.draws.one(INTS) for _ in range(3))
        power, other = self.draws.one([("~", own), (own, "~"), ("~", "a")])
        out = self.draws.one(
            ["", f", NOT Q => {self.draws.one(BOOLS)}", f", Q => {self.draws.one(BOOLS)}", f", CV => {x}"]
        )
        after = self.draws.one(["", ".Q"])
        match self.draws.one(["count", "enabled", "both", "time", "add", "split"]):
            case "count":
                return f"k(CU := {power}, R := {other}, PV := 2{out}){after}"
            case "enabled":
                return f"k(EN := ~, CU := {own}, PV := 2{out}){after}"
            case "both":
                return f"k(EN := {power}, CU := {other}, PV := 2{out}){self.draws.one(['', '.Q', '.ENO'])}"
            case "time":
                return f"t(IN := ~, PT := T#20ms){after}"
            case "add":
                return f"{x} := ADD(EN := ~, IN1 := {y}, IN2 := {z}){self.draws.one(['', '.ENO'])}"
        return f"{x} := Split(EN := ~, whole := {y}, out => {z}, rest => {x}){self.draws.one(['', '.ENO'])}"

    # ---- networks ---------------------------------------------------------------------------------------------

    def network(self) -> str:
        return "\n    ".join(self.line() for _ in range(self.draws.integer(1, 6)))

    def pin(self) -> str:
        name = self.draws.one([*BOOLS, *self.bools])
        return f"{self.draws.one(['', '', 'NOT ', 'R_EDGE ', 'NOT F_EDGE '])}{name}"

    def number(self) -> str:
        return self.draws.one([*INTS, *self.ints])

    def wire(self, of: list[str]) -> str:
        of.append(f"#w{next(self.numbers)}")
        return of[-1]

    def line(self) -> str:
        one, enable = self.draws.one(BOOLS), f"EN := {self.pin()}, " if self.draws.flag() else ""
        match self.draws.one(["logic", "add", "count", "split", "wire", "take", "leave"]):
            case "logic":
                text = f"{self.draws.one(['AND', 'OR', 'XOR'])}({self.pin()}, {self.pin()})"
                return f"{self.wire(self.bools)} = {text};" if self.draws.flag() else f"{one} {self.operator()} {text};"
            case "add":
                text = f"ADD({enable}IN1 := {self.number()}, IN2 := {self.number()})"
                return (
                    f"{self.wire(self.ints)} = {text};" if self.draws.flag() else f"{self.draws.one(INTS)} := {text};"
                )
            case "count":
                text = f"k({enable}CU := {self.pin()}, R := {self.pin()}, PV := 2"
                taken = self.draws.one(["var", "not", "wires", "none"])
                q = one if taken in ("var", "not") else self.wire(self.bools)
                cv = self.draws.one(INTS) if taken in ("var", "not") else self.wire(self.ints)
                if taken == "none":
                    del self.bools[-1], self.ints[-1]
                    return f"{text});"
                return f"{text}, {'NOT ' if taken == 'not' else ''}Q => {q}, CV => {cv});"
            case "split":
                outputs = f"out => {self.draws.one(INTS)}, rest => {self.draws.one(INTS)}"
                return f"{self.draws.one(INTS)} := Split({enable}whole := {self.number()}, {outputs});"
            case "wire":
                text = self.pin()
                return f"{self.wire(self.bools)} = {text};"
            case "take":
                return (
                    f"{self.draws.one(INTS)} := {self.number()};"
                    if self.draws.flag()
                    else f"{one} {self.operator()} {self.pin()};"
                )
        text = self.leave()
        return f"{text} IF {self.pin()};" if self.draws.integer(0, 3) else f"{text};"

    def operator(self) -> str:
        return self.draws.one([":=", ":=", ":=", "S=", "R="])


def drawn(draws: Draws) -> Drawn:
    """Each network by itself has a label or none, or nothing but a label."""
    count, kind = draws.integer(1, 4), draws.one(["rungs", "networks", "both"])
    numbers = iter(range(10_000))
    labels = [f"l{number}" if draws.flag() else "" for number in range(count)]
    texts = []
    for number, label in enumerate(labels):
        maker = Maker(draws, numbers, [each for each in labels[number + 1 :] if each])
        rung = kind == "rungs" or (kind == "both" and draws.flag())
        word = "RUNG" if rung else "NETWORK"
        inner = "" if label and not draws.integer(0, 3) else f"    {maker.rung() if rung else maker.network()}\n"
        texts.append(f"{word}{f' {label}:' if label else ''}\n{inner}END_{word}\n")
    source = (
        f"PROGRAM Main\nVAR {', '.join(BOOLS)} : BOOL; {', '.join(INTS)} : INT; k : CTU; t : TON; END_VAR\n"
        f"{''.join(texts)}END_PROGRAM\n"
    )
    ranges = {**dict.fromkeys(BOOLS, (0, 1)), **dict.fromkeys(INTS, (-40, 40))}
    return Drawn(source, [draws.values(ranges) for _ in range(SCANS)], lambda: _nothing)


def _nothing(_: int, __: Values) -> Values:
    return dict.fromkeys(SHOWN, 0)
