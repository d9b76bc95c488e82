"""What people have to know of a run file that was read; what is damaged in it is put aside."""

from pathlib import Path

from scanbench.recording.blocks import Contents
from scanbench.recording.fingerprints import libm_fingerprint
from scanbench.recording.format import Damage, Kind, RunFile

_BLOCKS = {Kind.PROGRAM: "program", Kind.ENTRY: "command", Kind.KEYFRAME: "state", Kind.DELTA: "change of the state"}
"""What is lost with a block, in words."""


def _aside(path: Path) -> Path:
    number = 1
    while (aside := path.with_name(f"{path.name}.damaged-{number}")).exists():
        number += 1
    return aside


def flaws(file: RunFile, found: Contents, read_only: bool) -> str:
    """Says it; `read_only`: the file is left as it is."""
    text = "" if file.damage is None else _put_aside(file, file.damage, found.last_scan, read_only)
    if found.about.libm != libm_fingerprint():
        text += "; " * bool(text) + (
            "recorded on a machine with a different mathematical library: results of SIN, EXP and the like may differ "
            "in their last digit, and a replay with them"
        )
    return text


def _put_aside(file: RunFile, damage: Damage, last_scan: int, read_only: bool) -> str:
    """Ends the file where the damage begins, and says what that means."""
    name, where = file.path.name, "left as it was"
    if not read_only:
        aside = _aside(file.path)
        file.cut(damage.offset, aside)
        where = f"moved to {aside.name}"
    if damage.torn:
        text = f"{name} ended in the middle of a block, at byte {damage.offset}: its last write did not come to its end"
    else:
        text = f"{name} is damaged at byte {damage.offset}"
    text += f". Everything before it was recovered, up to scan {last_scan}"
    if damage.last_scan > last_scan:
        text += f"; {damage.last_scan - last_scan} scans after it, up to {damage.last_scan}, are lost"
    elif not damage.torn:
        text += "; how many scans came after it is not known"
    kept = [f"{count} {_BLOCKS[kind]}{'s' * (count != 1)}" for kind, count in damage.lost if kind in _BLOCKS]
    if kept:
        text += f", and with them {', '.join(kept)}"
    return f"{text}. The damaged rest was {where}"
