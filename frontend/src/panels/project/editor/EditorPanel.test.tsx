import { act, render, screen, waitFor } from "@testing-library/react";
import { expect, test } from "vitest";
import { clockTime } from "../../../logic/format/numbers";
import { useDocuments } from "../../../store/project/documents";
import { begins, box, button, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { Status } from "../../../testing/routes";
import type { FakeServer } from "../../../testing/server";
import { t } from "../../../text";
import type { OnlineChange, Problem } from "../../../wire/types";
import { ProblemsPanel } from "../problems/ProblemsPanel";
import { EditorPanel } from "./EditorPanel";

const PATH = "Main.st";
const FILE = { path: PATH, version: 1, author: "Mika" };

async function openEditor(prepare: (server: FakeServer) => void = () => undefined) {
  const page = await openPage((server) => {
    server.on("GET", "/projects/*/files", () => [FILE]);
    server.on("GET", "/projects/*/files/**", () => ({ ...FILE, text: "stored" }));
    server.on("PUT", "/projects/*/files/**", () => ({ ...FILE, version: 2 }));
    prepare(server);
  });
  render(<EditorPanel path={PATH} />);
  await waitFor(() => expect(text().value).toBe("stored"));
  return page;
}

const text = () => box(PATH);
const saveButton = () => button(t("save"));
const buildButton = () => button(t("build"));

test("what is typed is saved with the version that it began from", async () => {
  const { server, user } = await openEditor();
  expect(saveButton()).toHaveProperty("disabled", true);
  await user.type(text(), " and more");
  await user.click(saveButton());
  await waitFor(() => expect(saveButton()).toHaveProperty("disabled", true));
  expect(server.askedOf("PUT", `/projects/${server.instance.project.id}/files/${PATH}`)).toEqual([
    { text: "stored and more", version: 1 },
  ]);
});

test("who saves and builds before the first answer is there is no conflict to oneself", async () => {
  let answer: () => void = () => undefined;
  let version = 1;
  const { server, user } = await openEditor((server) => {
    server.on("PUT", "/projects/*/files/**", async (question) => {
      if (version === 1) await new Promise<void>((come) => (answer = come));
      const { version: from } = question.body as { version: number };
      if (from < version)
        return new Status(409, { message: "", theirs: { ...FILE, version, text: "", author: "Mika" } });
      version += 1;
      return { ...FILE, version };
    });
    server.on("POST", "/projects/*/build", () => new Status(422, { message: "enough", near: [] }));
  });
  await user.type(text(), " one");
  await user.click(saveButton());
  await user.type(text(), " two");
  await user.click(buildButton());
  const sent = () => server.askedOf("PUT", `/projects/${server.instance.project.id}/files/${PATH}`);
  expect(sent()).toHaveLength(1);
  answer();
  await screen.findByText(t("build.refused"));
  expect(sent()).toEqual([
    { text: "stored one", version: 1 },
    { text: "stored one two", version: 2 },
  ]);
});

test.each(["mine", "theirs"] as const)(
  "of two who save the second one is shown both texts, and takes %s",
  async (choice) => {
    let first = true;
    const { server, user } = await openEditor((server) =>
      server.on("PUT", "/projects/*/files/**", () => {
        if (!first) return { ...FILE, version: 3 };
        first = false;
        return new Status(409, { message: "", theirs: { ...FILE, version: 2, text: "Jo's", author: "Jo" } });
      }),
    );
    await user.type(text(), " mine");
    await user.click(saveButton());
    await screen.findByText(t("conflict.title", { path: PATH, version: 2, author: "Jo" }));
    await screen.findByText("Jo's");
    await user.click(button(t(`conflict.${choice}`)));
    await waitFor(() => expect(screen.queryByRole("alert")).toBeNull());
    expect(text().value).toBe(choice === "mine" ? "stored mine" : "Jo's");
    const sent = server.askedOf("PUT", `/projects/${server.instance.project.id}/files/${PATH}`);
    expect(sent.at(-1)).toMatchObject({ text: "stored mine", version: choice === "mine" ? 2 : 1 });
  },
);

test("a file that somebody deletes: a text that was edited stays, says who, and saved is a file again", async () => {
  const { server, user } = await openEditor();
  await user.type(text(), " mine");
  server.say({ type: "deleted", path: PATH, author: "Jo" });
  await screen.findByText(t("deleted.by", { author: "Jo", path: PATH }));
  expect(text().value).toBe("stored mine");
  await user.click(saveButton());
  await waitFor(() => expect(screen.queryByText(t("deleted.by", { author: "Jo", path: PATH }))).toBeNull());
  expect(server.askedOf("PUT", `/projects/${server.instance.project.id}/files/${PATH}`)).toEqual([
    { text: "stored mine", version: 0 },
  ]);
});

test("without a connection nothing can be saved or built, and both say why; the text stays", async () => {
  const { server, user } = await openEditor();
  await user.type(text(), " mine");
  server.hangUp();
  await waitFor(() => expect(saveButton()).toHaveProperty("disabled", true));
  expect(saveButton().title).toBe(t("lost.nosave"));
  expect(buildButton()).toHaveProperty("disabled", true);
  expect(buildButton().title).toBe(t("lost.nobuild"));
  expect(text().value).toBe("stored mine");
});

test("a build says for whom; what it changed can be taken back until it was", async () => {
  const { server, user } = await openEditor((server) => {
    const change: OnlineChange = {
      instance: server.instance.id,
      name: "line-1",
      kept: 58,
      reinitialized: 0,
      new: 0,
      removed: 0,
      lost: [],
      lost_count: 0,
      refusal: "",
    };
    const project = { ...server.instance.project, version: 2 };
    const result = {
      ok: true,
      needs_agreement: false,
      message: "",
      changes: [change],
      pous: [],
      problems: [],
      project,
    };
    server.on("POST", "/projects/*/build", () => result);
  });
  await user.click(buildButton());
  const outcome = await screen.findByRole("status");
  await waitFor(() => expect(textOf(outcome)).toContain("line-1"));
  server.becomes({ program_version: 2, previous_version: 1 });
  await user.click(button(t("change.rollback")));
  await waitFor(() => expect(server.sentOf("roll_back")).toHaveLength(1));
  await waitFor(() => expect(screen.queryByRole("button", { name: t("change.rollback") })).toBeNull());
});

test("a build that is refused opens the problems", async () => {
  const { user, places } = await openEditor((server) => {
    const problem = {
      file: PATH,
      line: 3,
      column: 1,
      end_line: 3,
      end_column: 7,
      message: "NOTYPE",
      code: "E1",
      severity: "error",
    } as const;
    const { project } = server.instance;
    const result = {
      ok: false,
      needs_agreement: false,
      message: "1 error",
      changes: [],
      pous: [],
      problems: [problem],
      project,
    };
    server.on("POST", "/projects/*/build", () => result);
    server.on("POST", "/projects/*/check", () => ({ checks: [], tasks: [], pous: [], problems: [problem] }));
  });
  await user.click(buildButton());
  await waitFor(() => expect(places).toEqual(["panel problems"]));
  expect(textOf(screen.getByRole("status"))).toContain(t("build.refused"));
});

test("the past before a build shows the text that ran, to be read only; the own one comes back", async () => {
  const { server, user } = await openEditor((server) => {
    server.instance = { ...server.instance, project: { ...server.instance.project, version: 2 } };
    server.on("GET", "/instances/*/program", () => ({ version: 1, files: { [PATH]: "as it ran" }, pous: [] }));
  });
  await user.type(text(), " mine");
  server.becomes({ state: "past", scan: 10, program_version: 1, past: { by: "Ann", live_scan: 1000 } });
  await waitFor(() => expect(text().value).toBe("as it ran"));
  expect(text()).toHaveProperty("readOnly", true);
  expect(saveButton()).toHaveProperty("disabled", true);
  await screen.findByText(t("past.text", { version: 1 }));
  await screen.findByText(t("past.text.unsaved"));
  server.becomes({ state: "running", scan: 1000, program_version: 2, past: null });
  await waitFor(() => expect(text().value).toBe("stored mine"));
  expect(saveButton()).toHaveProperty("disabled", false);
});

test("a build that was refused for errors in the text says so until there are none of them any more, and since when", async () => {
  const at = { file: PATH, line: 1, column: 1, end_line: 1, end_column: 2 };
  const error = (code: string): Problem => ({ ...at, severity: "error", code, message: code });
  let problems = [error("S001")];
  const { server, user } = await openEditor((server) => {
    server.on("POST", "/projects/*/check", () => ({ checks: [], tasks: [], pous: [], problems }));
    server.on("POST", "/projects/*/build", () => ({
      ok: false,
      message: "it has errors",
      problems,
      pous: [],
      checks: [],
      changes: [],
      needs_agreement: false,
      project: server.instance.project,
    }));
  });
  render(<ProblemsPanel />);
  await waitFor(() => expect(useDocuments.getState().problems).toHaveLength(1));
  await user.click(buildButton());
  await screen.findByText(t("build.refused"));
  const says = t("build.refused.at", { at: clockTime(new Date().toISOString()), message: "" });
  expect(screen.getByText(begins(says.trim()))).toBeDefined();
  // What is wrong now has nothing to do with that build.
  problems = [error("S002")];
  await user.type(text(), " corrected");
  await waitFor(() => expect(screen.queryByText(t("build.refused"))).toBeNull());
  expect(screen.queryByText(begins(says.trim()))).toBeNull();

  // Refused for a different reason, it stays.
  server.on("POST", "/projects/*/build", () => new Status(422, { message: "enough", near: [] }));
  await user.click(buildButton());
  await screen.findByText(t("build.refused"));
  act(() => useDocuments.setState({ problems: [] }));
  expect(screen.getByText(t("build.refused"))).toBeDefined();
});
