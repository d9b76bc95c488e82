import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { unused } from "../../../logic/verify/traceImport";
import { openTraceImport } from "../../../store/verify/traceImport";
import { box, button, choose, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { refusal } from "../../../testing/routes";
import { symbol } from "../../../testing/samples";
import type { FakeServer } from "../../../testing/server";
import { t } from "../../../text";
import type { SavedMapping, TraceMapping, TraceProblem, UploadedTrace } from "../../../wire/types";
import { TraceImport } from "./TraceImport";

const problem = (message: string, column = "", row: number | null = null): TraceProblem => ({
  message,
  column,
  row,
  warning: false,
  more: 0,
  last: null,
  near: [],
});

const MAPPING: TraceMapping = {
  axis: "scan",
  unit: "scan",
  gaps: "refuse",
  columns: [
    { ...unused("start"), path: "start", role: "input" },
    { ...unused("sped"), role: "output" },
  ],
  sampled: "end",
};

const TRACE: UploadedTrace = {
  file: "f1",
  name: "line.csv",
  rows: 20,
  columns: ["scan", "start", "sped"],
  sample: [["0", "FALSE", "1"]],
  mapping: MAPPING,
  problems: [],
  guesses: [{ column: "start", score: 0.84, near: ["start", "Main.start"] }],
  layout: "TwinCAT Scope",
  left_out: ["`Trigger` is no variable of the program."],
};

/** A server that wants a variable for each column that is used. */
async function openImport(prepare: (server: FakeServer) => void = () => undefined) {
  const saved: SavedMapping[] = [];
  const page = await openPage((server) => {
    server.on("POST", "/projects/*/traces", () => TRACE);
    server.on("GET", "/projects/*/trace-mappings", () => saved);
    server.on("POST", "/projects/*/trace-mappings", ({ body }) => {
      const mapping = { ...body, id: 1, by: "Mika" };
      saved.push(mapping);
      return mapping;
    });
    server.on("POST", "/instances/*/trace-check", ({ body }) => {
      const { mapping } = body;
      const wrong = (mapping.columns ?? []).filter(({ path, role }) => role !== "ignore" && !path);
      const problems = wrong.map(({ column }) => problem("names no variable", column, 1));
      return { ok: wrong.length === 0, problems, first: 0, last: 19, missing: 0 };
    });
    prepare(server);
  });
  render(<TraceImport />);
  openTraceImport();
  await screen.findByRole("dialog", { name: t("import.trace.title") });
  const upload = (name: string) =>
    page.user.upload(screen.getByLabelText(t("import.trace.file")), new File(["x"], name));
  return { ...page, upload };
}

const start = () => button(t("import.trace.start"));
const verdict = () => textOf(screen.getAllByRole("status").at(-1) ?? null);
const role = (column: string) =>
  screen.getByRole<HTMLSelectElement>("combobox", { name: t("import.trace.role.of", { column }) });
const variable = (column: string) =>
  screen.getByRole<HTMLInputElement>("combobox", { name: t("import.trace.variable.of", { column }) });

test("a broken file is refused with its row, and nothing of it is there", async () => {
  const { upload } = await openImport((server) =>
    server.on("POST", "/projects/*/traces", () => ({
      ...TRACE,
      file: "",
      problems: [problem("has too many cells", "", 3)],
    })),
  );
  expect(start()).toHaveProperty("disabled", true);
  await upload("broken.csv");
  const alert = await screen.findByRole("alert");
  expect(textOf(alert)).toContain(t("import.trace.refused", { name: "broken.csv" }));
  expect(textOf(alert)).toContain(t("import.trace.problem.row", { row: 3 }));
  expect(screen.queryByRole("table", { name: t("import.trace.columns") })).toBeNull();
  expect(start()).toHaveProperty("disabled", true);
});

test("a controller that runs takes the place of a file; what is wrong with it is told", async () => {
  const { server, user } = await openImport((server) =>
    server.on("POST", "/projects/*/controllers", () => refusal("nothing listens there")),
  );
  await user.click(screen.getByText(t("import.controller")));
  const connect = button(t("import.controller.connect"));
  expect(connect).toHaveProperty("disabled", true);
  await user.type(screen.getByLabelText(t("import.controller.address")), "press4:4840");
  await user.type(screen.getByLabelText(t("import.controller.nodes")), "ns=4;s=Main.level{enter}ns=4;i=12");
  await user.click(connect);
  await waitFor(() => expect(textOf(screen.getByRole("dialog"))).toContain("nothing listens there"));
  const asked = server.asked.filter(({ path }) => path.endsWith("/controllers"));
  expect(asked[0]?.body).toMatchObject({
    address: "opc.tcp://press4:4840",
    interval_ms: 100,
    nodes: ["ns=4;s=Main.level", "ns=4;i=12"],
  });
});

test("what is wrong is told with row and column; corrected by hand and by offers, the mapping can be verified", async () => {
  const { server, user, upload } = await openImport((server) =>
    server.on("GET", "/instances/*/complete", () => [symbol("Main.belt.position", "INT")]),
  );
  await upload("line.csv");
  await waitFor(() => expect(verdict()).toContain(t("import.trace.check.bad.one")));
  const problems = textOf(screen.getByRole("list", { name: t("import.trace.problems") }));
  expect(problems).toContain(t("import.trace.problem.column", { column: "sped" }));
  expect(problems).toContain(t("import.trace.problem.row", { row: 1 }));
  expect(textOf(screen.getByRole("table"))).toContain(t("import.trace.proposed"));
  expect(start()).toHaveProperty("disabled", true);

  await user.type(variable("sped"), "Main.belt.pos");
  await user.click(await screen.findByRole("option", { name: /Main\.belt\.position/ }));
  expect(variable("sped").value).toBe("Main.belt.position");
  await waitFor(() => expect(verdict()).toContain(t("import.trace.check.ok", { first: 0, last: 19 })));
  await user.selectOptions(role("sped"), t("import.trace.role.ignore"));
  await waitFor(() => expect(start()).toHaveProperty("disabled", false));

  // The corrected file keeps what was mapped by hand; put away and opened again it is as it was left.
  await upload("line.csv");
  await waitFor(() => expect(server.asked.filter(({ path }) => path.includes("/traces?"))).toHaveLength(2));
  await user.click(button(t("cancel")));
  await waitFor(() => expect(screen.queryByRole("dialog")).toBeNull());
  openTraceImport();
  await screen.findByRole("dialog");
  expect(role("sped").value).toBe("ignore");
  expect(variable("sped").value).toBe("Main.belt.position");
});

test("a variable that may be meant is taken by a click", async () => {
  const { server, user, upload } = await openImport();
  server.on("POST", "/instances/*/trace-check", ({ body }) => {
    const known = body.mapping.columns?.find(({ column }) => column === "sped")?.path === "Main.speed";
    const problems = known ? [] : [{ ...problem("Nothing is called `sped`.", "sped", 1), near: ["Main.speed"] }];
    return { ok: known, problems, first: 0, last: 19, missing: 0 };
  });
  await upload("line.csv");
  await user.click(await screen.findByRole("button", { name: t("import.trace.take", { path: "Main.speed" }) }));
  expect(variable("sped").value).toBe("Main.speed");
  await waitFor(() => expect(start()).toHaveProperty("disabled", false));
});

test("a mapping is saved under a name, and fits again", async () => {
  const { user, upload } = await openImport();
  await upload("line.csv");
  await waitFor(() => expect(variable("start").value).toBe("start"));
  await user.type(variable("sped"), "speed");
  await user.click(button(t("import.trace.save")));
  const asking = await screen.findByRole("dialog", { name: t("import.trace.save") });
  await user.type(box(t("import.trace.save.name"), asking), "Line 1");
  await user.click(button(t("import.trace.save.do"), asking));
  await waitFor(() => expect(verdict()).toContain(t("import.trace.saved", { name: "Line 1" })));
  await user.clear(variable("sped"));
  await user.type(variable("sped"), "lamp");
  await choose(user, t("import.trace.load"), "Line 1");
  await waitFor(() => expect(variable("sped").value).toBe("speed"));
});

test("what the server refuses to begin stays in the dialog", async () => {
  const { server, user, upload } = await openImport((server) =>
    server.on("POST", "/instances/*/trace-verifications", () => {
      throw new TypeError("the connection broke");
    }),
  );
  await upload("line.csv");
  await user.type(variable("sped"), "speed");
  await waitFor(() => expect(start()).toHaveProperty("disabled", false));
  await user.click(start());
  await waitFor(() =>
    expect(textOf(within(screen.getByRole("dialog")).getByRole("alert"))).toContain(t("lost.change")),
  );
  expect(server.askedOf("POST", `/instances/${server.instance.id}/trace-verifications`)).toMatchObject([
    { file: "f1" },
  ]);
  expect(screen.getByRole("dialog")).not.toBeNull();
});

test("the file says whose it is and how sure a variable is; an output gets a tolerance", async () => {
  const { server, user, upload } = await openImport();
  await upload("line.csv");
  await screen.findByText("TwinCAT Scope");
  expect(textOf(screen.getByRole("table"))).toContain(`${t("import.trace.proposed")} 84 %`);
  await user.type(variable("sped"), "speed");
  await user.click(button(t("import.trace.tolerance.of", { column: "sped" })));
  const dialog = await screen.findByRole("dialog", { name: t("import.trace.tolerance.of", { column: "sped" }) });
  const percent = box(t("import.trace.tolerance.relative"), dialog);
  await user.type(percent, "200");
  expect(textOf(dialog)).toContain(t("import.trace.tolerance.bad.percent"));
  await user.clear(percent);
  await user.type(percent, "1");
  await user.type(box(t("import.trace.tolerance.late"), dialog), "20");
  await user.click(button(t("import.trace.tolerance.do"), dialog));
  await waitFor(() => expect(textOf(screen.getByRole("table"))).toContain("1 %, 20 ms"));
  await waitFor(() => expect(start()).toHaveProperty("disabled", false));
  const sent = server.askedOf("POST", `/instances/${server.instance.id}/trace-check`).at(-1);
  expect(sent).toMatchObject({ mapping: { columns: [{}, { column: "sped", relative: 0.01, late_ms: 20 }] } });
});
