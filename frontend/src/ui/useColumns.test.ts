import { expect, test } from "vitest";
import { roomFor } from "./useColumns";

test("a column has room for its longest text", () => {
  const room = (texts: string[]) => Number.parseFloat(roomFor(texts));
  expect(room(["Ada", "OPC UA Ada, Pure Python Client"])).toBe(room(["OPC UA Ada, Pure Python Client"]));
  expect(room(["OPC UA Ada, Pure Python Client"])).toBeGreaterThanOrEqual(30 * 7.3);
  expect(room([])).toBeGreaterThan(0);
});
