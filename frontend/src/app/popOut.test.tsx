import { render, screen, waitFor } from "@testing-library/react";
import { expect, test, vi } from "vitest";
import { lonePath } from "../logic/plc/links";
import { showPanel } from "../store/page/navigate";
import { COMMANDS, commandsNow, showPalette } from "../store/page/palette";
import { usePrefs } from "../store/page/prefs";
import { openPage } from "../testing/page";
import { t } from "../text";
import { App } from "./App";
import { canPopOut } from "./popOut";

/** The page at an address, as a window that was opened there. */
async function openAt(path: (instance: number) => string) {
  const page = await openPage();
  history.replaceState(null, "", path(page.server.instance.id));
  render(<App />);
  return page;
}

const command = (label: string) => commandsNow().find((each) => each.label === label);
const tabs = () => screen.getAllByRole("tab").map((tab) => tab.textContent);

test("a window of its own has one panel and the state of its PLC, opens others beside it, and keeps no arrangement", async () => {
  await openAt((instance) => lonePath(instance, "log"));
  await waitFor(() => expect(tabs()).toEqual([t("panel.log")]));
  await waitFor(() => expect(document.title).toContain(t("panel.log")));
  expect(screen.getByRole("link", { name: t("popout.back") }).getAttribute("href")).toMatch(/^\/i\/\d+$/);
  command(t("command.panel", { panel: t("panel.forces") }))?.run();
  await waitFor(() => expect(tabs()).toEqual([t("panel.log"), t("panel.forces")]));
  expect(Object.keys(localStorage).filter((key) => key.includes("layout"))).toEqual([]);
  showPalette(COMMANDS);
  await screen.findByRole("dialog");
  showPalette(null);
});

test("the active panel gets a window once; a second time that window is shown", async () => {
  const page = await openAt((instance) => `/i/${instance}`);
  const opened = { location: { href: "about:blank" }, focus: vi.fn() };
  const open = vi.spyOn(window, "open").mockReturnValue(opened as unknown as Window);
  await screen.findByRole("tab", { name: t("panel.log") });
  const openLog = () => {
    showPanel("log"); // a file that opens by itself would take its place
    command(t("popout.do"))?.run();
  };
  openLog();
  const address = lonePath(page.server.instance.id, "log");
  expect(opened.location.href).toBe(address);
  opened.location.href = `http://localhost${address}`;
  openLog();
  expect(opened.location.href).toBe(`http://localhost${address}`);
  expect(opened.focus).toHaveBeenCalledTimes(2);
  expect(new Set(open.mock.calls.map(([, name]) => name)).size).toBe(1);
  open.mockRestore();
});

test("a panel whose content no address knows stays where it is", () => {
  expect(["watch", "file:Main.st", "memory"].every(canPopOut)).toBe(true);
  expect(["record", "compare", "cross"].some(canPopOut)).toBe(false);
});

test("a theme chosen in one window is that of the others", () => {
  const before = usePrefs.getState();
  localStorage.setItem("scanbench.prefs", JSON.stringify({ ...before, theme: "contrast" }));
  dispatchEvent(new StorageEvent("storage", { key: "scanbench.prefs" }));
  expect(document.documentElement.dataset.theme).toBe("contrast");
  usePrefs.setState(before);
});
