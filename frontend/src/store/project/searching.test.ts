import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { searcher } from "./searching";

/** A worker that answers when it is told to. */
class Slow {
  onmessage: ((event: { data: unknown }) => void) | null = null;
  onerror: (() => void) | null = null;
  asked: unknown[] = [];
  ended = false;
  postMessage(question: unknown): void {
    this.asked.push(question);
  }
  terminate(): void {
    this.ended = true;
  }
}

const workers: Slow[] = [];
const begin = () => {
  const worker = new Slow();
  workers.push(worker);
  return worker as unknown as Worker;
};
const question = (text: string) => ({
  wanted: { text, cased: false, whole: false, regex: true },
  texts: [{ path: "Main.st", text: "x" }],
});

beforeEach(() => {
  workers.length = 0;
  vi.useFakeTimers();
});
afterEach(() => {
  vi.useRealTimers();
});

test("one worker answers one question after the other", async () => {
  const ask = searcher(begin);
  for (const text of ["a", "b"]) {
    const answer = ask(question(text));
    workers[0]?.onmessage?.({ data: [{ path: text, matches: [] }] });
    expect(await answer).toEqual([{ path: text, matches: [] }]);
  }
  expect(workers).toHaveLength(1);
  expect(workers[0]?.asked).toEqual([question("a"), question("b")]);
});

test("an expression that takes too long is ended, and the next question has a worker of its own", async () => {
  const ask = searcher(begin);
  const never = ask(question("(x+)+y"));
  vi.runAllTimers();
  expect(await never).toBeNull();
  expect(workers[0]?.ended).toBe(true);
  const answer = ask(question("x"));
  workers[1]?.onmessage?.({ data: [] });
  expect(await answer).toEqual([]);
});

test("the next question ends the one before", async () => {
  const ask = searcher(begin);
  const before = ask(question("(x+)+y"));
  const after = ask(question("x"));
  expect(await before).toBeNull();
  workers[1]?.onmessage?.({ data: [] });
  expect(await after).toEqual([]);
});
