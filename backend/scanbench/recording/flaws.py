"""What people have to know of a run file that was read; what is damaged in it is put aside."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from scanbench.recording.blocks import Contents
from scanbench.recording.fingerprints import libm_fingerprint
from scanbench.recording.format import Damage, Kind, RunFile

_BLOCKS = {Kind.PROGRAM: "program", Kind.ENTRY: "command", Kind.KEYFRAME: "state", Kind.DELTA: "change of the state"}
"""What is lost with a block, in words."""
_MOST = 5
"""Parts that are named."""


def _aside(path: Path) -> Path:
    number = 1
    while (aside := path.with_name(f"{path.name}.damaged-{number}")).exists():
        number += 1
    return aside


def flaws(file: RunFile, found: Contents, read_only: bool) -> str:
    """Says it; `read_only`: the file is left as it is."""
    told = list[str]()
    holes = file.mended.holes() if file.mended is not None else []
    if holes or found.gaps:
        told.append(_in_the_middle(file.path.name, holes, found))
    if file.damage is not None:
        told.append(_put_aside(file, file.damage, found.last_scan, read_only))
    if found.about.libm != libm_fingerprint():
        told.append(
            "recorded on a machine with a different mathematical library: results of SIN, EXP and the like may differ "
            "in their last digit, and a replay with them"
        )
    return "; ".join(told)


def _in_the_middle(name: str, holes: Sequence[int], found: Contents) -> str:
    """What is lost between blocks that are good."""
    if not holes:
        text = f"{name} is a copy of a damaged file"
    elif len(holes) == 1:
        text = f"{name} is damaged at byte {holes[0]}"
    else:
        text = f"{name} is damaged at byte {holes[0]}, and in {len(holes) - 1} more places"
    if not found.gaps:
        return (
            f"{text}. No scan is lost: all that was entered is there, and a state that is missing is calculated again"
        )
    for gap in found.gaps[:_MOST]:
        text += f". {gap.lost}"
    if len(found.gaps) > _MOST:
        text += f". {len(found.gaps) - _MOST} more parts are lost"
    return f"{text}. All other scans can be read"


def _put_aside(file: RunFile, damage: Damage, last_scan: int, read_only: bool) -> str:
    """Ends the file where the damage begins, and says what that means."""
    name, where = file.path.name, "left as it was"
    if not read_only:
        aside = _aside(file.path)
        file.cut(damage.offset, aside)
        where = f"moved to {aside.name}"
    if damage.torn:
        text = f"{name} ended in the middle of a block, at byte {damage.offset}: its last write did not come to its end, or the file was cut off"
    else:
        text = f"{name} is damaged at byte {damage.offset}"
    text += f". Everything before it was recovered, up to scan {last_scan}"
    last = max((each.scan for each in damage.after), default=-1)
    if last > last_scan:
        text += f"; {last - last_scan} scans after it, up to {last}, are lost"
    elif not damage.torn:
        text += "; how many scans came after it is not known"
    lost = Counter(each.kind for each in damage.after)
    kept = [f"{lost[kind]} {word}{'s' * (lost[kind] != 1)}" for kind, word in _BLOCKS.items() if lost[kind]]
    if kept:
        text += f", and with them {', '.join(kept)}"
    return f"{text}. The damaged rest was {where}"
