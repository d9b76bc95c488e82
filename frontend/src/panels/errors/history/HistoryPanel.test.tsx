import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { useSimulator } from "../../../store/errors/simulator";
import { BASIC, BATTERY, CATALOGUE, CLEARED, MEMORY, RAISED, row, verdict } from "../../../testing/catalogue";
import { button, choose, pick, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { refusal } from "../../../testing/routes";
import type { FakeServer } from "../../../testing/server";
import { t } from "../../../text";
import type { HistoryVersion } from "../../../wire/types";
import { HistoryPanel } from "./HistoryPanel";

const VERSIONS: HistoryVersion[] = [
  { version: 2, at: null, author: "Mika", raised: 0, running: true },
  { version: 1, at: null, author: "Mika", raised: 1, running: false },
];
const TESTED = row(BATTERY, { ...CLEARED, reaction: verdict("acted", 1) });

async function openHistory(prepare: (server: FakeServer) => void = () => undefined) {
  const page = await openPage((server) => {
    server.on("GET", "/instances/*/model", () => CATALOGUE);
    prepare(server);
  });
  render(<HistoryPanel />);
  page.server.say({ type: "errors", whole: false, rows: [row(MEMORY), TESTED, row(BASIC)] });
  await waitFor(() => expect(lines()).toHaveLength(3));
  return page;
}

const lines = () =>
  within(screen.getByRole("table", { name: t("history.table") }))
    .getAllByRole("row")
    .slice(1);
const line = (name: string) => lines().find((each) => textOf(each).includes(name));
const filter = (name: string, now: string) => t("history.filter.of", { name, filter: now });

test("a row tells what was done with an error, by whom, and what the program did", async () => {
  await openHistory();
  for (const said of [t("errors.status.cleared"), "Mika", t("verdict.acted")])
    expect(textOf(line(BATTERY.name) ?? null)).toContain(said);
  expect(textOf(line(BASIC.name) ?? null)).toContain(t("errors.status.never"));
});

test.each(["simulator", "tool", "program"] as const)("what went by the %s says so", async (way) => {
  const { server } = await openHistory();
  server.say({ type: "errors", whole: false, rows: [row(BATTERY, { ...CLEARED, recovered_way: way })] });
  await waitFor(() => expect(textOf(line(BATTERY.name) ?? null)).toContain(t(`errors.way.${way}`)));
});

test("what somebody acknowledged says so, and what they said", async () => {
  const { server } = await openHistory();
  const acknowledged = { by: "OPC UA Ada, HMI", at: "2026-11-29T12:00:00Z", scan: 1234, remark: "new one is in" };
  server.say({ type: "errors", whole: false, rows: [row(BATTERY, { ...RAISED, acknowledged })] });
  const word = await screen.findByText(t("history.acknowledged"));
  expect(word.title).toContain("OPC UA Ada, HMI");
  expect(word.title).toContain("new one is in");
});

test("a name leads to the details of just this instance in the error simulator", async () => {
  const { server, user, places } = await openHistory();
  const unit = (slot: number) => row(BASIC, { ...RAISED, instance: `basic-io-error:rack=0,slot=${slot}` });
  server.say({ type: "errors", whole: false, rows: [unit(0), unit(3)] });
  await waitFor(() => expect(lines()).toHaveLength(4));
  await user.click(within(lines()[3] as HTMLElement).getByRole("button", { name: BASIC.name }));
  expect(places).toEqual(["panel errors"]);
  expect(useSimulator.getState().selected).toBe("basic-io-error:rack=0,slot=3");
});

test("filters leave what is wanted, and say when nothing is left; a column sorts", async () => {
  const { user } = await openHistory();
  await choose(user, filter(t("errors.state"), t("errors.status.all")), t("errors.status.cleared"));
  expect(lines()).toHaveLength(1);
  await choose(user, filter(t("errors.state"), t("errors.status.cleared")), t("errors.status.never"));
  expect(lines()).toHaveLength(2);
  await choose(user, filter(t("errors.state"), t("errors.status.never")), t("errors.status.all"));
  await user.type(screen.getByRole("searchbox"), "no such error");
  await screen.findByText(t("history.nomatch"));
  await user.clear(screen.getByRole("searchbox"));
  await user.click(within(screen.getByRole("columnheader", { name: t("log.by") })).getByRole("button"));
  expect(textOf(lines()[0] ?? null)).toContain(BATTERY.name);
});

test("every version has a history of its own: the old one is shown as one that runs no more", async () => {
  const { server, user } = await openHistory((server) => {
    server.instance = { ...server.instance, state: { ...server.instance.state, program_version: 2 } };
    server.on("GET", "/instances/*/history/versions", () => VERSIONS);
    server.on("GET", "/instances/*/history", () => ({ version: 1, running: false, rows: [row(BATTERY, RAISED)] }));
  });
  server.say({ type: "errors", whole: false, rows: [row(BATTERY)] });
  const running = t("history.version.of", { version: t("history.version.running", { version: 2 }) });
  await waitFor(() => expect(button(running)).toHaveProperty("disabled", false));
  await waitFor(() => expect(textOf(line(BATTERY.name) ?? null)).toContain(t("errors.status.never")));

  await choose(user, running, t("history.version", { version: 1 }));
  await waitFor(() =>
    expect(textOf(screen.getByRole("status"))).toContain(t("history.old", { version: 1, running: 2 })),
  );
  await waitFor(() =>
    expect(server.askedOf("GET", `/instances/${server.instance.id}/history?version=1`)).toHaveLength(1),
  );
  expect(textOf(line(BATTERY.name) ?? null)).toContain(t("errors.status.generated"));
  await user.click(button(t("history.old.back")));
  await waitFor(() => expect(textOf(line(BATTERY.name) ?? null)).toContain(t("errors.status.never")));
  expect(screen.queryByRole("status")).toBeNull();
});

test("a record that cannot be read is refused with the server's words; one that can is shown", async () => {
  let broken = true;
  const info = { id: 9, project: 1, title: "line-2", by: "Jo", at: "2026-11-20T10:00:00+00:00" };
  const { user, places } = await openHistory((server) => {
    server.on("POST", "/projects/*/records", () => (broken ? refusal("record.xml:3:1: nothing was kept") : info));
    server.on("GET", "/projects/*/records/*", () => refusal("not asked here"));
  });
  const file = document.querySelector("input[type=file]") as HTMLInputElement;
  await user.upload(file, new File(["<TestRecord>"], "broken.xml", { type: "text/xml" }));
  await waitFor(() => expect(textOf(screen.getByRole("alert"))).toContain("record.xml:3:1: nothing was kept"));
  expect(places).toEqual([]);
  broken = false;
  await user.upload(file, new File(["<TestRecord/>"], "good.xml", { type: "text/xml" }));
  await waitFor(() => expect(places).toEqual(["page record"]));
});

test("the scan at which an error was raised leads there, and to a replay", async () => {
  const { server, user } = await openHistory();
  server.say({ type: "errors", whole: false, rows: [row(BASIC, { ...RAISED, generated_scan: 500 })] });
  await user.click(await screen.findByRole("button", { name: t("rerun.of", { scan: 500 }) }));
  await pick(user, t("changes.goto", { scan: 500 }));
  await waitFor(() => expect(server.sentOf("travel")).toMatchObject([{ scan: 500 }]));
});
