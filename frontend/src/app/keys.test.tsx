/** Keys of the window: one alone, and two that follow each other. */
import { fireEvent } from "@testing-library/react";
import { afterEach, beforeEach, expect, test } from "vitest";
import { SYMBOLS, showKeys, showPalette, useKeys, usePalette } from "../store/page/palette";
import { installKeys } from "./keys";

let remove = () => {};
beforeEach(() => {
  remove = installKeys();
});
afterEach(() => {
  remove();
  showKeys(false);
  showPalette(null);
});

const ctrl = (key: string) => fireEvent.keyDown(document.body, { key, ctrlKey: true });

test("Ctrl+T looks for symbols, and the browser gets no new tab", () => {
  expect(ctrl("t")).toBe(false); // its default is prevented
  expect(usePalette.getState().begins).toBe(SYMBOLS);
});

test("Ctrl+K Ctrl+S shows the keys, the second alone does not; what the editor does with Ctrl+K it still gets", () => {
  const seen: string[] = [];
  const see = (event: KeyboardEvent) => seen.push(event.key);
  document.body.addEventListener("keydown", see);
  ctrl("k");
  fireEvent.keyDown(document.body, { key: "Control" });
  ctrl("s");
  document.body.removeEventListener("keydown", see);
  expect(useKeys.getState().open).toBe(true);
  expect(seen).toEqual(["k", "Control", "s"]);
  showKeys(false);
  ctrl("s");
  ctrl("k");
  ctrl("x");
  ctrl("s");
  expect(useKeys.getState().open).toBe(false);
});
