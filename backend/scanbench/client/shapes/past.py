"""Answers of the REST API: the past of a run, what was reached, and what left its subrange. Made by `python -m tests.client_shapes`; do not edit."""

from typing import Literal, TypedDict


class VerifyPlace(TypedDict):
    """Where in the program something happened."""

    task: str
    instance: str
    """Instance path of the POU that ran: `Main.belt[3]`; of a FUNCTION its name."""
    pou: str
    file: str
    line: int
    text: str
    """The source line, trimmed."""


class LastWriter(TypedDict):
    """The last write of a variable before a moment."""

    path: str
    """The variable itself, after in-outs have been followed."""
    by: Literal["program", "command", "plc", "start"]
    """program: a statement. command: somebody, or an armed fault. plc: the PLC itself (system words, plant, input refresh). start: nobody wrote it since the first scan that is kept."""
    scan: int
    """In which it was written; a command's is the scan before which it was entered."""
    count: int
    """Of a statement: the position before it (`engines.debug`); else 0."""
    place: VerifyPlace | None
    author: str
    """Of a command."""
    text: str
    """For people: `Main.st:31, Main.belt[3]: speed := LIMIT(...)`, `Write by Ada: Main.level := 7`."""
    value: str
    """The value after the write: its bytes in the image."""
    shown: str
    """The value as text."""


class VariableChange(TypedDict):
    """A variable, or an address without one, whose value differs."""

    path: str
    type: str
    kind: str
    size: int
    values: list[list[str | int]]
    before: str
    """Its bytes in the image at the first moment."""
    after: str
    """The same at the second."""
    before_shown: str
    """As text."""
    after_shown: str
    """As text."""


class BetweenEntry(TypedDict):
    """A command that was entered."""

    scan: int
    run: Literal["", "A", "B"]
    """Which of two runs has it; empty where there is one."""
    author: str
    text: str


class RunChanges(TypedDict):
    """What changed between two moments."""

    first: int
    last: int
    changes: list[VariableChange]
    count: int
    """So many there are, those that found no room included."""
    entries: list[BetweenEntry]
    """What was entered in between; of two runs none."""
    note: str
    """That the program changed in between, say: then variables are compared by their names."""
    at_least: bool
    """There may be more than `count`: so much differs that not every place was looked at."""


class NotComparedVariable(TypedDict):
    """What two runs cannot be compared in."""

    path: str
    """The variable, or the program; empty where it is about all variables: scans that are lost."""
    reason: str
    """Which of them has it, or in what the two differ."""


class RunDivergence(TypedDict):
    """Where two runs part first."""

    compared: int
    """Scans. Fewer than from `first` to `last` where the files lost some between them: these are in `left`."""
    first: int
    last: int
    """The first and the last scan that was compared."""
    scan: int | None
    """The first scan after which anything differs; None: the two are the same as far as both go."""
    cause: Literal["", "command", "program", "start"]
    """command: what was entered differs. program: the programs differ. start: the runs differ from their beginning."""
    text: str
    """One sentence: the scan, the task, the variable, why."""
    place: VerifyPlace | None
    """The statement that wrote the first variable that differs, if it is known."""
    changes: RunChanges | None
    """All variables that differ after that scan."""
    entries: list[BetweenEntry]
    """Commands that only one of them has, up to that scan and shortly after it."""
    marks: list[list[int]]
    """Stretches of scans in which they differ, for a timeline: at most 200, joined where there are more."""
    same: Literal["", "all", "partly", "nothing"]
    """Without a difference. all: all variables, in all scans that both have. partly: only variables that both have, or a file is damaged and lost scans. nothing: the programs have no variable in common."""
    variables: int | None
    """How many were compared by their names, an array of plain values counts as one; None: one program ran, so all."""
    left: list[NotComparedVariable]
    """What was not compared, and why: the first 100."""
    left_count: int
    """So many there are, those that found no room included."""


class Comparison(TypedDict):
    """How far a comparison of the runs of instances `a` and `b` is, and what came of it. The last 20 of an instance are kept."""

    id: int
    a: int
    b: int
    by: str
    done: int
    of: int
    """Scans."""
    result: RunDivergence | None
    message: str
    """Why nothing came of it."""
    type: Literal["comparison"]


