"""Makes the golden database: `python -m tests.store.golden_database` has a server do what people do, and writes `golden/VERSION.sql`,
the files that lie beside the database, and `golden/VERSION.json`: what all of it says (`tests.store.said`).

It is made once for each release: every later version must read it and say the same. Where tables come between two releases, it gets a name of
its own: `python -m tests.store.golden_database 0.1.0.10` is that of revision 0010 after release 0.1.0.
"""

import json
import shutil
import sqlite3
import sys
from base64 import b64decode, b64encode
from contextlib import closing
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from pycrdt import Doc, Text

from scanbench import __version__
from scanbench.faults.reaction.reaction import WINDOW
from scanbench.store.store import Store
from tests.store.golden_data import GOLDEN
from tests.store.said import BESIDE, said
from tests.web.dap.client import BrowserClient
from tests.web.server import Browser, Message, Server

PROGRAM = """\
TYPE Color : (red, green, blue); END_TYPE
PROGRAM Main
VAR
  n : DINT; level : INT := 100; doubled : INT; color : Color; speed : REAL; fine : LREAL; wait : TIME; text : STRING[12];
  lamp AT CIO 100.00 : BOOL; ready AT CIO 0.00 : BOOL; basic AT A402.12 : BOOL; battery AT A402.04 : BOOL; hot AT W10.00 : BOOL;
  belt : Ramp;
END_VAR
  n := n + 1;
  doubled := level * 2;
  IF n MOD 2 = 0 THEN color := red; ELSE color := blue; END_IF;
  speed := DINT_TO_REAL(n) / 4.0; fine := fine + 0.1; wait := wait + T#10ms;
  IF basic OR hot THEN lamp := TRUE; END_IF;
  IF battery THEN ; END_IF;
  IF n > 30 THEN text := 'high'; ELSE text := 'low'; END_IF;
  belt(target := 600);
END_PROGRAM
FUNCTION_BLOCK Ramp
VAR_INPUT target : INT; END_VAR
VAR_OUTPUT speed : INT; END_VAR
  speed := LIMIT(speed - 25, target, speed + 25);
END_FUNCTION_BLOCK
"""
PUMP = {
    "id": "pump-hot", "group": ["Pumps"], "code": "4101", "flag": "W10.00", "severity": "nonfatal", "priority": "300",
    "texts": [{"language": "en", "name": "Pump hot"}, {"language": "ja", "name": "ポンプ過熱"}],
    "details": [{"name": "pump", "control": "List", "addresses": [
        {"id": "north", "type": "Bit", "address": "W12.03"}, {"id": "south", "type": "Bit", "address": "W12.04"},
    ]}],
}  # fmt: skip
LOG = "scan,Main.level,Main.doubled,remark\n1,100,200,a\n2,100,200,b\n3,101,202,c\n"
REQUIRED = """\
battery-error:
  at least acted
  Main.lamp within 2 scans
basic-io-error: Main.lamp within 2 scans
basic-io-error in Idel: Main.lamp
pump-hot: Main.lamp within 2 scans
batery-error: Main.lamp
"""
ADA, BOB = {"scanbench_user": "Ada Lovelace"}, {"scanbench_user": "Bob Noyce"}


