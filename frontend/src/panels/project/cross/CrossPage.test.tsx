import { render, screen, waitFor, within } from "@testing-library/react";
import { beforeEach, expect, onTestFinished, test, vi } from "vitest";
import { showCrossReferences, showCrossReferencesOf, showUnused } from "../../../store/project/cross";
import { edit, openDocument, useDocuments } from "../../../store/project/documents";
import { openPage } from "../../../testing/page";
import { symbol } from "../../../testing/samples";
import { t } from "../../../text";
import { LspClient } from "../../../wire/lsp";
import type { Coverage } from "../../../wire/types";
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

const MAIN = `${"\n".repeat(8)}level := level + 1;\nEND_PROGRAM\n`;
const covered = (reached: boolean): Coverage => ({
  type: "coverage",
  on: true,
  since_scan: 1,
  scans: 5,
  files: [
    {
      file: "Main.st",
      sites: [{ line: 9, column: 1, end_line: 9, end_column: 20, pou: "Main", reached, outcomes: [] }],
    },
  ],
});

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

test("the value lives; with coverage on each line says whether it ran, an edited one that it is not built", async () => {
  const { server: plc, user } = await openPage((server) => {
    const file = { path: "Main.st", version: 1, author: "Mika" };
    server.on("GET", "/projects/*/files", () => [file]);
    server.on("GET", "/projects/*/files/**", () => ({ ...file, text: MAIN, saved_at: 0 }));
  });
  await openDocument("Main.st");
  plc.has(symbol("level", "INT"), 7);
  server.answers.set("crossReferences", LEVEL);
  await showCrossReferences({ file: "Main.st", line: 9, column: 4 }, "level");
  render(<CrossPage />);
  await waitFor(() => expect(screen.getByTestId("value:level").textContent).toBe("7"));
  plc.set("level", 8);
  await waitFor(() => expect(screen.getByTestId("value:level").textContent).toBe("8"));

  await user.click(screen.getByRole("button", { name: t("coverage.label") }));
  expect(plc.sentOf("set_coverage").at(-1)).toMatchObject({ on: true });
  plc.say(covered(false));
  const ran = () => rows().map((row) => row.split(" | ")[3]);
  await waitFor(() => expect(ran()).toEqual(["", t("coverage.none"), t("coverage.none")]));
  plc.say(covered(true));
  await waitFor(() => expect(ran()).toEqual(["", t("coverage.full"), t("coverage.full")]));
  edit("Main.st", MAIN.replace("+ 1", "+ 2"));
  await waitFor(() => expect(ran()).toEqual(["", t("cross.ran.edited"), t("cross.ran.edited")]));
});
