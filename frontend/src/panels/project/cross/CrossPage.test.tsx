import { render, screen, waitFor, within } from "@testing-library/react";
import { beforeEach, expect, onTestFinished, test, vi } from "vitest";
import { showCrossReferences, showCrossReferencesOf, showUnused } from "../../../store/project/cross";
import { useDocuments } from "../../../store/project/documents";
import { openPage } from "../../../testing/page";
import { t } from "../../../text";
import { LspClient } from "../../../wire/lsp";
import { CrossPage } from "./CrossPage";

const server = { asked: [] as [string, object][], answers: new Map<string, unknown>() };

const at = (file: string, line: number) => ({
  uri: `scanbench:/${file}`,
  range: { start: { line: line - 1, character: 2 }, end: { line: line - 1, character: 7 } },
});
const LEVEL = {
  name: "level",
  symbol: ["variable", "GLOBAL", "LEVEL"],
  complete: true,
  references: [
    { ...at("Globals.st", 2), access: "declared", pou: "", text: "level : INT;" },
    { ...at("Main.st", 9), access: "written", pou: "Main", text: "level := level + 1;" },
    { ...at("Main.st", 9), access: "read", pou: "Main", text: "level := level + 1;" },
  ],
};

/** The language server, which the fake server does not have. */
beforeEach(() => {
  server.asked.length = 0;
  server.answers.clear();
  const asked = vi.spyOn(LspClient.prototype, "request").mockImplementation(async (method, params) => {
    server.asked.push([method.replace("scanbench/", ""), params]);
    return (server.answers.get(method.replace("scanbench/", "")) ?? null) as never;
  });
  onTestFinished(() => asked.mockRestore());
});

const rows = () =>
  within(screen.getByRole("table"))
    .getAllByRole("row")
    .slice(1)
    .map((row) =>
      within(row)
        .getAllByRole("cell")
        .map((cell) => cell.textContent)
        .join(" | "),
    );

test("who reads and who writes is listed line by line, leads there, and is asked for again when the texts change", async () => {
  const { places, user } = await openPage();
  server.answers.set("crossReferences", LEVEL);
  await showCrossReferences({ file: "Main.st", line: 9, column: 4 }, "level");
  render(<CrossPage />);
  await waitFor(() => expect(screen.getByText(t("cross.count", { read: 1, written: 1 }))).toBeTruthy());
  expect(rows()).toEqual([
    `${t("cross.declared")} | Globals.st:2 |  | level : INT;`,
    `${t("cross.written")} | Main.st:9 | Main | level := level + 1;`,
    `${t("cross.read")} | Main.st:9 | Main | level := level + 1;`,
  ]);
  await user.click(screen.getByRole("button", { name: "Globals.st:2" }));
  expect(places.at(-1)).toBe("file Globals.st");

  server.answers.set("crossReferences", { ...LEVEL, complete: false, references: LEVEL.references.slice(0, 1) });
  useDocuments.setState({ problems: [] });
  await waitFor(() => expect(rows()).toHaveLength(1));
  expect(server.asked.at(-1)).toEqual(["crossReferences", { symbol: LEVEL.symbol }]);
  expect(screen.getByRole("status").textContent).toBe(t("cross.errors"));
});

test("what has no declaration says so; nothing is listed as unread while the program has errors", async () => {
  await openPage();
  server.answers.set("crossReferences", { name: "", symbol: null, complete: true, references: [] });
  server.answers.set("unused", { complete: false, unused: [] });
  await showCrossReferencesOf("D100");
  render(<CrossPage />);
  await waitFor(() => expect(screen.getByText(t("cross.nothing", { path: "D100" }))).toBeTruthy());
  await showUnused();
  await waitFor(() => expect(screen.getByRole("status").textContent).toBe(t("cross.unused.errors")));
  const spare = { ...at("Main.st", 3), name: "spare", written: false, pou: "Main" };
  server.answers.set("unused", { complete: true, unused: [spare] });
  await showUnused();
  await waitFor(() => expect(rows()).toEqual([`${t("cross.unused.never")} | Main.st:3 | Main | spare`]));
  server.answers.clear();
  await showUnused();
  await waitFor(() => expect(screen.getByRole("alert").textContent).toBe(t("cross.unanswered")));
  expect(screen.queryByRole("table")).toBeNull();
});
