"""An injection campaign for people and machines: a table, JSON, JUnit."""

from dataclasses import asdict, dataclass
from typing import Literal

from scanbench.history.campaign.contract import OUTCOMES, Campaign, Outcome, Trial
from scanbench.reports.junit import Case, junit
from scanbench.reports.report_json import Json

FORMAT = 1
"""Raised when the meaning of a key changes; new keys may come at any time."""
Require = Literal["any", "program"]
WORDS: dict[Outcome, str] = {
    "both": "noticed by verification and program",
    "verification": "noticed by verification only",
    "program": "noticed by the program only",
    "nothing": "noticed by nothing",
    "no effect": "without effect",
    "missed": "did not come about",
}


@dataclass(frozen=True, slots=True)
class CampaignReport:
    """What was tried, and on what."""

    project: str
    model: str
    campaign: Campaign
    of: int
    """So many were to be tried."""
    require: Require = "any"
    allowed: int = 0
    """So many findings are let pass."""
    instance: str = ""
    """Name of the virtual PLC; empty where there was none."""

    @property
    def whole(self) -> bool:
        """Whether all of them were."""
        return len(self.campaign.trials) >= self.of

    @property
    def findings(self) -> tuple[Trial, ...]:
        """Those that nobody noticed, or of which an output was wrong and the program did not notice it."""
        if self.require == "program":
            return tuple(each for each in self.campaign.trials if each.silent)
        return tuple(each for each in self.campaign.trials if each.outcome == "nothing")

    @property
    def failed(self) -> bool:
        """Whether there are more findings than are let pass."""
        return len(self.findings) > self.allowed


def campaign_text(report: CampaignReport) -> list[str]:
    """Lines: how many of each, then those that are findings."""
    wanted, trials = report.campaign.wanted, report.campaign.trials
    lines = [
        f"{report.project} on {report.model}: {len(trials)} disturbances in scans {wanted.first} to {wanted.last}, seed {wanted.seed}, "
        f"{wanted.window} scans to notice each"
    ]
    if not report.whole:
        lines.append(f"  {_broken_off(report)}")
    lines += [f"  {report.campaign.count(each):>6}  {WORDS[each]}" for each in OUTCOMES if report.campaign.count(each)]
    silent = sum(each.silent for each in trials)
    lines.append(f"  {silent:>6}  made an output wrong, and the program did not notice it")
    if report.allowed:
        lines.append(
            f"  {len(report.findings):>6}  {'finding' if len(report.findings) == 1 else 'findings'}, {report.allowed} are allowed"
        )
    for each in report.findings:
        lines += ["", *trial_text(each)]
    return lines


def trial_text(trial: Trial) -> list[str]:
    """All that is known of one."""
    lines = [f"{trial.number}: {trial.text}: {WORDS[trial.outcome]}"]
    if trial.verification:
        lines.append(f"  verification  {trial.verification}")
    if trial.program:
        lines.append(f"  program       in scan {trial.program_scan}: {'; '.join(trial.program)}")
    if trial.output_scan is not None:
        lines.append(f"  output        different after scan {trial.output_scan}")
    if trial.differs:
        lines.append("  memory        different at the end")
    lines += [f"  refused       {each}" for each in trial.refused]
    lines += [f"  no value      {each}" for each in trial.unvalued]
    if trial.why:
        lines.append(f"  why           {trial.why}")
    return lines


def campaign_json(report: CampaignReport) -> dict[str, Json]:
    """One object; its shape is described in docs/verification.md."""
    wanted = report.campaign.wanted
    return {
        "format": FORMAT, "project": report.project, "instance": report.instance, "model": report.model, "seed": wanted.seed, "count": wanted.count,
        "first": wanted.first, "last": wanted.last, "window": wanted.window, "kinds": list(wanted.kinds),
        "alarms": list(wanted.alarms), "require": report.require,
        "allowed": report.allowed, "whole": report.whole,
        "outcomes": {each: report.campaign.count(each) for each in OUTCOMES},
        "silent": sum(each.silent for each in report.campaign.trials),
        "findings": [each.number for each in report.findings],
        "trials": [_trial(each) for each in report.campaign.trials],
    }  # fmt: skip


def _trial(trial: Trial) -> Json:
    told: dict[str, Json] = {
        **asdict(trial), "program": list(trial.program), "refused": list(trial.refused), "unvalued": list(trial.unvalued), "silent": trial.silent
    }  # fmt: skip
    return told


def campaign_junit(report: CampaignReport) -> str:
    """A test case for each disturbance: it fails where it is a finding, and is skipped where it did not come about, or where no more
    findings than are let pass. One more is an error where not all were tried."""
    group = f"campaign.seed{report.campaign.wanted.seed}"
    cases = [_case(group, each, report) for each in report.campaign.trials]
    if not report.whole:
        cases.insert(0, Case(group, "all disturbances are tried", "error", _broken_off(report), "broken_off"))
    named = f"{report.project}, {report.instance}" if report.instance else report.project
    return junit(f"{named} on {report.model}", cases)


def _case(group: str, trial: Trial, report: CampaignReport) -> Case:
    name, told = f"{trial.number}: {trial.text}", "\n".join(trial_text(trial))
    if trial in report.findings and not report.failed:
        return Case(group, name, "skipped", f"{_finding(trial)}; {report.allowed} such findings are allowed", text=told)
    if trial in report.findings:
        return Case(group, name, "failure", _finding(trial), trial.outcome.replace(" ", "_"), told)
    if trial.outcome == "missed":
        return Case(group, name, "skipped", trial.why)
    return Case(group, name, text=told)


def _broken_off(report: CampaignReport) -> str:
    return f"only {len(report.campaign.trials)} of {report.of} disturbances were tried"


def _finding(trial: Trial) -> str:
    if trial.output_scan is not None:
        return f"an output is wrong after scan {trial.output_scan}, {WORDS[trial.outcome]}"
    return f"what the program remembers is wrong, {WORDS[trial.outcome]}"
