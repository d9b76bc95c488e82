import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { useDebug } from "../../../store/debug/debug";
import { useStack } from "../../../store/debug/stack";
import { box, button, choose, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { JO, MIKA } from "../../../testing/samples";
import type { FakeServer } from "../../../testing/server";
import { t } from "../../../text";
import type { BreakpointInfo, HaltInfo } from "../../../wire/types";
import { TopBar } from "../../run/topbar/TopBar";
import { ConsolePanel } from "../console/ConsolePanel";
import { DebugSide } from "./DebugSide";

async function openDebug(prepare: (server: FakeServer) => void = () => undefined) {
  const page = await openPage(prepare);
  render(<DebugSide />);
  return page;
}

const AT: HaltInfo = {
  number: 1,
  reason: "breakpoint",
  by: "Mika",
  text: "",
  file: "Main.st",
  line: 7,
  column: 1,
  end_line: 7,
  end_column: 9,
  pou: "Counter",
  instance: "Main.a[3]",
  task: "Cyclic",
  count: 12,
  past: false,
};

const BREAKPOINT: BreakpointInfo = {
  id: 4,
  kind: "line",
  group: "",
  author: "Jo",
  enabled: true,
  verified: true,
  message: "",
  file: "Main.st",
  line: 7,
  at_line: 7,
  column: 0,
  at_column: 1,
  condition: "",
  hits: "",
  log: "",
  assign: "",
  instance: "",
  task: "",
  path: "",
  access: "change",
  error: "",
  scan: 0,
  reached: 3,
};

/** The program is halted in an instance of a block that it called. */
function halted(server: FakeServer) {
  const source = { name: "Main.st", path: "Main.st" };
  const frame = (id: number, name: string, line: number) => ({ id, name, line, column: 1, source });
  server.debug("stackTrace", () => ({ stackFrames: [frame(1, "Counter", 7), frame(2, "Main", 20)] }));
  server.debug("scopes", ({ frameId }) => ({
    scopes: [{ name: "VAR", variablesReference: Number(frameId) * 10, namedVariables: 1, expensive: false }],
  }));
  let count = "30";
  server.debug("variables", ({ variablesReference }) => ({
    variables: [
      variablesReference === 10
        ? { name: "count", evaluateName: "count", value: count, type: "INT", variablesReference: 0 }
        : { name: "i", evaluateName: "i", value: "3", type: "INT", variablesReference: 0 },
    ],
  }));
  server.debug("setExpression", ({ value }) => {
    if (value === "70000") throw new Error("70000 is outside of INT");
    count = String(value);
    return { value: count };
  });
}

const halt = (server: FakeServer, more: Partial<HaltInfo> = {}) => {
  server.becomes({ state: "halted", halt: { ...AT, ...more } });
  server.debugEvent("stopped", { reason: "breakpoint", threadId: 1, allThreadsStopped: true });
};
const section = (title: string) => screen.getByRole("region", { name: title });
const variable = (name: string) => textOf(screen.queryByTestId(`variable:${name}`));

test("what was still being read when the PLC halted again is not asked of the later halt", async () => {
  let now = 1;
  const asked: number[] = [];
  const { server } = await openDebug((server) => {
    halted(server);
    const scope = (name: string, variablesReference: number) => ({
      name,
      variablesReference,
      namedVariables: 1,
      expensive: false,
    });
    server.debug("scopes", () => ({ scopes: [scope("VAR_INPUT", 10 * now), scope("VAR", 10 * now + 1)] }));
    server.debug("variables", ({ variablesReference }) => {
      const reference = Number(variablesReference);
      asked.push(reference);
      if (Math.floor(reference / 10) !== now) throw new Error(`variables ${reference} are of an earlier halt`);
      if (now === 1) {
        now = 2;
        halt(server, { number: 2 });
      }
      return { variables: [{ name: `v${reference}`, value: "1", type: "INT", variablesReference: 0 }] };
    });
  });
  halt(server);
  await waitFor(() => expect(variable("v21")).toBe("1"));
  expect(asked).toEqual([10, 20, 21]);
  expect(useDebug.getState().refused).toBeNull();
});

test("the frames are listed, the caller shows its own variables; a value that is refused says so in its row", async () => {
  const { server, user } = await openDebug(halted);
  halt(server);
  await waitFor(() => expect(variable("count")).toBe("30"));
  const frames = within(screen.getByRole("tree", { name: t("debug.stack") })).getAllByRole("treeitem");
  expect(frames.map(textOf)).toEqual([expect.stringContaining("Counter"), expect.stringContaining("Main")]);
  await user.click(frames[1] as HTMLElement);
  await waitFor(() => expect(variable("i")).toBe("3"));
  await user.click(frames[0] as HTMLElement);
  await waitFor(() => expect(variable("count")).toBe("30"));

  await user.click(screen.getByTestId("variable:count"));
  const entry = () => box(t("debug.set.of", { name: "count" }));
  await user.clear(entry());
  await user.type(entry(), "70000{Enter}");
  await waitFor(() =>
    expect(textOf(within(section(t("debug.variables"))).getByRole("alert"))).toContain("outside of INT"),
  );
  await user.clear(entry());
  await user.type(entry(), "500{Enter}");
  await waitFor(() => expect(variable("count")).toBe("500"));
});

test("the row with the focus keeps it when the stack is read again, with new ids", async () => {
  let ids = 0;
  const { server } = await openDebug((server) => {
    halted(server);
    const frame = (name: string, line: number) => ({ id: ++ids, name, line, column: 1 });
    server.debug("stackTrace", () => ({ stackFrames: [frame("Counter", 7), frame("Main", 20)] }));
  });
  const rows = () => within(screen.getByRole("tree", { name: t("debug.stack") })).getAllByRole("treeitem");
  halt(server);
  await waitFor(() => expect(rows()).toHaveLength(2));
  rows()[1]?.focus();
  halt(server);
  await waitFor(() => expect(ids).toBe(4));
  await waitFor(() => expect(useStack.getState().frame).toBe(3));
  expect(document.activeElement).toBe(rows()[1]);
});

test("two people: who made it halt is said, the way there is one click; whose breakpoint it is, too", async () => {
  const { server, user, places } = await openDebug((server) => {
    halted(server);
    server.greeting = { users: [MIKA, JO], breakpoints: [BREAKPOINT] };
  });
  halt(server, { by: "Jo" });
  await waitFor(() => expect(textOf(section(t("debug.stack")))).toContain(t("debug.by", { by: "Jo" })));
  expect(places).toEqual([]); // nobody's text is taken away
  await user.click(within(section(t("debug.stack"))).getByRole("button", { name: /Main\.st/ }));
  expect(places).toEqual(["file Main.st"]);
  expect(textOf(section(t("debug.breakpoints")))).toContain("Jo");

  await user.click(button(t("debug.bp.removeall")));
  await waitFor(() => expect(server.debugged("scanbench/removeBreakpoints")).toEqual([{}]));
  server.say({ type: "breakpoints", breakpoints: [] });
  server.becomes({ state: "running", halt: null });
  await waitFor(() => expect(screen.queryByRole("region", { name: t("debug.stack") })).toBeNull());
  expect(textOf(section(t("debug.breakpoints")))).toContain(t("debug.bp.none"));
});

test("a breakpoint at a variable that there is not is refused where it is typed, and is not kept", async () => {
  const { server, user } = await openDebug((server) =>
    server.debug("scanbench/setBreakpoint", ({ breakpoint }) => {
      const known = JSON.stringify(breakpoint).includes("Main.a[2].count");
      return { breakpoint: { id: 9, verified: known, message: known ? undefined : "Main.nope is not known" } };
    }),
  );
  await choose(user, t("debug.bp.new"), t("debug.new.data"));
  const dialog = await screen.findByRole("dialog", { name: t("debug.new.data") });
  await user.click(button(t("debug.form.set"), dialog));
  expect(textOf(within(dialog).getByRole("alert"))).toContain(t("debug.edit.nopath"));
  await user.type(box(t("debug.edit.path"), dialog), "Main.nope");
  await user.click(button(t("debug.form.set"), dialog));
  await waitFor(() => expect(textOf(within(dialog).getByRole("alert"))).toContain("Main.nope is not known"));
  expect(server.debugged("scanbench/removeBreakpoints")).toEqual([{ ids: [9] }]);
  await user.clear(box(t("debug.edit.path"), dialog));
  await user.type(box(t("debug.edit.path"), dialog), "Main.a[[2].count");
  await user.type(box(t("debug.form.condition"), dialog), "Main.n > 3");
  await user.click(button(t("debug.form.set"), dialog));
  await waitFor(() => expect(screen.queryByRole("dialog")).toBeNull());
  expect(server.debugged("scanbench/setBreakpoint").at(-1)).toMatchObject({
    breakpoint: { kind: "data", path: "Main.a[2].count", condition: "Main.n > 3" },
  });
});

test("the console evaluates, says what it cannot, and shows what logpoints say", async () => {
  const { server, user } = await openPage((server) =>
    server.debug("evaluate", ({ expression }) => {
      if (expression === "Main.nothing") throw new Error("nothing is not known");
      return { result: "47", type: "INT", variablesReference: 0 };
    }),
  );
  render(<ConsolePanel />);
  const entry = screen.getByRole<HTMLInputElement>("combobox", { name: t("console.entry") });
  await user.type(entry, "Main.n + 40{Enter}");
  await waitFor(() => expect(textOf(screen.getByRole("log"))).toContain("47"));
  await user.type(entry, "Main.nothing{Enter}");
  await waitFor(() => expect(textOf(screen.getByRole("log"))).toContain("nothing is not known"));
  server.debugEvent("output", { output: "n is 12\n", source: { path: "Main.st" }, line: 21 });
  await waitFor(() => expect(textOf(screen.getByRole("log"))).toContain("n is 12"));
  await user.type(entry, "{ArrowUp}");
  expect(entry.value).toBe("Main.nothing");
  await user.click(button(t("console.clear")));
  await screen.findByText(t("console.none"));
});

test("the console completes the word at the caret: Enter takes what an arrow chose, and evaluates where nothing is chosen", async () => {
  const { server, user } = await openPage((server) => {
    server.debug("evaluate", () => ({ result: "47", type: "INT", variablesReference: 0 }));
    server.debug("completions", ({ text }) => ({
      targets: text === "Main.be" ? [{ label: "belt", type: "variable", detail: "Belt", start: 5, length: 2 }] : [],
    }));
  });
  render(<ConsolePanel />);
  const entry = screen.getByRole<HTMLInputElement>("combobox", { name: t("console.entry") });
  await user.type(entry, "2 + Main.be");
  const list = await screen.findByRole("listbox", { name: t("console.offers") });
  expect(textOf(list)).toContain("Main.belt");
  await user.keyboard("{ArrowDown}{Enter}");
  expect(entry.value).toBe("2 + Main.belt");
  expect(server.debugged("evaluate")).toEqual([]);
  await user.keyboard("{Enter}");
  await waitFor(() => expect(server.debugged("evaluate")).toMatchObject([{ expression: "2 + Main.belt" }]));
  expect(entry.value).toBe("");
});

test("after a run-time error the way back stays open: a step back, and no step on", async () => {
  const { server, user } = await openPage();
  render(<TopBar onResetLayout={() => undefined} />);
  server.becomes({ state: "trapped" });
  await user.click(await screen.findByRole("button", { name: t("debug.back") }));
  await waitFor(() => expect(server.debugged("stepBack")).toEqual([{ threadId: 1 }]));
  expect(button(t("debug.over"))).toHaveProperty("disabled", true);
});