class Rerun(TypedDict):
    """How far a replay with a change is, and the instance that came of it."""

    id: int
    by: str
    name: str
    done: int
    of: int
    instance: int | None
    refused: list[str]
    """Commands that were not taken this time, and why."""
    message: str
    """Why nothing came of it."""
    type: Literal["rerun"]


class WhatIfValue(TypedDict):
    """A variable or address, and its value as typed."""

    path: str
    value: str


class WhatIfWanted(TypedDict):
    """What is tried: the `values` in every try; with `vary`, each of the values `tried`; with `search`, the smallest change of the variables `candidates` with which `condition` holds. None of them: one try."""

    scan: int
    """The values are set before this scan, after all that was entered there."""
    values: list[WhatIfValue]
    vary: str
    tried: list[str]
    """Values as typed, or ranges of whole numbers: `0..100/5`."""
    search: bool
    candidates: list[str]
    hold: bool
    """The values are forced all the time; else they are written once."""
    window: int
    """So many scans are run, `scan` the first of them."""
    condition: str
    """What is to be, in ST: `Main.valve = 3`. It is met where it holds after one of the scans."""
    watch: list[str]
    """Variables and addresses whose values after the last scan are told."""


class WhatIfTry(TypedDict):
    """What came of one set of values."""

    values: list[WhatIfValue]
    """None: the run as it was recorded."""
    met: int | None
    """After this scan the condition held for the first time."""
    unvalued: int | None
    """After this scan, before it held, the condition had no value for the first time."""
    output_scan: int | None
    """After this scan an output (%Q) was different from the recorded run for the first time."""
    shown: list[str]
    """The values of what is watched."""
    trapped: str
    """The run-time error that stopped the program, and where."""
    refused: list[str]
    """A value that the PLC did not take, then nothing was run; or what had been entered later, and was not taken this time."""
    ran: int
    """Scans."""
    compared: int
    """Scans of which the outputs were compared: the recorded run may have ended before."""


class WhatIf(TypedDict):
    """All that was tried."""

    wanted: WhatIfWanted
    recorded: WhatIfTry
    tries: list[WhatIfTry]
    best: int | None
    """Of a search: the index of the smallest change that was found."""
    note: str
    """What the search did not look at, and why a row may differ from the recorded run."""
    scenario: str
    """A scenario file that does the same from a cold start and expects the condition; empty where there can be none."""
    undisturbed: WhatIfTry | None
    """Where a disturbance came in the recorded run: without it, as all tries are, and with no other value."""


class Calling(TypedDict):
    """A call that leads to a violation."""

    pou: str
    instance: str
    """path of the instance that calls; empty in a FUNCTION."""
    method: str
    """the method or action of the instance that calls; empty in its body."""
    file: str
    line: int
    column: int


class Violation(TypedDict):
    """A place and instance at which a value left its subrange, by one path of calls."""

    file: str
    line: int
    column: int
    end_line: int
    end_column: int
    pou: str
    instance: str
    """path of the instance that ran; empty in a FUNCTION."""
    variable: str
    target: str
    """the variable, where `variable` is that of an in-out or reference; else empty."""
    value: str
    beyond: bool
    """the value was farther outside than 65 bits can say."""
    low: str
    high: str
    text: str
    times: int
    first_scan: int
    last_scan: int
    calls: list[Calling]
    """that lead there, the outermost first; none in what a task runs."""
    cut: bool
    """there are more calls around these: 8 are kept, and of a POU that calls itself the innermost one."""


class Diagnostics(TypedDict):
    """The runtime diagnostics, whenever they change: the list is bounded, and says what did not fit."""

    type: Literal["diagnostics"]
    violations: list[Violation]
    dropped: int
    count: int


class CoveredOutcome(TypedDict):
    """A way that a statement can go."""

    name: str
    """As `symbols.sites.Outcome`."""
    taken: bool
    """Whether it went that way."""


class CoveredSite(TypedDict):
    """A statement, how it went so far, and the ways it can go."""

    line: int
    column: int
    end_line: int
    end_column: int
    pou: str
    reached: bool
    outcomes: list[CoveredOutcome]


class CoveredFile(TypedDict):
    """A file of the program, and its places that can be reached."""

    file: str
    sites: list[CoveredSite]


class Coverage(TypedDict):
    """Told while coverage is on, whenever something more was reached, and when it is switched."""

    on: bool
    since_scan: int
    scans: int
    """How many scans were noted."""
    files: list[CoveredFile]
    type: Literal["coverage"]
