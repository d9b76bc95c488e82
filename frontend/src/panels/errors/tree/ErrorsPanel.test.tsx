import { render, screen, waitFor, within } from "@testing-library/react";
import type { UserEvent } from "@testing-library/user-event";
import { expect, test } from "vitest";
import { grouped } from "../../../logic/format/numbers";
import { BASIC, BATTERY, CATALOGUE, CLEARED, MEMORY, RAISED, row, verdict } from "../../../testing/catalogue";
import { button, choose, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import type { FakeServer } from "../../../testing/server";
import { t } from "../../../text";
import type { ArmedFault, PreviewedErrors, Reaction } from "../../../wire/types";
import { ErrorsPanel } from "./ErrorsPanel";

const PREVIEW: PreviewedErrors = { ok: true, message: "", scan: 1001, more: 0, writes: [] };

async function openSimulator(prepare: (server: FakeServer) => void = () => undefined) {
  const page = await openPage((server) => {
    server.on("GET", "/instances/*/model", () => CATALOGUE);
    server.on("POST", "/instances/*/errors/preview", () => PREVIEW);
    prepare(server);
  });
  render(<ErrorsPanel />);
  await screen.findByRole("treegrid");
  page.server.say({ type: "errors", rows: [row(BATTERY), row(BASIC), row(MEMORY)] });
  return page;
}

const tree = () => screen.getByRole("treegrid", { name: t("errors.of", { model: CATALOGUE.name }) });
const tick = (name: string) => within(tree()).getByRole<HTMLInputElement>("checkbox", { name });
const line = (name: string) => tick(name).closest("[role=row]") as HTMLElement;
const details = () => screen.getByRole("region", { name: t("errors.details") });
const armed = () => screen.queryByRole("region", { name: t("armed.label") });
const generate = () => button(new RegExp(`^(${t("errors.generate")}|${t("errors.arm")})$`));
const shows = (name: string, text: string) => waitFor(() => expect(textOf(line(name))).toContain(text));

async function shape(user: UserEvent, what: "shape.when" | "shape.how", option: string): Promise<void> {
  await user.selectOptions(within(details()).getByRole("combobox", { name: t(what) }), option);
}

async function type(user: UserEvent, field: string, text: string): Promise<void> {
  const input = within(details()).getByRole("textbox", { name: field });
  await user.clear(input);
  await user.type(input, text);
}

const fault = (more: Partial<ArmedFault>): ArmedFault => ({
  id: 5,
  errors: [BATTERY.id],
  state: "running",
  text: "on for 5 of every 40 scans",
  raised: 0,
  next_scan: null,
  by: "Mika",
  ...more,
});

test("an error is found, raised and ticked by keyboard alone", async () => {
  const { server, user } = await openSimulator();
  tree().focus();
  await user.keyboard("batt");
  expect(textOf(details())).toContain(BATTERY.name);
  await user.keyboard("{Enter}");
  await waitFor(() =>
    expect(server.sentOf("generate")).toMatchObject([{ errors: [{ id: BATTERY.id }], again: false }]),
  );
  server.say({ type: "errors", rows: [row(BATTERY, RAISED)] });
  await shows(BATTERY.name, t("errors.status.generated"));

  await user.keyboard("{Home}{ArrowLeft}");
  expect(within(tree()).queryByRole("checkbox", { name: MEMORY.name })).toBeNull();
  await user.keyboard("{ArrowRight}{ArrowRight} ");
  expect(tick(MEMORY.name).checked).toBe(true);
  await user.keyboard(" ");
  expect(tick(MEMORY.name).checked).toBe(false);
});

test("for some scans: a number that is none arms nothing; armed, the next error is an ordinary one again", async () => {
  const { server, user } = await openSimulator();
  await user.click(line(BATTERY.name));
  await shape(user, "shape.how", t("shape.how.for"));
  expect(textOf(generate())).toBe(t("errors.arm"));
  await type(user, t("shape.scans"), "0");
  expect(generate()).toHaveProperty("disabled", true);
  await type(user, t("shape.scans"), "20");
  await user.click(generate());
  await waitFor(() => expect(textOf(generate())).toBe(t("errors.generate")));
  expect(server.sentOf("arm")).toMatchObject([
    { errors: [{ id: BATTERY.id }], gap: 0, start: { kind: "now" }, shape: { kind: "for", scans: 20 } },
  ]);
});

test("what comes and goes is listed with how often, by whom and when next, until it is taken back", async () => {
  const { server, user } = await openSimulator();
  expect(armed()).toBeNull();
  server.say({ type: "armed", faults: [fault({ raised: 3, next_scan: 4711 })] });
  await waitFor(() => expect(armed()).not.toBeNull());
  const facts = [
    t("armed.again", { count: 3 }),
    t("armed.next", { scan: grouped(4711) }),
    t("armed.by", { by: "Mika" }),
  ];
  for (const said of [BATTERY.name, ...facts]) expect(textOf(armed())).toContain(said);
  await shows(BATTERY.name, t("errors.armed"));
  await user.click(button(t("armed.takeback.of", { errors: BATTERY.name })));
  await waitFor(() => expect(server.sentOf("disarm")).toMatchObject([{ ids: [5] }]));
  server.say({ type: "armed", faults: [] });
  await waitFor(() => expect(armed()).toBeNull());
});

test("while one chatters, it is said what another one would write", async () => {
  const flag = { address: "A402.12", before: "0", after: "1", what: "flag", error: BASIC.id } as const;
  const { server, user } = await openSimulator((server) =>
    server.on("POST", "/instances/*/errors/preview", () => ({ ...PREVIEW, writes: [flag] })),
  );
  server.say({ type: "armed", faults: [fault({ text: "chatters" })] });
  await user.click(line(BASIC.name));
  const preview = await within(details()).findByRole("region", { name: t("preview.title") });
  await waitFor(() => expect(textOf(preview)).toContain("A402.12"));
  for (const status of [RAISED, CLEARED, RAISED]) server.say({ type: "errors", rows: [row(BATTERY, status)] });
  await waitFor(() =>
    expect(server.askedOf("POST", `/instances/${server.instance.id}/errors/preview`).length).toBeGreaterThan(1),
  );
  expect(textOf(preview)).toContain("0 → 1");
});

test("a scan that goes by while one thinks is over, without a key being pressed", async () => {
  const { server, user } = await openSimulator();
  await user.click(line(BATTERY.name));
  await shape(user, "shape.when", t("shape.when.scan"));
  await type(user, t("shape.scan"), "1200");
  expect(textOf(details())).not.toContain(t("shape.bad.past"));
  server.runsTo(1201);
  await waitFor(() => expect(textOf(details())).toContain(t("shape.bad.past")));
  expect(generate()).toHaveProperty("disabled", true);
});

test("a condition with an unknown name is refused below the row, corrected with one click, and waits", async () => {
  const { server, user } = await openSimulator();
  server.command("arm", ({ start }) =>
    start.condition === "strat" ? { message: "condition: strat is not known", near: ["start"] } : undefined,
  );
  await user.click(line(BATTERY.name));
  await shape(user, "shape.when", t("shape.when.condition"));
  await user.type(within(details()).getByRole("combobox", { name: t("shape.condition") }), "strat");
  await user.click(generate());
  const alert = await within(tree()).findByRole("alert");
  expect(textOf(alert)).toContain("strat is not known");
  expect(line(BATTERY.name).nextElementSibling?.contains(alert)).toBe(true);
  await user.click(within(alert).getByRole("button", { name: "start" }));
  await user.click(generate());
  await waitFor(() => expect(within(tree()).queryByRole("alert")).toBeNull());
  expect(server.sentOf("arm").map(({ start }) => start.condition)).toEqual(["strat", "start"]);
  server.say({ type: "armed", faults: [fault({ state: "waiting", text: "when start" })] });
  await waitFor(() => expect(textOf(armed())).toContain(t("armed.waiting")));
});

const REACTED: Reaction = {
  verdict: "acted",
  basis: "exact",
  carried: [],
  decided_by: [],
  displayed: [],
  unreached: [],
  window: 100,
  first_read: 1234,
  first_effect: 1,
  note: "",
  readers: [{ file: "ErrorHandler.st", line: 12, pou: "ErrorHandler", scan: 1234, what: "flag" }],
  lines: [{ file: "ErrorHandler.st", line: 14 }],
  differences: [{ path: "lamp", without: "FALSE", value: "TRUE", output: true, scan: 1234 }],
  difference_count: 1,
};

test("an error that only a sweep raised says so, beside the count of those that were tested", async () => {
  const { server } = await openSimulator();
  server.say({ type: "errors", rows: [row(BASIC, { swept: verdict("acted", 1) })] });
  await shows(BASIC.name, t("verdict.acted"));
  expect(textOf(line("Units"))).toContain(t("errors.tested", { tested: 1, total: 1 }));
  expect(textOf(line(BASIC.name))).toContain(t("errors.status.swept"));
  expect(textOf(line(BASIC.name))).not.toContain(t("errors.status.never"));
});

test("the reaction is shown in the tree and in words; its readers are links; a finding says what to do next", async () => {
  const { server, user, places } = await openSimulator((server) => {
    const unread: Reaction = {
      ...REACTED,
      verdict: "never_read",
      readers: [],
      lines: [],
      differences: [],
      difference_count: 0,
    };
    server.on("GET", "/instances/*/errors/*/reaction", (_, [, , error]) => (error === BASIC.id ? REACTED : unread));
  });
  const rows = [row(BASIC, { ...RAISED, reaction: verdict("acted", 1) })];
  server.say({ type: "errors", rows: [...rows, row(BATTERY, { ...RAISED, reaction: verdict("never_read") })] });
  await shows(BASIC.name, t("verdict.acted"));
  expect(textOf(line("Units"))).toContain(t("errors.tested", { tested: 1, total: 1 }));

  await user.click(line(BASIC.name));
  const reaction = within(details()).getByRole("region", { name: t("reaction.label") });
  await waitFor(() => expect(textOf(reaction)).toContain(t("reaction.says.reacted.one")));
  expect(textOf(within(reaction).getByRole("table", { name: t("reaction.differences") }))).toContain("lamp");
  const readers = within(reaction).getByRole("group", { name: t("reaction.readers") });
  await user.click(within(readers).getByRole("button", { name: "ErrorHandler.st:12" }));
  expect(places).toEqual(["file ErrorHandler.st"]);

  await user.click(line(BATTERY.name));
  await waitFor(() =>
    expect(textOf(details())).toContain(t("reaction.says.never_read", { flag: BATTERY.flag, window: 100 })),
  );
  expect(textOf(details())).toContain(t("reaction.next.never_read", { flag: BATTERY.flag }));
  await choose(user, t("errors.filters", { filter: t("errors.status.all") }), t("errors.reaction.findings"));
  expect(within(tree()).queryByRole("checkbox", { name: BASIC.name })).toBeNull();
  expect(textOf(line(BATTERY.name))).toContain(t("verdict.never_read"));
});
