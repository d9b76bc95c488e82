"""What if: messages between the server and a job process."""

from dataclasses import dataclass

from scanbench.history.whatif.contract import WhatIf, WhatIfWanted


@dataclass(frozen=True, slots=True)
class RunWhatIf:
    """Goes on with the run, as far as it is over before scan `until`, with other values. Answered with a `TryDone` for each try, then
    `WhatIfDone`."""

    ref: int
    run: str
    wanted: WhatIfWanted
    until: int


@dataclass(frozen=True, slots=True)
class TryDone:
    """Tries that are done, and at most how many."""

    ref: int
    done: int
    of: int


@dataclass(frozen=True, slots=True)
class WhatIfDone:
    """All that came of it."""

    ref: int
    found: WhatIf
