import { beforeEach, expect, it, vi } from "vitest";
import type { WatchNote } from "../../logic/watch/watchrows";
import { dismissRefusals, force, releaseForce, useWatchList, write } from "./watchlist";

const answers = vi.hoisted(() => new Map<string, { ok: boolean; sent: boolean; message: string }>());
const refused = { ok: false, sent: true, message: "D100 may not be written" };
vi.mock("../../wire/send", () => ({
  newRef: () => 1,
  send: async ({ path }: { path: string | null }) => answers.get(path ?? "") ?? { ok: true, sent: true, message: "" },
}));
vi.mock("../../wire/socket", () => ({ link: { post: () => true } }));

const notes = () => [...useWatchList.getState().notes].map(([path, { kind }]) => `${path} ${kind}`);

beforeEach(async () => {
  answers.clear();
  const unsent: WatchNote = { kind: "unsent", message: "", near: [], instead: [] };
  useWatchList.setState({ notes: new Map([["c", unsent]]) });
  answers.set("a", refused);
  await write("a", "a", "9");
  expect(notes()).toEqual(["c unsent", "a refused"]);
});

it("a refusal disappears while the same row is written again", async () => {
  const again = write("a", "a", "8");
  expect(notes()).toEqual(["c unsent"]);
  await again;
  expect(notes()).toEqual(["c unsent", "a refused"]);
});

it("a refusal disappears after a later action: written, forced, released", async () => {
  for (const done of [() => write("b", "b", "1"), () => force("b", "b", "1"), () => releaseForce("b")]) {
    await write("a", "a", "9");
    expect(notes()).toEqual(["c unsent", "a refused"]);
    await done();
    expect(notes()).toEqual(["c unsent"]);
  }
});

it("a refusal stays while a further action is refused, and disappears when it is dismissed", async () => {
  answers.set("b", refused);
  await write("b", "b", "1");
  expect(notes()).toEqual(["c unsent", "a refused", "b refused"]);
  expect(dismissRefusals()).toBe(true);
  expect(notes()).toEqual(["c unsent"]);
  expect(dismissRefusals()).toBe(false);
});
