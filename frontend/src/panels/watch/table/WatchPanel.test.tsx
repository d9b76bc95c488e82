import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { menuItem, pick, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { symbol } from "../../../testing/samples";
import type { FakeServer } from "../../../testing/server";
import { t } from "../../../text";
import { WatchPanel } from "./WatchPanel";

/** The watch table, with these variables in its list. */
async function openTable(paths: readonly string[], prepare: (server: FakeServer) => void) {
  const page = await openPage((server) => {
    server.instance = { ...server.instance, project: { ...server.instance.project, watch: [...paths] } };
    prepare(server);
  });
  render(<WatchPanel />);
  return page;
}

const words = (server: FakeServer) => {
  const range = { ...symbol("W10:3", "WORD"), type: "ARRAY[0..2] OF WORD", kind: "array", expandable: true } as const;
  const members = ["W10", "W11", "W12"].map((path) => symbol(path, "WORD", { address: path }));
  server.has(range);
  for (const member of members) server.has(member);
  server.on("GET", "/instances/*/symbols", () => members);
};

const table = () => screen.getByRole("treegrid", { name: t("watch.table") });
const entry = (path: string) => screen.getByRole("textbox", { name: t("watch.change.of", { path }) });
const adding = () => screen.getByRole("combobox", { name: t("watch.add") });
const line = (path: string) => document.querySelector<HTMLElement>(`[data-path="${path}"]`);
const shows = (path: string, text: string) =>
  waitFor(() => expect(textOf(screen.queryByTestId(`current:${path}`))).toBe(text));
const written = (server: FakeServer) => server.sentOf("write").map(({ path, value }) => `${path} ${value}`);

test("what is refused stays, says why in its row, and is corrected with one click; Escape puts the reason away", async () => {
  const { server, user } = await openTable(["position"], (server) => server.has(symbol("position", "INT"), 5));
  await shows("position", "5");
  server.command("write", ({ value }) => (value === "99999" ? "99999 is outside of INT: -32768 to 32767" : undefined));

  await user.type(entry("position"), "99999{Enter}");
  const alert = await within(table()).findByRole("alert");
  expect(textOf(alert)).toContain(t("notwritten"));
  expect(textOf(alert)).toContain("99999 is outside of INT");
  expect(entry("position")).toHaveProperty("value", "99999");
  await user.keyboard("{Escape}");
  expect(within(table()).queryByRole("alert")).toBeNull();

  await user.type(entry("position"), "99999{Enter}");
  await user.click(await screen.findByRole("button", { name: t("watch.instead.write", { value: "32767" }) }));
  await waitFor(() => expect(within(table()).queryByRole("alert")).toBeNull());
  expect(written(server)).toEqual(["position 99999", "position 99999", "position 32767"]);
  expect(entry("position")).toHaveProperty("value", "");
  server.set("position", 32767);
  await shows("position", "32767");
});

test("a name that is not known says which it may have been, and becomes that one", async () => {
  const { user } = await openTable([], (server) => {
    server.has(symbol("motor", "BOOL"));
    server.near = ["motor"];
  });
  await user.type(adding(), "motr{Enter}");
  expect(textOf(await within(table()).findByRole("alert"))).toContain("motr is not known");
  await user.click(within(table()).getByRole("button", { name: "motor" }));
  await shows("motor", "FALSE");
  expect(line("motr")).toBeNull();
});

test("a range shows its words, written one by one; its format is theirs, and that of what is typed there", async () => {
  const { server, user } = await openTable([], words);
  await user.type(adding(), "W10:3{Enter}");
  for (const word of ["W10", "W11", "W12"]) await shows(word, "16#0000");

  await user.type(entry("W11"), "4660{Enter}");
  await waitFor(() => expect(written(server)).toEqual(["W11 4660"]));
  server.set("W11", 0x1234);
  await shows("W11", "16#1234");

  await user.pointer({ keys: "[MouseRight]", target: line("W10:3") as Element });
  await pick(user, t("format.bcd"));
  await shows("W11", "1234");
  await user.type(entry("W10"), "1234{Enter}");
  await waitFor(() => expect(written(server).at(-1)).toBe("W10 4660"));
  server.set("W10", 0x1234);

  // A word of the range may have a format of its own.
  await user.pointer({ keys: "[MouseRight]", target: line("W10") as Element });
  await pick(user, t("format.decimal"));
  await shows("W10", "4660");
  await shows("W11", "1234");
  await user.type(entry("W10"), "77{Enter}");
  await waitFor(() => expect(written(server).at(-1)).toBe("W10 77"));
});

test("by keyboard alone: to a row, type, write, force, release, remove, take back", async () => {
  const { server, user } = await openTable(["start", "motor"], (server) => {
    server.has(symbol("start", "BOOL"));
    server.has(symbol("motor", "BOOL"));
  });
  await shows("start", "FALSE");
  table().focus();
  await user.keyboard("{Home}");
  expect(line("start")?.getAttribute("aria-selected")).toBe("true");
  await user.keyboard("{ArrowDown}{ArrowUp}{F2}TRUE{Enter}");
  await waitFor(() => expect(written(server)).toEqual(["start TRUE"]));
  server.set("start", true);
  await shows("start", "TRUE");
  await user.keyboard("{Escape}");
  expect(document.activeElement).toBe(table());

  await user.keyboard("{F7}");
  await waitFor(() => expect(server.sentOf("force")).toMatchObject([{ path: "start", value: "TRUE" }]));
  const force = { path: "start", through: "", value: "TRUE", author: "Mika", scan: 1000 };
  server.say({ type: "forces", forces: [{ ...force, before: "", after_program: "", after: "" }], ended: [] });
  await screen.findByRole("button", { name: t("force.release.path", { path: "start" }) });
  await user.keyboard("{Shift>}{F7}{/Shift}");
  await waitFor(() => expect(server.sentOf("release")).toMatchObject([{ path: "start" }]));
  server.say({ type: "forces", forces: [], ended: [] });
  await waitFor(() =>
    expect(screen.queryByRole("button", { name: t("force.release.path", { path: "start" }) })).toBeNull(),
  );

  await user.keyboard("{Home}{Delete}");
  await waitFor(() => expect(line("start")).toBeNull());
  await user.keyboard("{Control>}z{/Control}");
  await waitFor(() => expect(line("start")).not.toBeNull());
});

test.each([
  ["in RUN", { mode: "RUN" }, "permit.run"],
  ["in the past", { state: "past", past: { by: "Ann", live_scan: 2000 } }, "permit.past"],
] as const)("%s one may only look, and each place says why", async (_, state, why) => {
  const { server, user } = await openTable(["start"], (server) => server.has(symbol("start", "BOOL")));
  await shows("start", "FALSE");
  server.becomes(state);
  await waitFor(() => expect(entry("start")).toHaveProperty("readOnly", true));
  expect(entry("start").getAttribute("aria-description")).toBe(t(why));
  expect(entry("start").getAttribute("placeholder")).toBe(t("watch.locked"));
  await user.type(entry("start"), "TRUE{Enter}");
  await user.pointer({ keys: "[MouseRight]", target: line("start") as Element });
  for (const label of [t("force.to", { value: "TRUE" }), t("watch.write.to", { value: "TRUE" })])
    expect(menuItem(label)).toHaveProperty("disabled", true);
  expect(server.sentOf("write")).toEqual([]);
});

test("the menu says whose force would be replaced", async () => {
  const { server, user } = await openTable(["start"], (server) => server.has(symbol("start", "BOOL")));
  await shows("start", "FALSE");
  const held = (author: string) =>
    server.say({
      type: "forces",
      forces: [
        { path: "start", through: "", value: "TRUE", author, scan: 5, before: "", after_program: "", after: "" },
      ],
      ended: [],
    });
  const hint = t("force.held", { author: "Aki", value: "TRUE" });
  held("Aki");
  await user.pointer({ keys: "[MouseRight]", target: line("start") as Element });
  expect(menuItem(t("force.to", { value: "FALSE" })).textContent).toContain(hint);
  await user.keyboard("{Escape}");
  held("Mika");
  await user.pointer({ keys: "[MouseRight]", target: line("start") as Element });
  expect(menuItem(t("force.to", { value: "FALSE" })).textContent).not.toContain(hint);
});
