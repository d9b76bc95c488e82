"""In a job process: a campaign of disturbances."""

import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

from scanbench.engines.observe import MakeObserved
from scanbench.faults.agenda import agenda_of_faults
from scanbench.history.bench import Bench
from scanbench.history.campaign.contract import BadCampaign
from scanbench.history.campaign.trials import Trials
from scanbench.host.run_files import texts_in
from scanbench.recording.programs import ProgramsOf
from scanbench.recording.reader import RunReader
from scanbench.wire.campaigns import CampaignDone, RunCampaign, TrialDone
from scanbench.wire.codec import ENTRIES
from scanbench.wire.refused import Refused


def run_campaign(
    ask: RunCampaign, programs_of: ProgramsOf, observed: MakeObserved, say: Callable[[object], None]
) -> CampaignDone:  # fmt: skip
    """Each trial is told when it is done."""
    with tempfile.TemporaryDirectory() as folder, RunReader(Path(ask.run), programs_of, ENTRIES, texts_in) as reader:
        reader.follow(ask.until or None)
        if ask.created and ask.created != reader.recording.about.created:
            raise Refused("the run was replaced since: begin a campaign on the new one")
        programs = programs_of(reader.kept), programs_of(reader.kept)
        bench = Bench(Path(folder), ENTRIES, *programs, lambda: agenda_of_faults(observed), texts_in)
        try:
            trials = Trials(reader, ask.wanted, bench)
            numbers = ask.only or range(1, len(trials.disturbances) + 1)
            for number in numbers:
                say(TrialDone(ask.ref, trials.trial(number), len(numbers)))
        except BadCampaign as bad:
            raise Refused(str(bad)) from bad
        if ask.to:
            shutil.copyfile(trials.file, ask.to)
    return CampaignDone(ask.ref)
