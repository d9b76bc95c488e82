"""A run with an error, and on after its recovery: what became of the requirements, and which outputs restarted."""

from collections.abc import Sequence
from dataclasses import replace

from scanbench.faults.inject import ACTIVE, Recover
from scanbench.faults.reaction.effects import Variables
from scanbench.faults.reaction.error_memory import Words
from scanbench.faults.reaction.reaction import OutputRestart, Reaction, RequiredResult
from scanbench.faults.reaction.required_rules import Made
from scanbench.faults.reaction.required_watch import Watch, allows, graded, not_checked, result
from scanbench.faults.reaction.restarts import Outputs, is_on
from scanbench.faults.reaction.steps import advance, state_words
from scanbench.faults.reference import ErrorRef
from scanbench.runtime.command import Refusal
from scanbench.runtime.resource import Resource
from scanbench.symbols.leaves import Leaf


class RequiredRun:
    """Follows a run from the moment when the error is present."""

    def __init__(
        self, every: Sequence[Made], resource: Resource, error: ErrorRef, window: int, variables: Variables, *, alone: bool
    ) -> None:  # fmt: skip
        """`alone`: nobody gives commands meanwhile, so that what goes on does so by itself."""
        self._every, self._resource, self._error, self._window, self._alone = every, resource, error, window, alone
        present = [made for made in every if not made.source.recovery]
        self._present = Watch(present, resource.program, resource.memory, window)
        self._outputs = Outputs(variables, state_words(resource))
        self._scans = 0
        """Scans with the error."""
        self._recovered: Watch | None = None
        self._recovery = 0
        """Scans since the recovery."""
        self._off: list[Leaf] = []
        self._restarts: dict[str, OutputRestart] = {}

    def entering(self) -> None:
        """Something from outside is about to be entered: it may recover the error, and change what is looked at."""
        if self._recovered is None:
            self._present.keep(self._scans)

    def before(self) -> None:
        """A scan comes; what came from outside is entered."""
        if self._recovered is None and not self._is_present():
            self._present.close(self._scans)
            self._recover()

    def _is_present(self) -> bool:
        active = self._resource.journal.derived(ACTIVE).get(self._error.id)
        return active is not None and self._error in active.refs

    def after(self, scan: int, without: Words) -> None:
        """A scan of the window is over, here and in the run without the error."""
        if self._recovered is None:
            self._scans = scan
            if self._resource.trap is not None:
                return  # what is off now was switched off by the stop, not by the program
            self._present.after(scan)
            self._outputs.add(without, state_words(self._resource))
        else:
            self._after_recovery(self._recovered)

    def judged(self, reaction: Reaction, author: str) -> Reaction:
        """The reaction with what became of the requirements; runs on, beyond the recovery, where something depends on it."""
        scans = reaction.window
        if self._resource.trap is None:
            self.before()  # the program may have recovered it in the last scan
        present = self._present.results(scans, self._stopped(scans))
        recovered = self._run_on(author)
        found = [*graded(self._every, reaction.verdict), *present, *recovered, *_invalid(self._every)]
        return replace(
            reaction,
            required=tuple(sorted(found, key=lambda each: each.line)),
            restarts=tuple(self._restarts.values()),
            recovery=self._recovery,
        )

    def _run_on(self, author: str) -> list[RequiredResult]:
        wanted = [made for made in self._every if made.source.recovery and made.condition is not None]
        checked = [made for made in wanted if made.source.form != "may_restart"]
        if self._resource.trap is not None and self._recovered is None:
            return list(not_checked(checked, "ended", self._stopped(None)))
        if self._recovered is None:
            if not checked and not (self._alone and self._outputs.switched_off()):
                return []
            refused = self._resource.submit(Recover(author, (str(self._error),)))
            if isinstance(refused, Refusal):
                return list(not_checked(checked, "not_recovered", refused.message))
            self._recover()
        elif not checked and not self._off:
            self._recovery = 0  # nothing depends on it
            return []
        assert self._recovered is not None
        while self._recovery < self._window and self._resource.trap is None and self._resource.runnable:
            advance(self._resource)
            self._after_recovery(self._recovered)
        return self._recovered.results(self._recovery, self._stopped(self._recovery))

    def _recover(self) -> None:
        """From now on scans count from the recovery."""
        wanted = [made for made in self._every if made.source.recovery]
        self._recovered = Watch(wanted, self._resource.program, self._resource.memory, self._window)
        self._off = self._outputs.switched_off() if self._alone else []

    def _after_recovery(self, watch: Watch) -> None:
        if self._recovery >= self._window:
            return
        self._recovery += 1
        if self._resource.trap is not None:
            return
        watch.after(self._recovery)
        memory = self._resource.memory
        for leaf in self._off:
            if leaf.name not in self._restarts and is_on(leaf, memory):
                allowed = allows(self._every, leaf, self._resource.program, memory)
                self._restarts[leaf.name] = OutputRestart(leaf.name, self._recovery, allowed)

    def _stopped(self, scans: int | None) -> str:
        """What ended the run early; empty: nothing."""
        trap = self._resource.trap
        if trap is not None:
            return f"the program stopped: {trap}" if scans is None else f"the program stopped in scan {scans}: {trap}"
        if scans is not None and scans < self._window and not self._resource.runnable:
            return "the program does not run any more"
        return ""


def stopped(every: Sequence[Made]) -> tuple[RequiredResult, ...]:
    """Of an error that stops the PLC."""
    note = "the error is fatal: the PLC stops, as the model says"
    found = (*graded(every, "stopped"), *not_checked(every, "stopped", note))
    return tuple(sorted(found, key=lambda each: each.line))


def _invalid(every: Sequence[Made]) -> list[RequiredResult]:
    return [result(made, "not_checked", "invalid", made.invalid) for made in every if made.invalid]