class Maker:
    """What people do at one PLC, one thing after the other."""

    def __init__(self, server: Server, project: int) -> None:
        self.server, self.project = server, project
        self.post(f"/api/projects/{project}/build", {})
        self.instance = int(self.post("/api/instances", {"project": project, "name": "line 1"})["id"])
        self.at = f"/api/instances/{self.instance}"

    def call(self, method: str, path: str, body: object = None, user: Message = ADA) -> Message:
        """One request that is not refused."""
        reply = self.server.http.request(method, path, json=body, params=user)
        assert reply.is_success, (path, reply.text)
        found: Message = reply.json() if reply.content else {}
        return found

    def post(self, path: str, body: object, user: Message = ADA) -> Message:
        """The same, of the kind that most are."""
        return self.call("POST", path, body, user)

    def scans(self, browser: Browser, count: int) -> None:
        """So many scans."""
        end = int(browser.ask(type="run", action="continue", speed=0, scans=count)["scan"]) + count

        def over() -> bool:
            state = self.server.state(self.instance)
            return bool(state["state"] == "paused" and state["scan"] >= end)

        browser.wait(over)

    def work(self, browser: Browser) -> None:
        """All of it."""
        self.lists()
        self.breakpoints(browser)
        trace = self.traced(browser)
        self.errors(browser)
        self.verified(browser)
        self.swept(browser)
        self.kept(browser, trace)
        self.logs()
        self.later(browser)
        self.labelled()
        self.drafted(browser)

    def lists(self) -> None:
        entries = [{"path": "Main.n", "group": "belt", "format": "hex"}, {"path": "W10:8"}]
        path = f"/api/projects/{self.project}/watch-lists"
        shared = self.post(path, {"name": "Belt", "shared": True, "groups": ["belt"], "entries": entries})
        self.post(path, {"name": "Mine", "shared": False, "entries": [{"path": "Main.level"}]}, BOB)
        again = {"name": "Belt 3", "shared": True, "groups": ["belt", "none"], "entries": entries, "version": 1}
        self.call("PUT", f"/api/watch-lists/{shared['id']}", again, BOB)

    def breakpoints(self, browser: Browser) -> None:
        tool = BrowserClient(browser)
        tool.ask("attach", instance=self.instance)
        line = {
            "kind": "line", "source": {"path": "main.st"}, "line": 8, "enabled": False, "condition": "Main.n > 1000000",
            "hits": ">= 3", "log": "n is {n}",
        }  # fmt: skip
        for each in (
            line,
            {"kind": "data", "path": "Main.level", "access": "write", "enabled": False},
            {"kind": "scan", "scan": 1 << 40},
        ):
            tool.ask("scanbench/setBreakpoint", breakpoint=each)

    def traced(self, browser: Browser) -> int:
        signals = ["Main.n", "Main.color", "Main.speed", "Main.fine", "Main.wait", "Main.ready", "Main.level + 1"]
        trigger = {"text": "Main.n", "when": "rises", "value": "20", "before": 70}
        every = {"name": "All", "signals": signals, "scans": 30, "every": 2, "trigger": trigger, "repeat": True}
        trace = self.post(f"{self.at}/traces", every)
        self.post(f"{self.at}/traces", {"name": "Plain", "signals": ["Main.n"]}, BOB)
        self.scans(browser, 40)
        return int(trace["id"])

    def errors(self, browser: Browser) -> None:
        def compared(id: object) -> bool:
            rows = {each["id"]: each for each in self.server.http.get(f"{self.at}/errors").json()}
            return bool((rows[id]["reaction"] or {}).get("state") == "done")

        wanted = [{"id": "basic-io-error", "details": {}}, {"id": "pump-hot", "details": {"pump": "north"}}]
        for each in wanted:
            assert browser.ask(type="generate", errors=[each])["ok"]
            self.scans(browser, WINDOW)
            browser.wait(partial(compared, each["id"]))
        assert browser.ask(type="recover", ids=["basic-io-error"])["ok"]

    def verified(self, browser: Browser) -> None:
        scan = int(self.server.state(self.instance)["scan"])
        self.post(f"{self.at}/disturbances", {"kind": "result", "site": "main.st:9", "bit": 3, "scan": scan + 2})
        self.scans(browser, 5)
        begun = self.post(
            f"{self.at}/verifications", {"range": {"file": "main.st", "first": 8, "last": 10}, "first": scan, "last": scan + 4}
        )  # fmt: skip

        def over() -> bool:
            found = self.server.http.get(f"{self.at}/verifications").json()
            return bool(next(each for each in found if each["id"] == begun["id"])["state"] == "done")

        browser.wait(over)
        self.post(f"/api/verifications/{begun['id']}/keep", {"name": "five scans"})

    def swept(self, browser: Browser) -> None:
        states = [int(self.post(f"{self.at}/states", {"name": "Idle"})["id"])]
        assert browser.ask(type="write", path="Main.ready", value="TRUE")["ok"]
        states.append(int(self.post(f"{self.at}/states", {"name": "Ready"}, BOB)["id"]))
        errors = ["battery-error", "basic-io-error", "io-bus-error", "fal", "pump-hot"]
        sweep = self.post(f"{self.at}/sweeps", {"states": states, "window": 20, "errors": errors})["id"]
        browser.wait(lambda: bool(self.call("GET", f"/api/sweeps/{sweep}")["status"] == "done"))
        accepted = {"error": "fal", "state": "Idle", "reason": "no such instruction is used"}
        self.post(f"/api/sweeps/{sweep}/accept", accepted)

    def kept(self, browser: Browser, trace: int) -> None:
        self.post(f"{self.at}/traces/{trace}/keep", {"name": "thirty scans"})
        retrospective = self.post(f"{self.at}/retrospectives", {"signals": ["Main.n", "Main.color"], "scans": 10})
        browser.wait(lambda: len(self.server.http.get(f"/api/projects/{self.project}/trace-records").json()) == 2)
        assert retrospective["id"]
        xml = self.server.http.get(f"{self.at}/record", params={"format": "xml"})
        brought = self.server.http.post(f"/api/projects/{self.project}/records", content=xml.content, params=BOB)
        assert brought.status_code == 201, brought.text

    def logs(self) -> None:
        at = f"/api/projects/{self.project}"
        sent = self.server.http.post(f"{at}/traces", params={"name": "real.csv"}, content=LOG).json()
        mapping = sent["mapping"]
        roles = {"Main.level": "input", "Main.doubled": "output"}
        for column in mapping["columns"]:
            column["role"] = roles.get(column["column"], "ignore")
        self.post(f"{at}/trace-mappings", {"name": "line 3", "mapping": mapping})

    def later(self, browser: Browser) -> None:
        """A second version of the program, and a PLC that is off."""
        text = PROGRAM.replace("n := n + 1", "n := n + 2")
        self.call("PUT", f"/api/projects/{self.project}/files/main.st", {"text": text, "version": 1}, BOB)
        assert self.post(f"/api/projects/{self.project}/build", {"agreed": True}, BOB)["ok"]
        browser.wait(lambda: bool(self.server.state(self.instance)["program_version"] == 2))
        assert browser.ask(type="generate", errors=[{"id": "battery-error", "details": {}}])["ok"]
        self.scans(browser, 2)
        other = self.post("/api/instances", {"project": self.project, "name": "line 2"})["id"]
        self.call("PATCH", f"/api/instances/{other}", {"power": False, "limits": {"memory_mib": 2000, "run_mib": 100}})

    def labelled(self) -> None:
        """The first version has a name and says what it is for."""
        said = {"label": "Accepted", "message": "as it was when the belt was accepted"}
        self.call("PATCH", f"/api/projects/{self.project}/versions/1", said, BOB)

    def drafted(self, browser: Browser) -> None:
        """Somebody types in a file, and does not save it."""
        assert browser.ask(type="open_draft", path="main.st")["ok"]
        opened = browser.wait_for("draft")
        doc: Doc[Text] = Doc()
        text = doc.get("text", type=Text)
        doc.apply_update(b64decode(opened["update"]))
        before = doc.get_state()
        text.insert(0, "(* not saved *) ")
        update = b64encode(doc.get_update(before)).decode()
        assert browser.ask(type="edit_draft", path="main.st", draft=opened["draft"], update=update)["ok"]


