/** Search and replace reach the texts of all files as people edit them, also of those that are not open here. */
import { render, screen, waitFor } from "@testing-library/react";
import { expect, onTestFinished, test } from "vitest";
import * as Y from "yjs";
import { closeDocument } from "../../../store/project/documents";
import { look, useSearch } from "../../../store/project/search";
import { decode, encode } from "../../../store/project/sharedText";
import { openPage } from "../../../testing/page";
import { refusal } from "../../../testing/routes";
import { t } from "../../../text";
import { SearchPanel } from "./SearchPanel";

const file = (path: string) => ({ path, version: 1, author: "Grace" });

/** Two files: others edited Belt.st and did not save it. */
async function openSearch(answersDrafts = true) {
  const doc = new Y.Doc();
  doc.getText("text").insert(0, "speed := 2;\nspeed := 3;\n");
  const page = await openPage((server) => {
    server.on("GET", "/projects/*/files", () => [file("Belt.st"), file("Main.st")]);
    server.on("GET", "/projects/*/files/**", (_, [, , path]) => ({ ...file(path ?? ""), text: "speed := 1;\n" }));
    server.on("GET", "/projects/*/drafts", () =>
      answersDrafts ? [{ path: "Belt.st", text: doc.getText("text").toString() }] : refusal("the disk is full"),
    );
    server.command("open_draft", ({ path }) => {
      const mine = path === "Belt.st" ? doc : new Y.Doc();
      if (mine !== doc) mine.getText("text").insert(0, "speed := 1;\n");
      const update = encode(Y.encodeStateAsUpdate(mine));
      server.say({ type: "draft", path, draft: path, update, vector: encode(Y.encodeStateVector(mine)), version: 1 });
      return undefined;
    });
    server.command("edit_draft", ({ path, update }) => {
      if (path === "Belt.st") Y.applyUpdate(doc, decode(update));
      return undefined;
    });
  });
  onTestFinished(() => {
    look({ text: "" });
    for (const path of ["Belt.st", "Main.st"]) closeDocument(path);
  });
  render(<SearchPanel />);
  return { ...page, draft: () => doc.getText("text").toString() };
}

test("a text that others edited and nobody saved is searched, and replaced as they have it", async () => {
  const { user, draft } = await openSearch();
  await user.type(screen.getByRole("textbox", { name: t("search.text") }), "speed");
  await screen.findByText(t("search.count", { count: 3, files: 2 }));
  await user.type(screen.getByRole("textbox", { name: t("search.by") }), "rate");
  await user.click(screen.getByRole("button", { name: t("search.all", { count: 3 }) }));
  await waitFor(() => expect(draft()).toBe("rate := 2;\nrate := 3;\n"));
  await screen.findByText(t("search.none"));
});

test("where the server does not say what is not saved, the files are named that were not searched", async () => {
  const { user } = await openSearch(false);
  await user.type(screen.getByRole("textbox", { name: t("search.text") }), "speed");
  const alert = await screen.findByRole("alert");
  expect(alert.textContent).toContain(t("search.unread", { paths: "Belt.st, Main.st" }));
  expect(useSearch.getState().found).toEqual([]);
});
