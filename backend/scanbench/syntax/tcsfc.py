"""Sequential function charts of TwinCAT (`<SFC>` of a `.TcPOU`) -> the text of a chart: steps, and transitions with FROM and TO.

The archive has a list of elements, from top to bottom: `SFCStep`, `SFCTransition`, `SFCJump`, and `SFCBranch`, whose list has the legs
from left to right, an `SFCSegment` with such a list each. What an element has is in its attributes, each with the GUID of what it is
(the archive itself has a table of them); the name of a transition is its condition, the name of a jump the step. This was read off
published projects (TwinCAT 3.1.4024) and the documentation of one of them; what an archive has besides is refused, by its name.

The actions of a step are its entry action (P1), its main action, and its exit action (P0). A main action has no final scan, unlike N, so it
is called by an action of its own that asks for its Q. Step names in FROM and TO are made texts.
"""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from scanbench.syntax.chart import QUALIFIERS, TIMED
from scanbench.syntax.tcarchive import Archive, Line, NotRead, Operand, Piece
from scanbench.syntax.xml_outline import Element

NAME, INITIAL, PARALLEL, EXCLUDED, MINIMUM = (
    "38391c6d-6d4a-42f8-8ee7-9f45e5adafa8",
    "6844a48e-46c2-4cc8-a185-a478f3b99cc0",
    "23bdaa98-72ec-41f7-817b-9dede5697086",
    "01580b27-6378-448b-8ecb-0e4b795b58d6",
    "cacf1a68-236e-47c2-b7b1-1cf9199718cb",
)
MAIN, ENTRY, EXIT, QUALIFIER = (
    "700a583f-b4d4-43e4-8c14-629c7cd3bec8",
    "a6b08bd8-b696-47e3-9cbf-7408b61c9ff8",
    "a2621e18-7de3-4ea6-ae6d-89e9e0b7befd",
    "e174fc0d-80b0-4a9e-a530-ca239c249a50",
)
FLAGS = re.compile(r"\bSFC(?:Init|Reset|Pause|Tip|TipMode|QuitError|EnableLimit)\b", re.IGNORECASE)
"""Variables with which a program drives its chart in TwinCAT."""
EMBEDDED = ("EmbeddedMainAction", "EmbeddedEntryAction", "EmbeddedExitAction")
Condition = Callable[[Operand], tuple[Piece, ...]]
"""What is tested where a transition names this: itself, or the body of a transition that has this name."""


@dataclass(slots=True)
class _Transition:
    element: Element
    condition: Operand
    sources: list[str]
    targets: list[str] = field(default_factory=list)


@dataclass(slots=True)
class _State:
    """Where a sequence has come to: steps that are active together, or transitions that wait for what follows them."""

    steps: list[str] = field(default_factory=list)
    pending: list[_Transition] = field(default_factory=list)
    start: bool = False


