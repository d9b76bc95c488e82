"""The objects of an SFC -> the text of a chart."""

from collections.abc import Callable
from dataclasses import dataclass, field

from scanbench.syntax.plcopen import notes
from scanbench.syntax.plcopen.elements import Pin, Thing, ends_of, things_in
from scanbench.syntax.plcopen.ladder import NoLadder, Rung
from scanbench.syntax.xml_tree import Element, attribute, child, children

INDENT = "    "
BodyText = Callable[[Element], str]
"""The text of a body in whichever language."""


@dataclass(slots=True)
class Chart:
    """One chart as it is written."""

    body: Element
    body_text: BodyText
    conditions: dict[str, str]
    """Bodies of the named transitions of the POU, by upper-case name."""
    notes: list[str] = field(default_factory=list)
    _things: dict[str, Thing] = field(default_factory=dict)
    _nodes: dict[str, Element] = field(default_factory=dict)
    _made: list[str] = field(default_factory=list)
    """Actions that had no name."""

    def text(self) -> str:
        self._things = {each.id: each for each in things_in(self.body)}
        self._nodes = {attribute(each, "localId"): each for each in children(self.body)}
        steps = "".join(self._step(each) for each in self._things.values() if each.kind == "step")
        transitions = "".join(self._transition(each) for each in self._things.values() if each.kind == "transition")
        for each in self._things.values():
            if each.kind == "macroStep":
                self.notes.append(notes.MACRO_STEP)
        return steps + "".join(self._made) + transitions

    # ---- steps ------------------------------------------------------------------------------------------------

    def _step(self, each: Thing) -> str:
        initial = attribute(self._nodes[each.id], "initialStep") == "true"
        lines = []
        for block in self._things.values():
            if block.kind == "actionBlock" and any(end == each.id for pin in block.inputs for end, _ in pin.ends):
                lines += [self._action(each, one) for one in children(self._nodes[block.id], "action")]
        inner = "".join(f"{INDENT}{line}\n" for line in lines)
        return f"{'INITIAL_' if initial else ''}STEP {each.name}:\n{inner}END_STEP\n"

    def _action(self, step: Thing, node: Element) -> str:
        qualifier = attribute(node, "qualifier", "N") or "N"
        duration = attribute(node, "duration")
        name = attribute(child(node, "reference"), "name")
        inline = child(node, "inline")
        if not name and inline is not None:
            name = f"{step.name}_action{len(self._made) + 1}"
            self._made.append(f"ACTION {name}:\n{self.body_text(inline)}END_ACTION\n")
        timed = f", {duration}" if duration and qualifier in ("L", "D", "SD", "DS", "SL") else ""
        return f"{name}({qualifier}{timed});"

    # ---- transitions ------------------------------------------------------------------------------------------

    def _transition(self, each: Thing) -> str:
        sources, targets = self._before(each), self._after(each)
        if not sources or not targets:
            self.notes.append(notes.no_transition(each.line))
            return ""
        priority = attribute(self._nodes[each.id], "priority")
        said = f"(PRIORITY := {priority}) " if priority.isdigit() else ""
        return f"TRANSITION {said}FROM {listed(sources)} TO {listed(targets)} {self._condition(each)} END_TRANSITION\n"

    def _before(self, each: Thing, way: tuple[Thing, ...] = ()) -> list[str]:
        """The steps that lead to it. `way`: from the transition to it."""
        if self._is_circle(each, way):
            return []
        found: list[str] = []
        for end in (end for pin in each.inputs for end, _ in pin.ends):
            source = self._things.get(end)
            if source is not None and source.kind == "step":
                found.append(source.name)
            elif source is not None and source.kind in (
                "selectionDivergence",
                "simultaneousConvergence",
                "simultaneousDivergence",
            ):
                found += self._before(source, (*way, each))
        return list(dict.fromkeys(found))

    def _after(self, each: Thing, way: tuple[Thing, ...] = ()) -> list[str]:
        """The steps that it leads to."""
        if self._is_circle(each, way):
            return []
        found: list[str] = []
        for other in self._things.values():
            if not any(end == each.id for pin in other.inputs for end, _ in pin.ends):
                continue
            if other.kind in ("step", "jumpStep"):
                found.append(other.name)
            elif other.kind in ("selectionConvergence", "simultaneousDivergence", "simultaneousConvergence"):
                found += self._after(other, (*way, each))
        return list(dict.fromkeys(found))

    def _is_circle(self, each: Thing, way: tuple[Thing, ...]) -> bool:
        if each not in way:
            return False
        said = notes.circle(way[0].line)
        if said not in self.notes:
            self.notes.append(said)
        return True

    def _condition(self, each: Thing) -> str:
        """`:= expression;`, or `: ` and a rung."""
        node = child(self._nodes[each.id], "condition")
        name = attribute(child(node, "reference"), "name")
        if name:
            return self._written(each, self.conditions.get(name.upper(), name))
        inline = child(node, "inline")
        if inline is not None:
            return self._written(each, self.body_text(inline))
        point = child(node, "connectionPointIn")
        ends = () if point is None else ends_of(point)
        values = [
            self._things[end].name for end, _ in ends if end in self._things and self._things[end].kind == "inVariable"
        ]
        if len(ends) == 1 and len(values) == 1:
            return f":= {values[0]};"
        try:
            return self._drawn(each, ends)
        except NoLadder:
            return self._unread(each)

    def _written(self, each: Thing, body: str) -> str:
        """A body of its own: of drawn ones only one rung is a condition."""
        if not body.startswith(("RUNG", "NETWORK")):
            return f":= {expression(body)};"
        if body.startswith("RUNG") and body.count("END_RUNG\n") == 1:
            return f": {body.rstrip()}"
        return self._unread(each)

    def _drawn(self, each: Thing, ends: tuple[tuple[str, str], ...]) -> str:
        """What is drawn beside the transition, from the rail; a last contact takes its power as the transition does."""
        before: dict[str, Thing] = {}
        left = [end for end, _ in ends]
        while left:
            thing = self._things.get(left.pop())
            if thing is not None and thing.id not in before:
                before[thing.id] = thing
                left += [end for pin in thing.inputs for end, _ in pin.ends]
        rails = {one.id for one in before.values() if one.kind == "leftPowerRail"}
        group = sorted((one for one in before.values() if one.id not in rails), key=lambda one: one.place)
        last = Thing("condition", "contact", each.line, each.place, inputs=[Pin("", ends=ends)])
        path, last_one, after = Rung([*group, last], rails).elements().rpartition(" []")
        if not last_one or after or "->" in path:
            raise NoLadder
        return f": RUNG\n{INDENT}{path}\nEND_RUNG"

    def _unread(self, each: Thing) -> str:
        self.notes.append(notes.drawn_condition(each.line))
        return ":= FALSE;"


def expression(text: str) -> str:
    """A condition in ST: an expression, perhaps with `:=` before it or `;` after it."""
    return text.strip().removeprefix(":=").strip().rstrip(";").strip() or "TRUE"


def listed(names: list[str]) -> str:
    return names[0] if len(names) == 1 else f"({', '.join(names)})"
