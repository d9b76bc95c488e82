import { beforeEach, expect, it } from "vitest";
import { useBench } from "./bench";
import { query } from "./query";
import { instanceChanged } from "./reset";

const answers = new Map<string, { resolve: (text: string) => void; reject: (error: Error) => void }>();
const question = query(
  (instance: number, asked: string) =>
    new Promise<string>((resolve, reject) => answers.set(`${instance} ${asked}`, { resolve, reject })),
);

beforeEach(() => {
  question.close();
  useBench.setState({ instance: { id: 3 } as never });
});

it("uses only the answer to the last query", async () => {
  const first = question.ask("a");
  const second = question.ask("b");
  answers.get("3 b")?.resolve("of b");
  answers.get("3 a")?.resolve("of a");
  await Promise.all([first, second]);
  expect(question.use.getState()).toEqual({ asked: "b", found: "of b", refused: null });
});

it("keeps the reason of a refusal", async () => {
  const asked = question.ask("a");
  answers.get("3 a")?.reject(new Error("no"));
  await asked;
  expect(question.use.getState()).toEqual({ asked: "a", found: null, refused: "no" });
});

it("is closed by a change of the instance, and a late answer is dropped", async () => {
  const asked = question.ask("a");
  await instanceChanged({ project: {} as never, instance: null, otherProject: false });
  answers.get("3 a")?.resolve("late");
  await asked;
  expect(question.use.getState()).toEqual({ asked: null, found: null, refused: null });
});
