import { beforeAll, expect, test, vi } from "vitest";
import type { PlcSymbol } from "../../wire/types";
import { apply, assign, bindCell, currentText, drop } from "./values";

const int: PlcSymbol = {
  path: "",
  name: "",
  type: "INT",
  kind: "int",
  size: 2,
  address: null,
  writable: true,
  section: "VAR",
  expandable: false,
  values: [],
  range: "",
  in_out: false,
};

const frame = (id: number, value: number) => ({
  full: false,
  scan: 1,
  timeNs: 0,
  ids: new Uint32Array([id]),
  values: new Uint8Array([value, 0, 0, 0, 0, 0, 0, 0]),
  strings: [],
});

beforeAll(() => vi.stubGlobal("requestAnimationFrame", () => 0));

test("a value that others still watch is not shown in the place of a different value", () => {
  assign("Main.a", 7, int);
  apply(frame(7, 11));
  drop("Main.a", 7);
  bindCell("Main.b", "default", () => undefined);
  assign("Main.b", 8, int);
  apply(frame(8, 22));
  apply(frame(7, 33)); // frames are the same for everybody
  expect(currentText("Main.b")).toBe("22");
});

test("a variable that is watched again shows its value again", () => {
  assign("Main.c", 9, int);
  apply(frame(9, 1));
  drop("Main.c", 9);
  assign("Main.c", 9, int);
  apply(frame(9, 2));
  expect(currentText("Main.c")).toBe("2");
});

test("a reference shows the name of what it refers to", () => {
  assign("Main.r", 10, { ...int, type: "REF_TO INT", kind: "ref", size: 8 });
  bindCell("Main.r", "default", () => undefined);
  apply({ ...frame(11, 0), strings: [{ id: 10, bytes: new TextEncoder().encode("-> Main.größe") }] });
  expect(currentText("Main.r")).toBe("-> Main.größe");
});
