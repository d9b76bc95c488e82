import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { showSweeps } from "../../../store/errors/sweeps";
import { button, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import type { FakeServer } from "../../../testing/server";
import { t } from "../../../text";
import type { Reaction, SweepCell, SweepError, SweepSummary } from "../../../wire/types";
import { SweepPage } from "./SweepPage";

const sweepOf = (server: FakeServer, more: Partial<SweepSummary> = {}): SweepSummary => ({
  id: 3,
  project: server.instance.project.id,
  instance: "line-1",
  instance_id: server.instance.id,
  model: "CJ1M",
  program_version: 1,
  by: "Ann",
  at: "2026-11-20T10:00:00+00:00",
  status: "running",
  message: "",
  done: 25,
  total: 100,
  seconds: 10,
  window: 1000,
  states: ["Now"],
  counts: {},
  unmet: 0,
  problems: [],
  ...more,
});

async function openSweeps(prepare: (server: FakeServer) => void = () => undefined) {
  const page = await openPage(prepare);
  render(<SweepPage />);
  showSweeps();
  await screen.findByText(t("sweep.empty.title"));
  return page;
}

const told = (server: FakeServer, more: Partial<SweepSummary> = {}) =>
  server.say({ type: "sweep", sweep: sweepOf(server, more), now: "battery-error", cells: [] });
const list = () => within(screen.getByRole("table", { name: t("sweep.tab.list") }));

test("a sweep that somebody else began is in the list at once, with how far it is, and whatever becomes of it", async () => {
  const { server } = await openSweeps();
  told(server);
  await waitFor(() => expect(textOf(list().getAllByRole("row").at(-1) ?? null)).toContain("Ann"));
  const line = () => textOf(list().getAllByRole("row").at(-1) ?? null);
  expect(line()).toContain("25");
  told(server, { done: 60 });
  await waitFor(() => expect(line()).toContain("60"));
  for (const status of ["cancelled", "interrupted", "done"] as const) {
    told(server, { done: 60, status });
    await waitFor(() => expect(line()).toContain(t(`sweep.status.${status}`)));
  }
});

test("what could not be tried is red, with the reason, and so is a mistake in what is required", async () => {
  const { server, user } = await openSweeps((server) => {
    const unit: SweepError = {
      id: "unit:unit=3",
      name: "Unit error (unit=3)",
      code: "0303",
      severity: "nonfatal",
      group: "",
    };
    const note = "unit 3 is not fitted";
    const rule: Reaction["required"][number] = {
      text: "lamp within 2 scans",
      line: 4,
      outcome: "not_checked",
      reason: "not_raised",
      note,
      recovery: false,
      scan: null,
      values: [],
    };
    const cell: SweepCell = {
      error: unit.id,
      state: "Now",
      verdict: null,
      first_read: null,
      first_effect: null,
      raised_scan: 7,
      difference_count: 0,
      required: 1,
      unmet: 1,
      note,
      accepted: null,
      untried: [rule],
    };
    server.on("GET", "/sweeps/*", () => ({
      ...sweepOf(server, { status: "done", done: 1, total: 1 }),
      problems: [{ line: 9, column: 1, message: "CJ1M knows no error 'batery-error'." }],
      errors: [unit],
      cells: [cell],
    }));
  });
  told(server, { status: "done" });
  await screen.findByRole("table", { name: t("sweep.tab.list") });
  await user.click(list().getAllByRole("button")[0] as HTMLElement);
  const problems = await screen.findByRole("list", { name: t("sweep.problems") });
  expect(textOf(problems)).toContain("required.reactions:9");
  expect(textOf(problems)).toContain("batery-error");
  const wanted = t("sweep.line.not_tried", { note: "unit 3 is not fitted" });
  expect((await screen.findByText(wanted)).closest(".unmet")).not.toBeNull();
  const rules = within(screen.getByRole("region", { name: t("required.label") })).getByRole("listitem");
  expect(textOf(rules)).toContain(t("required.not_tried"));
  expect(textOf(rules)).toContain("lamp within 2 scans");
});

test("a colleague cancels it, and goes on with it", async () => {
  const { server, user } = await openSweeps((server) => {
    const whole = (more: Partial<SweepSummary> = {}) => ({ ...sweepOf(server, more), errors: [], cells: [] });
    server.on("GET", "/sweeps/*", () => whole());
    server.on("POST", "/sweeps/*/cancel", () => sweepOf(server, { status: "cancelled" }));
    server.on("POST", "/sweeps/*/resume", () => sweepOf(server));
  });
  told(server);
  await screen.findByRole("table", { name: t("sweep.tab.list") });
  await user.click(list().getAllByRole("button")[0] as HTMLElement);
  expect((await screen.findByRole("progressbar")).getAttribute("aria-valuenow")).toBe("25");
  await user.click(button(t("cancel")));
  await waitFor(() => expect(server.askedOf("POST", "/sweeps/3/cancel")).toHaveLength(1));
  told(server, { status: "cancelled" });
  await user.click(await screen.findByRole("button", { name: t("sweep.resume") }));
  await waitFor(() => expect(server.askedOf("POST", "/sweeps/3/resume")).toHaveLength(1));
});
