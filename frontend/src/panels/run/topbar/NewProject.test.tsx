import { fireEvent, render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { begins, box, button, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { refusal } from "../../../testing/routes";
import { MODEL, someInstance, someProject } from "../../../testing/samples";
import { t } from "../../../text";
import type { ModelSummary } from "../../../wire/types";
import { Explorer } from "../../project/explorer/Explorer";
import { NewProject } from "./NewProject";
import { Picker } from "./Picker";

const MODELS: ModelSummary[] = ["CJ1M", "NJ501"].map((name) => ({
  name,
  vendor: "Omron",
  description: "",
  error_count: 3,
  verified_count: 3,
  fact_count: 12,
  verified_facts: 9,
}));

test("a project needs its model: it is not made before the models are here, and they are asked for again", async () => {
  let arrive: (models: ModelSummary[]) => void = () => undefined;
  let tries = 0;
  const { server, user } = await openPage((server) => {
    server.on("GET", "/models", () => {
      tries += 1;
      if (tries === 1) throw new TypeError("the connection was refused");
      return new Promise((resolve) => {
        arrive = resolve;
      });
    });
    server.on("GET", "/models/*", () => MODEL);
    server.on("POST", "/projects", () => someProject(800));
    server.on("PUT", "/projects/*/files/**", () => ({ path: "Main.st", version: 1, author: "Mika" }));
    const result = { ok: true, needs_agreement: false, message: "", changes: [], pous: [], problems: [] };
    server.on("POST", "/projects/*/build", () => ({ ...result, project: someProject(800) }));
    server.on("POST", "/instances", () => {
      server.instance = someInstance(800, someProject(800));
      return server.instance;
    });
  });
  let closed = false;
  render(<NewProject onClose={() => (closed = true)} />);
  const dialog = screen.getByRole("dialog", { name: t("newproject.title") });
  await waitFor(() => expect(textOf(within(dialog).queryByRole("alert"))).toContain(t("lost.read")));
  await user.type(box(begins(t("newproject.name")), dialog), "late");
  await user.click(button(t("lost.now"), dialog));
  await waitFor(() =>
    expect(textOf(within(dialog).getByRole("combobox", { name: t("newproject.model") }))).toContain(
      t("newproject.loading"),
    ),
  );
  expect(button(t("create"), dialog)).toHaveProperty("disabled", true);
  await user.type(box(begins(t("newproject.name")), dialog), "{Enter}");
  expect(server.askedOf("POST", "/projects")).toEqual([]);

  arrive(MODELS);
  await waitFor(() => expect(button(t("create"), dialog)).toHaveProperty("disabled", false));
  await user.click(button(t("create"), dialog));
  await waitFor(() => expect(closed).toBe(true));
  expect(server.askedOf("POST", "/projects")).toEqual([{ name: "late", model: "CJ1M" }]);
  expect(server.askedOf("POST", "/instances")).toMatchObject([{ project: 800 }]);
});

test("a zip file gives name, model and files; what it is not is told, and makes no project", async () => {
  let arrive: () => void = () => undefined;
  const { server, user } = await openPage((server) => {
    server.on("GET", "/models", () => new Promise((resolve) => (arrive = () => resolve(MODELS))));
    server.on("GET", "/models/*", () => MODEL);
    const has = {
      name: "Press",
      model: "NJ501",
      files: ["Main.st", "lib/F.st"],
      left_out: ["notes.txt"],
      notes: ["Valve: a note"],
    };
    server.on("POST", "/archives", () => has);
    server.on("POST", "/archives/projects", () => someProject(801));
    server.on("GET", "/projects/*/files", () => [{ path: "Main.st", version: 1, author: "Mika" }]);
    const result = { ok: true, needs_agreement: false, message: "", changes: [], pous: [], problems: [] };
    server.on("POST", "/projects/*/build", () => ({ ...result, project: someProject(801) }));
    server.on("POST", "/instances", () => {
      server.instance = someInstance(801, someProject(801));
      return server.instance;
    });
  });
  let closed = false;
  render(<NewProject onClose={() => (closed = true)} />);
  const dialog = screen.getByRole("dialog", { name: t("newproject.title") });
  const file = () =>
    within(dialog).getByLabelText(new RegExp(t("newproject.archive").slice(0, 20).replace(/[()]/g, ".")));
  await user.upload(file(), new File(["zip"], "press.zip"));
  await waitFor(() => expect(box(begins(t("newproject.name")), dialog)).toHaveProperty("value", "Press"));
  arrive(); // the models come after the file was read
  await waitFor(() =>
    expect(within(dialog).getByRole("combobox", { name: t("newproject.model") })).toHaveProperty("value", "NJ501"),
  );
  expect(textOf(dialog)).toContain(t("newproject.archive.left", { count: 2, left: 1, names: "notes.txt" }));

  server.on("POST", "/archives", () => refusal("no zip file"));
  await user.upload(file(), new File(["nonsense"], "other.zip"));
  await waitFor(() => expect(textOf(within(dialog).queryByRole("alert"))).toContain("no zip file"));
  server.on("POST", "/archives", () => ({ name: "", model: "", files: ["Main.st"], left_out: [], notes: [] }));
  await user.upload(file(), new File(["zip"], "press.zip"));
  await waitFor(() => expect(textOf(dialog)).toContain(t("newproject.archive.has", { count: 1 })));
  await user.click(button(t("create"), dialog));
  await waitFor(() => expect(closed).toBe(true));
  expect(server.askedOf("POST", "/projects")).toEqual([]);
  expect(server.askedOf("PUT", "/projects/801/files/Main.st")).toEqual([]);
});

test("a template gives its model and its files", async () => {
  const { server, user } = await openPage((server) => {
    server.on("GET", "/models", () => MODELS);
    server.on("GET", "/models/*", () => MODEL);
    server.on("GET", "/templates", () => [
      { id: "sequence", name: "Sequence", model: "NJ501", files: ["Main.st"] },
      { id: "conveyor", name: "Conveyor", model: "elsewhere", files: ["Main.st"] },
    ]);
    server.on("POST", "/projects", () => someProject(802));
    server.on("GET", "/projects/*/files", () => [{ path: "Main.st", version: 1, author: "Mika" }]);
    const result = { ok: true, needs_agreement: false, message: "", changes: [], pous: [], problems: [] };
    server.on("POST", "/projects/*/build", () => ({ ...result, project: someProject(802) }));
    server.on("POST", "/instances", () => {
      server.instance = someInstance(802, someProject(802));
      return server.instance;
    });
  });
  let closed = false;
  render(<NewProject onClose={() => (closed = true)} />);
  const dialog = screen.getByRole("dialog", { name: t("newproject.title") });
  const begin = await within(dialog).findByRole("combobox", { name: t("newproject.template") });
  await waitFor(() => expect(within(begin).getAllByRole("option")).toHaveLength(3));
  const sample = t("newproject.template.sample", { name: "Conveyor" });
  expect(textOf(within(begin).getAllByRole("option")[2] ?? null)).toBe(`${sample} (elsewhere)`);
  await user.selectOptions(begin, "conveyor");
  expect(within(dialog).getByText(t("newproject.template.model", { model: "elsewhere" }))).toBeTruthy();
  await user.selectOptions(begin, "sequence");
  expect(within(dialog).getByRole("combobox", { name: t("newproject.model") })).toHaveProperty("value", "NJ501");
  await user.type(box(begins(t("newproject.name")), dialog), "steps");
  await user.click(button(t("create"), dialog));
  await waitFor(() => expect(closed).toBe(true));
  expect(server.askedOf("POST", "/projects")).toEqual([{ name: "steps", model: "NJ501", template: "sequence" }]);
});

test("a zip file that was dropped on the explorer is looked at in the dialog", async () => {
  const { server, user } = await openPage((server) => {
    server.on("GET", "/models", () => MODELS);
    server.on("GET", "/models/*", () => MODEL);
    server.on("POST", "/archives", () => ({
      name: "Press",
      model: "NJ501",
      files: ["Main.st"],
      left_out: [],
      notes: [],
    }));
  });
  render(
    <>
      <Explorer />
      <Picker />
    </>,
  );
  const file = new File(["zip"], "press.zip");
  fireEvent.drop(screen.getByRole("navigation"), { dataTransfer: { files: [file], types: ["Files"] } });
  const dialog = await screen.findByRole("dialog", { name: t("newproject.title") });
  await within(dialog).findByText(`press.zip: ${t("newproject.archive.has", { count: 1 })}`);
  await waitFor(() =>
    expect(within(dialog).getByRole("combobox", { name: t("newproject.model") })).toHaveProperty("value", "NJ501"),
  );
  expect(box(begins(t("newproject.name")), dialog)).toHaveProperty("value", "Press");
  expect(server.askedOf("POST", "/archives")).toHaveLength(1);
  await user.click(button(t("cancel"), dialog));
  await waitFor(() => expect(screen.queryByRole("dialog", { name: t("newproject.title") })).toBeNull());
});
