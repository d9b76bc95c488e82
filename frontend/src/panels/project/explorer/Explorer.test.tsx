import { fireEvent, render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { box, button, textOf } from "../../../testing/find";
import { folderEntry } from "../../../testing/folder";
import { openPage } from "../../../testing/page";
import { t } from "../../../text";
import type { FileInfo } from "../../../wire/types";
import { DeleteFile } from "./DeleteFile";
import { Explorer } from "./Explorer";

async function openExplorer() {
  const files: FileInfo[] = [{ path: "Main.st", version: 1, author: "Mika" }];
  const page = await openPage((server) => {
    server.on("GET", "/projects/*/files", () => files);
    server.on("PUT", "/projects/*/files/**", (_, [, , path = ""]) => {
      const saved = { path: decodeURIComponent(path), version: 1, author: "Mika" };
      files.push(saved);
      return saved;
    });
  });
  render(<Explorer />);
  const add = (...chosen: File[]) =>
    page.user.upload(screen.getByLabelText(t("file.add"), { selector: "input" }), chosen);
  return { ...page, files, add };
}

test("files of other tools are taken as they are; a table goes to the plant by itself; the first one opens", async () => {
  const { server, add, places } = await openExplorer();
  const latin1 = new Uint8Array([..."Name := 'T"].map((sign) => sign.charCodeAt(0)).concat(0xfc, 0x72, 0x27));
  await add(new File(["time; CIO0\n0; 0\n"], "inputs.csv"), new File([latin1], "Name.st"));
  const { id } = server.instance.project;
  await waitFor(() => expect(places).toEqual(["file plant/inputs.csv"]));
  expect(server.askedOf("PUT", `/projects/${id}/files/plant/inputs.csv`)).toMatchObject([
    { text: "time; CIO0\n0; 0\n" },
  ]);
  expect(server.askedOf("PUT", `/projects/${id}/files/Name.st`)).toMatchObject([{ text: "Name := 'Tür'" }]);
});

test("a name that is taken is refused with the reason, the others are added", async () => {
  const { user, add, files } = await openExplorer();
  await add(new File(["x"], "main.ST"), new File(["y"], "Belt.st"));
  const dialog = await screen.findByRole("dialog", { name: t("file.add.done", { added: 1, left: 1 }) });
  expect(textOf(dialog)).toContain(`main.ST: ${t("file.add.exists")}`);
  expect(files.map(({ path }) => path)).toEqual(["Main.st", "Belt.st"]);
  await user.click(
    within(dialog)
      .getAllByRole("button", { name: t("close") })
      .at(-1) as HTMLElement,
  );
  expect(screen.queryByRole("dialog")).toBeNull();
  expect(button(t("file.add"))).toHaveProperty("disabled", false);
});

test("a dropped folder is added with what is below it, and it is said what was left out and why", async () => {
  const { files, places, user } = await openExplorer();
  const folder = folderEntry("Line", { "B.st": "b", "notes.txt": "n", Deep: { "C.st": "c", "in.csv": "t" } });
  const item = { kind: "file", webkitGetAsEntry: () => folder };
  const single = { kind: "file", webkitGetAsEntry: () => ({ isDirectory: false }) };
  const dataTransfer = {
    types: ["Files"],
    items: [item, single],
    files: [new File([], "Line"), new File(["m"], "MAIN.st")],
  };
  fireEvent.drop(screen.getByRole("navigation"), { dataTransfer });
  const dialog = await screen.findByRole("dialog", { name: t("file.add.done", { added: 3, left: 2 }) });
  expect(files.map(({ path }) => path)).toEqual(["Main.st", "Line/B.st", "Line/Deep/C.st", "plant/Line/Deep/in.csv"]);
  const rows = (name: string) =>
    within(within(dialog).getByRole("list", { name })).getAllByRole("listitem").map(textOf);
  expect(rows(t("file.left"))).toEqual([`Line/notes.txt: ${t("file.left.kind")}`, `MAIN.st: ${t("file.add.exists")}`]);
  expect(rows(t("file.added"))).toEqual(["Line/B.st", "Line/Deep/C.st", "plant/Line/Deep/in.csv"]);
  expect(places.at(-1)).toBe("file Line/B.st");
  await user.keyboard("{Escape}");
});

test("a new file is of the kind that its name says until somebody chooses, and in the chosen language", async () => {
  const { server, user } = await openExplorer();
  await user.click(button(t("file.new")));
  const dialog = await screen.findByRole("dialog", { name: t("file.new") });
  await user.type(box(t("file.name"), dialog), "FB_Belt");
  const kind = within(dialog).getByRole<HTMLSelectElement>("combobox", { name: t("file.kind") });
  expect(kind.value).toBe("function_block");
  await user.selectOptions(kind, "type");
  expect(within(dialog).queryByRole("radiogroup", { name: t("file.language") })).toBeNull();
  await user.selectOptions(kind, "program");
  await user.click(within(dialog).getByRole("radio", { name: t("file.language.IL") }));
  await user.click(button(t("create"), dialog));
  await waitFor(() => expect(screen.queryByRole("dialog")).toBeNull());
  const [sent] = server.askedOf("PUT", `/projects/${server.instance.project.id}/files/FB_Belt.st`) as {
    text: string;
  }[];
  expect(sent?.text).toMatch(/^PROGRAM FB_Belt\n[\s\S]*LD {3}enable/);
});

test("the arrow keys choose the language of a new file", async () => {
  const { user } = await openExplorer();
  await user.click(button(t("file.new")));
  const dialog = await screen.findByRole("dialog", { name: t("file.new") });
  const language = (name: "ST" | "SFC") => within(dialog).getByRole("radio", { name: t(`file.language.${name}`) });
  language("ST").focus();
  await user.keyboard("{ArrowLeft}");
  expect(language("SFC")).toHaveProperty("ariaChecked", "true");
});

test("a file that somebody edited and nobody saved is marked, though it is not open here", async () => {
  await openPage((server) => {
    server.on("GET", "/projects/*/files", () => [{ path: "notes.csv", version: 1, author: "Mika" }]);
    server.on("GET", "/projects/*/unsaved", () => ["notes.csv"]);
  });
  render(<Explorer />);
  expect(await screen.findByTitle(t("unsaved.others"))).toBeDefined();
});

test("tasks are listed with how often they run and what; a task leads to its declaration, a program to its text", async () => {
  const pous = [{ name: "Belt", kind: "program" as const, file: "Belt.st", line: 3 }];
  const programs = [{ name: "second", pou: "Belt" }];
  const place = { file: "plant.st", line: 5 };
  const fast = { name: "fast", interval_ns: 10_000_000, event: false, priority: 1, ...place, programs };
  const once = { name: "once", interval_ns: 0, event: true, priority: 2, ...place, line: 6, programs: [] };
  const { user, places } = await openPage((server) => {
    server.on("POST", "/projects/*/check", () => ({ checks: [], tasks: [fast, once], pous, problems: [] }));
  });
  render(<Explorer />);
  const row = await screen.findByRole("treeitem", { name: /^fast/ });
  expect(textOf(row)).toContain(`10 ms · ${t("explorer.task.priority", { priority: 1 })}`);
  expect(textOf(screen.getByRole("treeitem", { name: /^once/ }))).toContain(t("explorer.task.event"));
  await user.dblClick(row);
  await user.dblClick(screen.getByRole("treeitem", { name: /^second/ }));
  expect([...new Set(places)]).toEqual(["file plant.st", "file Belt.st"]);
});

test("who deletes a file sees before who is in it, and that it has text that is not saved", async () => {
  const { server } = await openExplorer();
  const at = { initials: "A", colour: 1, instance: 1, line: 1, anchor: null, head: "x" };
  server.on("GET", "/projects/*/unsaved", () => ["Main.st"]);
  render(<DeleteFile path="Main.st" onClose={() => undefined} />);
  const asking = await screen.findByRole("dialog", { name: t("file.delete.title", { path: "Main.st" }) });
  await waitFor(() => expect(textOf(asking)).toContain(t("file.delete.unsaved")));
  server.say({ type: "people", you: 1, people: [{ ...at, id: 2, name: "Aki", file: "Main.st" }] });
  await waitFor(() => expect(textOf(asking)).toContain(t("file.delete.here.unsaved", { names: "Aki" })));
  expect(textOf(asking)).not.toContain(t("file.delete.unsaved"));
});