def drive(data: Path) -> None:
    """Leaves a data directory in which each table has rows."""
    data.mkdir(parents=True, exist_ok=True)
    store = Store(f"sqlite:///{data / 'scanbench.db'}")  # with a project in it no samples are made
    project = store.projects.create("conveyor", "CJ1M-CPU63", ["Main.n"]).id
    store.close()
    with Server(data) as server:
        at = f"/api/projects/{project}"
        for path, text in {"main.st": PROGRAM, "required.reactions": REQUIRED}.items():
            saved = server.http.put(f"{at}/files/{path}", json={"text": text, "version": 0}, params=ADA)
            assert saved.is_success, saved.text
        errors = server.http.put(f"{at}/user-errors", json={"version": 0, "errors": [PUMP]}, params=ADA)
        assert errors.is_success, errors.text
        maker = Maker(server, project)
        with server.browser(maker.instance) as browser:
            assert browser.ask(type="run", action="pause")["ok"]
            maker.work(browser)


def dump(data: Path, to: Path) -> None:
    """The database as SQL, which shows what it holds, and the files of records that lie beside it."""
    with closing(sqlite3.connect(data / "scanbench.db")) as connection:
        to.with_name(f"{to.name}.sql").write_text("\n".join(connection.iterdump()) + "\n", "utf-8")
    shutil.rmtree(to, ignore_errors=True)
    for name in BESIDE:
        shutil.copytree(data / name, to / name)


def main(name: str) -> None:
    """Makes it, beside those of other releases."""
    with TemporaryDirectory() as directory:
        data = Path(directory) / "data"
        drive(data)
        dump(data, GOLDEN / name)
        told = json.dumps(said(data), indent=1, ensure_ascii=False)
    (GOLDEN / f"{name}.json").write_text(told + "\n", "utf-8")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else __version__)
