"""The tasks of a project, as the explorer lists them."""

from scanbench.check.build import check_sources
from scanbench.check.incremental import Checks
from scanbench.check.task_infos import TaskInfo, TaskProgram
from tests.caseformat import MODELS

MODEL = MODELS["GENERIC-IEC"]
BELT = "PROGRAM Belt\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n"
PLANT = """\
CONFIGURATION Plant
  VAR_GLOBAL go : BOOL; END_VAR
  RESOURCE Cpu ON PLC
    TASK slow (INTERVAL := T#100ms, PRIORITY := 5);
    TASK fast (INTERVAL := T#10ms, PRIORITY := 1);
    TASK once (SINGLE := go, PRIORITY := 0);
    PROGRAM first WITH slow : Belt;
    PROGRAM second WITH fast : Belt;
    PROGRAM third WITH once : Belt;
  END_RESOURCE
END_CONFIGURATION
"""


def test_tasks_are_listed_by_priority_with_what_they_run_and_where_they_are_declared() -> None:
    once, fast, slow = check_sources({"belt.st": BELT, "plant.st": PLANT}, MODEL).tasks
    assert fast == TaskInfo("fast", 10_000_000, False, 1, "plant.st", 5, (TaskProgram("second", "Belt"),))
    assert (slow.interval_ns, slow.priority, slow.line) == (100_000_000, 5, 4)
    assert (once.interval_ns, once.event, once.programs) == (0, True, (TaskProgram("third", "Belt"),))


def test_without_a_configuration_one_task_runs_every_program() -> None:
    sources = {"belt.st": BELT, "main.st": "PROGRAM Main\nEND_PROGRAM\n"}
    (task,) = check_sources(sources, MODEL).tasks
    assert (task.name, task.interval_ns, task.file) == ("Main", 10_000_000, "")
    assert [each.pou for each in task.programs] == ["Belt", "Main"]


def test_an_edit_in_a_body_leaves_the_tasks_and_an_error_says_none() -> None:
    checks = Checks()
    before = checks.diagnose({"belt.st": BELT, "plant.st": PLANT}, MODEL, 10_000_000).tasks
    after = checks.diagnose({"belt.st": BELT.replace("+ 1", "+ 2"), "plant.st": PLANT}, MODEL, 10_000_000)
    assert len(before) == 3
    assert after.tasks == before
    assert checks.diagnose({"belt.st": BELT.replace("+ 1", "+"), "plant.st": PLANT}, MODEL, 10_000_000).tasks == ()
