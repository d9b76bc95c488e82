import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { unsavedPaths } from "../../../store/project/unsaved";
import { box, button, choose, menuItem, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { JO, MIKA } from "../../../testing/samples";
import { t } from "../../../text";
import { TopBar } from "./TopBar";

async function openBar() {
  const page = await openPage();
  render(<TopBar onResetLayout={() => undefined} />);
  return page;
}

const state = () => textOf(screen.getByRole("status", { name: t("state.label") }));
const dialog = (title: string) => screen.findByRole("dialog", { name: title });
const noDialog = () => waitFor(() => expect(screen.queryByRole("dialog")).toBeNull());

test("a run until a condition: a name that is not known gets the one that comes near; what it waits for is shown", async () => {
  const { server, user } = await openBar();
  server.command("run", ({ until }) =>
    until?.includes("totl") ? { message: "Main.parts.totl is not known", near: ["Main.parts.total"] } : undefined,
  );
  await choose(user, t("run.more"), t("run.until"));
  const asking = await dialog(t("run.until.title"));
  await user.type(box(t("run.until.condition"), asking), "Main.parts.totl >= 3");
  await user.click(button(t("run.scans.do"), asking));
  expect(textOf(await within(asking).findByRole("alert"))).toContain("totl");
  await user.click(button("Main.parts.total", asking));
  expect(box(t("run.until.condition"), asking).value).toBe("Main.parts.total >= 3");
  expect(within(asking).queryByRole("alert")).toBeNull();
  await user.click(button(t("run.scans.do"), asking));
  await noDialog();
  expect(server.sentOf("run").at(-1)).toMatchObject({ action: "continue", until: "Main.parts.total >= 3" });

  server.becomes({ target: "until Main.parts.total >= 3" });
  await waitFor(() => expect(state()).toContain("until Main.parts.total >= 3"));
  server.becomes({ state: "paused", target: "" });
  await waitFor(() => expect(state()).toContain(t("state.paused")));
  // What was accepted is offered again.
  await choose(user, t("run.more"), t("run.until.last", { condition: "Main.parts.total >= 3" }));
  await waitFor(() => expect(server.sentOf("run")).toHaveLength(3));
});

test("a hundred scans are asked for by their number, and nothing else is one", async () => {
  const { server, user } = await openBar();
  await choose(user, t("run.more"), t("run.scans"));
  const asking = await dialog(t("run.scans.title"));
  const count = box(t("run.scans.count"), asking);
  await user.clear(count);
  await user.type(count, "0{Enter}");
  expect(textOf(await within(asking).findByRole("alert"))).toBe(t("run.scans.bad"));
  await user.clear(count);
  await user.type(count, "100{Enter}");
  await noDialog();
  expect(server.sentOf("run")).toMatchObject([{ action: "continue", scans: 100 }]);
});

test("a new run is begun after a question only; what is refused stays in it", async () => {
  const { server, user } = await openBar();
  await choose(user, t("restart.menu"), t("newrun.menu"));
  expect(textOf(await dialog(t("newrun.title")))).toContain(t("newrun.about"));
  await user.click(button(t("cancel")));
  await noDialog();
  expect(server.sentOf("new_run")).toEqual([]);

  let refused = true;
  server.command("new_run", () => (refused ? "There is no room on the disk." : undefined));
  await choose(user, t("restart.menu"), t("newrun.menu"));
  await user.click(button(t("newrun.do")));
  await waitFor(() => expect(textOf(screen.getByRole("alert"))).toContain("no room"));
  refused = false;
  await user.click(button(t("newrun.do")));
  await noDialog();
  expect(server.sentOf("new_run")).toHaveLength(2);
});

test.each([
  ["cold", "restart.cold"],
  ["warm", "restart.warm"],
  ["power", "restart.power"],
] as const)("a %s restart is one command", async (kind, item) => {
  const { server, user } = await openBar();
  await choose(user, t("restart.menu"), t(item));
  await waitFor(() => expect(server.sentOf("restart")).toMatchObject([{ kind }]));
});

test("a mode is chosen; in RUN the program cannot be rolled back, and the menu says why", async () => {
  const { server, user } = await openBar();
  server.becomes({ program_version: 2, previous_version: 1 });
  await user.click(screen.getByRole("radio", { name: "RUN" }));
  expect(server.sentOf("mode")).toMatchObject([{ mode: "RUN" }]);
  server.becomes({ mode: "RUN" });
  await waitFor(() => expect(screen.getByRole("radio", { name: "RUN" }).getAttribute("aria-checked")).toBe("true"));
  await user.click(button(t("restart.menu")));
  expect(menuItem(t("restart.rollback"))).toHaveProperty("disabled", true);
  expect(textOf(menuItem(t("restart.rollback")))).toContain(t("permit.run.change"));
  expect(menuItem(t("restart.cold"))).toHaveProperty("disabled", false);
});

const person = (id: number, name: string, file: string | null = null, line: number | null = null) => ({
  ...{ id, name, initials: name[0] ?? "", colour: id % 8, file, line, anchor: null, head: null },
});

test("the menu of people says where the others are, leads there, and follows them", async () => {
  const { server, user, places } = await openBar();
  const instance = server.instance.id;
  const say = (file: string, line: number) =>
    server.say({
      type: "people",
      you: 1,
      people: [
        { ...person(1, "Mika"), instance },
        { ...person(2, "Jo", file, line), instance },
      ],
    });
  say("Belt.st", 4);
  const menu = t("people.menu", { name: "Mika" });
  const at = t("people.at", { file: "Belt.st", line: 4 });
  await choose(user, menu, t("people.goto", { name: "Jo", place: at }));
  await waitFor(() => expect(places).toEqual(["file Belt.st"]));
  await choose(user, menu, t("people.follow", { name: "Jo" }));
  await waitFor(() => expect(places).toEqual(["file Belt.st", "file Belt.st"]));
  say("Main.st", 9);
  await waitFor(() => expect(places.at(-1)).toBe("file Main.st"));
});

test("an invitation is an address with the token, and says what it gives", async () => {
  const { server, user } = await openBar();
  server.on("POST", "/invitations", () => ({ token: "secret" }));
  await choose(user, t("people.menu", { name: "Mika" }), t("invite.menu"));
  const asking = await dialog(t("invite.title"));
  await waitFor(() =>
    expect(box(t("invite.address"), asking).value).toContain(`/i/${server.instance.id}?token=secret`),
  );
  expect(textOf(asking)).toContain(t("invite.about"));
  expect(textOf(asking)).toContain(t("invite.own", { host: "localhost" }));
});

test("a new name is the browser's, and the server sees it with a new connection", async () => {
  const { server, user } = await openBar();
  await choose(user, t("people.menu", { name: "Mika" }), t("name.menu"));
  const asking = await dialog(t("name.title"));
  await user.clear(box(t("name.label"), asking));
  server.greeting = {
    you: { name: "Mi ka", initials: "MK", client: false },
    users: [{ name: "Mi ka", initials: "MK", client: false }],
  };
  await user.type(box(t("name.label"), asking), "Mi ka{Enter}");
  await noDialog();
  expect(document.cookie).toContain("scanbench_user=Mi%20ka");
  await screen.findByRole("button", { name: t("people.menu", { name: "Mi ka" }) });
});

test("in the past one goes scan by scan, and the mode is not to be changed", async () => {
  const { server, user } = await openBar();
  server.becomes({ state: "past", scan: 500, past: { by: "Ann", live_scan: 1000 } });
  await waitFor(() => expect(state()).toContain(t("state.past")));
  for (const mode of ["PROGRAM", "MONITOR", "RUN"])
    expect(screen.getByRole("radio", { name: mode })).toHaveProperty("disabled", true);
  await user.click(button(t("run.back")));
  await user.click(button(t("run.scan.past")));
  await waitFor(() => expect(server.sentOf("travel").map(({ scan }) => scan)).toEqual([499, 501]));
});

test("how long a scan of the past took is not known", async () => {
  const { server } = await openBar();
  server.becomes({ cycle_us: 12 });
  await waitFor(() => expect(screen.getByTestId("cycle").textContent).toContain("12"));
  server.becomes({ state: "past", scan: 5, past: { by: "Ann", live_scan: 2000 }, cycle_us: 0.02 });
  await waitFor(() => expect(screen.getByTestId("cycle").textContent).toBe("–"));
});

test("an export says that it leaves out what is not saved", async () => {
  const { server, user } = await openPage((server) => {
    server.on("GET", "/projects/*/files", () => [{ path: "Main.st", version: 1, author: "Mika" }]);
    server.on("GET", "/projects/*/unsaved", () => ["Main.st"]);
  });
  render(<TopBar onResetLayout={() => undefined} />);
  await waitFor(() => expect(unsavedPaths()).toEqual(["Main.st"]));
  const before = server.askedOf("GET", "").length;
  await user.click(button(t("picker.label")));
  expect(server.askedOf("GET", "").length, "the server is asked once").toBe(before + 1);
  expect(textOf(menuItem(t("picker.export")))).toContain(t("picker.export.hint.unsaved", { count: 1 }));
});

test("at the head is the version that the PLC runs, not the newest of the project", async () => {
  const { server } = await openBar();
  const { project, model } = server.instance;
  server.becomes({ program_version: project.version + 3 });
  const version = t("picker.about", { model, version: project.version + 3 });
  await waitFor(() => expect(textOf(button(t("picker.label")))).toContain(version));
});

test("a name that is too long is not cut, but refused with how long it may be", async () => {
  const { user } = await openBar();
  await choose(user, t("people.menu", { name: "Mika" }), t("name.menu"));
  const asking = await dialog(t("name.title"));
  await user.clear(box(t("name.label"), asking));
  await user.type(box(t("name.label"), asking), `${"a".repeat(41)}{Enter}`);
  expect(textOf(asking)).toContain(t("name.long", { longest: 40, length: 41 }));
  expect(document.cookie).not.toContain("aaaa");
});

test("clients and plants are no people who are connected", async () => {
  const { server } = await openBar();
  const here = () => textOf(screen.getByRole("list", { name: t("people.here") }));
  server.say({ type: "users", users: [MIKA, JO, { name: "Modbus plant", initials: "MP", client: true }] });
  await waitFor(() => expect(here()).toContain("+1"));
  expect(here()).not.toContain("MP");
});
