import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import * as Y from "yjs";
import { edit, openDocument, useDocuments } from "../store/project/documents";
import { encode } from "../store/project/sharedText";
import { button, textOf } from "../testing/find";
import { openPage } from "../testing/page";
import { refusal } from "../testing/routes";
import type { FakeServer } from "../testing/server";
import { t } from "../text";
import { CloseUnsaved } from "./CloseUnsaved";
import { useClosing } from "./closing";

const PATH = "Main.st";
const FILE = { path: PATH, version: 1, author: "Mika" };

/** The same, of a file that is edited together. */
const closeShared = () =>
  closeEdited(false, (server) => {
    const doc = new Y.Doc();
    doc.getText("text").insert(0, "stored");
    server.command("open_draft", () => {
      const update = encode(Y.encodeStateAsUpdate(doc));
      const vector = encode(Y.encodeStateVector(doc));
      server.say({ type: "draft", path: PATH, draft: "draft", update, vector, version: 1 });
      return undefined;
    });
  });

/** Somebody closes the tab of a file whose text was edited. */
async function closeEdited(refuses = false, prepare: (server: FakeServer) => void = () => undefined) {
  const page = await openPage((server) => {
    prepare(server);
    server.on("GET", "/projects/*/files", () => [FILE]);
    server.on("GET", "/projects/*/files/**", () => ({ ...FILE, text: "stored" }));
    server.on("PUT", "/projects/*/files/**", () => (refuses ? refusal("The disk is full.") : { ...FILE, version: 2 }));
  });
  await openDocument(PATH);
  edit(PATH, "mine");
  const closed: string[] = [];
  render(<CloseUnsaved onClosed={(panel) => closed.push(panel)} />);
  useClosing.setState({ panel: `file:${PATH}` });
  const dialog = await screen.findByRole("dialog", { name: t("close.title", { name: PATH }) });
  return { ...page, closed, dialog };
}

const gone = () => waitFor(() => expect(screen.queryByRole("dialog")).toBeNull());
const text = () => useDocuments.getState().open[PATH]?.text;

test("what was typed and not saved is asked about; cancelled, all is as it was", async () => {
  const { user, closed, dialog } = await closeEdited();
  await user.click(button(t("cancel"), dialog));
  await gone();
  expect(closed).toEqual([]);
  expect(text()).toBe("mine");
});

test("kept in the browser it is closed and comes back; discarded it does not", async () => {
  const { user, closed, dialog } = await closeEdited();
  await user.click(button(t("close.keep"), dialog));
  await gone();
  expect(closed).toHaveLength(1);
  expect(Object.values(localStorage).join()).toContain("mine");
  useClosing.setState({ panel: `file:${PATH}` });
  await user.click(await screen.findByRole("button", { name: t("close.discard") }));
  await gone();
  expect(closed).toHaveLength(2);
  expect(text()).toBe("stored");
  expect(Object.values(localStorage).join()).not.toContain("mine");
});

test("while others are in the file it is not discarded", async () => {
  const { server, dialog } = await closeShared();
  expect(button(t("close.discard"), dialog)).toBeDefined();
  const place = { colour: 1, initials: "X", instance: server.instance.id, line: 1, anchor: null, head: null };
  const grace = { id: 2, name: "Grace", file: PATH, ...place };
  server.say({ type: "people", you: 1, people: [{ id: 1, name: "Ada", file: PATH, ...place }, grace] });
  await waitFor(() => expect(textOf(dialog)).toContain(t("close.hint.others", { names: "Grace" })));
  expect(within(dialog).queryByRole("button", { name: t("close.discard") })).toBeNull();
  server.say({ type: "people", you: 1, people: [{ id: 1, name: "Ada", file: PATH, ...place }] });
  await within(dialog).findByRole("button", { name: t("close.discard") });
});

test("saved from the question it is closed; what cannot be saved stays, with the reason", async () => {
  const refused = await closeEdited(true);
  await refused.user.click(button(t("save"), refused.dialog));
  await waitFor(() => expect(textOf(within(refused.dialog).getByRole("alert"))).toContain("The disk is full."));
  expect(refused.closed).toEqual([]);
  refused.server.on("PUT", "/projects/*/files/**", () => ({ ...FILE, version: 2 }));
  await refused.user.click(button(t("save"), refused.dialog));
  await gone();
  expect(refused.closed).toHaveLength(1);
});
