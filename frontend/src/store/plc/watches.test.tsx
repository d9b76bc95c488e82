import { expect, test } from "vitest";
import { eventually } from "../../testing/eventually";
import { openPage } from "../../testing/page";
import { useWatches, watch } from "./watches";

const PATH = "Main.third";

test("a path that the program of one scan has not is asked for again when a different program is shown", async () => {
  const { server } = await openPage();
  const release = watch([PATH]);
  await eventually(() => expect(useWatches.getState().refusals.has(PATH)).toBe(true));
  const asked = () => server.sentOf("watch").filter(({ paths }) => paths.includes(PATH)).length;
  expect(asked()).toBe(1);
  server.say({ type: "watching", ref: null, items: [] });
  await eventually(() => expect(asked()).toBe(2));
  release();
});
