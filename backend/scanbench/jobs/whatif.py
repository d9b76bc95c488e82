"""In a job process: what if inputs of a run had other values."""

import tempfile
from collections.abc import Callable
from pathlib import Path

from scanbench.engines.observe import MakeObserved
from scanbench.faults.agenda import agenda_of_faults
from scanbench.history.bench import Bench
from scanbench.history.whatif.contract import BadWhatIf
from scanbench.history.whatif.tries import what_if
from scanbench.host.run_files import texts_in
from scanbench.recording.programs import ProgramsOf
from scanbench.recording.reader import RunReader
from scanbench.wire.codec import ENTRIES
from scanbench.wire.refused import Refused
from scanbench.wire.whatif import RunWhatIf, TryDone, WhatIfDone


def run_what_if(
    ask: RunWhatIf, programs_of: ProgramsOf, observed: MakeObserved, say: Callable[[object], None]
) -> WhatIfDone:  # fmt: skip
    """Each try is told when it is done."""
    with tempfile.TemporaryDirectory() as folder, RunReader(Path(ask.run), programs_of, ENTRIES, texts_in) as reader:
        reader.follow(ask.until or None)
        programs = programs_of(reader.kept)
        bench = Bench(Path(folder), ENTRIES, programs, programs, lambda: agenda_of_faults(observed), texts_in)
        try:
            found = what_if(reader, ask.wanted, bench, lambda done, of: say(TryDone(ask.ref, done, of)))
        except BadWhatIf as bad:
            raise Refused(str(bad), bad.near) from bad
    return WhatIfDone(ask.ref, found)
