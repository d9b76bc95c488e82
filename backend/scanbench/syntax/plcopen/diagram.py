"""Connected objects of an FBD, or of a ladder that is none by itself -> the text of a NETWORK, one box a line."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from scanbench.syntax.plcopen import notes
from scanbench.syntax.plcopen.elements import RESULTS, Pin, Thing

INDENT = "    "
_NAMED = re.compile(r"[#%]?[\w.]+")
"""What is looked at for an edge as it is."""
End = tuple[str, str]


@dataclass(slots=True)
class Diagram:
    """One network as it is written."""

    group: list[Thing]
    rails: set[str]
    numbers: Iterator[int]
    """Of the wires of the body."""
    types: Mapping[str, str] = field(default_factory=dict)
    """Of the variables of the POU, by name in upper case."""
    lines: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    """What could not be kept as it was."""
    _wires: dict[End, str] = field(default_factory=dict)
    _things: dict[str, Thing] = field(default_factory=dict)
    _used: set[End] = field(default_factory=set)
    _taken: dict[End, str] = field(default_factory=dict)
    _inside: set[str] = field(default_factory=set)
    """Objects that are written in the call of a box."""
    _written: set[str] = field(default_factory=set)
    _early: set[End] = field(default_factory=set)
    """What is read before its box runs: its value of the scan before."""

    def text(self, head: str) -> str:
        self._things = {each.id: each for each in self.group}
        for each in self.group:
            for pin in each.inputs:
                self._used |= {self._end(end) for end in pin.ends if end[0] in self._things}
        self._find_taken()
        for each in self.group:
            if each.id not in self._inside:
                self._line(each)
            self._written.add(each.id)
        if not self.lines:
            return ""
        inner = "".join(f"{INDENT}{line}\n" for line in self.lines)
        return f"NETWORK{head}\n{inner}END_NETWORK\n"

    def _find_taken(self) -> None:
        """A variable that takes an output right after its box is written in the call."""
        box: Thing | None = None
        for each in self.group:
            if each.kind == "block":
                box = each
            elif each.kind == "outVariable" and box is not None and not (each.negated or each.storage or each.edge):
                ends = [self._end(end) for pin in each.inputs for end in pin.ends if not (pin.negated or pin.edge)]
                output = box.output(ends[0][1]) if len(ends) == 1 and ends[0][0] == box.id else None
                if output is None or self._uses(ends[0]) != 1 or (output.negated and output is result_of(box)):
                    box = None
                    continue
                self._taken[ends[0]] = each.name
                self._inside.add(each.id)
            elif each.kind != "inVariable":
                box = None

    def _uses(self, end: End) -> int:
        return sum(self._end(one) == end for each in self.group for pin in each.inputs for one in pin.ends)

    # ---- values -----------------------------------------------------------------------------------------------

    def _end(self, end: End) -> End:
        thing = self._things.get(end[0])
        output = None if thing is None else thing.output(end[1])
        return end[0], "" if output is None else output.name

    def _wire(self, end: End) -> str:
        end = self._end(end)
        if end not in self._wires:
            self._wires[end] = f"#w{next(self.numbers)}"
        return self._wires[end]

    def _value(self, end: End) -> str:
        """What an end carries, where it is used."""
        if end[0] in self.rails:
            return "TRUE"
        thing = self._things.get(end[0])
        if thing is None:
            self.notes.append(notes.NO_SOURCE)
            return "FALSE"
        if thing.kind in ("inVariable", "inOutVariable"):
            return f"NOT {_operand(thing.name)}" if thing.negated else thing.name or "FALSE"
        if thing.kind == "continuation":
            source = next(
                (each for each in self.group if each.kind == "connector" and each.name.upper() == thing.name.upper()),
                None,
            )
            return self._input(source.inputs[0]) if source is not None and source.inputs else "FALSE"
        if thing.kind == "block" and thing.id not in self._written:
            output = thing.output(end[1])
            if thing.instance and output is not None and output.name.upper() != "ENO":
                return f"{'NOT ' if output.negated else ''}{thing.instance}.{output.name}"
            self._early.add(self._end(end))
        return self._wire(end)

    def _typed(self, end: End) -> str:
        """A wire as it is set: one that is read above its line says its type, which is that of a variable that takes its value."""
        wire = self._wire(end)
        if end not in self._early:
            return wire
        takers = (
            each.name.upper() for each in self.group if each.kind == "outVariable"
            for pin in each.inputs for one in pin.ends if self._end(one) == end
        )  # fmt: skip
        type = next((self.types[name] for name in takers if name in self.types), "")
        if not type:
            self.notes.append(notes.no_type(wire))
        return f"{wire} : {type}" if type else wire

    def _input(self, pin: Pin) -> str:
        """The value at an input, also of several connections, of which one TRUE is enough."""
        values = [self._value(end) for end in pin.ends]
        if not values:
            return pin.expression
        value = values[0] if len(values) == 1 else self._joined(values)
        value = _operand(value) if pin.edge or pin.negated else value
        if pin.edge:
            value = self._edge(pin.edge, value)
        return f"NOT {value}" if pin.negated else value

    def _edge(self, edge: str, value: str) -> str:
        """Of a variable or a wire; of anything else a wire is made."""
        if not _NAMED.fullmatch(value) or value in ("TRUE", "FALSE"):
            wire = f"#w{next(self.numbers)}"
            self.lines.append(f"{wire} = {value};")
            value = wire
        return f"{'R' if edge == 'rising' else 'F'}_EDGE {value}"

    def _joined(self, values: list[str]) -> str:
        if "TRUE" in values:
            return "TRUE"
        wire = f"#w{next(self.numbers)}"
        self.lines.append(f"{wire} = OR({', '.join(values)});")
        return wire

    # ---- lines ------------------------------------------------------------------------------------------------

    def _line(self, each: Thing) -> None:
        match each.kind:
            case "contact":
                self._contact(each)
            case "coil" | "outVariable":
                self._assignment(each)
            case "block":
                self._block(each)
            case "jump" | "return":
                value = self._input(each.inputs[0]) if each.inputs else ""
                word = f"JMP {each.name}" if each.kind == "jump" else "RETURN"
                self.lines.append(f"{word};" if value in ("", "TRUE") else f"{word} IF {value};")

    def _contact(self, each: Thing) -> None:
        power = self._input(each.inputs[0]) if each.inputs else "FALSE"
        edge = {"rising": "R_EDGE ", "falling": "F_EDGE "}.get(each.edge, "")
        name = each.name or "FALSE"
        own = f"{'NOT ' if each.negated else ''}{edge}{_operand(name) if each.negated or edge else name}"
        wire = self._wire((each.id, ""))
        self.lines.append(f"{wire} = {own};" if power == "TRUE" else f"{wire} = AND({power}, {own});")

    def _assignment(self, each: Thing) -> None:
        value = (self._input(each.inputs[0]) if each.inputs else "") or "FALSE"
        if each.edge:
            value = self._edge(each.edge, value)
        if each.negated:
            value = value.removeprefix("NOT ") if value.startswith("NOT ") else f"NOT {value}"
        operator = {"set": "S=", "reset": "R="}.get(each.storage, ":=")
        self.lines.append(f"{each.name} {operator} {value};")
        if (each.id, "") in self._used:  # a coil hands its power on
            self.lines.append(
                f"{self._wire((each.id, ''))} = {(self._input(each.inputs[0]) if each.inputs else '') or 'FALSE'};"
            )

    def _block(self, each: Thing) -> None:
        arguments = [
            f"{formal(pin.name)} := {value}" if pin.name else value
            for pin in each.inputs
            if (value := self._input(pin)) not in ("", "???")
        ]
        result = result_of(each)
        after: list[str] = []
        for pin in each.outputs:
            end = (each.id, pin.name)
            if pin is result or any(pin.name == one.name for one in each.inputs):
                continue
            name = f"{'NOT ' if pin.negated else ''}{pin.name}"
            if end in self._taken:
                arguments.append(f"{name} => {self._taken[end]}")
            elif end in self._used:
                arguments.append(f"{name} => {self._wire(end)}")
            elif pin.expression:
                arguments.append(f"{name} => {pin.expression}")
        call = f"{each.instance or each.name}({', '.join(arguments)})"
        taken = "" if result is None else self._taken.get((each.id, result.name), "")
        if taken:
            self.lines.append(f"{taken} := {call};")
        elif result is not None and ((each.id, result.name) in self._used or not result.expression):
            wire = self._wire((each.id, result.name))
            self.lines.append(f"{self._typed((each.id, result.name))} = {call};")
            if result.negated:
                after.append(self._negated((each.id, result.name), wire))
        elif result is not None and result.expression:
            self.lines.append(f"{result.expression} := {call};")
        else:
            self.lines.append(f"{call};")
        self.lines += after

    def _negated(self, end: End, wire: str) -> str:
        self._wires[end] = f"#w{next(self.numbers)}"
        return f"{self._wires[end]} = NOT {wire};"


def result_of(each: Thing) -> Pin | None:
    """The output that is the result of a function: what is named as the function before what tools name so."""
    if each.instance:
        return None
    named = next((pin for pin in each.outputs if pin.name.upper() in ("", each.name.upper())), None)
    return named or next((pin for pin in each.outputs if pin.name.upper() in RESULTS), None)


def formal(name: str) -> str:
    """Tools write `In1` for the inputs of operators."""
    return name.upper() if name[:2].upper() == "IN" and name[2:].isdigit() else name


def _operand(value: str) -> str:
    """In brackets, unless it is a name or a literal."""
    return value if re.fullmatch(r"[\w#%.?\[\]^]+", value) else f"({value})"
