import { render, screen, waitFor } from "@testing-library/react";
import { beforeEach, expect, onTestFinished, test, vi } from "vitest";
import { showCalls } from "../../../store/project/calls";
import { useDocuments } from "../../../store/project/documents";
import { openPage } from "../../../testing/page";
import { t } from "../../../text";
import { LspClient } from "../../../wire/lsp";
import { CallsPage } from "./CallsPage";

const range = (line: number) => ({ start: { line: line - 1, character: 2 }, end: { line: line - 1, character: 7 } });
const party = (name: string, kind: number, file = `${name}.st`) => ({
  name,
  kind,
  uri: `scanbench:/${file}`,
  range: range(1),
  selectionRange: range(1),
  data: ["pou", "", name.toUpperCase()],
});
const MAIN = party("Main", 2);
const BELT = party("Belt", 5);
const STEP = party("Step", 12);
const CALLS: Record<string, [ReturnType<typeof party>, number[]][]> = {
  Main: [[BELT, [14, 20]]],
  Belt: [[STEP, [8]]],
  Step: [[BELT, [3]]],
};

let asked: string[] = [];
let calls = CALLS;

/** The language server, which the fake server does not have. */
beforeEach(() => {
  asked = [];
  calls = CALLS;
  const server = vi.spyOn(LspClient.prototype, "request").mockImplementation(async (method, params) => {
    const { item } = params as { item?: typeof MAIN };
    asked.push(`${method.split("/")[1]} ${item?.name ?? ""}`);
    if (method === "textDocument/prepareCallHierarchy") return [MAIN] as never;
    const all = Object.entries(calls).flatMap(([from, called]) => called.map(([to, lines]) => ({ from, to, lines })));
    if (method === "callHierarchy/outgoingCalls")
      return all
        .filter(({ from }) => from === item?.name)
        .map(({ to, lines }) => ({ to, fromRanges: lines.map(range) })) as never;
    return all
      .filter(({ to }) => to.name === item?.name)
      .map(({ from, lines }) => ({ from: party(from, 2), fromRanges: lines.map(range) })) as never;
  });
  onTestFinished(() => server.mockRestore());
});

const rows = () => screen.getAllByRole("treeitem").map((row) => `${row.ariaLevel} ${row.textContent}`);
const row = (name: string) => screen.getAllByRole("treeitem", { name }).at(-1) as HTMLElement;

test("calls unfold level by level, end where they come back, lead to the call, and follow the texts", async () => {
  const { places, user } = await openPage();
  await showCalls({ file: "Main.st", line: 1, column: 10 });
  render(<CallsPage />);
  await waitFor(() => expect(rows()).toEqual(["1 Main", "2 BeltMain.st:14, 20"]));
  row("Belt").focus();
  await user.keyboard("{ArrowRight}");
  await waitFor(() => expect(rows().at(-1)).toBe("3 StepBelt.st:8"));
  row("Step").focus();
  await user.keyboard("{ArrowRight}");
  await waitFor(() => expect(rows().at(-1)).toBe(`4 Belt${t("calls.again")} Step.st:3`));
  expect(row("Belt").ariaExpanded).toBeNull();
  await user.click(row("Step"));
  expect(places.at(-1)).toBe("file Belt.st");

  calls = { Main: [[STEP, [14]]] };
  useDocuments.setState({ problems: [] });
  await waitFor(() => expect(rows()).toEqual(["1 Main", "2 StepMain.st:14"]));
});

test("the other way round it shows who calls, and says where nobody does", async () => {
  const { user } = await openPage();
  await showCalls({ file: "Main.st", line: 1, column: 10 });
  render(<CallsPage />);
  await user.click(await screen.findByRole("radio", { name: t("calls.callers") }));
  await screen.findByText(t("calls.none.callers", { name: "Main" }));
  calls = { Station: [[MAIN, [5]]] };
  useDocuments.setState({ problems: [] });
  await waitFor(() => expect(rows()).toEqual(["1 Main", "2 StationStation.st:5"]));
  expect(asked).toContain("incomingCalls Main");
});
