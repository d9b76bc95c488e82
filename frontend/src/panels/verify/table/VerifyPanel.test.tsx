import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { useWhatIf } from "../../../store/verify/whatif";
import { button, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { refusal } from "../../../testing/routes";
import type { FakeServer } from "../../../testing/server";
import { t } from "../../../text";
import type {
  PlcSymbol,
  VerificationInfo,
  VerifyColumn,
  VerifyDifference,
  VerifyRow,
  VerifyUse,
} from "../../../wire/types";
import { VerifyPanel } from "./VerifyPanel";

const WRONG = 501;
const column = (name: string, type: string, more: Partial<VerifyColumn>): VerifyColumn => ({
  name,
  type,
  kind: type === "BOOL" ? "bool" : "int",
  size: type === "BOOL" ? 1 : 2,
  values: [],
  input: false,
  output: false,
  ...more,
});
const COLUMNS = [column("barrier", "BOOL", { output: true }), column("position", "INT", { input: true })];

const DIFFERENCE: VerifyDifference = {
  name: "barrier",
  type: "BOOL",
  kind: "bool",
  size: 1,
  cause: "logic",
  control: "01",
  monitor: "00",
  message: "The same inputs gave a different result",
  place: null,
};

/** In each scan position is 300, so that the barrier is off; in the wrong one the control device says that it is on. */
const rowOf = (scan: number, set: string | null): VerifyRow => ({
  index: scan - 500,
  kind: "pass",
  scan,
  call: 1,
  count: 1,
  instance: "Main.belt",
  place: null,
  compared: true,
  note: "",
  used: 2,
  disturbances: [],
  differences: scan === WRONG ? [DIFFERENCE] : [],
  consequences: [],
  next: null,
  inputs: { position: { recorded: "2c01", expected: null, set: scan === WRONG ? set : null } },
  outputs: {
    barrier: {
      control: scan === WRONG ? "01" : "00",
      monitor: "00",
      set: scan === WRONG && set !== null ? "01" : null,
    },
  },
});

const INFO: VerificationInfo = {
  id: 8,
  title: "Belt",
  by: "Ada",
  state: "stopped",
  source: "live",
  memory: "recorded",
  pace: "free",
  auto: false,
  range: { pou: "Belt", file: "", first: 0, last: 0, instance: "" },
  instances: ["Main.belt"],
  first: 500,
  last: null,
  first_scan: 500,
  scan: 502,
  rows: 3,
  forgotten: 0,
  generation: 1,
  compared: 3,
  skipped: 0,
  coverage: null,
  not_run: 0,
  not_reached: 0,
  verdict: "same",
  differing: 1,
  first_difference: DIFFERENCE,
  limit: 4096,
  used: 6,
  message: "",
  stretches: [[500, 502]],
  trace: "",
};

const symbolAt = (path: string): PlcSymbol => ({
  ...{ path, name: path, type: "INT", kind: "int", size: 2, address: null, writable: true },
  ...{ section: "var", expandable: false, values: [], range: "", in_out: false },
});

const USE: VerifyUse = {
  name: "barrier",
  written: true,
  control: "TRUE",
  monitor: "FALSE",
  file: "Belt.st",
  line: 20,
  instance: "Main.belt",
};

/** A verification of three scans; what is set in the wrong one makes the reference give A, too. */
async function openVerify(begun = INFO, kind: "pass" | "none" = "pass") {
  let info = begun;
  let set: string | null = null;
  const page = await openPage((server: FakeServer) => {
    const rows = () =>
      [500, WRONG, 502].map((scan) =>
        kind === "pass" ? rowOf(scan, set) : { ...rowOf(scan, null), kind, outputs: {}, inputs: {}, differences: [] },
      );
    server.on("GET", "/instances/*/verifications", () => [info]);
    server.on("GET", "/verifications/*/rows", () => ({
      columns: COLUMNS,
      rows: rows(),
      first: 0,
      count: 3,
      differing: kind === "pass" ? [1] : [],
    }));
    server.on("PATCH", "/verifications/*", ({ body }) => {
      info = { ...info, memory: body.memory ?? info.memory, generation: info.generation + 1 };
      return info;
    });
    server.on("POST", "/verifications/*/cells", ({ body }) => {
      const [cell] = body.cells;
      if (cell?.value === "fast") return refusal("fast is not INT");
      set = "0a00";
      info = { ...info, generation: info.generation + 1 };
      return info;
    });
    server.on("GET", "/verifications/*/uses", () => [USE]);
  });
  render(<VerifyPanel />);
  await waitFor(() => expect(row(WRONG)).not.toBeNull());
  return page;
}

const table = () => screen.getByRole("grid", { name: t("verify.table") });
const row = (scan: number) => document.querySelector<HTMLElement>(`[data-scan="${scan}"]`);
const cell = (track: string) => row(WRONG)?.querySelector<HTMLElement>(`[data-cell="${track}"]`) ?? null;
const facts = () => textOf(screen.getByRole("region", { name: t("verify.facts") }));

test("the first difference is one click away, and says what differs", async () => {
  const { user } = await openVerify();
  expect(textOf(screen.getByTestId("verify:differ"))).toContain("1");
  await user.click(button(t("verify.first")));
  await waitFor(() => expect(row(WRONG)?.getAttribute("aria-selected")).toBe("true"));
  expect(row(WRONG)?.dataset.differs).toBe("true");
  expect(row(500)?.dataset.differs).toBeUndefined();
  expect(facts()).toContain(t("verify.difference", { at: 1, of: 1 }));
  expect(facts()).toContain("The same inputs gave a different result");
  expect(textOf(cell("output:barrier:A"))).toBe("TRUE");
  expect(textOf(cell("output:barrier:A'"))).toBe("FALSE");
});

test("set data: what is no value is refused in its row; with other inputs the reference gives A, too; A never changes", async () => {
  const { server, user } = await openVerify();
  await user.click(button(t("verify.first")));
  await user.click(await screen.findByRole("button", { name: t("verify.try") }));
  const entry = () => within(table()).queryByRole<HTMLInputElement>("textbox");
  await waitFor(() => expect(entry()).not.toBeNull());
  expect(document.activeElement).toBe(entry());
  await user.clear(entry() as HTMLElement);
  await user.type(entry() as HTMLElement, "fast{Enter}");
  await waitFor(() => expect(textOf(within(table()).getByRole("alert"))).toContain("not INT"));
  expect(entry()?.value).toBe("fast");

  await user.clear(entry() as HTMLElement);
  await user.type(entry() as HTMLElement, "10{Enter}");
  await waitFor(() => expect(entry()).toBeNull());
  expect(server.askedOf("POST", "/verifications/8/cells").at(-1)).toEqual({
    cells: [{ scan: WRONG, call: 1, column: "position", value: "10" }],
  });
  await waitFor(() => expect(textOf(cell("output:barrier:A'"))).toBe("TRUE"));
  expect(textOf(cell("output:barrier:A"))).toBe("TRUE");
  expect(textOf(cell("input:position"))).toBe("10");
  expect(textOf(cell("from"))).toBe(t("verify.set"));
  expect(facts()).toContain(t("verify.set.explains"));

  await user.click(screen.getByRole("radio", { name: t("verify.recorded") }));
  await waitFor(() => expect(textOf(cell("output:barrier:A'"))).toBe("FALSE"));
  expect(textOf(cell("input:position"))).toBe("300");
  expect(textOf(cell("from"))).toBe(t("verify.recorded"));
});

test("from a difference one goes to its scan, and sees every use of a variable", async () => {
  const { server, user } = await openVerify();
  await user.click(button(t("verify.first")));
  await user.click(await screen.findByRole("button", { name: t("verify.uses") }));
  await waitFor(() => expect(facts()).toContain(`20barrier${t("verify.uses.written")}`));
  await user.click(button(t("verify.goto")));
  await waitFor(() => expect(server.sentOf("travel")).toMatchObject([{ scan: WRONG }]));
});

test("what if: the result of a variable inside of a block is asked for by its whole path", async () => {
  const { server, user } = await openVerify();
  const inside = ["Main.belt.barrier", "Main.belt.position"].map(symbolAt);
  server.on("GET", "/instances/*/symbols", () => inside);
  await user.click(button(t("verify.first")));
  await user.click(await screen.findByRole("button", { name: t("whatif.show") }));
  await waitFor(() => expect(useWhatIf.getState().form.condition).toBe("Main.belt.barrier = TRUE"));
  expect(useWhatIf.getState().form.candidates).toBe("Main.belt.position");
});

test("of a controller log it says what was compared, and what was not", async () => {
  const coverage: VerificationInfo["coverage"] = {
    outputs: [
      {
        column: "MAIN.level",
        path: "Main.level",
        compared: 1190,
        differing: 2,
        allowed: 3,
        left_open: 4,
        missing: 5,
        largest: 0.0475,
      },
    ],
    inputs: ["Main.start"],
    ignored: ["remark"],
    unrecorded: ["Main.belt.run"],
    remembered: [],
    ungiven: ["Main.start"],
    assumed: ["Main.station.run = TRUE"],
    more: 7,
  };
  const { user } = await openVerify({ ...INFO, source: "trace", trace: "press4.csv", coverage });
  await user.click(button(t("verify.coverage")));
  const dialog = await screen.findByRole("dialog", { name: t("verify.coverage") });
  const said = textOf(dialog);
  for (const word of [
    "press4.csv",
    "Main.level",
    "0.0475",
    "Main.start",
    "remark",
    "Main.belt.run",
    "Main.station.run = TRUE",
  ])
    expect(said).toContain(word);
  expect(said).not.toContain(t("verify.coverage.remembered"));
  expect(said).toContain(t("verify.coverage.more", { count: "7" }));
});

test("of a range that never ran it says that nothing was compared", async () => {
  await openVerify(
    {
      ...INFO,
      state: "done",
      last: 502,
      differing: 0,
      first_difference: null,
      not_run: 3,
      not_reached: 7,
      verdict: "nothing compared",
    },
    "none",
  );
  expect(textOf(screen.getByTestId("verify:compared"))).toContain("0");
  expect(textOf(screen.getByTestId("verify:notrun"))).toContain("3");
  expect(textOf(screen.getByTestId("verify:notreached"))).toContain("7");
  expect(textOf(screen.getByRole("status"))).toContain(t("verify.state.nothing"));
  expect(button(t("verify.first")).title).toBe(t("verify.differences.nothing"));
  expect(textOf(document.body)).not.toContain(t("verify.hint.same"));
});
