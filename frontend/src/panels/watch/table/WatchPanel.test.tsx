import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { openPage } from "../../../testing/page";
import { symbol } from "../../../testing/samples";
import type { FakeServer } from "../../../testing/server";
import { t } from "../../../text";
import { WatchPanel } from "./WatchPanel";

/** The watch table, with these variables in its list. */
async function openTable(paths: readonly string[], prepare: (server: FakeServer) => void = () => undefined) {
  const page = await openPage((server) => {
    server.instance = { ...server.instance, project: { ...server.instance.project, watch: [...paths] } };
    prepare(server);
  });
  render(<WatchPanel />);
  return page;
}

const table = () => screen.getByRole("treegrid", { name: t("watch.table") });
const entry = (path: string) => screen.getByRole("textbox", { name: t("watch.change.of", { path }) });
const shows = (path: string, text: string) =>
  waitFor(() => expect(screen.getByTestId(`current:${path}`).textContent).toBe(text));
const rows = () => [...document.querySelectorAll<HTMLElement>("[data-path]")].map(({ dataset }) => dataset.path);

test("what is out of range stays, says why, and is corrected with one click", async () => {
  const { server, user } = await openTable(["position"], (server) => server.has(symbol("position", "INT"), 5));
  await shows("position", "5");
  server.command("write", ({ value }) => (value === "99999" ? "99999 is outside of INT: -32768 to 32767" : undefined));

  await user.type(entry("position"), "99999{Enter}");
  const alert = await within(table()).findByRole("alert");
  expect(alert.textContent).toContain(t("notwritten"));
  expect(alert.textContent).toContain("99999 is outside of INT");
  expect(entry("position")).toHaveProperty("value", "99999");

  await user.click(screen.getByRole("button", { name: t("watch.instead.write", { value: "32767" }) }));
  await waitFor(() => expect(within(table()).queryByRole("alert")).toBeNull());
  expect(server.sentOf("write").map(({ value }) => value)).toEqual(["99999", "32767"]);
  expect(entry("position")).toHaveProperty("value", "");
  server.set("position", 32767);
  await shows("position", "32767");
  expect(rows()).toEqual(["position"]);
});
