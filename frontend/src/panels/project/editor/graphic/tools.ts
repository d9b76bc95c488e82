/** What can be put in and done at a place of a drawing, by its key: its menu and its buttons have the same. */

import type { DrawnPart } from "../../../../logic/graphic/sheet";

type Kind = DrawnPart["kind"];

interface Of<What extends string> {
  /** As the keyboard is named: what is done is what the key does. */
  key: string;
  /** As it is shown, where that is different; empty where there is no key. */
  shown?: string;
  what: What;
}

/** Each has a word in the menu, `graphic.menu.`, and a shorter one on its button, `graphic.tool.`. */
export type Tool = Of<
  | ("contact" | "closed" | "below" | "coil" | "set" | "reset" | "box" | "assign" | "input" | "jump")
  | ("step" | "action" | "alternative" | "parallel" | "negate" | "edge" | "name" | "delete" | "rung" | "network")
>;

export const NAME: Tool = { key: "Enter", what: "name" };
export const DELETE: Tool = { key: "Delete", shown: "Del", what: "delete" };

export const INSERTS: Record<Kind, readonly Tool[]> = {
  rung: [
    { key: "c", what: "contact" },
    { key: "/", what: "closed" },
    { key: "w", what: "below" },
    { key: "o", what: "coil" },
    { key: "s", what: "set" },
    { key: "r", what: "reset" },
    { key: "f", what: "box" },
  ],
  network: [
    { key: "f", what: "box" },
    { key: "a", what: "assign" },
    { key: "+", what: "input" },
    { key: "j", what: "jump" },
  ],
  chart: [
    { key: "s", what: "step" },
    { key: "a", what: "action" },
    { key: "v", what: "alternative" },
    { key: "p", what: "parallel" },
    { key: "j", what: "jump" },
  ],
};

const MODE: readonly Tool[] = [
  { key: "!", what: "negate" },
  { key: "e", what: "edge" },
];
export const MODES: Record<Kind, readonly Tool[]> = { rung: MODE, network: MODE, chart: [] };

/** A part of its own below. */
export const NEXT: Record<Kind, readonly Tool[]> = {
  rung: [{ key: "Ctrl+I", what: "rung" }],
  network: [{ key: "Ctrl+I", what: "network" }],
  chart: [],
};

/** As a key is written for people. */
export const keyText = ({ key, shown }: { key: string; shown?: string }) =>
  shown ?? (key.length === 1 ? key.toUpperCase() : key);
