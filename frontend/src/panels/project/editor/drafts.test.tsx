/** Texts that a browser has and the server has not (yet): they come back once, whole, and nothing is forgotten that nobody else has. */
import { render, screen } from "@testing-library/react";
import { expect, onTestFinished, test, vi } from "vitest";
import * as Y from "yjs";
import { closeDocument, edit, openDocument, save, useDocuments } from "../../../store/project/documents";
import { unsent } from "../../../store/project/drafts";
import { decode, encode } from "../../../store/project/sharedText";
import { eventually } from "../../../testing/eventually";
import { openPage } from "../../../testing/page";
import { Status } from "../../../testing/routes";
import type { FakeServer, Verdict } from "../../../testing/server";
import { t } from "../../../text";
import type { ClientMessage } from "../../../wire/types";
import { EditorPanel } from "./EditorPanel";

const PATH = "Main.st";
const DRAFT = "draft";

/** The drafts of a server: one file. */
class Shared {
  readonly doc = new Y.Doc();
  /** Why changes are refused. */
  refusal: Verdict;
  refusesToOpen: string | undefined;

  constructor(private readonly server: FakeServer) {
    this.text.insert(0, "saved");
    server.on("GET", "/projects/*/files", () => [{ path: PATH, version: 1, author: "Mika" }]);
    server.on("GET", "/projects/*/files/**", () => ({ path: PATH, version: 1, author: "Mika", text: "saved" }));
    server.command("open_draft", (asked) => this.opens(asked));
    server.command("edit_draft", ({ update }) => {
      if (this.refusal === undefined) Y.applyUpdate(this.doc, decode(update));
      return this.refusal;
    });
  }

  get text(): Y.Text {
    return this.doc.getText("text");
  }

  private opens({ draft, vector }: Extract<ClientMessage, { type: "open_draft" }>): string | undefined {
    if (this.refusesToOpen !== undefined) return this.refusesToOpen;
    const known = draft === DRAFT && vector ? decode(vector) : undefined;
    this.server.say({
      type: "draft",
      path: PATH,
      draft: DRAFT,
      update: encode(Y.encodeStateAsUpdate(this.doc, known)),
      vector: encode(Y.encodeStateVector(this.doc)),
      version: 1,
    });
    return undefined;
  }
}

async function openBench(prepare: (drafts: Shared) => void = () => undefined) {
  let drafts: Shared | undefined;
  const page = await openPage((server) => {
    drafts = new Shared(server);
    prepare(drafts);
  });
  if (!drafts) throw new Error("openPage prepares the server");
  onTestFinished(() => closeDocument(PATH));
  return { ...page, drafts };
}

async function openShared() {
  const bench = await openBench();
  await openDocument(PATH);
  return bench;
}

/** Time goes by as the test says. */
function withOwnClock() {
  vi.useFakeTimers({ toFake: ["setTimeout", "clearTimeout"] });
  onTestFinished(() => void vi.useRealTimers());
}

function projectNow(): number {
  const { project } = useDocuments.getState();
  if (project === null) throw new Error("the page shows no project");
  return project;
}

const textHere = () => useDocuments.getState().open[PATH]?.text;
const keptTexts = () => Object.entries(localStorage).filter(([, text]) => String(text).includes(" typed"));
/** What a page before had typed and not sent. */
function leftover(drafts: Y.Doc, text: string): { draft: string; update: string; text: string; version: number } {
  const page = new Y.Doc();
  Y.applyUpdate(page, Y.encodeStateAsUpdate(drafts));
  const before = Y.encodeStateVector(page);
  page.getText("text").insert(page.getText("text").length, text);
  const update = encode(Y.encodeStateAsUpdate(page, before));
  return { draft: DRAFT, update, text: page.getText("text").toString(), version: 1 };
}

const keep = (key: string, value: object) => localStorage.setItem(`scanbench.${key}`, JSON.stringify(value));

