import { render, screen, waitFor } from "@testing-library/react";
import { expect, onTestFinished, test, vi } from "vitest";
import { useNavigation } from "../../../store/page/navigate";
import { openDocument, useDocuments } from "../../../store/project/documents";
import { openPage } from "../../../testing/page";
import { symbolOf } from "../../../testing/symbols";
import { t } from "../../../text";
import { LspClient } from "../../../wire/lsp";
import { Outline } from "./Outline";

const PATH = "Belt.st";
const SYMBOLS = [
  symbolOf("Belt", 5, 1, 8, [
    symbolOf("VAR_INPUT", 4, 2, 3, [{ ...symbolOf("run", 13, 2, 2), detail: "VAR_INPUT BOOL" }]),
    symbolOf("VAR", 4, 4, 5, [symbolOf("speed", 13, 5, 5)]),
    symbolOf("IF run", 25, 6, 7),
  ]),
];

const names = () => screen.getAllByRole("treeitem").map((row) => row.getAttribute("aria-label"));
const selected = () => screen.getAllByRole("treeitem", { selected: true }).map((row) => row.textContent);

test("the outline is folded at first; open, it follows the caret, leads to a name, and is filtered", async () => {
  const asked = vi.spyOn(LspClient.prototype, "request").mockImplementation(async () => SYMBOLS as never);
  onTestFinished(() => asked.mockRestore());
  const { user } = await openPage((server) => {
    server.on("GET", "/projects/*/files", () => [{ path: PATH, version: 1, author: "Mika" }]);
    server.on("GET", "/projects/*/files/**", () => ({ path: PATH, version: 1, author: "Mika", text: "", saved_at: 0 }));
  });
  await openDocument(PATH);
  useDocuments.setState({ active: PATH, cursor: { line: 2, column: 1 } });
  render(<Outline />);
  expect(asked).not.toHaveBeenCalled();
  await user.click(screen.getByRole("button", { name: t("outline.title") }));
  await waitFor(() => expect(names()).toEqual(["Belt", "VAR_INPUT", "run", "VAR"]));
  expect(selected()).toEqual(["runBOOL"]);

  useDocuments.setState({ cursor: { line: 5, column: 1 } });
  await waitFor(() => expect(names()).toEqual(["Belt", "VAR_INPUT", "VAR", "speed"]));
  expect(selected()).toEqual(["speed"]);
  useDocuments.setState({ cursor: { line: 6, column: 1 } });
  await waitFor(() => expect(selected()).toEqual(["Belt"]));

  await user.type(screen.getByRole("searchbox"), "RU");
  expect(names()).toEqual(["Belt", "VAR_INPUT", "run"]);
  await user.click(screen.getByRole("treeitem", { name: "run" }));
  expect(useNavigation.getState().place).toMatchObject({ path: PATH, line: 2, column: 1 });
  await user.type(screen.getByRole("searchbox"), "zzz");
  expect(screen.getByText(t("outline.filter.none", { text: "RUzzz" }))).toBeTruthy();
});
