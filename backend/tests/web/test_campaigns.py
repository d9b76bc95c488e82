"""A campaign on the run of a PLC through the whole house."""

from lxml import etree

from tests.web.server import Message, Server
from tests.web.test_verify import MODEL, paused, scans

PROGRAM = """\
VAR_GLOBAL lamp AT CIO100.00 : BOOL; END_VAR
PROGRAM Main
VAR n, half : INT; alarm : BOOL; END_VAR
  n := (n + 1) MOD 100;
  half := n / 2;
  IF half > n THEN alarm := TRUE; END_IF;
  lamp := n > 50;
END_PROGRAM
"""
WANTED = {"count": 8, "seed": 4, "first": 2, "last": 25, "window": 5, "alarms": ["Main.alarm"]}


def tried(server: Server, instance: int, wanted: Message) -> Message:
    """A campaign that is over."""
    with server.browser(instance) as browser:
        begun = server.http.post(f"/api/instances/{instance}/campaigns", json=wanted)
        assert begun.status_code == 201, begun.text
        id = begun.json()["id"]
        browser.wait(
            lambda: any(each["type"] == "campaign" and each["id"] == id and each["over"] for each in browser.messages)
        )
    whole: Message = server.http.get(f"/api/campaigns/{id}").json()
    return whole


def known(server: Server, instance: int) -> list[int]:
    return [int(each["id"]) for each in server.http.get(f"/api/instances/{instance}/campaigns").json()]


def test_a_campaign_is_told_kept_and_comes_again(server: Server) -> None:
    instance = server.instance("guarded", MODEL, main=PROGRAM)
    with server.browser(instance) as browser:
        paused(browser)
        scans(browser, 30)
    one = tried(server, instance, WANTED)
    assert (one["state"]["done"], one["state"]["of"], one["state"]["message"]) == (8, 8, "")
    assert sum(each["count"] for each in one["state"]["outcomes"]) == 8
    assert tried(server, instance, WANTED)["trials"] == one["trials"]
    assert known(server, instance) == [2, 1]

    told = server.http.get("/api/campaigns/1/export").json()
    assert [each["number"] for each in told["trials"]] == list(range(1, 9))
    (made,) = (each for each in server.http.get("/api/instances").json() if each["id"] == instance)
    assert (told["project"], told["instance"]) == (made["project"]["name"], made["name"])
    cases = etree.fromstring(server.http.get("/api/campaigns/1/export", params={"format": "junit"}).content)
    assert len(cases.findall(".//testcase")) == 8

    hit = next(each for each in one["trials"] if each["verification"])
    again = [server.http.post(f"/api/campaigns/1/trials/{hit['number']}/open").json() for _ in range(2)]
    named = f"{made['name']}, disturbance {hit['number']}"
    assert [each["name"] for each in again] == [named, f"{named} (2)"]
    opened = again[0]
    with server.browser(opened["id"]) as browser:
        assert browser.ask(type="travel", scan=hit["scan"])["ok"]
        said = f"disturbance {hit['number']} of the campaign with seed 4: {hit['text']}"
        assert said in [each["text"] for each in browser.hello["log"]]

    assert server.http.delete("/api/campaigns/1").status_code == 204
    assert server.http.get("/api/campaigns/1").status_code == 404
    refused = tried(server, instance, {**WANTED, "alarms": ["Main.nowhere"]})
    assert "nowhere" in refused["state"]["message"]
    assert known(server, instance) == [refused["state"]["id"], 2]
    last = tried(server, instance, WANTED)
    assert known(server, instance) == [last["state"]["id"], 2], (
        "why a campaign came to nothing is told until the next one"
    )


def test_a_trial_of_a_run_that_was_replaced_is_not_opened(server: Server) -> None:
    instance = server.instance("replaced", MODEL, main=PROGRAM)
    with server.browser(instance) as browser:
        paused(browser)
        scans(browser, 30)
    id = tried(server, instance, WANTED)["state"]["id"]
    assert server.http.post(f"/api/campaigns/{id}/trials/1/open").status_code == 201
    with server.browser(instance) as browser:
        assert browser.ask(type="new_run")["ok"]
        browser.wait(lambda: any(m["type"] == "timeline" and m["fresh"] for m in browser.messages))
        scans(browser, 60)
    refused = server.http.post(f"/api/campaigns/{id}/trials/1/open")
    assert refused.status_code == 422, refused.text
    assert "the run was replaced since" in refused.json()["message"]
