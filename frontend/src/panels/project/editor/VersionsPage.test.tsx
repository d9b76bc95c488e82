import { act, render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { edit, openDocument } from "../../../store/project/documents";
import { openVersions } from "../../../store/project/versions";
import { openPage } from "../../../testing/page";
import { refusal } from "../../../testing/routes";
import type { FakeServer } from "../../../testing/server";
import { t } from "../../../text";
import type { GitStatus, ProjectVersion } from "../../../wire/types";
import { VersionsPage } from "./VersionsPage";

const NO_GIT: GitStatus = { missing: "", folder: "", branch: "", head: "", elsewhere: [], changes: [] };
const FOLDER: GitStatus = { ...NO_GIT, folder: "/data/projects/1", branch: "main" };
const version = (number: number, more: Partial<ProjectVersion> = {}): ProjectVersion => ({
  version: number,
  author: "Mika",
  at: `2026-11-24T10:0${number}:00.000Z`,
  label: "",
  message: "",
  ...more,
});

/** A server with these versions, and with git. */
function having(status: GitStatus, versions: ProjectVersion[] = []) {
  const now = { status };
  const prepare = (server: FakeServer) => {
    server.on("GET", "/projects/*/versions", () => versions);
    server.on("GET", "/projects/*/versions/*", () => ({ version: 1, files: {} }));
    server.on("GET", "/projects/*/git", () => now.status);
    server.on("GET", "/projects/*/git/commits", () => [
      { commit: "abcdef0123456", author: "Jo", at: "2026-11-24T10:01:30.000Z", message: "the belt stops" },
    ]);
  };
  return { now, prepare };
}

test("versions are listed with label and message, commits among them, and described", async () => {
  const { prepare } = having({ ...FOLDER, head: "abcdef0123456" }, [
    version(2, { label: "FAT", message: "quicker" }),
    version(1),
  ]);
  const { server, user } = await openPage(prepare);
  render(<VersionsPage />);
  await openVersions();
  const list = await screen.findByRole("list", { name: t("versions.history") });
  await waitFor(() => expect(within(list).getAllByRole("listitem")).toHaveLength(3));
  const rows = within(list).getAllByRole("listitem");
  expect(rows[0]?.textContent).toContain("FATquicker");
  expect(rows[1]?.textContent).toContain("abcdef0 the belt stopsJo");

  server.on("PATCH", "/projects/*/versions/*", ({ body }) =>
    version(1, { label: body.label ?? "", message: body.message ?? "" }),
  );
  await user.click(screen.getByRole("button", { name: t("versions.describe", { version: 1 }) }));
  await user.type(screen.getByRole("textbox", { name: t("versions.label") }), "pilot");
  await user.click(screen.getByRole("button", { name: t("save") }));
  await waitFor(() => expect(rows[2]?.textContent).toContain("pilot"));
});

test("a project is put under git, and a commit that is refused says why", async () => {
  const { now, prepare } = having(NO_GIT);
  const { server, user } = await openPage(prepare);
  render(<VersionsPage />);
  await openVersions();
  server.on("POST", "/projects/*/git", () => {
    now.status = { ...FOLDER, changes: [{ path: "Main.st", kind: "new" }] };
    return now.status;
  });
  await user.click(await screen.findByRole("button", { name: t("git.begin") }));
  expect(await screen.findByText(t("git.changes", { count: 1 }))).toBeTruthy();

  server.on("POST", "/projects/*/git/commits", () => refusal("somebody committed in the meantime"));
  await user.type(screen.getByRole("textbox", { name: t("git.message") }), "first");
  await user.click(screen.getByRole("button", { name: t("git.commit") }));
  expect((await screen.findByRole("alert")).textContent).toBe("somebody committed in the meantime");

  now.status = { ...FOLDER, head: "abcdef0123456", elsewhere: ["Main.st"] };
  await openVersions();
  server.on("POST", "/projects/*/git/commits", ({ body }) =>
    body.agreed ? { commit: "1", author: "Mika", at: "", message: body.message } : refusal("not agreed"),
  );
  await user.click(await screen.findByRole("button", { name: t("git.commit.anyway") }));
  await waitFor(() => expect(screen.queryByRole("alert")).toBeNull());
  expect(server.askedOf("POST", `/projects/${server.instance.project.id}/git/commits`).at(-1)).toMatchObject({
    message: "first",
    agreed: true,
  });
});

test("texts that are not saved are named beside what a commit would keep, and saved there", async () => {
  const { prepare } = having({ ...FOLDER, head: "abcdef0123456" });
  const file = (path: string) => ({ path, version: 1, author: "Mika" });
  const saved: string[] = [];
  const { user } = await openPage((server) => {
    prepare(server);
    server.on("GET", "/projects/*/files", () => ["Belt.st", "Main.st"].map(file));
    server.on("GET", "/projects/*/files/**", (_, [, , path]) => ({ ...file(path ?? ""), text: "stored" }));
    server.on("GET", "/projects/*/unsaved", () => (saved.includes("Belt.st") ? [] : ["Belt.st"]));
    server.on("PUT", "/projects/*/files/**", (_, [, , path]) => {
      saved.push(path ?? "");
      return { ...file(path ?? ""), version: 2 };
    });
  });
  render(<VersionsPage />);
  await openVersions();
  expect(await screen.findByText(t("git.edited.one", { path: "Belt.st" }))).toBeTruthy();
  expect(screen.queryByText(t("git.clean"))).toBeNull();
  await openDocument("Main.st");
  act(() => edit("Main.st", "typed"));
  expect(await screen.findByText(t("git.edited", { count: 2 }))).toBeTruthy();
  await openDocument("Belt.st");
  act(() => edit("Belt.st", "typed, too"));
  await user.click(screen.getByRole("button", { name: t("save") }));
  await waitFor(() => expect(saved).toEqual(["Belt.st", "Main.st"]));
  expect(await screen.findByText(t("git.clean"))).toBeTruthy();
});

test("without git the page says what to do", async () => {
  const { prepare } = having({ ...NO_GIT, missing: "the program git is not installed" });
  await openPage(prepare);
  render(<VersionsPage />);
  await openVersions();
  expect((await screen.findByRole("note")).textContent).toBe(t("git.missing"));
});

test("the page that was there at the start of a window finds its versions, and compares again what is edited", async () => {
  const { prepare } = having(NO_GIT, [version(1)]);
  const file = { path: "Main.st", version: 1, author: "Mika" };
  await openPage((server) => {
    prepare(server);
    server.on("GET", "/projects/*/files", () => [file]);
    server.on("GET", "/projects/*/files/**", () => ({ ...file, text: "stored" }));
    server.on("GET", "/projects/*/versions/*", () => ({ version: 1, files: { "Main.st": "stored" } }));
  });
  render(<VersionsPage />);
  await screen.findByText(t("versions.same"));
  await openDocument("Main.st");
  act(() => edit("Main.st", "other"));
  await screen.findByText("stored -> other");
});

test("an answer that comes after a newer one is not shown", async () => {
  const { prepare } = having(FOLDER);
  const { server } = await openPage(prepare);
  render(<VersionsPage />);
  await openVersions();
  let answerOld = () => {};
  server.on("GET", "/projects/*/git", () => {
    server.on("GET", "/projects/*/git", () => FOLDER);
    return new Promise((answer) => {
      answerOld = () => answer({ ...FOLDER, elsewhere: ["Main.st"] });
    });
  });
  const older = openVersions();
  await openVersions();
  answerOld();
  await act(() => older);
  expect(screen.queryByText(t("git.elsewhere", { paths: "Main.st" }))).toBeNull();
});

test("a text that others edited and nobody saved is compared as they have it, though it is not open here", async () => {
  const { prepare } = having(NO_GIT, [version(1)]);
  const file = { path: "Main.st", version: 1, author: "Mika" };
  const { server } = await openPage((server) => {
    prepare(server);
    server.on("GET", "/projects/*/files", () => [file]);
    server.on("GET", "/projects/*/files/**", () => ({ ...file, text: "stored" }));
    server.on("GET", "/projects/*/versions/*", () => ({ version: 1, files: { "Main.st": "stored" } }));
    server.on("GET", "/projects/*/drafts", () => [{ path: "Main.st", text: "typed by Jo" }]);
  });
  render(<VersionsPage />);
  await screen.findByText("stored -> typed by Jo");
  server.on("GET", "/projects/*/drafts", () => [{ path: "Main.st", text: "typed on" }]);
  const jo = {
    id: 2,
    name: "Jo",
    initials: "J",
    colour: 1,
    instance: server.instance.id,
    file: "Main.st",
    line: 2,
    anchor: null,
    head: null,
  };
  act(() => server.say({ type: "people", you: 1, people: [jo] }));
  await screen.findByText("stored -> typed on");
});
