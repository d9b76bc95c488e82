/**
 * Every panel and page in Japanese, at a server that has something to tell for each: what is on the screen, and what is read aloud, has no
 * English sentence. What the server says is Japanese here, as it is for who reads Japanese.
 */
import { render } from "@testing-library/react";
import type { FunctionComponent } from "react";
import { afterEach, beforeEach, expect, test } from "vitest";
import { chooseLanguage } from "../store/page/prefs";
import { BASIC, CATALOGUE, CLEARED, MEMORY, RAISED, row, verdict } from "../testing/catalogue";
import { eventually } from "../testing/eventually";
import { openPage } from "../testing/page";
import { RUN } from "../testing/samples";
import type { FakeServer } from "../testing/server";
import type { LogLine } from "../wire/types";
import { announcement } from "./announcements";
import { components } from "./dockParts";

beforeEach(() => chooseLanguage("ja"));
afterEach(() => chooseLanguage("en"));

/** Two words of small letters: an English sentence, or a part of one. */
const ENGLISH = /[A-Za-z]{2,} [a-z]{2,}/;
const READ_ALOUD = ["aria-label", "aria-description", "title", "placeholder", "alt"];
const AT = "2026-11-20T10:00:00+00:00";
const KINDS: LogLine["kind"][] = ["write", "force", "error", "recover", "mode", "run", "build", "system", "halt"];
const names = {
  "Basic I/O Unit error": "基本I/Oユニット異常",
  "Memory error": "メモリ異常",
  "Battery error": "電池異常",
};

/** Names of errors are the model's, which has them in Japanese, too. */
const inJapanese = <T,>(value: T): T =>
  JSON.parse(Object.entries(names).reduce((text, [en, ja]) => text.replaceAll(en, ja), JSON.stringify(value))) as T;

function busy(server: FakeServer): void {
  const log = KINDS.map((kind, n) => ({ kind, at: AT, author: "Mika", scan: n, text: "スキャン間で変更" }));
  const violation = { file: "Main.st", line: 3, column: 1, end_line: 3, end_column: 4, pou: "Main", variable: "level" };
  server.greeting = inJapanese({
    errors: [
      row(BASIC, { ...RAISED, reaction: verdict("reacted", 12) }),
      row(MEMORY, { ...CLEARED, reaction: verdict("never_read") }),
    ],
    log,
    armed: [
      {
        id: 1,
        by: "Mika",
        errors: ["battery-error"],
        state: "waiting",
        raised: 2,
        next_scan: 5000,
        text: "解除するまで",
      },
    ],
    forces: [
      {
        path: "lamp",
        value: "TRUE",
        author: "Mika",
        scan: 12,
        through: "",
        before: "FALSE",
        after: "",
        after_program: "FALSE",
      },
    ],
    diagnostics: {
      type: "diagnostics",
      count: 1,
      dropped: 0,
      violations: [
        {
          ...violation,
          instance: "Main",
          low: "0",
          high: "100",
          value: "120",
          times: 3,
          first_scan: 4,
          last_scan: 9,
          text: "範囲外",
          calls: [{ pou: "Main", instance: "Main", method: "", file: "Main.st", line: 7, column: 1 }],
          cut: true,
        },
      ],
    },
    disturbances: [
      { id: 4, kind: "stuck", text: "start 固定", by: "Mika", state: "active", fired: 2, next_scan: null, why: "" },
    ],
    timeline: { ...RUN, marks: log.map(({ kind, scan, text, author }) => ({ kind, scan, text, author })) },
  } as FakeServer["greeting"]);
  server.on("GET", "/instances/*/model", () => inJapanese(CATALOGUE));
  server.on("GET", "/instances/*/rack", () => []);
  const settings = {
    on: false,
    host: "127.0.0.1",
    port: 502,
    unit: 1,
    every_ms: 50,
    lost: "keep" as const,
    answers: "",
    ranges: [],
  };
  const fault = { kind: "none" as const, late_ms: 1000, scans: null, period: null };
  const plant = { settings, fault, answers: false, trouble: "", exchanges: 0, took_ms: 0, per_second: 0, frames: [] };
  const published = { on: false, host: "127.0.0.1", port: 1883, sparkplug: false, prefix: "scanbench", every_ms: 1000 };
  const mqtt = {
    settings: { ...published, variables: [], user: "", tls: false, ca: "" },
    password: false,
    identity: false,
    connected: false,
    trouble: "",
    published: 0,
    per_second: 0,
    frames: [],
  };
  server.on("GET", "/instances/*/communication", () => ({
    servers: [],
    error_readers: [],
    plant,
    mqtt,
    own_map: false,
    map_trouble: "",
  }));
  server.on("GET", "/instances/*/communication/modbus/map", () => []);
  server.on("GET", "/projects/*/user-errors", () => ({
    errors: [],
    groups: [],
    problems: [],
    readable: true,
    version: 0,
  }));
  server.on("POST", "/projects/*/check", () => ({
    checks: [],
    tasks: [],
    pous: [],
    problems: [{ ...violation, code: "T001", severity: "error" as const, message: "`levle` は宣言されていません。" }],
  }));
}

/** Pages of the help are English, and say so. */
function englishIn(root: Element): string[] {
  const elements = [...root.querySelectorAll("*")].filter((element) => !element.closest("[lang=en]"));
  const texts = elements.flatMap((element) => [
    ...[...element.childNodes].filter((node) => node instanceof Text).map((node) => node.data),
    ...READ_ALOUD.map((name) => element.getAttribute(name) ?? ""),
  ]);
  return texts.filter((text) => ENGLISH.test(text));
}

test("what is English would be found", () => {
  const { container } = render(<p title="nothing to do">x</p>);
  expect(englishIn(container)).toEqual(["nothing to do"]);
});

test.each(Object.keys(components).sort())("%s", async (name) => {
  await openPage(busy);
  const Panel = components[name] as FunctionComponent<{ params: object; api: object }>;
  const api = {
    isVisible: true,
    isMaximized: () => false,
    onDidVisibilityChange: () => ({ dispose: () => undefined }),
  };
  const { container } = render(<Panel params={{ path: "Main.st" }} api={api} />);
  await eventually(() => expect(container.textContent).not.toBe(""));
  expect(englishIn(container)).toEqual([]);
});

test("what the dock says aloud", () => {
  const says = (id: string, title: string) => announcement({ kind: "maximize", panel: { id, title } });
  expect(says("memory", "memory")).toBeNull(); // a page that has no title yet
  expect(says("memory", "メモリ")).toBe("メモリ を最大化しました");
  expect(says("watch", "watch")).toBe("ウォッチ を最大化しました");
  expect(says("file:line/Main.st", "file:line/Main.st")).toBe("Main.st を最大化しました");
});

test("in a different language the server is asked again, and knows which one", async () => {
  const { server } = await openPage(busy);
  const checks = () => server.askedOf("POST", `/projects/${server.instance.project.id}/check`).length;
  await eventually(() => expect(checks()).toBe(1));
  let greeted = 0;
  const { opened } = server;
  server.opened = (socket) => {
    if (socket.url.endsWith("/socket")) greeted += 1; // the language server has a socket of its own
    opened.call(server, socket);
  };
  chooseLanguage("en");
  expect(document.cookie).toContain("scanbench_language=en");
  await eventually(() => expect([greeted, checks()]).toEqual([1, 2]));
});
