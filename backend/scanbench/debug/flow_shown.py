"""What is known of the flow through one instance in one scan, as text."""

from dataclasses import dataclass

from scanbench.public import Public


@dataclass(frozen=True, slots=True)
class FlowAsked:
    """What somebody looks at."""

    pou: str
    """Whose text is drawn: a PROGRAM, a block, a FUNCTION, a method (`Tank.Fill`). The actions of a chart belong to it."""
    instance: str = ""
    """The path of the instance; empty for a FUNCTION, of which each call counts."""
    call: int = 0
    """Which of several calls in the scan, from 1; 0 for the last one."""
    first: int = 1
    last: int = 1 << 30
    """The lines of the text that are in sight: of others nothing is noted."""


@dataclass(frozen=True, slots=True)
class FlowValue(Public):
    """A variable, as the POU names it, and its value when the element read it, or after the element wrote it."""

    name: str
    text: str
    written: bool


@dataclass(frozen=True, slots=True)
class FlowElement(Public):
    """A contact, coil, box, line or step that ran."""

    line: int
    column: int
    """Where it begins in the text, from 1."""
    power: bool | None
    """The power after a contact, a box or a link; None where the element has none of its own (a coil hands on what it gets),
    or where it is not known."""
    values: tuple[FlowValue, ...]
    """In the order of use; of a variable that is read and written both."""
    runs: int = 1
    """How often it ran in this call: several times where a jump goes back. Values and power are those of the last time."""


@dataclass(frozen=True, slots=True)
class FlowWire(Public):
    """A wire of a function block diagram, and what it had."""

    name: str
    text: str
    line: int
    """Where it is set: networks have wires of their own, also of the same name."""


@dataclass(frozen=True, slots=True)
class Flow(Public):
    """One call of the instance in one scan, up to its end or to where the scan is halted."""

    scan: int
    calls: int
    """How often the scan has called the instance; 0: it was not called, so no element ran."""
    call: int
    """Which of these is told here, from 1; 0 where there is none."""
    whole: bool
    """The scan ran to its end. False: it is halted, and what comes later is not in here."""
    elements: tuple[FlowElement, ...]
    """Those in sight that ran, in the order of the text. Whatever is not here was jumped over, or left out as EN or a condition said so."""
    wires: tuple[FlowWire, ...] = ()
    """The wires of the function block diagrams that ran."""


@dataclass(frozen=True, slots=True)
class Flows(Public):
    """What is known now."""

    file: str
    program_version: int
    """The program that ran: the lines are those of its text."""
    flows: tuple[Flow, ...]
    """The newest first. Where a scan is halted that scan, as far as it has come, and then the one before it, which was whole."""
    refused: str = ""
    """Why there are none, or not both."""
    first: int = 1
    last: int = 1 << 30
    """The lines that were in sight: of elements elsewhere nothing is known."""
