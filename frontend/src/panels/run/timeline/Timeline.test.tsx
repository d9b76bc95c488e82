import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { grouped } from "../../../logic/format/numbers";
import { saveScenario, useTimeline } from "../../../store/plc/timeline";
import { box, button, pick, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { RUN } from "../../../testing/samples";
import type { FakeServer } from "../../../testing/server";
import { t } from "../../../text";
import type { Mark } from "../../../wire/types";
import { Timeline } from "./Timeline";

async function openTimeline() {
  const page = await openPage();
  render(<Timeline />);
  await screen.findByRole("slider");
  return page;
}

const mark = (scan: number, text: string, kind: Mark["kind"] = "mode"): Mark => ({ scan, text, kind, author: "Ann" });
const show = (server: FakeServer, marks: Mark[]) => server.say({ ...RUN, marks });
const marks = () => within(screen.getByRole("list", { name: t("timeline.marks") })).getAllByRole("button");
const position = () => Number(screen.getByRole("slider").getAttribute("aria-valuenow"));
const alert = () => screen.queryByRole("alert");
const inPast = (scan: number) => ({ state: "past", scan, past: { by: "Ann", live_scan: 1000 } }) as const;

test("a mark leads to its scan, and says what was done there and by whom", async () => {
  const { server, user } = await openTimeline();
  show(server, [mark(300, "start := TRUE", "write")]);
  const name = t("timeline.mark", { kind: t("log.kind.write"), text: "start := TRUE", scan: 300, author: "Ann" });
  await user.click(await screen.findByRole("button", { name }));
  await waitFor(() => expect(server.sentOf("travel")).toMatchObject([{ scan: 300 }]));
});

test("marks that lie close are one that is looked at closer; those of one scan become a list", async () => {
  const { server, user } = await openTimeline();
  show(server, [mark(300, "mode PROGRAM"), mark(300, "mode MONITOR"), mark(330, "mode RUN")]);
  await waitFor(() => expect(marks()).toHaveLength(1));
  expect(marks()[0]?.getAttribute("aria-label")).toContain(`${t("log.kind.mode")} 3`);
  await user.click(marks()[0] as HTMLElement);
  await waitFor(() => expect(marks()).toHaveLength(2));
  expect(server.sentOf("travel")).toEqual([]);
  expect(button(t("timeline.all"))).toHaveProperty("disabled", false);

  await user.click(marks()[0] as HTMLElement);
  await screen.findByRole("menu", { name: t("timeline.marks") });
  await pick(user, t("timeline.mark", { kind: t("log.kind.mode"), text: "mode PROGRAM", scan: 300, author: "Ann" }));
  await waitFor(() => expect(server.sentOf("travel")).toMatchObject([{ scan: 300 }]));
});

test("a scan that there is not says so, until another one is shown; a time is a scan, too", async () => {
  const { server, user } = await openTimeline();
  await user.type(box(t("timeline.goto")), "1.5{Enter}");
  await waitFor(() => expect(textOf(alert())).toBe(t("timeline.goto.bad", { first: 0, live: grouped(1000) })));
  server.becomes(inPast(999));
  await waitFor(() => expect(alert()).toBeNull());
  await user.clear(box(t("timeline.goto")));
  await user.type(box(t("timeline.goto")), "0:01{Enter}");
  await waitFor(() => expect(server.sentOf("travel")).toHaveLength(1));
  expect(Math.abs((server.sentOf("travel")[0]?.scan ?? 0) - 99)).toBeLessThan(2);
  expect(box(t("timeline.goto")).value).toBe("");
});

test("keys go scan by scan and from mark to mark; the playhead is there at once", async () => {
  const { server, user } = await openTimeline();
  show(server, [mark(200, "start := TRUE", "write"), mark(700, "start := FALSE", "write")]);
  server.becomes(inPast(500));
  await waitFor(() => expect(position()).toBe(500));
  screen.getByRole("slider").focus();
  await user.keyboard("{ArrowLeft}");
  expect(position()).toBe(499);
  server.becomes(inPast(499));
  await user.keyboard("{Control>}{ArrowRight}{/Control}");
  expect(position()).toBe(700);
  await waitFor(() => expect(server.sentOf("travel").map(({ scan }) => scan)).toEqual([499, 700]));
});

test("a stretch is selected by keyboard, and its menu asks what changed in it", async () => {
  const { server, user } = await openTimeline();
  server.becomes(inPast(500));
  await waitFor(() => expect(position()).toBe(500));
  screen.getByRole("slider").focus();
  await user.keyboard("{Shift>}{PageDown}{/Shift}");
  const scans = { first: 500, last: 600 };
  await waitFor(() => expect(textOf(screen.getByRole("status"))).toBe(t("stretch.selected", scans)));
  const none = { ...scans, changes: [], count: 0, entries: [], note: "", at_least: false };
  server.on("GET", "/instances/*/changes", () => none);
  await user.keyboard("{Enter}");
  await pick(user, t("stretch.changes", scans));
  const changes = `/instances/${server.instance.id}/changes?first=500&last=601`;
  await waitFor(() => expect(server.askedOf("GET", changes)).toHaveLength(1));
  await user.keyboard("{Escape}");
});

test("a run with a target shows what it waits for, and can be stopped before", async () => {
  const { server, user } = await openTimeline();
  server.becomes({ target: "until Main.parts.total > 30000" });
  await waitFor(() => expect(button(t("run.stop"))).not.toBeNull());
  expect(textOf(screen.getByRole("region", { name: t("timeline.label") }))).toContain("until Main.parts.total > 30000");
  await user.click(button(t("run.stop")));
  await waitFor(() => expect(server.sentOf("run")).toMatchObject([{ action: "pause" }]));
});

test("scans that a damaged run file lost are marked on the axis, and named beside the size of the file", async () => {
  const { server } = await openTimeline();
  const name = t("timeline.lost", { first: 400, last: 499 });
  server.say({ ...RUN, info: { ...(RUN.info as NonNullable<typeof RUN.info>), lost: [{ first: 400, until: 500 }] } });
  expect(await screen.findByTitle(name)).toHaveProperty("className", "lost");
  expect(screen.getByText(t("timeline.lost.short", { first: 400, last: 499 }))).toBeTruthy();
});

test("a wrong scan is gone from the field once a different scan is shown", async () => {
  const { server, user } = await openTimeline();
  const field = box(t("timeline.goto"));
  await user.type(field, "nowhere{Enter}");
  expect(alert()).not.toBeNull();
  server.becomes(inPast(300));
  await waitFor(() => expect(field).toHaveProperty("value", ""));
  expect(alert()).toBeNull();
});

test("the page says which test was downloaded, and of how many scans", async () => {
  const { server } = await openPage((server) => {
    server.on("GET", "/instances/*/scenario", () => new Response("# a test\nscans: 120\n"));
  });
  URL.createObjectURL ??= () => "blob:";
  URL.revokeObjectURL ??= () => undefined;
  await saveScenario(null);
  expect(useTimeline.getState()).toMatchObject({
    refused: null,
    made: { name: `${server.instance.name}-120-scans.scenario.yaml`, expects: false },
  });
});
