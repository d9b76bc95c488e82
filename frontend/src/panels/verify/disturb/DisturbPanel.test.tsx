import { render, screen, waitFor } from "@testing-library/react";
import { expect, test } from "vitest";
import { box, button, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { symbol } from "../../../testing/samples";
import type { FakeServer } from "../../../testing/server";
import { t } from "../../../text";
import type { DisturbanceInfo } from "../../../wire/types";
import { DisturbPanel } from "./DisturbPanel";

async function openDisturb(prepare: (server: FakeServer) => void = () => undefined) {
  const page = await openPage((server) => {
    server.on("POST", "/instances/*/disturbances", ({ body }) => {
      const known = body.path !== "Main.belt.positon";
      const message = known ? "memory Main.belt.position, bit 3" : "positon is not known";
      return { ok: known, message, near: known ? [] : ["Main.belt.position"], scan: 1001 };
    });
    server.on("DELETE", "/instances/*/disturbances", () => ({ ok: true, message: "", near: [], scan: 1002 }));
    server.on("DELETE", "/instances/*/disturbances/*", () => ({ ok: true, message: "", near: [], scan: 1002 }));
    prepare(server);
  });
  render(<DisturbPanel />);
  const order = () => page.server.askedOf("POST", `/instances/${page.server.instance.id}/disturbances`);
  return { ...page, order };
}

const path = () => screen.getByRole<HTMLInputElement>("combobox", { name: t("disturb.path") });
const doIt = () => button(t("disturb.do"));
const refused = () => textOf(screen.queryByRole("alert"));
const DEFINED: DisturbanceInfo = {
  id: 4,
  kind: "stuck",
  text: "start stuck",
  by: "Mika",
  state: "active",
  fired: 2,
  next_scan: null,
  why: "",
};

test("a mistake says what is missing, what was typed stays, and a name that comes near is one click", async () => {
  const { user, order } = await openDisturb();
  await user.click(doIt());
  expect(refused()).toBe(t("disturb.bad.path"));
  await user.type(path(), "Main.belt.positon");
  await user.click(doIt());
  await waitFor(() => expect(refused()).toContain("positon is not known"));
  await user.click(button(t("import.trace.take", { path: "Main.belt.position" })));
  expect(path().value).toBe("Main.belt.position");
  await user.type(box(t("disturb.bit")), "x");
  await user.click(doIt());
  expect(refused()).toBe(t("disturb.bad.bit"));
  expect(order()).toHaveLength(1);
  await user.clear(box(t("disturb.bit")));
  await user.type(box(t("disturb.bit")), "3");
  await user.click(doIt());
  await waitFor(() => expect(textOf(screen.getByRole("status"))).toContain("Memory Main.belt.position, bit 3"));
  expect(order().at(-1)).toMatchObject({ kind: "flip", path: "Main.belt.position", bit: 3 });
});

test("the program offers its variables, and Enter takes the one that is chosen", async () => {
  const { user } = await openDisturb((server) =>
    server.on("GET", "/instances/*/complete", () => [symbol("Main.belt.position", "INT")]),
  );
  await user.type(path(), "Main.belt.pos");
  await screen.findByRole("option", { name: /Main\.belt\.position/ });
  await user.keyboard("{ArrowDown}{Enter}");
  expect(path().value).toBe("Main.belt.position");
});

test("by chance: a probability that is none is refused; one that is becomes a number", async () => {
  const { user, order } = await openDisturb();
  await user.click(screen.getByRole("radio", { name: new RegExp(`^${t("disturb.kind.result")}`) }));
  await user.type(box(t("disturb.site")), "Main.st:12");
  await user.selectOptions(screen.getByRole("combobox", { name: t("disturb.when") }), t("disturb.when.chance"));
  const chance = box(t("disturb.chance"));
  await user.clear(chance);
  await user.type(chance, "120 %");
  await user.click(doIt());
  expect(refused()).toBe(t("disturb.bad.chance"));
  await user.clear(chance);
  await user.type(chance, "1/2");
  await user.click(doIt());
  await waitFor(() => expect(order()).toMatchObject([{ kind: "result", site: "Main.st:12", probability: 0.5 }]));
});

test("everybody sees what is defined, by whom and how often, and may take back one or all", async () => {
  const { server, user } = await openDisturb();
  await screen.findByRole("region", { name: t("disturb.none") });
  const waiting = { ...DEFINED, id: 5, text: "D500, bit 0", state: "waiting", fired: 0, next_scan: 9000 } as const;
  server.say({ type: "disturbances", disturbances: [DEFINED, waiting] });
  const list = await screen.findByRole("region", { name: t("disturb.list") });
  for (const said of [
    t("disturb.count", { count: 2 }),
    t("disturb.active"),
    t("disturb.waiting"),
    t("disturb.by", { by: "Mika" }),
    t("disturb.fired", { count: 2 }),
  ])
    expect(textOf(list)).toContain(said);
  await user.click(button(t("disturb.takeback.of", { text: "start stuck" })));
  await user.click(button(t("disturb.takeback.all")));
  const at = `/instances/${server.instance.id}/disturbances`;
  await waitFor(() =>
    expect(server.asked.filter(({ method }) => method === "DELETE").map((one) => one.path)).toEqual([`${at}/4`, at]),
  );
  server.say({ type: "disturbances", disturbances: [] });
  await screen.findByRole("region", { name: t("disturb.none") });
});

test("in the past nothing can be disturbed, and a scan that is over is none", async () => {
  const { server, user, order } = await openDisturb();
  await user.type(path(), "D500");
  await user.selectOptions(screen.getByRole("combobox", { name: t("disturb.when") }), t("disturb.when.scan"));
  await user.type(box(t("shape.scan")), "1");
  await user.click(doIt());
  expect(refused()).toBe(t("shape.bad.past"));
  server.becomes({ state: "past", scan: 500, past: { by: "Ann", live_scan: 1000 } });
  await waitFor(() => expect(doIt()).toHaveProperty("disabled", true));
  expect(doIt().title).toBe(t("permit.past"));
  server.becomes({ state: "running", scan: 1000, past: null });
  await waitFor(() => expect(doIt()).toHaveProperty("disabled", false));
  expect(order()).toEqual([]);
});
