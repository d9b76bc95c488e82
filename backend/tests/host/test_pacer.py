"""The course of a run: targets, rests, and what is late."""

from scanbench.host.pacer import MAX_SPEED, Course

INTERVAL = 10_000_000


def test_so_many_scans_and_no_more() -> None:
    course = Course(INTERVAL, 1.0, paused=True, cpu_percent=None)
    course.run_on(100, 30, None)
    assert (course.paused, course.target, course.scans) == (False, "scan 130", 30)
    course.ran(10, held=False, now=110)
    assert (course.paused, course.scans) == (False, 20)
    course.ran(20, held=False, now=130)
    assert (course.paused, course.target) == (True, "")
    assert course.reached == "stopped at scan 130, as asked for"
    course.run_on(130, None, None)
    assert (course.reached, course.target) == ("", "")


def test_a_limit_of_the_cpu_is_rested_for() -> None:
    course = Course(INTERVAL, MAX_SPEED, paused=False, cpu_percent=10)
    course.worked(1_000_000_000)
    assert 8 < course.rest_s <= 9
    course.speed = 1.0
    course.worked(5_000_000_000)
    assert course.rest_s <= 9  # at a pace there is nothing to rest for
    assert Course(INTERVAL, MAX_SPEED, paused=False, cpu_percent=None).rest_s == 0


def test_what_is_late_is_of_the_pace_since_it_was_set() -> None:
    course = Course(INTERVAL, 1.0, paused=False, cpu_percent=None)
    assert course.late_percent == 0
    course.look()
    course.pace.scans, course.pace.late_scans = 200, 3
    assert course.late_percent == 1.5
    course.set_pace(INTERVAL)
    assert course.late_percent == 0
