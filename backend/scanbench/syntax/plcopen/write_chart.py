"""A chart -> objects of SFC."""

from collections.abc import Sequence

from scanbench.syntax import chart, networks
from scanbench.syntax.plcopen.write_ladder import LadderWriter
from scanbench.syntax.plcopen.write_objects import ROW, CannotWrite, End, Known, Objects, add, paragraph, text


def write_chart(objects: Objects, written: chart.Chart, known: Known) -> None:
    """Steps and transitions in the order of the text; a transition to a step above is a jump."""
    _Writer(objects, written, known).write()


class _Writer:
    def __init__(self, objects: Objects, written: chart.Chart, known: Known) -> None:
        self._objects, self._chart = objects, written
        self._ladder = LadderWriter(objects, known)
        self._order = {each.name.name.upper(): number for number, each in enumerate(written.steps)}
        self._steps: dict[str, str] = {}
        self._after: dict[str, End] = {}
        """What transitions from a step begin at."""
        self._into: dict[str, list[End]] = {name: [] for name in self._order}

    def write(self) -> None:
        named = (one.name for each in self._chart.transitions for one in (*each.sources, *each.targets))
        missing = next((name for name in named if name.upper() not in self._order), None)
        if missing is not None:
            raise CannotWrite(f"a transition of the step {missing}, which is not there")
        nodes = {}
        for step in self._chart.steps:
            name = step.name.name.upper()
            marks = {"initialStep": "true"} if step.initial else {}
            id, nodes[name] = self._objects.make("step", name=step.name.name, **marks)
            self._steps[name] = id
        for name, id in self._steps.items():
            self._after[name] = self._divergence(name, (id, ""))
        for transition in self._chart.in_order:
            self._transition(transition)
        for name, node in nodes.items():
            ends = self._into[name]
            if len(ends) > 1:
                joined, made = self._objects.make("selectionConvergence")
                for end in ends:
                    self._objects.connect(made, [end])
                add(made, "connectionPointOut")
                ends = [(joined, "")]
            if ends:
                self._objects.connect(node, ends)
            add(node, "connectionPointOut", formalParameter="sfc")
        for step in self._chart.steps:
            self._actions(step)

    def _divergence(self, name: str, end: End) -> End:
        leading = [each for each in self._chart.transitions if [one.name.upper() for one in each.sources] == [name]]
        if len(leading) < 2:
            return end
        id, made = self._objects.make("selectionDivergence")
        self._objects.connect(made, [end])
        for _ in leading:
            add(made, "connectionPointOut", formalParameter="")
        return id, ""

    def _transition(self, each: chart.Transition) -> None:
        if each.condition is None:
            raise CannotWrite("a transition without a condition")
        names = [one.name.upper() for one in each.sources]
        if len(names) == 1:
            before = self._after[names[0]]
        else:
            id, made = self._objects.make("simultaneousConvergence")
            for name in names:
                self._objects.connect(made, [(self._steps[name], "")])
            add(made, "connectionPointOut")
            before = (id, "")
        priority = {"priority": str(each.priority)} if each.priority is not None else {}
        id, made = self._objects.make("transition", **priority)
        self._objects.connect(made, [before])
        add(made, "connectionPointOut")
        condition = add(made, "condition")
        if isinstance(each.condition, networks.Rung):
            self._objects.connect(condition, self._ladder.condition(each.condition))
        else:
            paragraph(add(add(condition, "inline", name=each.name), "ST"), text(each.condition))
        self._lead([one.name.upper() for one in each.targets], (id, ""), max(self._order[name] for name in names))

    def _lead(self, targets: Sequence[str], end: End, above: int) -> None:
        if len(targets) > 1:
            id, made = self._objects.make("simultaneousDivergence")
            self._objects.connect(made, [end])
            for _ in targets:
                add(made, "connectionPointOut", formalParameter="")
            end = (id, "")
        for name in targets:
            if self._order[name] > above:
                self._into[name].append(end)
                continue
            _, made = self._objects.make("jumpStep", targetName=self._chart.steps[self._order[name]].name.name)
            self._objects.connect(made, [end])

    def _actions(self, step: chart.Step) -> None:
        if not step.actions:
            return
        _, made = self._objects.make("actionBlock")
        self._objects.connect(made, [(self._steps[step.name.name.upper()], "")])
        for number, each in enumerate(step.actions):
            time = {"duration": text(each.duration)} if each.duration is not None else {}
            action = add(made, "action", localId=self._objects.local_id(), qualifier=each.qualifier, **time)
            add(action, "relPosition", x="0", y=str(number * ROW))
            add(action, "reference", name=each.name)
