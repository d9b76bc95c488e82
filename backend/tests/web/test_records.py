"""Histories by version and test records, through the whole server."""

import asyncio
import threading
from datetime import UTC, datetime
from typing import cast

import pytest
from lxml import etree

from scanbench.reports.record import RecordHead, TestRecord
from scanbench.server.workbench import Workbench
from scanbench.web.routes import records as routes_records
from tests.web.server import Browser, Server

MODEL = "CJ1M-CPU63"
SOURCE = """PROGRAM Main
VAR n : INT; lamp AT CIO 100.00 : BOOL; basic AT A402.12 : BOOL; END_VAR
  n := n + 1;
  lamp := basic;
END_PROGRAM
"""
Row = dict[str, object]


def row(server: Server, instance: int, id: str, **query: object) -> Row:
    told = server.http.get(f"/api/instances/{instance}/history", params={k: str(v) for k, v in query.items()})
    assert told.status_code == 200, told.text
    found: Row = next(each for each in told.json()["rows"] if each["id"] == id)
    return found


def raise_and_recover(browser: Browser, server: Server, instance: int, id: str) -> None:
    assert browser.ask(type="generate", errors=[{"id": id, "details": {}}])["ok"]
    browser.wait(lambda: row(server, instance, id)["status"] == "generated")
    assert browser.ask(type="recover", ids=[id])["ok"]
    browser.wait(lambda: row(server, instance, id)["status"] == "cleared")


def test_a_record_goes_out_and_comes_in_again(server: Server) -> None:
    instance = server.instance("recorded", MODEL, main=SOURCE)
    project = server.http.get(f"/api/instances/{instance}").json()["project"]["id"]
    with server.browser(instance) as browser:
        raise_and_recover(browser, server, instance, "battery-error")
    base = f"/api/instances/{instance}/record"
    told = server.http.get(base).json()
    assert (told["project"], told["program_version"], told["model"]) == ("recorded", 1, MODEL)
    assert len(told["program_hash"]) == 64
    battery = next(error for error in told["errors"] if error["id"] == "battery-error")
    assert (battery["status"], battery["count"], battery["by"]) == ("cleared", 1, "Ada Lovelace")
    assert {line["text"].split()[0] for line in told["log"]} == {"generated", "recovered"}
    assert told["summary"]["tested"] == 1

    xml = server.http.get(base, params={"format": "xml"})
    assert xml.headers["content-disposition"].startswith('attachment; filename="recorded-version-1-record.xml"')
    page = server.http.get(base, params={"format": "html", "lang": "ja"})
    assert "default-src 'none'" in page.headers["content-security-policy"]
    assert "試験成績書" in page.text
    csv = server.http.get(base, params={"format": "csv"}).text
    assert "battery-error" in csv

    at = f"/api/projects/{project}/records"
    brought = server.http.post(at, content=xml.content, headers={"Content-Type": "application/xml"})
    assert brought.status_code == 201, brought.text
    info = brought.json()
    assert "recorded" in info["title"]
    assert server.http.get(at).json() == [info]
    again = server.http.get(f"{at}/{info['id']}").json()
    assert again["info"] == info
    assert {**again["record"], "exported_at": ""} == {
        **told,
        "exported_at": "",
        "exported_by": again["record"]["exported_by"],
    }
    assert "Battery error" in server.http.get(f"{at}/{info['id']}", params={"format": "html"}).text
    assert server.http.delete(f"{at}/{info['id']}").status_code == 204
    assert server.http.get(at).json() == []
    assert server.http.get(f"{at}/{info['id']}").status_code == 404


def test_every_version_has_a_history(server: Server) -> None:
    instance = server.instance("versions", MODEL, main=SOURCE)
    project = server.http.get(f"/api/instances/{instance}").json()["project"]["id"]
    with server.browser(instance) as browser:
        raise_and_recover(browser, server, instance, "battery-error")
        saved = server.http.put(
            f"/api/projects/{project}/files/main.st", json={"text": SOURCE.replace("+ 1", "+ 2"), "version": 1}
        )
        assert saved.status_code == 200
        assert server.http.post(f"/api/projects/{project}/build", json={}).json()["ok"]
        browser.wait(lambda: server.state(instance)["program_version"] == 2)
        browser.wait(lambda: row(server, instance, "battery-error")["status"] == "never")
        assert row(server, instance, "battery-error", version=1)["status"] == "cleared"
        raise_and_recover(browser, server, instance, "fal")
    told = server.http.get(f"/api/instances/{instance}/history/versions").json()
    assert [(each["version"], each["running"], each["raised"]) for each in told] == [(2, True, 1), (1, False, 1)]
    assert all(each["at"] for each in told)
    old = server.http.get(f"/api/instances/{instance}/record", params={"version": 1}).json()
    assert {line["text"].split(",")[0] for line in old["log"]} == {"generated Battery error", "recovered Battery error"}
    refused = server.http.get(f"/api/instances/{instance}/history", params={"version": 7})
    assert refused.status_code == 404
    assert "no error history of version 7; there are 1, 2" in refused.json()["message"]


def test_what_is_no_record_is_refused_with_its_place(server: Server) -> None:
    project = server.project("unrecorded", MODEL, main=SOURCE)
    at = f"/api/projects/{project}/records"
    for body, says in (
        (b"<TestRecord\n Version='1'>", "record.xml:"),
        (b"\xff\xfe", "byte 0 is not UTF-8"),
        (b"<Model/>", "here belongs <TestRecord>"),
        (b" " * 5_000_000, "nothing was imported: the file is larger than 4 MiB"),
    ):
        refused = server.http.post(at, content=body)
        assert refused.status_code == 422
        assert says in refused.json()["message"], refused.text
    assert server.http.get(at).json() == []


def test_a_record_of_another_project_is_not_there(server: Server) -> None:
    instance = server.instance("theirs", MODEL, main=SOURCE)
    project = server.http.get(f"/api/instances/{instance}").json()["project"]["id"]
    xml = server.http.get(f"/api/instances/{instance}/record", params={"format": "xml"}).content
    assert etree.fromstring(xml).tag == "TestRecord"
    id = server.http.post(f"/api/projects/{project}/records", content=xml).json()["id"]
    other = server.project("not theirs", MODEL, main=SOURCE)
    assert server.http.get(f"/api/projects/{other}/records/{id}").status_code == 404
    assert server.http.delete(f"/api/projects/{other}/records/{id}").status_code == 404


def test_a_record_is_written_where_nobody_waits_for_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """The event loop drives every PLC and browser."""
    threads = []

    def noted(found: TestRecord, language: str) -> str:
        threads.append(threading.get_ident())
        return f"{found.head.project} {language}"

    class Known:
        records: "Known"

        async def one(self, project: int, id: int) -> tuple[None, TestRecord]:
            return None, record

    head = RecordHead("line", MODEL, "line-1", 1, "", datetime(2026, 11, 21, tzinfo=UTC), "Ada", "Scanbench")
    record, bench = TestRecord(head, ()), Known()
    bench.records = bench
    monkeypatch.setattr(routes_records, "to_html", noted)
    answer = asyncio.run(routes_records.on_imported(cast(Workbench, bench), 1, 1, "html", "ja"))
    assert answer.body == b"line ja"
    assert threading.get_ident() not in threads
