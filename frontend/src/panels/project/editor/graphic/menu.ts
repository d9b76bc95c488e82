/** The menu of a place in a drawing. Each entry is a key of the drawing, and does what that does. */

import type { Place } from "../../../../logic/graphic/ladderLayout";
import type { DrawnPart } from "../../../../logic/graphic/sheet";
import { type TextKey, t } from "../../../../text";
import type { IconName } from "../../../../ui/Icon";
import type { MenuItem } from "../../../../ui/Menu";
import { FORCE, operandAt } from "./operand";

interface Entry {
  key: string;
  word: TextKey;
  icon?: IconName;
  /** As it is shown, where there is a key for it: empty where there is none. */
  shown?: string;
}

const NAME: Entry = { key: "Enter", word: "graphic.menu.name" };
const MODE: readonly Entry[] = [
  { key: "!", word: "graphic.menu.negate" },
  { key: "e", word: "graphic.menu.edge" },
];
const HEAD: readonly Entry[] = [
  { key: "t", word: "graphic.menu.title" },
  { key: ";", word: "graphic.menu.comment" },
  { key: "Ctrl+/", word: "graphic.menu.off" },
];

const INSERT: Record<DrawnPart["kind"], readonly Entry[]> = {
  rung: [
    { key: "c", word: "graphic.menu.contact" },
    { key: "/", word: "graphic.menu.closed" },
    { key: "w", word: "graphic.menu.below" },
    { key: "o", word: "graphic.menu.coil" },
    { key: "s", word: "graphic.menu.set" },
    { key: "r", word: "graphic.menu.reset" },
    { key: "f", word: "graphic.menu.box" },
    { key: "Ctrl+I", word: "graphic.menu.rung" },
  ],
  network: [
    { key: "f", word: "graphic.menu.box" },
    { key: "a", word: "graphic.menu.assign" },
    { key: "+", word: "graphic.menu.input" },
    { key: "j", word: "graphic.menu.jump" },
    { key: "Ctrl+I", word: "graphic.menu.network" },
  ],
  chart: [
    { key: "s", word: "graphic.menu.step" },
    { key: "a", word: "graphic.menu.action" },
    { key: "v", word: "graphic.menu.alternative" },
    { key: "p", word: "graphic.menu.parallel" },
    { key: "j", word: "graphic.menu.jump" },
  ],
};

const COPY: Entry = { key: "Ctrl+C", word: "graphic.menu.copy" };
const CLIPBOARD: readonly Entry[] = [
  { key: "Ctrl+X", word: "graphic.menu.cut" },
  COPY,
  { key: "Ctrl+V", word: "graphic.menu.paste" },
  { key: "Delete", shown: "Del", word: "graphic.menu.delete", icon: "trash" },
];

const OPERAND: readonly Entry[] = [
  { key: "Ctrl+Alt+W", word: "graphic.menu.watch" },
  { key: FORCE.true, shown: "", word: "graphic.menu.force.true" },
  { key: FORCE.false, shown: "", word: "graphic.menu.force.false" },
  { key: FORCE.release, shown: "", word: "graphic.menu.release" },
  { key: "Shift+F12", word: "graphic.menu.writer" },
  { key: "Ctrl+Alt+R", word: "graphic.menu.uses" },
];
const RENAME: Entry = { key: "Ctrl+F2", word: "graphic.menu.rename" };
const BREAKPOINT: Entry = { key: "F9", word: "graphic.menu.breakpoint", icon: "bp" };

/** What can be done at a place of a part; without a place with all of it. `press` does what the key of that name does. */
export function menuOf(
  part: DrawnPart | undefined,
  place: Place,
  readOnly: boolean,
  press: (key: string) => void,
): MenuItem[] {
  if (!part) return [];
  const at = place.length > 0;
  const variable = operandAt(part, place) !== null;
  const modes = at && part.kind !== "chart" ? MODE : [];
  const edits = [at ? [NAME, ...modes] : [], INSERT[part.kind], CLIPBOARD, !at && part.kind !== "chart" ? HEAD : []];
  const groups: (readonly Entry[])[] = [
    ...(readOnly ? [[COPY]] : edits),
    variable ? [...OPERAND, ...(readOnly ? [] : [RENAME])] : [],
    at ? [BREAKPOINT] : [],
  ];
  return groups.flatMap((entries, group) =>
    entries.map(({ key, word, icon, shown }, index) => ({
      label: t(word),
      ...(icon ? { icon } : {}),
      hint: shown ?? (key.length === 1 ? key.toUpperCase() : key),
      separated: index === 0 && groups.slice(0, group).some((before) => before.length > 0),
      onSelect: () => press(key),
    })),
  );
}
