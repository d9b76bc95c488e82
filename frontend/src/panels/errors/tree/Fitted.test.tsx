import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { BASIC, BATTERY, CATALOGUE, CLEARED, MEMORY, RAISED, row } from "../../../testing/catalogue";
import { button, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { t } from "../../../text";
import type { ErrorHistoryRow, ErrorInfo, ModelInfo } from "../../../wire/types";
import { ErrorsPanel } from "./ErrorsPanel";
import { PanelEnd } from "./PanelEnd";

const NUMBER: ErrorInfo = {
  ...BASIC,
  absent: true,
  details: BASIC.details.map((each) => ({ ...each, identifies: "several", hardware: "basic-io-unit" })),
};
const HARDWARE: ModelInfo = {
  ...CATALOGUE,
  hardware: true,
  catalogue: [
    { name: "CPU", errors: [MEMORY, BATTERY], groups: [] },
    { name: "Units", errors: [NUMBER], groups: [] },
  ],
};
const unit = (slot: number, more: Partial<ErrorHistoryRow> = {}) =>
  row(NUMBER, { instance: `basic-io-error:rack=0,slot=${slot}`, details: `rack=0, slot=${slot}`, ...more });

async function openSimulator() {
  const page = await openPage((server) => {
    server.on("GET", "/instances/*/model", () => HARDWARE);
    server.on("POST", "/instances/*/errors/preview", () => ({
      ...{ ok: true, message: "", scan: 1, more: 0, writes: [] },
    }));
  });
  render(
    <>
      <PanelEnd />
      <ErrorsPanel />
    </>,
  );
  await screen.findByRole("treegrid");
  const rows = [row(BATTERY), row(MEMORY, { fitted: false }), unit(3, { label: "Analog inputs" })];
  page.server.say({ type: "errors", whole: true, rows });
  await waitFor(() => tick(`${NUMBER.name}, Analog inputs, Rack number 0, Slot number 3`));
  return page;
}

const tree = () => screen.getByRole("treegrid");
const tick = (name: string) => within(tree()).getByRole<HTMLInputElement>("checkbox", { name });
const line = (name: string) => tick(name).closest("[role=row]") as HTMLElement;
const details = () => screen.getByRole("region", { name: t("errors.details") });

test("what is not fitted says so and where to change it before anybody tries; it cannot be ticked", async () => {
  const { user, places } = await openSimulator();
  expect(textOf(line(MEMORY.name))).toContain(t("errors.absent"));
  expect(line(MEMORY.name).title).toContain(t("errors.absent.where"));
  expect(tick(MEMORY.name).disabled).toBe(true);
  await user.click(line(MEMORY.name));
  expect(textOf(details())).toContain(t("errors.absent.cannot"));
  expect(within(details()).queryByRole("button", { name: t("errors.anyway") })).toBeNull();
  await user.click(within(details()).getByRole("button", { name: t("errors.absent.change") }));
  expect(places).toEqual(["page hardware"]);
});

test("what the device reports all the same is raised anyway: from its details, and after a refusal", async () => {
  const { server, user } = await openSimulator();
  server.command("generate", ({ anyway }) => (anyway ? undefined : "it is not fitted"));
  await user.click(line(NUMBER.name));
  expect(textOf(details())).toContain(t("errors.absent.can"));
  await user.click(within(details()).getByRole("button", { name: t("errors.anyway") }));
  const wanted = { id: NUMBER.id, details: { rack: "0", slot: "0" } };
  await waitFor(() => expect(server.sentOf("generate")).toMatchObject([{ errors: [wanted], anyway: true }]));
  await user.click(button(t("errors.generate")));
  const refusal = await within(tree()).findByRole("alert");
  await user.click(within(refusal).getByRole("button", { name: t("errors.anyway") }));
  await waitFor(() => expect(server.sentOf("generate").map(({ anyway }) => anyway)).toEqual([true, false, true]));
});

test("the details have what the project calls the unit, and the answer, too", async () => {
  const { server, user } = await openSimulator();
  server.command("generate", () => undefined);
  await user.click(line(`${NUMBER.name}, Analog inputs, Rack number 0, Slot number 3`));
  expect(within(details()).getByText("Analog inputs")).toBeDefined();
  server.say({ type: "errors", whole: false, rows: [unit(3, { ...RAISED, label: "Analog inputs" })] });
  await waitFor(() => expect(textOf(details())).toContain("Mika"));
});

test("a build without a unit takes its row and its count away without a reload", async () => {
  const { server } = await openSimulator();
  const counted = (total: number) => t("errors.tested", { tested: 0, total });
  server.say({ type: "errors", whole: true, rows: [row(BATTERY), row(MEMORY), unit(3), unit(5)] });
  await waitFor(() => expect(screen.getByText(counted(4))).toBeDefined());
  server.say({ type: "errors", whole: true, rows: [row(BATTERY), row(MEMORY), unit(5)] });
  await waitFor(() => expect(screen.getByText(counted(3))).toBeDefined());
  expect(within(tree()).queryByRole("checkbox", { name: `${NUMBER.name}, Rack number 0, Slot number 3` })).toBeNull();
});

test("a Recover that comes too late says who was first, and recovers what is left", async () => {
  const { server, user } = await openSimulator();
  const gone = { ...CLEARED, recovered_by: "Ann", recovered_way: "simulator" } as const;
  server.say({ type: "errors", whole: false, rows: [row(BATTERY, RAISED), unit(3, RAISED)] });
  await waitFor(() => expect(textOf(line(BATTERY.name))).toContain(t("errors.status.generated")));
  let asked = 0;
  server.command("recover", () => {
    asked += 1;
    if (asked > 1) return undefined;
    server.say({ type: "errors", whole: false, rows: [row(BATTERY, gone)] });
    return "battery-error is not generated: there is nothing to recover";
  });
  await user.click(tick(BATTERY.name));
  await user.click(tick(`${NUMBER.name}, Rack number 0, Slot number 3`));
  await user.click(button(t("errors.recover.many", { count: 2 })));
  const said = t("errors.already.simulator", { error: BATTERY.name, by: "Ann" });
  await screen.findByText((text) => text.includes(said));
  expect(screen.queryByRole("alert")).toBeNull();
  expect(server.sentOf("recover").map(({ ids }) => ids)).toEqual([
    [BATTERY.id, "basic-io-error:rack=0,slot=3"],
    ["basic-io-error:rack=0,slot=3"],
  ]);
});

test.each(["simulator", "tool", "program"] as const)("the details say that it went by the %s", async (way) => {
  const { server, user } = await openSimulator();
  const gone = { ...CLEARED, recovered_by: "Ann", recovered_way: way };
  server.say({ type: "errors", whole: false, rows: [row(BATTERY, gone)] });
  await user.click(line(BATTERY.name));
  const words = t(`errors.way.${way}.by`, { by: "Ann", at: "AT", scan: "1,300" }).split("AT")[0] ?? "";
  await waitFor(() => expect(textOf(details())).toContain(words));
});
