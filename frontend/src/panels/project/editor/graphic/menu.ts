/** The menu of a place in a drawing. Each entry is a key of the drawing, and does what that does. */

import type { Place } from "../../../../logic/graphic/ladderLayout";
import type { DrawnPart } from "../../../../logic/graphic/sheet";
import { type TextKey, t } from "../../../../text";
import type { IconName } from "../../../../ui/Icon";
import type { MenuItem } from "../../../../ui/Menu";
import { FORCE, type Forcing, operandAt } from "./operand";
import { DELETE, INSERTS, keyText, MODES, NAME, NEXT, type Tool } from "./tools";

interface Entry {
  key: string;
  word: TextKey;
  icon?: IconName;
  /** As it is shown, where there is a key for it: empty where there is none. */
  shown?: string;
}

const said = ({ what, ...tool }: Tool): Entry => ({ ...tool, word: `graphic.menu.${what}` });

const OFF: Entry = { key: "Ctrl+/", word: "graphic.menu.off" };
const HEAD: readonly Entry[] = [
  { key: "t", word: "graphic.menu.title" },
  { key: ";", word: "graphic.menu.comment" },
  OFF,
];

const COPY: Entry = { key: "Ctrl+C", word: "graphic.menu.copy" };
const CLIPBOARD: readonly Entry[] = [
  { key: "Ctrl+X", word: "graphic.menu.cut" },
  COPY,
  { key: "Ctrl+V", word: "graphic.menu.paste" },
  { ...said(DELETE), icon: "trash" },
];

/** Where no element is meant: as it is said of the whole part. */
const WHOLE: Partial<Record<TextKey, Partial<Record<DrawnPart["kind"], Entry>>>> = {
  "graphic.menu.contact": { rung: { key: "c", word: "graphic.menu.contact.start" } },
  "graphic.menu.closed": { rung: { key: "/", word: "graphic.menu.closed.start" } },
  "graphic.menu.box": { rung: { key: "f", word: "graphic.menu.box.start" } },
  "graphic.menu.coil": { rung: { key: "o", word: "graphic.menu.coil.end" } },
  "graphic.menu.set": { rung: { key: "s", word: "graphic.menu.set.end" } },
  "graphic.menu.reset": { rung: { key: "r", word: "graphic.menu.reset.end" } },
  "graphic.menu.delete": {
    rung: { key: "Ctrl+Delete", shown: "Ctrl+Del", word: "graphic.menu.delete.rung", icon: "trash" },
    network: { key: "Ctrl+Delete", shown: "Ctrl+Del", word: "graphic.menu.delete.network", icon: "trash" },
  },
};

/** There is nothing for a contact to be below of. */
const OF_ELEMENTS: readonly TextKey[] = ["graphic.menu.below"];

const WATCH: Entry = { key: "Ctrl+Alt+W", word: "graphic.menu.watch" };
const TO: readonly Entry[] = [
  { key: FORCE.true, shown: "", word: "graphic.menu.force.true" },
  { key: FORCE.false, shown: "", word: "graphic.menu.force.false" },
];
const RELEASE: Entry = { key: FORCE.release, shown: "", word: "graphic.menu.release" };
const USES: readonly Entry[] = [
  { key: "Shift+F12", word: "graphic.menu.writer" },
  { key: "Ctrl+Alt+R", word: "graphic.menu.uses" },
];
const RENAME: Entry = { key: "Ctrl+F2", word: "graphic.menu.rename" };
const BREAKPOINT: Entry = { key: "F9", word: "graphic.menu.breakpoint", icon: "bp" };

export interface Several {
  count: number;
  of: "elements" | "rungs" | "networks";
}

interface Can {
  readOnly: boolean;
  /** What is chosen together, where the menu is of that: how many, and of what. */
  several?: Several | null;
  forcing: Forcing;
  /** Whether the key of that name means something at the place. */
  can: (key: string) => boolean;
  /** Does what the key of that name does. */
  press: (key: string) => void;
}

/** What can be done at a place of a part; without a place with all of it. */
export function menuOf(part: DrawnPart | undefined, place: Place, asked: Can): MenuItem[] {
  const { readOnly, several, forcing, can, press } = asked;
  if (!part) return [];
  if (several) return itemsOf(readOnly ? [[COPY]] : editsOfSeveral(several), press, several.count);
  const groups = readOnly ? [[COPY]] : editsOf(part, place, can);
  if (operandAt(part, place)) {
    const forces = [...(forcing.bool ? TO : []), ...(forcing.forced ? [RELEASE] : [])];
    groups.push([WATCH, ...forces, ...USES, ...(readOnly ? [] : [RENAME])]);
  }
  if (place.length > 0) groups.push([BREAKPOINT]);
  return itemsOf(groups, press);
}

function itemsOf(groups: readonly (readonly Entry[])[], press: Can["press"], count = 1): MenuItem[] {
  return groups.flatMap((entries, group) =>
    entries.map(({ key, word, icon, shown }, index) => ({
      label: t(word, { count }),
      ...(icon ? { icon } : {}),
      hint: keyText(shown === undefined ? { key } : { key, shown }),
      separated: index === 0 && groups.slice(0, group).some((before) => before.length > 0),
      onSelect: () => press(key),
    })),
  );
}

/** What the keys do with all that is chosen: see `useChosen`. */
function editsOfSeveral({ of }: Several): Entry[][] {
  const remove: Entry = { key: "Delete", shown: "Del", word: `graphic.menu.delete.${of}`, icon: "trash" };
  return [
    [...CLIPBOARD.filter(({ key }) => key !== "Delete" && key !== "Ctrl+V"), remove],
    of === "elements" ? [] : [OFF],
  ];
}

function editsOf(part: DrawnPart, place: Place, can: Can["can"]): Entry[][] {
  const at = place.length > 0;
  const first = at ? [NAME, ...MODES[part.kind]].map(said) : [];
  const inserts = [...INSERTS[part.kind], ...NEXT[part.kind]].map(said);
  const groups = [first, inserts, CLIPBOARD, !at && part.kind !== "chart" ? HEAD : []];
  const meant = (entry: Entry) => (at ? entry : (WHOLE[entry.word]?.[part.kind] ?? entry));
  const means = ({ key, word }: Entry) => (at || !OF_ELEMENTS.includes(word)) && (key.startsWith("Ctrl+") || can(key));
  return groups.map((entries) => entries.map(meant).filter(means));
}
