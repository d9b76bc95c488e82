import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { BASIC, BATTERY, CATALOGUE, RAISED, row } from "../../../testing/catalogue";
import { button, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { t } from "../../../text";
import type { DeviceError, DeviceErrors, DeviceStandby } from "../../../wire/types";
import { DevicePage } from "./DevicePage";

const NOTHING: DeviceErrors = {
  scan: 7,
  past: false,
  code: "0000",
  codes: "hex4",
  has_log: true,
  keeps_latest: false,
  errors: [],
  log: [],
  messages: [],
  standby: null,
};
const FLAT: DeviceError = {
  id: BATTERY.id,
  name: "Battery",
  severity: "nonfatal",
  code: "00F7",
  flag: "A402.04",
  details: [],
  text: "",
  cause: "",
  lasting: true,
  top: true,
};

async function openDevice(found: Partial<DeviceErrors> = {}) {
  const page = await openPage((server) => server.on("GET", "/instances/*/model", () => CATALOGUE));
  render(<DevicePage />);
  expect(textOf(screen.getByRole("region", { name: t("device.title") }))).toContain(t("device.nothing"));
  page.server.say({ type: "device", found: { ...NOTHING, ...found } });
  await screen.findByText(t("device.present.count", { count: found.errors?.length ?? 0 }));
  return page;
}

const lines = (table: string) =>
  within(screen.getByRole("table", { name: table }))
    .getAllByRole("row")
    .map(textOf);

test("a PLC without errors says so, and there is nothing to clear", async () => {
  await openDevice();
  screen.getByText(t("device.present.none"));
  screen.getByText(t("device.log.none"));
  for (const name of [t("device.clear"), t("device.clearall"), t("device.clearlog")])
    expect(button(name)).toHaveProperty("disabled", true);
});

test("errors, messages and the log are shown in the words of the catalogue", async () => {
  const details = [{ name: "number", value: "42", text: "FAL number: 42" }];
  const said = { ...FLAT, id: "", name: "An error with the flag A402.15", flag: "A402.15", details, text: "PUMP HOT" };
  const record = {
    number: 1,
    time: "",
    code: "7777",
    contents: "0012",
    id: "",
    name: "",
    severity: null,
    details: [],
    text: "",
  };
  await openDevice({
    code: "412A",
    errors: [said, FLAT],
    log: [record],
    messages: [{ instruction: "MSG", number: 3, text: "TANK FULL" }],
  });
  const [, first, second] = lines(t("device.present"));
  for (const part of [said.name, "FAL number: 42", "PUMP HOT"]) expect(first).toContain(part);
  for (const part of [BATTERY.name, "00F7", t("device.lasting")]) expect(second).toContain(part);
  expect(lines(t("device.messages"))).toEqual([expect.stringContaining("TANK FULL")]);
  expect(lines(t("device.log"))[1]).toContain(t("device.log.unknown"));
});

test("a tool clears, the simulator recovers what it raised, and a refusal is told", async () => {
  const { server, user } = await openDevice({ errors: [FLAT] });
  const recover = () => button(t("device.recover.of", { error: BATTERY.name }));
  expect(recover()).toHaveProperty("disabled", true);
  server.say({ type: "errors", whole: false, rows: [row(BATTERY, RAISED)] });
  await screen.findByTitle(t("device.recover.about"));
  server.command("clear_errors", () => "error will not clear: the cause of battery-error, code 00F7 is still there");
  await user.click(button(t("device.clear")));
  expect(textOf(await screen.findByRole("alert"))).toContain(`cause of ${BATTERY.name}`);
  expect(server.sentOf("clear_errors")).toMatchObject([{ what: "current" }]);
  await user.click(recover());
  expect(server.sentOf("recover")).toMatchObject([{ ids: [BATTERY.id] }]);
});

test("what was done is told until an error comes", async () => {
  const { server, user } = await openDevice({ errors: [FLAT] });
  await user.click(button(t("device.clearall")));
  await screen.findByRole("status");
  server.say({ type: "device", found: NOTHING });
  await screen.findByText(t("device.present.none"));
  screen.getByRole("status");
  server.say({ type: "device", found: { ...NOTHING, errors: [FLAT] } });
  await waitFor(() => expect(screen.queryByRole("status")).toBeNull());
});

test("of several units of a kind one is recovered", async () => {
  const unit = (number: number): DeviceError => ({
    ...FLAT,
    id: BASIC.id,
    details: [{ name: "unit", value: String(number), text: `Unit number: ${number}` }],
  });
  const { server, user } = await openDevice({ errors: [unit(3), unit(7)] });
  const instance = (number: number) => `${BASIC.id}:unit=${number}`;
  server.say({
    type: "errors",
    whole: false,
    rows: [3, 7].map((number) => row(BASIC, { ...RAISED, instance: instance(number) })),
  });
  await waitFor(() => expect(screen.getAllByTitle(t("device.recover.about"))).toHaveLength(2));
  await user.click(button(t("device.recover.of", { error: `${BASIC.name}, Unit number: 7` })));
  expect(server.sentOf("recover")).toMatchObject([{ ids: [instance(7)] }]);
});

test("of two CPU Units the page says which controls, and the failed one is repaired when no error is left", async () => {
  const duplex: DeviceStandby = { duplex: true, side: "left", causes: [], time: "" };
  const { server, user } = await openDevice({ standby: duplex });
  screen.getByText(t("device.standby.duplex", { side: t("device.standby.left") }));
  const simplex: DeviceStandby = { duplex: false, side: "right", causes: [BATTERY.id], time: "2026-11-24 10:15:02" };
  server.say({ type: "device", found: { ...NOTHING, errors: [FLAT], standby: simplex } });
  const region = await screen.findByRole("region", { name: t("device.standby") });
  await waitFor(() => expect(textOf(region)).toContain("2026-11-24 10:15:02"));
  expect(textOf(region)).toContain(BATTERY.name);
  expect(screen.queryByRole("button", { name: t("device.standby.back") })).toBeNull();
  server.say({ type: "device", found: { ...NOTHING, standby: simplex } });
  await user.click(await screen.findByRole("button", { name: t("device.standby.back") }));
  expect(server.sentOf("recover")).toMatchObject([{ ids: null }]);
});

test("an error for which the device has no code says so", async () => {
  const port = { ...BATTERY, id: "port", code: "" };
  const group = { name: "Ports", groups: [], errors: [port] };
  const page = await openPage((server) =>
    server.on("GET", "/instances/*/model", () => ({ ...CATALOGUE, catalogue: [group] })),
  );
  render(<DevicePage />);
  page.server.say({ type: "device", found: { ...NOTHING, errors: [{ ...FLAT, id: "port", code: "" }] } });
  await waitFor(() => expect(lines(t("device.present"))[1]).toContain(t("errors.nocode")));
});

test("a model without a log says so", async () => {
  await openDevice({ has_log: false });
  screen.getByText(t("device.log.no"));
  expect(screen.queryByRole("button", { name: t("device.clearlog") })).toBeNull();
});
