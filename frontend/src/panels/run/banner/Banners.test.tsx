import { act, cleanup, render, screen, waitFor, within } from "@testing-library/react";
import type { UserEvent } from "@testing-library/user-event";
import { expect, test } from "vitest";
import { grouped } from "../../../logic/format/numbers";
import { useBench } from "../../../store/plc/bench";
import { useLinks } from "../../../store/plc/links";
import { travel } from "../../../store/plc/timeline";
import { follow } from "../../../store/project/people";
import { BATTERY, RAISED, row } from "../../../testing/catalogue";
import { box, button, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { JO, MIKA, someApp, someInstance } from "../../../testing/samples";
import type { FakeServer } from "../../../testing/server";
import { t } from "../../../text";
import type { InstanceState } from "../../../wire/types";
import { Banners } from "./Banners";

async function openBanners(prepare: (server: FakeServer) => void = () => undefined) {
  const page = await openPage(prepare);
  render(<Banners />);
  return page;
}

const alert = () => textOf(screen.queryByRole("alert"));
const past = (scan: number, by = "Ann") => ({ state: "past", scan, past: { by, live_scan: 2000 } }) as const;

const TRAP: InstanceState["trap"] = {
  kind: "division",
  message: "division by zero",
  file: "Main.st",
  line: 9,
  column: 3,
  scan: 1500,
};

test("a run-time error says what, where and when; the place is a way there", async () => {
  const { server, user, places } = await openBanners();
  server.becomes({ state: "trapped", trap: TRAP });
  await waitFor(() => expect(alert()).toContain("Division by zero"));
  expect(alert()).toContain(t("trap.scan", { scan: grouped(1500) }));
  await user.click(button("Main.st:9"));
  expect(places).toEqual(["file Main.st"]);
});

test("after the cause is corrected one goes on: what is present is recovered first, the program goes on in MONITOR", async () => {
  const { server, user } = await openBanners();
  server.say({ type: "errors", whole: false, rows: [row(BATTERY, RAISED)] });
  server.becomes({ state: "trapped", trap: TRAP });
  await user.click(await screen.findByRole("button", { name: t("trap.goon") }));
  await waitFor(() => expect(server.sentOf("mode")).toMatchObject([{ mode: "MONITOR" }]));
  expect(server.sentOf("recover")).toMatchObject([{ ids: null }]);
  server.becomes({ state: "running", trap: null });
  await waitFor(() => expect(screen.queryByRole("alert")).toBeNull());
});

test("where the model does not allow MONITOR at once, the way leads by PROGRAM", async () => {
  const { server, user } = await openBanners();
  let stopped = false;
  server.command("mode", ({ mode }) => {
    if (mode === "PROGRAM") stopped = true;
    return stopped ? undefined : "Only PROGRAM is possible now";
  });
  server.becomes({ state: "trapped", trap: TRAP });
  await user.click(await screen.findByRole("button", { name: t("trap.goon") }));
  await waitFor(() => expect(server.sentOf("mode").map(({ mode }) => mode)).toEqual(["MONITOR", "PROGRAM", "MONITOR"]));
});

test("the past says which scan and by whom; back to live is one click", async () => {
  const { server, user } = await openBanners();
  server.becomes(past(500));
  const banner = await screen.findByRole("region", { name: t("past.label") });
  expect(textOf(banner)).toContain(t("past.title", { scan: 500, live: grouped(2000) }));
  expect(textOf(banner)).toContain(t("past.by", { by: "Ann" }));
  await user.click(button(t("past.live")));
  await waitFor(() => expect(server.sentOf("travel")).toMatchObject([{ scan: null }]));
});

test("a branch gets a name and begins in the scan that is shown; the page goes there", async () => {
  const { server, user } = await openBanners((server) =>
    server.on("POST", "/instances/*/branch", ({ body }) => {
      const made = someInstance(server.instance.id + 5000, server.instance.project);
      server.instance = { ...made, name: body.name };
      return server.instance;
    }),
  );
  const { id } = server.instance;
  server.becomes(past(500));
  await user.click(await screen.findByRole("button", { name: t("past.branch") }));
  await user.clear(box(t("instances.name")));
  await user.type(box(t("instances.name")), "what-if");
  await user.click(button(t("create")));
  await waitFor(() => expect(server.asked.map(({ path }) => path)).toContain(`/instances/${id + 5000}/model`));
  expect(server.askedOf("POST", `/instances/${id}/branch`)).toEqual([{ name: "what-if", scan: 500, look: false }]);
  await waitFor(() => expect(screen.queryByRole("region", { name: t("past.label") })).toBeNull());
});

/** The page was opened with the address of a scan; others look at the PLC. */
async function openLink(scan: number, instance?: number) {
  return openBanners((server) => {
    server.greeting = { users: [MIKA, JO] };
    useLinks.setState({
      opened: { instance: instance ?? server.instance.id, scan, panel: null },
      question: null,
      trouble: null,
    });
  });
}

test("a link to a scan asks first while others look at the PLC; then the address is its own again", async () => {
  const { server, user } = await openLink(300);
  const question = await screen.findByRole("region", { name: t("link.label") });
  expect(textOf(question)).toContain(t("link.ask.title", { scan: 300 }));
  expect(server.sentOf("travel")).toEqual([]);
  await user.click(button(t("link.ask", { scan: 300 })));
  await waitFor(() => expect(server.sentOf("travel")).toMatchObject([{ scan: 300 }]));
  server.becomes(past(300, "Mika"));
  await waitFor(() => expect(location.pathname).toBe(`/i/${server.instance.id}/scan/300`));
  server.becomes({ state: "running", past: null });
  await waitFor(() => expect(location.pathname).toBe(`/i/${server.instance.id}`));
});

test("one may stay; and what there is not is said in words", async () => {
  const { server, user } = await openLink(300);
  await user.click(await screen.findByRole("button", { name: t("link.not") }));
  expect(screen.queryByRole("region", { name: t("link.label") })).toBeNull();
  expect(server.sentOf("travel")).toEqual([]);
});

test.each([
  ["a scan that is not in the run", 999_999, undefined, "999"],
  ["an instance that is not there", 3, 4711, "4711"],
] as const)("a link to %s says so", async (_, scan, instance, said) => {
  const { server, user } = await openLink(scan, instance);
  await waitFor(() => expect(alert()).toContain(said));
  await user.click(button(t("link.read")));
  expect(screen.queryByRole("alert")).toBeNull();
  expect(server.sentOf("travel")).toEqual([]);
});

test("without a connection the page says since when, and tries again when told to", async () => {
  const { server, user } = await openBanners();
  server.hangUp();
  await waitFor(() => expect(alert()).toContain(server.instance.name));
  expect(alert()).toContain(grouped(server.instance.state.scan));
  await user.click(button(t("lost.now")));
  await waitFor(() => expect(screen.queryByRole("alert")).toBeNull());
});

test("a fatal error says how to go on: by the button of the banner where a mode is chosen, else by choosing one", async () => {
  const { server } = await openBanners();
  server.becomes({ state: "fatal", mode: "MONITOR", scan: 70 });
  await waitFor(() => expect(alert()).toContain(t("fatal.about.goon", { scan: "70", mode: "MONITOR" })));
  expect(button(t("fatal.goon"))).toBeDefined();
});

test("a guest is asked for a name once somebody else is here, and once only", async () => {
  const guest = { name: "Guest 3", initials: "G3", client: false };
  const { server, user } = await openBanners((server) => {
    server.greeting = { you: guest, users: [guest] };
  });
  expect(screen.queryByRole("form", { name: t("name.title") })).toBeNull();
  server.say({ type: "users", users: [guest, { name: "FINS 127.0.0.1, node 5", initials: "F1", client: true }] });
  expect(screen.queryByRole("form", { name: t("name.title") }), "a client sees nobody's name").toBeNull();
  server.say({ type: "users", users: [guest, JO] });
  await user.click(await screen.findByRole("button", { name: t("name.stay", { name: "Guest 3" }) }));
  expect(screen.queryByRole("form", { name: t("name.title") })).toBeNull();
  cleanup();
  render(<Banners />);
  expect(screen.queryByRole("form", { name: t("name.title") })).toBeNull();
});

test.each([
  ["Escape", (user: UserEvent) => user.keyboard("{Escape}")],
  ["a click", (user: UserEvent) => user.click(document.body)],
  ["the button", (user: UserEvent) => user.click(button(t("follow.end")))],
] as const)("whom one follows is said; %s ends it, and so does their leaving", async (_, end) => {
  const { server, user } = await openBanners();
  const nowhere = { file: null, line: null, anchor: null, head: null, instance: server.instance.id };
  const people = [MIKA, JO].map((each, at) => ({ ...each, ...nowhere, id: at + 1, colour: at }));
  const banner = () => screen.queryByRole("region", { name: t("follow.label") });
  server.say({ type: "people", you: 1, people });
  act(() => follow(2));
  expect(textOf(banner())).toContain(t("follow.title", { name: JO.name }));
  await end(user);
  await waitFor(() => expect(banner()).toBeNull());
  act(() => follow(2));
  server.say({ type: "people", you: 1, people: people.slice(0, 1) });
  await waitFor(() => expect(banner()).toBeNull());
});

test("who would take others to the past is asked: everybody, or oneself alone at a branch that is deleted afterwards", async () => {
  const { server, user } = await openBanners((server) => {
    server.greeting = { users: [MIKA, JO] };
    server.on("POST", "/instances/*/branch", ({ body }) => {
      const made = someInstance(server.instance.id + 6000, server.instance.project);
      server.instance = { ...made, name: body.name };
      return server.instance;
    });
    server.on("DELETE", "/instances/*", () => undefined);
  });
  const { id } = server.instance;
  void travel(500);
  const question = () => screen.findByRole("region", { name: t("alone.ask.label") });
  await user.click(within(await question()).getByRole("button", { name: t("link.not") }));
  expect(server.sentOf("travel")).toEqual([]);
  void travel(500);
  await question();
  await user.click(button(t("alone.everybody")));
  await waitFor(() => expect(server.sentOf("travel")).toMatchObject([{ scan: 500 }]));
  void travel(400);
  await question();
  await user.click(button(t("alone.look")));
  const alone = await screen.findByRole("region", { name: t("alone.label") });
  expect(textOf(alone)).toContain("400");
  expect(server.askedOf("POST", `/instances/${id}/branch`)).toMatchObject([{ scan: 400, look: true }]);
  expect(server.sentOf("travel")).toHaveLength(1);
  await user.click(within(alone).getByRole("button"));
  await waitFor(() => expect(screen.queryByRole("region", { name: t("alone.label") })).toBeNull());
  expect(server.askedOf("DELETE", `/instances/${id + 6000}`)).toHaveLength(1);
});

test("who is at a PLC that somebody deletes is told so, by whom, and is led to a different one", async () => {
  const { server, user } = await openBanners();
  const other = { ...someInstance(8, server.instance.project), name: "line-8" };
  server.on("GET", "", () => ({ ...someApp(server.instance), instances: [other] }));
  server.say({ type: "instance_deleted", author: "Jo" });
  server.becomes({ state: "off" });
  await waitFor(() => expect(alert()).toContain(t("gone.title", { name: server.instance.name, by: "Jo" })));
  expect(alert()).not.toContain(t("off.about"));
  expect(screen.queryByRole("button", { name: t("instances.power.on") })).toBeNull();
  const open = await screen.findByRole("button", { name: t("gone.open", { name: `${other.project.name} / line-8` }) });
  server.instance = other;
  await user.click(open);
  await waitFor(() => expect(useBench.getState().instance?.id).toBe(8));
  expect(screen.queryByRole("alert")).toBeNull();
});

test("a force of yours that somebody else ends is told; yours that you end, and theirs, are not", async () => {
  const { server, user } = await openBanners();
  const force = { through: "", value: "TRUE", scan: 5, before: "", after_program: "", after: "" };
  const held = () =>
    server.say({
      type: "forces",
      forces: [
        { ...force, path: "Main.motor", author: "Mika" },
        { ...force, path: "Main.lamp", author: "Jo" },
      ],
      ended: [],
    });
  const ended = (by: string) =>
    server.say({ type: "forces", forces: [], ended: ["Main.motor", "Main.lamp"].map((path) => ({ path, by })) });
  const banners = () => screen.queryAllByRole("status", { name: t("force.ended.label") });
  held();
  ended("Mika");
  held();
  server.say({ type: "forces", forces: [], ended: [] }); // at a scan of the past
  held();
  ended("Aki");
  await screen.findByText(t("force.ended", { by: "Aki", path: "Main.motor", mine: "TRUE" }));
  expect(banners()).toHaveLength(1);
  await user.click(button(t("force.taken.read")));
  await waitFor(() => expect(banners()).toEqual([]));
});

test("a force of yours that somebody else replaces is told, until you have read it or force again", async () => {
  const { server, user } = await openBanners();
  const held = (author: string, value: string) =>
    server.say({
      type: "forces",
      forces: [{ path: "Main.motor", through: "", value, author, scan: 5, before: "", after_program: "", after: "" }],
      ended: [],
    });
  held("Jo", "TRUE");
  held("Mika", "TRUE");
  held("Mika", "FALSE");
  held("Mika", "TRUE");
  held("Aki", "FALSE");
  const said = t("force.taken", { by: "Aki", path: "Main.motor", value: "FALSE", mine: "TRUE" });
  await screen.findByText(said);
  await user.click(button(t("force.taken.read")));
  await waitFor(() => expect(screen.queryByText(said)).toBeNull());
  held("Mika", "TRUE");
  held("Aki", "FALSE");
  await screen.findByText(said);
  held("Mika", "TRUE");
  await waitFor(() => expect(screen.queryByText(said)).toBeNull());
});

test("a force that replaced yours is told as long as it holds; then that yours was ended is", async () => {
  const { server } = await openBanners();
  const force = { path: "Main.stop", through: "", scan: 5, before: "", after_program: "", after: "" };
  const held = (author: string, value: string) =>
    server.say({ type: "forces", forces: [{ ...force, author, value }], ended: [] });
  const released = (by: string) => server.say({ type: "forces", forces: [], ended: [{ path: force.path, by }] });
  const said = (by: string, value: string) => t("force.taken", { by, path: force.path, value, mine: "TRUE" });
  const over = t("force.ended", { by: "Aki", path: force.path, mine: "TRUE" });
  held("Mika", "TRUE");
  held("Aki", "FALSE");
  await screen.findByText(said("Aki", "FALSE"));
  released("Jo");
  await screen.findByText(over);
  expect(screen.queryByText(said("Aki", "FALSE"))).toBeNull();
  expect(screen.getAllByRole("status", { name: t("force.ended.label") })).toHaveLength(1);
  held("Jo", "TRUE");
  await screen.findByText(said("Jo", "TRUE"));
  expect(screen.queryByText(over)).toBeNull();
});
