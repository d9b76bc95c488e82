"""The tasks of a TwinCAT project (`.TcTTO`) as a CONFIGURATION, so that programs run as often as there."""

import re
from collections.abc import Collection, Iterable
from dataclasses import dataclass
from html import unescape

ENDING = ".tctto"
FILE = "Tasks.st"
_NAME = re.compile(r"<Task\s[^>]*\bName\s*=\s*[\"']([^\"']*)[\"']")
_CYCLE = re.compile(r"<CycleTime>\s*(\d+)\s*</CycleTime>")
_PRIORITY = re.compile(r"<Priority>\s*(\d+)\s*</Priority>")
_CALL = re.compile(r"<PouCall>\s*<Name>\s*([^<]*?)\s*</Name>")
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
LONGEST_US = 24 * 3600 * 1_000_000


@dataclass(frozen=True, slots=True)
class Task:
    """One of them."""

    name: str
    cycle_us: int
    """Microseconds."""
    priority: int
    """As there: 0 goes before all others."""
    programs: tuple[str, ...]
    """In the order of their calls."""


def read_task(text: str) -> Task | None:
    """What the text of such a file says; None where it names no task, no cycle or no program."""
    text = _COMMENT.sub("", text)
    name, cycle, priority = (each.search(text) for each in (_NAME, _CYCLE, _PRIORITY))
    programs = tuple(unescape(each) for each in _CALL.findall(text))
    if name is None or cycle is None or not programs or not 0 < int(cycle[1]) <= LONGEST_US:
        return None
    return Task(unescape(name[1]), int(cycle[1]), min(int(priority[1]), 65535) if priority else 0, programs)


def configuration(tasks: Iterable[Task], files: Collection[str]) -> str:
    """The CONFIGURATION of these tasks, with the programs that are among the files; empty where there are none of them."""
    known = {re.split(r"[\\/]", path)[-1].rpartition(".")[0].lower() for path in files}
    lines: list[str] = []
    calls: list[str] = []
    seen: set[str] = set()
    for task in tasks:
        programs = [each for each in task.programs if each.lower() in known and each.lower() not in seen]
        name = re.sub(r"\W", "_", task.name, flags=re.ASCII)
        if not programs or not name.isidentifier() or name.lower() in seen:
            continue
        seen |= {name.lower(), *(each.lower() for each in programs)}
        lines.append(f"    TASK {name}(INTERVAL := {_shown(task.cycle_us)}, PRIORITY := {task.priority});")
        calls += [f"    PROGRAM {each} WITH {name} : {each};" for each in programs]
    if not lines:
        return ""
    head = "(* The tasks of the TwinCAT project. *)\nCONFIGURATION TwinCAT\n  RESOURCE PlcResource ON PLC\n"
    return head + "\n".join([*lines, *calls]) + "\n  END_RESOURCE\nEND_CONFIGURATION\n"


def _shown(microseconds: int) -> str:
    return f"T#{microseconds}us" if microseconds % 1000 else f"T#{microseconds // 1000}ms"
