import { wiresIn } from "../../../../logic/graphic/diagramEdit";
import type { Around, Box } from "../../../../logic/graphic/edit";
import { spotOfPin } from "../../../../logic/graphic/ladderPins";
import { inText } from "../../../../logic/graphic/places";
import { type DrawnPart, stopsOf } from "../../../../logic/graphic/sheet";
import { loadBoxes, variablesAt } from "../../../../store/graphic/boxes";
import { t } from "../../../../text";
import type { Offer } from "../../../../ui/useOffers";
import { sameElement } from "./cursor";
import { NameField } from "./NameField";
import { nameOfBoxPin, nameOfStop } from "./names";
import type { Named } from "./reopened";

interface Props {
  path: string;
  /** As it is in the file. */
  written: DrawnPart;
  /** As it is drawn while the field is open. */
  part: DrawnPart;
  /** How large it is drawn. */
  scale: number;
  named: Named;
  around: (part: DrawnPart) => Around;
  onTake: (text: string, onwards: boolean) => boolean;
  onLeave: () => void;
}

/** The field of the element that is being named, with what it offers. */
export function ElementField({ path, written, part, scale, named, around, onTake, onLeave }: Props) {
  const { naming, place, lost } = named;
  const { head } = naming;
  const found = head || lost ? undefined : stopsOf(part).find((each) => sameElement(each.place, place));
  if (!head && !lost && !found) return null;
  const pinned =
    found && naming.pin !== undefined && part.kind === "rung" && part.drawing
      ? spotOfPin(part.drawing, place, naming.pin)
      : null;
  const at = inText(written, written.found.body.at);

  async function names(): Promise<readonly Offer[]> {
    const { offers } = naming;
    if (offers === "none") return [];
    if (offers === "box") {
      await loadBoxes(path, at);
      return around(written).boxes.map(offerOf);
    }
    if (offers === "step") return stepsIn(part).map((name) => ({ path: name, type: "" }));
    const variables = await variablesAt(path, at);
    const fits = variables.filter(({ type }) => offers === "value" || type === "BOOL");
    const outputs = around(written).boxes.flatMap(({ kind, name, outputs }) =>
      kind === "instance" ? outputs.map((pin) => ({ path: `${name}.${pin}`, type: "" })) : [],
    );
    const wires = offers === "value" ? wiresIn(named.text).map((name) => ({ path: name, type: "" })) : [];
    return [...wires, ...fits.map(({ name, type }) => ({ path: name, type })), ...outputs];
  }

  async function take(text: string, onwards: boolean): Promise<boolean> {
    // What was typed quickly may come before the first answer of the server.
    if (naming.offers === "box" && around(written).boxes.length === 0) await loadBoxes(path, at);
    return onTake(text, onwards);
  }

  return (
    <NameField
      key={named.opened.id}
      naming={naming}
      spot={found ? scaled(pinned ?? found, scale) : HEAD}
      label={
        found
          ? (nameOfBoxPin(found, naming.pin) ?? nameOfStop(found))
          : t(head ? `graphic.head.${head}` : "graphic.field.lost")
      }
      lost={lost}
      names={names}
      onTake={take}
      onLeave={onLeave}
    />
  );
}

/** Above the drawing. */
const HEAD = { x: 0, y: -8, width: 360 };

const scaled = ({ x, y, width, up = 0 }: { x: number; y: number; width: number; up?: number }, scale: number) => ({
  x: x * scale,
  y: y * scale,
  width: width * scale,
  up: up * scale,
});

const ICONS = { function: "fn", block: "fb", instance: "var" } as const;

const offerOf = ({ name, kind, type, inputs, outputs, more, comment }: Box): Offer => {
  const pins = `${inputs.join(", ")}${more ? ", …" : ""}${outputs.length > 0 ? ` → ${outputs.join(", ")}` : ""}`;
  return { path: name, type: kind === "instance" ? type : pins, about: comment || " ", icon: ICONS[kind] };
};

const stepsIn = (part: DrawnPart) =>
  part.kind === "chart"
    ? (part.drawing?.elements.flatMap(({ element }) => (element.kind === "step" ? [element.name] : [])) ?? [])
    : [];
