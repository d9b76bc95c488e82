import { render, screen, waitFor, within } from "@testing-library/react";
import { beforeEach, expect, onTestFinished, test, vi } from "vitest";
import { useNavigation } from "../../../store/page/navigate";
import { openBreadcrumbs } from "../../../store/project/breadcrumbs";
import { openDocument, useDocuments } from "../../../store/project/documents";
import { openPage } from "../../../testing/page";
import { symbolOf } from "../../../testing/symbols";
import { t } from "../../../text";
import { LspClient } from "../../../wire/lsp";
import { Breadcrumbs } from "./Breadcrumbs";

const PATH = "Belt.st";
const SYMBOLS = [
  symbolOf("Belt", 5, 1, 8, [
    symbolOf("VAR_INPUT", 4, 2, 2, [symbolOf("run", 13, 2, 2)]),
    symbolOf("Stop", 6, 3, 4),
    symbolOf("IF run", 25, 6, 7),
  ]),
  symbolOf("Main", 2, 10, 12),
];
let symbols: unknown = SYMBOLS;

beforeEach(() => {
  symbols = SYMBOLS;
  const asked = vi
    .spyOn(LspClient.prototype, "request")
    .mockImplementation(async (method) => (method === "textDocument/documentSymbol" ? symbols : null) as never);
  onTestFinished(() => asked.mockRestore());
});

async function openCrumbs(line: number) {
  const page = await openPage((server) => {
    server.on("GET", "/projects/*/files", () => [
      { path: PATH, version: 1, author: "Mika" },
      { path: "Main.st", version: 1, author: "Mika" },
    ]);
    server.on("GET", "/projects/*/files/**", () => ({ path: PATH, version: 1, author: "Mika", text: "", saved_at: 0 }));
  });
  await openDocument(PATH);
  moveTo(line);
  render(<Breadcrumbs path={PATH} />);
  return page;
}

const moveTo = (line: number) => useDocuments.setState({ active: PATH, cursor: { line, column: 1 } });
const crumbs = () =>
  within(screen.getByRole("navigation"))
    .getAllByRole("button")
    .map((crumb) => crumb.textContent);
const items = () => within(screen.getByRole("menu")).getAllByRole("menuitemradio");

test("the line follows the caret; the menu of a part has what is beside it, and leads there", async () => {
  const { user } = await openCrumbs(6);
  await waitFor(() => expect(crumbs()).toEqual([PATH, "Belt", "IF run"]));
  await user.click(screen.getByRole("button", { name: "IF run" }));
  expect(items().map((item) => item.textContent)).toEqual(["VAR_INPUT", "Stop", "IF run"]);
  expect(document.activeElement).toBe(items()[2]);
  await user.keyboard("{ArrowUp}{Enter}");
  expect(useNavigation.getState().place).toMatchObject({ path: PATH, line: 3, column: 1 });
  moveTo(11);
  await waitFor(() => expect(crumbs()).toEqual([PATH, "Main"]));
  moveTo(9);
  await waitFor(() => expect(crumbs()).toEqual([PATH, "…"]));
  await user.click(screen.getByRole("button", { name: t("crumbs.inside") }));
  const inside = within(screen.getByRole("menu")).getAllByRole("menuitem");
  expect(inside.map((item) => item.textContent)).toEqual(["Belt", "Main"]);
});

test("by keys alone: the command opens the last menu, arrows go from part to part; files are the first part", async () => {
  const { user, places } = await openCrumbs(2);
  await waitFor(() => expect(crumbs()).toEqual([PATH, "Belt", "VAR_INPUT", "run"]));
  openBreadcrumbs();
  await waitFor(() => expect(items().map((item) => item.textContent)).toEqual(["run"]));
  await user.keyboard("{Escape}");
  screen.getByRole("button", { name: "run" }).focus();
  await user.keyboard("{Home}{ArrowRight}{ArrowLeft}{ArrowDown}");
  expect(items().map((item) => item.textContent)).toEqual([PATH, "Main.st"]);
  await user.keyboard("{ArrowDown}{Enter}");
  expect(places.at(-1)).toBe("file Main.st");
});

test("what was typed changes the line, and a server that is not there leaves it as it was", async () => {
  await openCrumbs(1);
  await waitFor(() => expect(crumbs()).toEqual([PATH, "Belt", "…"]));
  const type = (text: string) =>
    useDocuments.setState(({ open }) => ({ open: { ...open, [PATH]: { ...open[PATH], text } as never } }));
  symbols = null;
  type("x");
  symbols = [symbolOf("Lift", 5, 1, 8)];
  type("xy");
  await waitFor(() => expect(crumbs()).toEqual([PATH, "Lift"]));
});
