import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { showChanges } from "../../../store/past/changes";
import { compareWithOther } from "../../../store/past/comparisons";
import { showRerun } from "../../../store/past/reruns";
import { showWriter } from "../../../store/past/writer";
import { BASIC, CATALOGUE } from "../../../testing/catalogue";
import { box, button, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { refusal } from "../../../testing/routes";
import type { FakeServer } from "../../../testing/server";
import { t } from "../../../text";
import type { Comparison, LastWriter, Rerun, RunChanges, VariableChange } from "../../../wire/types";
import { Banners } from "../banner/Banners";
import { ComparePage } from "./ComparePage";
import { Past } from "./Past";

async function openPast(prepare: (server: FakeServer) => void) {
  const page = await openPage((server) => {
    server.on("GET", "/instances/*/model", () => CATALOGUE);
    prepare(server);
  });
  render(
    <>
      <Banners />
      <Past />
    </>,
  );
  return page;
}

const dialog = (title: string) => screen.findByRole("dialog", { name: title });

const written = (more: Partial<LastWriter>): LastWriter => ({
  path: "start",
  by: "command",
  author: "Ann",
  scan: 300,
  count: 0,
  value: "",
  shown: "TRUE",
  text: "start := TRUE",
  place: null,
  ...more,
});

test("who last wrote it: a person; before that a statement, which leads there with the statement in sight", async () => {
  const place = {
    file: "PartCounter.st",
    line: 12,
    text: "total := total + 1;",
    instance: "Main.parts",
    task: "Cyclic",
  };
  const { server, user, places } = await openPast((server) =>
    server.on("GET", "/instances/*/last-write", ({ path }) =>
      path.includes("scan=300")
        ? written({
            by: "program",
            author: "",
            scan: 250,
            count: 17,
            shown: "7",
            place: { ...place, pou: "PartCounter" },
          })
        : written({}),
    ),
  );
  showWriter("start");
  const shown = await dialog(t("writer.title", { path: "start" }));
  await waitFor(() => expect(textOf(shown)).toContain(t("writer.by.command")));
  for (const said of ["Ann", "TRUE"]) expect(textOf(shown)).toContain(said);
  await user.click(button(t("writer.again"), shown));
  await waitFor(() => expect(textOf(shown)).toContain(t("writer.by.program")));
  for (const said of ["PartCounter.st:12", "Main.parts", place.text]) expect(textOf(shown)).toContain(said);
  await user.click(button(t("writer.goto"), shown));
  await waitFor(() => expect(server.sentOf("travel")).toMatchObject([{ scan: 250, count: 17 }]));
  expect(places).toEqual(["file PartCounter.st"]);
  expect(screen.queryByRole("dialog")).toBeNull();
});

const changed = (path: string, before: string, after: string): VariableChange => ({
  path,
  type: "BOOL",
  kind: "bool",
  size: 1,
  values: [],
  before: "",
  after: "",
  before_shown: before,
  after_shown: after,
});
const CHANGES: RunChanges = {
  first: 300,
  last: 401,
  note: "",
  changes: [changed("motor", "FALSE", "TRUE"), changed("Main.parts.total", "0", "3")],
  count: 9,
  at_least: true,
  entries: [{ scan: 301, author: "Ann", run: "", text: "start := TRUE" }],
};

test("what changed in a stretch: the variables, filtered, and who entered what; a scan of it is a way there", async () => {
  const { server, user } = await openPast((server) => server.on("GET", "/instances/*/changes", () => CHANGES));
  showChanges(401, 300);
  const shown = await dialog(t("changes.title", { first: 300, last: 401 }));
  const table = await within(shown).findByRole("table", { name: t("changes.list") });
  await waitFor(() => expect(textOf(table)).toContain("motor"));
  const counted = textOf(within(shown).getByRole("status"));
  expect(counted).toContain(t("changes.count.least", { count: 9 }));
  expect(counted).toContain(t("changes.leftout.least", { count: 7 }));
  const entered = within(shown).getByRole("region", { name: t("changes.entered") });
  for (const said of ["start := TRUE", "Ann"]) expect(textOf(entered).toLowerCase()).toContain(said.toLowerCase());
  await user.type(within(shown).getByRole("searchbox"), "parts.total");
  await waitFor(() => expect(textOf(within(shown).getByRole("table"))).not.toContain("motor"));
  expect(textOf(within(shown).getByRole("table"))).toContain("Main.parts.total");
  await user.click(
    within(shown)
      .getAllByRole("button", { name: t("changes.goto", { scan: 401 }) })
      .at(-1) as HTMLElement,
  );
  await waitFor(() => expect(server.sentOf("travel")).toMatchObject([{ scan: 401 }]));
  expect(screen.queryByRole("dialog")).toBeNull();
});

test("the run once more with an error one scan later: refused it stays, done it can be compared", async () => {
  const rerun: Rerun = {
    type: "rerun",
    id: 6,
    name: "later",
    by: "Mika",
    done: 0,
    of: 100,
    instance: null,
    message: "",
    refused: [],
  };
  let refused = true;
  const { server, user, places } = await openPast((server) =>
    server.on("POST", "/instances/*/reruns", () => (refused ? refusal("An instance named later exists.") : rerun)),
  );
  showRerun({ scan: 500, error: BASIC.id }, { by: 1 });
  const asking = await dialog(t("rerun.title", { error: BASIC.name, scan: 500 }));
  expect(textOf(asking)).toContain(t("rerun.where", { scan: 501 }));
  await user.clear(box(t("rerun.name"), asking));
  await user.type(box(t("rerun.name"), asking), "later");
  await user.click(button(t("rerun.do"), asking));
  await waitFor(() => expect(textOf(within(asking).getByRole("alert"))).toContain("later exists"));
  refused = false;
  await user.click(button(t("rerun.do"), asking));
  server.say(rerun);
  await screen.findByRole("region", { name: t("rerun.started", { name: "later" }) });
  expect(screen.queryByRole("dialog")).toBeNull();
  const asked = server.askedOf("POST", `/instances/${server.instance.id}/reruns`);
  expect(asked.at(-1)).toMatchObject({
    scan: 500,
    error: BASIC.id,
    by: 1,
    instead: "",
    leave_out: false,
    name: "later",
  });

  server.say({ ...rerun, done: 100, instance: server.instance.id });
  await screen.findByRole("region", { name: t("rerun.done", { name: "later" }) });
  await user.click(button(t("rerun.compare")));
  await waitFor(() => expect(places).toEqual(["page compare"]));
});

test("a comparison that is over before the request is answered does not begin again with the answer", async () => {
  const { server } = await openPage((server) => {
    server.on("POST", "/instances/*/comparisons", () => {
      server.say({ ...begun, message: "run 99 was damaged" });
      return begun;
    });
  });
  const begun: Comparison = {
    type: "comparison",
    id: 3,
    a: server.instance.id,
    b: 99,
    by: "Ann",
    done: 0,
    of: 0,
    result: null,
    message: "",
  };
  render(<ComparePage />);
  await compareWithOther(99);
  await screen.findByText("run 99 was damaged");
  expect(screen.queryByRole("button", { name: t("compare.cancel") })).toBeNull();
});
