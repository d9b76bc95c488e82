/** What readers say about an element: its kind, its operand, its mode. Its value is said when it is selected. */

import type { ChartElement } from "../../../../logic/graphic/chartLayout";
import { type DiagramItem, NOTHING } from "../../../../logic/graphic/diagram";
import type { DiagramDrawn } from "../../../../logic/graphic/diagramLayout";
import type { PinSpot } from "../../../../logic/graphic/diagramPins";
import type { Drawn } from "../../../../logic/graphic/ladderLayout";
import type { Spot } from "../../../../logic/graphic/sheet";
import type { Box } from "../../../../logic/graphic/tree";
import { type TextKey, t } from "../../../../text";

const CONTACT: Record<string, TextKey> = {
  "": "graphic.contact",
  "/": "graphic.contact.negated",
  P: "graphic.contact.rising",
  N: "graphic.contact.falling",
};
const COIL: Record<string, TextKey> = {
  "": "graphic.coil",
  "/": "graphic.coil.negated",
  S: "graphic.coil.set",
  R: "graphic.coil.reset",
  P: "graphic.coil.rising",
  N: "graphic.coil.falling",
};

export function nameOf(element: Drawn["element"]): string {
  switch (element.kind) {
    case "contact":
      return t(CONTACT[element.mode] ?? "graphic.contact", { name: element.operand });
    case "coil":
      return t(COIL[element.mode] ?? "graphic.coil", { name: element.operand });
    case "box":
      return t("graphic.box", { name: element.callee });
    case "send":
      return t("graphic.send", { name: element.name });
    case "receive":
      return t("graphic.receive", { name: element.name });
    case "jump":
      return element.label === null ? t("graphic.return") : t("graphic.jump", { label: element.label });
  }
}

export function nameOfChartElement(element: ChartElement): string {
  switch (element.kind) {
    case "step":
      return t(element.initial ? "graphic.step.initial" : "graphic.step", { name: element.name });
    case "transition":
      return t("graphic.transition", {
        from: element.from.join(", "),
        to: element.to.join(", "),
        condition: element.condition,
      });
    case "action":
      return t("graphic.action", {
        name: element.action,
        qualifier: `${element.qualifier} ${element.duration}`.trim(),
        step: element.step,
      });
  }
}

/** A line of a function block diagram, with its number in the order of execution. */
export function nameOfItem({ kind, callee, inputs, outputs, label }: DiagramItem, order: number): string {
  const targets = outputs.map(({ target }) => target).join(", ");
  const value = inputs.map(({ text, negated }) => (negated ? `NOT ${text}` : text)).join(", ");
  if (kind === "box")
    return t(targets === "" ? "graphic.item.call" : "graphic.item.box", { order, name: callee, targets });
  if (kind === "value") return t("graphic.item.value", { order, value, targets });
  return label === "" ? t("graphic.item.return", { order }) : t("graphic.item.jump", { order, label });
}

/** A pin, without what reads as its item: that has a name of its own. */
export function nameOfPin({ of, index, side }: PinSpot): string {
  const { item } = of.element;
  const box = item.callee || t("graphic.pin.line", { order: of.order });
  if (side === "output") {
    const { name = "", target = "" } = item.outputs[index] ?? {};
    return t("graphic.pin.output", { name, box, target }).replace(/ {2,}/g, " ");
  }
  const { name = "", text = "", negated = false } = item.inputs[index] ?? {};
  const value = text === NOTHING ? t("graphic.nothing") : negated ? `NOT ${text}` : text;
  return t("graphic.pin.input", { name: name || index + 1, box, value });
}

/** A pin of a box in a rung, by the number of its argument; null where none is meant. */
export function nameOfBoxPin({ element }: Spot, pin: number | undefined): string | null {
  if (pin === undefined || element.kind !== "box") return null;
  const { args, callee, result } = element as Box;
  const { name, value, out } = args[pin] ?? { name: "", value: result ?? "", out: true };
  const shown = value === NOTHING ? t("graphic.nothing") : value;
  return out
    ? t("graphic.pin.output", { name: name ?? "", box: callee, target: shown }).replace(/ {2,}/g, " ")
    : t("graphic.pin.input", { name: name ?? pin + 1, box: callee, value: shown });
}

/** Whatever the cursor can be at. */
export function nameOfStop(stop: Spot): string {
  const { element } = stop;
  if (element.kind === "pin") return nameOfPin(stop as PinSpot);
  if ("item" in element) return nameOfItem((stop as DiagramDrawn).element.item, (stop as DiagramDrawn).order);
  if (element.kind === "step" || element.kind === "transition" || element.kind === "action")
    return nameOfChartElement(element as ChartElement);
  return nameOf(element as Drawn["element"]);
}
