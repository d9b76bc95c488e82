"""The pace of a run: targets, rests, and what is late."""

from scanbench.host.pacer import MAX_SPEED, Pacer

INTERVAL = 10_000_000


def test_so_many_scans_and_no_more() -> None:
    pacer = Pacer(INTERVAL, 1.0, paused=True, cpu_percent=None)
    pacer.run_on(100, 30, None)
    assert (pacer.paused, pacer.target, pacer.scans) == (False, "scan 130", 30)
    pacer.ran(10, held=False, now=110)
    assert (pacer.paused, pacer.scans) == (False, 20)
    pacer.ran(20, held=False, now=130)
    assert (pacer.paused, pacer.target) == (True, "")
    assert pacer.reached == "stopped at scan 130, as asked for"
    pacer.run_on(130, None, None)
    assert (pacer.reached, pacer.target) == ("", "")


def test_a_limit_of_the_cpu_is_rested_for() -> None:
    pacer = Pacer(INTERVAL, MAX_SPEED, paused=False, cpu_percent=10)
    pacer.worked(1_000_000_000)
    assert 8 < pacer.rest_s <= 9
    pacer.speed = 1.0
    pacer.worked(5_000_000_000)
    assert pacer.rest_s <= 9  # at a pace there is nothing to rest for
    assert Pacer(INTERVAL, MAX_SPEED, paused=False, cpu_percent=None).rest_s == 0


def test_what_is_late_is_of_the_pace_since_it_was_set() -> None:
    pacer = Pacer(INTERVAL, 1.0, paused=False, cpu_percent=None)
    assert pacer.late_percent == 0
    pacer.look()
    pacer.pace.scans, pacer.pace.late_scans = 200, 3
    assert pacer.late_percent == 1.5
    pacer.set_pace(INTERVAL)
    assert pacer.late_percent == 0