class _Reader:
    def __init__(self, archive: Archive, condition: Condition) -> None:
        self._archive, self._condition = archive, condition
        self.parts: list[Element | _Transition] = []
        """Steps and transitions, in the order of the archive."""

    # ---- the archive ----------------------------------------------------------------------------------------------

    def _attributes(self, each: Element) -> dict[str, Operand]:
        """By GUID; those that are empty are left out."""
        found: dict[str, Operand] = {}
        for one in self._archive.items(each, "Attributes"):
            value = self._archive.operand(self._archive.member(one, "Value"), "Value")
            if value is not None:
                found[self._archive.value(one, "AttributeId").strip("{}").lower()] = value
        return found

    def _elements(self, each: Element) -> list[tuple[str, Element]]:
        """Of a segment, branch or step: the types of its elements, and these."""
        inner = self._archive.member(each, "ElementList")
        listed = None if inner is None else self._archive.member(inner, "InnerList", "l2")
        if listed is None:
            return []
        kind = self._archive.attribute(listed, "cet")
        return [(self._archive.type(one, kind), one) for one in listed.children if one.tag == "o"]

    def _name(self, each: Element) -> Operand:
        found = self._attributes(each)
        if found.get(EXCLUDED) is not None and found[EXCLUDED].text.upper() == "TRUE":
            raise NotRead("A part of this chart is excluded from the build, which is not read", each)
        if NAME not in found:
            raise NotRead("A part of this chart has no name", each)
        return found[NAME]

    # ---- the graph ------------------------------------------------------------------------------------------------

    def chart(self, root: Element) -> None:
        state = self._sequence(self._elements(root), _State(start=True))
        if state.pending:
            raise NotRead("The last transition of this chart leads nowhere", state.pending[0].element)

    def _sequence(self, elements: list[tuple[str, Element]], state: _State) -> _State:
        for kind, each in elements:
            match kind:
                case "SFCStep":
                    state = self._step(each, state)
                case "SFCTransition":
                    state = self._transition(each, state)
                case "SFCJump":
                    state = self._jump(each, state)
                case "SFCBranch":
                    state = self._branch(each, state)
                case _:
                    raise NotRead(f"This chart has a {kind or 'part without a type'}, which is not read", each)
        return state

    def _step(self, each: Element, state: _State) -> _State:
        name = self._name(each).text
        if not (state.start or state.pending):
            raise NotRead(f"No transition leads to the step {name} of this chart", each)
        for transition in state.pending:
            transition.targets.append(name)
        self.parts.append(each)
        return _State([name])

    def _transition(self, each: Element, state: _State) -> _State:
        if any(one.tag == "o" and self._archive.attribute(one, "n") == "EmbeddedTransition" for one in each.children):
            raise NotRead("A transition of this chart has its condition inside of it, which is not read", each)
        made = _Transition(each, self._name(each), state.steps)
        if not state.steps:
            raise NotRead(f"No step is before the transition {made.condition.text} of this chart", each)
        self.parts.append(made)
        return _State(pending=[made])

    def _jump(self, each: Element, state: _State) -> _State:
        name = self._name(each).text
        if not state.pending:
            raise NotRead(f"No transition is before the jump to {name} of this chart", each)
        for transition in state.pending:
            transition.targets.append(name)
        return _State()

    def _branch(self, each: Element, state: _State) -> _State:
        found = self._attributes(each)
        legs = [self._elements(leg) for _, leg in self._elements(each)]
        parallel = found.get(PARALLEL) is not None and found[PARALLEL].text.upper() == "TRUE"
        if state.start or not legs:
            raise NotRead("A branch of this chart begins without a step", each)
        ends = [self._sequence(leg, _State(state.steps, state.pending)) for leg in legs]
        if parallel:
            if not all(end.steps for end in ends) or not state.pending:
                raise NotRead("A simultaneous branch of this chart does not begin and end with steps", each)
            return _State([step for end in ends for step in end.steps])
        if not state.steps:
            raise NotRead("An alternative branch of this chart does not begin with transitions", each)
        open = [end for end in ends if end.steps]
        pending = [one for end in ends for one in end.pending]
        if len(open) + (1 if pending else 0) > 1:
            raise NotRead("An alternative branch of this chart ends with steps, which is not read", each)
        return open[0] if open else _State(pending=pending)

    # ---- lines ----------------------------------------------------------------------------------------------------

    def lines(self) -> Iterator[Line]:
        for part in self.parts:
            if isinstance(part, _Transition):
                from_, to = _listed(part.sources), _listed(part.targets)
                condition = self._condition(part.condition)
                pieces = ("TRANSITION", "FROM", *from_, "TO", *to, ":=", *condition, ";", "END_TRANSITION")
                yield Line(part.element.start, pieces, part.element.end)
            else:
                yield from self._step_lines(part)

    def _step_lines(self, each: Element) -> Iterator[Line]:
        if any(one.tag == "o" and self._archive.attribute(one, "n") in EMBEDDED for one in each.children):
            raise NotRead("A step of this chart has an action inside of it, which is not read", each)
        found = self._attributes(each)
        name = found[NAME]
        if MINIMUM in found:
            raise NotRead(f"The step {name.text} of this chart has a minimal time, which is not read", each)
        initial = found.get(INITIAL) is not None and found[INITIAL].text.upper() == "TRUE"
        pieces: list[Piece] = ["INITIAL_STEP" if initial else "STEP", name, ":"]
        main = f"{name.text}_main"
        for key, text in ((ENTRY, "P1"), (MAIN, "N"), (EXIT, "P0")):
            if key in found:
                pieces += [main if key == MAIN else found[key], "(", text, ")", ";"]
        for kind, one in self._elements(each):
            pieces += self._association(kind, one)
        yield Line(each.start, (*pieces, "END_STEP"), each.end)
        if MAIN in found:
            body = ("IF", main, ".", "Q", "THEN", found[MAIN], "(", ")", ";", "END_IF", ";")
            yield Line(each.end, ("ACTION", main, ":", *body, "END_ACTION"), each.end)

    def _association(self, kind: str, each: Element) -> list[Piece]:
        found = self._attributes(each)
        words = found[QUALIFIER].text.upper().replace(",", " ").split() if QUALIFIER in found else []
        timed = len(words) == 2 and words[0] in TIMED
        if (
            NAME not in found
            or not words
            or words[0] not in QUALIFIERS
            or (not timed and (len(words) > 1 or words[0] in TIMED))
        ):
            raise NotRead(f"A step of this chart has a {kind or 'part without a type'}, which is not read", each)
        duration: list[Piece] = (
            [",", Operand(found[QUALIFIER].end - len(words[1]), found[QUALIFIER].end, words[1])] if timed else []
        )
        return [found[NAME], "(", words[0], *duration, ")", ";"]


def _listed(names: list[str]) -> tuple[Piece, ...]:
    if len(names) == 1:
        return (names[0],)
    return ("(", *[text for name in names for text in (name, ",")][:-1], ")")


def chart_lines(body: Element, archive: Archive, condition: Condition) -> list[Line]:
    """Of an `<SFC>`: a line of text for each step, main action and transition. `NotRead`."""
    root = body.child("XmlArchive", "Data", "o")
    segment = None if root is None else archive.member(root, "Root")
    if segment is None:
        raise NotRead("This chart has no list of its elements", body)
    reader = _Reader(archive, condition)
    reader.chart(segment)
    return list(reader.lines())
