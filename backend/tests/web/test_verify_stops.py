"""Disturbances that stop a PLC which runs: each is told at its scan, statement and instance while the PLC runs, and once more when the whole
run is verified afterwards."""

from tests.amounts import amount, nightly
from tests.verify.test_stopping import SOURCE, stops
from tests.web.server import PATIENCE_S, Browser, Message, Server
from tests.web.test_verify import MODEL, begin, disturb, ended, info, paused, rows

FATAL = 6
"""The line of `SOURCE` where the program stops itself."""
Stop = tuple[int, int, str, str]
"""Scan, line and instance where the PLC stopped, and what was injected."""


def told(server: Server, id: int, first: int = 0) -> list[Stop]:
    """The stops that a verification tells in its rows from this index on."""
    found: list[Stop] = []
    while True:
        page = rows(server, id, first=first, differing=True)["rows"]
        found += [stop_of(row) for row in page]
        if not page:
            return found
        first = page[-1]["index"] + 1


def stop_of(row: Message) -> Stop:
    (trap,) = [each for each in row["differences"] if each["cause"] == "trap"]
    (injected,) = row["disturbances"]
    return row["scan"], trap["place"]["line"], trap["place"]["instance"], injected


def stopped(browser: Browser, server: Server, instance: int, seed: int) -> Stop:
    """Stops the PLC that runs by a disturbance."""
    wanted, line, where = stops(seed)
    scan = paused(browser) + 1
    disturb(server, instance, kind="result", site=wanted.site, bit=wanted.bit, scan=scan)
    browser.ask(type="run", action="continue")
    browser.wait_state("fatal" if line == FATAL else "trapped")
    return scan, line, where, f"Result of {wanted.site}, bit {wanted.bit}"


@nightly
def test_each_is_told_while_the_plc_runs_and_in_the_past(server: Server) -> None:
    instance = server.instance("stopped often", MODEL, main=SOURCE)
    with server.browser(instance) as browser:
        first, seen = paused(browser), 0
        live = begin(server, instance)["id"]
        expected: list[Stop] = []
        for seed in range(amount(1000, 6)):
            expected.append(stopped(browser, server, instance, seed))
            browser.wait(lambda: info(server, instance, live)["differing"] == len(expected))
            assert told(server, live, seen) == expected[-1:]
            seen = info(server, instance, live)["rows"]
            assert browser.ask(type="restart", kind="cold")["ok"]
        status = info(server, instance, live)
        assert (status["skipped"], status["differing"]) == (0, len(expected))
        browser.wait(lambda: server.state(instance)["scan"] > expected[-1][0])  # before that its last scan is not over
        paused(browser)  # with nothing else to do
        past = begin(server, instance, first=first, last=expected[-1][0])["id"]
        over = ended(browser, server, instance, past, patience_s=10 * PATIENCE_S)
        assert told(server, past) == expected
        assert (over["differing"], over["skipped"], over["not_reached"]) == (len(expected), 0, 0)