test("what was not sent, and was edited on without the draft, is there once", async () => {
  const { drafts } = await openBench((server) => {
    server.refusesToOpen = "The database is locked.";
  });
  keep(`unsent.${projectNow()}.${PATH}//before`, leftover(drafts.doc, " typed"));
  withOwnClock();
  await openDocument(PATH);
  expect(textHere()).toBe("saved typed");
  edit(PATH, "saved typed on");
  drafts.refusesToOpen = undefined;
  await vi.advanceTimersByTimeAsync(5000);
  await eventually(() => expect(drafts.text.toString()).toBe("saved typed on"));
  await eventually(() => expect(keptTexts()).toEqual([]));
});

test("a change that the server refused is sent again after the draft was opened again", async () => {
  const { drafts, server } = await openShared();
  withOwnClock();
  drafts.refusal = "open Main.st first";
  edit(PATH, "saved typed");
  await eventually(() => expect(server.sentOf("edit_draft")).toHaveLength(1));
  drafts.refusal = undefined;
  await vi.advanceTimersByTimeAsync(5000);
  await eventually(() => expect(drafts.text.toString()).toBe("saved typed"));
  expect(server.sentOf("open_draft")).toHaveLength(2);
});

test("what the server never takes is said, kept here, and sent again only with the next change", async () => {
  const { drafts, server } = await openShared();
  render(<EditorPanel path={PATH} />);
  withOwnClock();
  drafts.refusal = { message: "the text would have 3000000 bytes", near: [], final: true };
  edit(PATH, "saved typed");
  await eventually(() => expect(screen.getByRole("alert").textContent).toContain("3000000 bytes"));
  expect(screen.getByRole("alert").textContent).toContain(t("draft.refused.kept"));
  await vi.advanceTimersByTimeAsync(10_000);
  expect(server.sentOf("edit_draft")).toHaveLength(1);
  expect(textHere()).toBe("saved typed");
  expect(keptTexts()).toHaveLength(1);
  drafts.refusal = undefined;
  edit(PATH, "saved type");
  await eventually(() => expect(drafts.text.toString()).toBe("saved type"));
  await eventually(() => expect(screen.queryByRole("alert")).toBeNull());
  expect(keptTexts()).toEqual([]);
});

test("what a different page of this browser has not sent is not forgotten when all of this page is", async () => {
  const { drafts } = await openShared();
  const key = `unsent.${projectNow()}.${PATH}//other`;
  keep(key, leftover(drafts.doc, " typed there"));
  edit(PATH, "saved typed");
  await eventually(() => expect(drafts.text.toString()).toBe("saved typed"));
  await eventually(() => expect(keptTexts().map(([name]) => name)).toEqual([`scanbench.${key}`]));
});

test("what was typed is kept after its frame, and at once where the page goes before", async () => {
  await openShared();
  edit(PATH, "saved typed");
  dispatchEvent(new Event("pagehide"));
  expect(keptTexts()).toHaveLength(1);
});

test("a file that is closed before its last change is acknowledged is forgotten then", async () => {
  const { drafts } = await openShared();
  edit(PATH, "saved typed");
  closeDocument(PATH);
  expect(keptTexts()).toHaveLength(1);
  await eventually(() => expect(drafts.text.toString()).toBe("saved typed"));
  await eventually(() => expect(unsent(PATH)).toBeNull());
  await eventually(() => expect(keptTexts()).toEqual([]));
});

test("who saved second saves what the first one saved as well, though the draft tells it later", async () => {
  const { drafts, server } = await openShared();
  edit(PATH, "saved typed");
  await eventually(() => expect(drafts.text.toString()).toBe("saved typed"));
  drafts.text.insert(0, "theirs ");
  const saved: unknown[] = [];
  server.on("PUT", "/projects/*/files/**", ({ body }) => {
    saved.push(body.text);
    if (body.version === 2) return { path: PATH, version: 3, author: "Mika" };
    const theirs = { path: PATH, version: 2, author: "Grace", text: "theirs saved" };
    return new Status(409, { message: "somebody was first", theirs });
  });
  await save(PATH);
  expect(saved).toEqual(["saved typed", "theirs saved typed"]);
});
