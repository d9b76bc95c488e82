/** What a key does to a function block diagram at the cursor. */

import { NOTHING } from "./diagram";
import {
  type At,
  at,
  type Diagram,
  diagramOf,
  headOf,
  lineAfter,
  negatedPin,
  nextPinEdge,
  swapped,
  withArgument,
  withoutArgument,
  withoutItem,
  withPin,
} from "./diagramEdit";
import { type Call, insertBox } from "./diagramInsert";
import {
  type Around,
  type Box,
  changed,
  type Edit,
  isName,
  isOnePiece,
  type Made,
  type Naming,
  newName,
  type Offers,
  type Refused,
  withDeclared,
} from "./edit";
import type { Place } from "./ladderLayout";

const UNREAD: Refused = { refused: "graphic.refused.unread" };

/** The network after a key; null where the key does nothing there. */
export function diagramEdit(text: string, key: string, place: Place, around: Around): Made {
  const diagram = diagramOf(text);
  const deed = DEEDS[key.length === 1 ? key.toLowerCase() : key];
  if (!deed) return null;
  return diagram ? deed(diagram, place, around) : UNREAD;
}

type Deed = (diagram: Diagram, place: Place, around: Around) => Made;

const DEEDS: Record<string, Deed> = {
  f: (diagram, place, around) => boxAt(diagram, place, around, false),
  "Shift+F": (diagram, place, around) => boxAt(diagram, place, around, true),
  a: assign,
  "+": addInput,
  "!": (diagram, place) => changedPin(diagram, place, negatedPin),
  e: (diagram, place) => changedPin(diagram, place, nextPinEdge),
  j: (diagram, place) => leave(diagram, place, `JMP ${NOTHING} IF ${NOTHING}`),
  "Shift+J": (diagram, place) => leave(diagram, place, `RETURN IF ${NOTHING}`),
  Delete: remove,
  Backspace: remove,
  Enter: name,
  F2: name,
  "Alt+ArrowUp": (diagram, place) => move(diagram, place, -1),
  "Alt+ArrowDown": (diagram, place) => move(diagram, place, 1),
};

const done = (text: string, place: Place): Edit => ({ text, place, naming: null });

/** The pin that is meant at a place: of what has one only that one. */
function pinAt(found: At | null) {
  return found && (found.input ?? (found.item.kind === "box" || found.output ? null : (found.item.inputs[0] ?? null)));
}

function changedPin(diagram: Diagram, place: Place, change: typeof negatedPin): Made {
  const found = at(diagram, place);
  if (!found) return null;
  if (found.output?.arg && change === negatedPin) {
    const { arg } = found.output;
    const written = diagram.text.slice(arg.at, arg.end);
    const text = found.output.negated ? written.replace(/^NOT\s+/i, "") : `NOT ${written}`;
    return done(changed(diagram.text, [{ ...arg, text }]), place);
  }
  const pin = pinAt(found);
  return pin ? done(withPin(diagram.text, pin, change(pin)), place) : { refused: "graphic.refused.pin" };
}

/** A field for a slice of a text; the element at the place has to be what is typed, and nothing else may change. */
function sliceNamed(
  text: string,
  span: { at: number; end: number },
  place: Place,
  offers: Offers,
): Edit & { naming: Naming } {
  const written = text.slice(span.at, span.end);
  const before = diagramOf(text);
  return {
    ...{ text, place },
    naming: {
      value: written === NOTHING ? "" : written,
      offers,
      taken: withDeclared((typed) => {
        const wanted = typed.trim();
        const made = changed(text, [{ ...span, text: wanted }]);
        const read = diagramOf(made);
        const found = read && at(read, place);
        if (!isOnePiece(wanted) || !read || !found || read.items.length !== before?.items.length) return null;
        const spans = [found.input?.span, found.output?.span, found.item.inputs[0]?.span, found.item.named];
        return spans.some((each) => each?.at === span.at && each.end === span.at + wanted.length)
          ? done(made, place)
          : null;
      }),
    },
  };
}

function name(diagram: Diagram, place: Place): Made {
  const found = at(diagram, place);
  if (!found) return null;
  const { item, input, output } = found;
  if (input) return sliceNamed(diagram.text, input.span, place, "value");
  if (output) return sliceNamed(diagram.text, output.span, place, "value");
  if (item.kind === "box" && item.named) return renamedBox(diagram, place);
  const span = item.named ?? item.inputs[0]?.span;
  return span ? sliceNamed(diagram.text, span, place, item.named ? "none" : "value") : null;
}

/** A different function or instance in a box, with the same arguments. */
function renamedBox({ text }: Diagram, place: Place): Made {
  const diagram = diagramOf(text);
  const named = diagram && at(diagram, place)?.item.named;
  if (!named) return null;
  const made = sliceNamed(text, named, place, "box");
  const taken = (typed: string, around: Around) => {
    const box = boxNamed(typed, around.boxes);
    return box?.kind === "block" ? null : made.naming.taken(box?.name ?? typed, around);
  };
  return { ...made, naming: { ...made.naming, taken } };
}

const boxNamed = (name: string, boxes: readonly Box[]) =>
  boxes.find((each) => each.name.toUpperCase() === name.trim().toUpperCase());

const CALL = /^\s*([\p{L}_][\p{L}\p{N}_.]*(?:\[[^\]]*\])?)\s*(?:\(([\s\S]*)\))?\s*$/u;
const CONVERSION = /^(?:\w+_)?TO_\w+$|^TRUNC\w*$/i;

/** The field for a new box: a function, an instance, or a block, whose instance is named next. */
function boxAt(diagram: Diagram, place: Place, around: Around, enabled: boolean): Made {
  const preview = insertBox(diagram, place, { box: UNKNOWN, callee: NOTHING, enabled: false, given: null }, around);
  if (!preview) return null;
  const [index = 0] = preview.place;
  const taken: Naming["taken"] = (typed, now) => {
    const [, callee = "", given] = CALL.exec(typed) ?? [];
    const known = boxNamed(callee, now.boxes) ?? (CONVERSION.test(callee) ? { ...UNKNOWN, name: callee } : undefined);
    if (!known) return null;
    const call: Call = { box: known, callee: known.name, enabled, given: given ?? null };
    return known.kind === "block" ? instance(diagram, place, call, now) : insertBox(diagram, place, call, now);
  };
  return { text: preview.text, place: [index], naming: { value: "", offers: "box", example: "AND, TON", taken } };
}

const UNKNOWN: Box = {
  ...{ name: NOTHING, kind: "function", type: "", inputs: ["IN"], outputs: [], types: [] },
  ...{ by_position: true, more: false, comment: "" },
};

/** The field for the instance of a block, which is declared with it. */
function instance(diagram: Diagram, place: Place, call: Call, around: Around): Edit | null {
  const type = call.box.name;
  const suggested = newName(
    `${type.slice(0, 1).toLowerCase()}${type.slice(1).toLowerCase().replace(/^fb_?/, "")}`,
    around.names,
  );
  const made = insertBox(diagram, place, { ...call, callee: suggested }, around);
  if (!made) return null;
  const [index = 0] = made.place;
  const taken: Naming["taken"] = (typed, now) => {
    const callee = typed.trim();
    if (!isName(callee)) return null;
    const known = boxNamed(callee, now.boxes);
    if (known && known.type.toUpperCase() !== type.toUpperCase()) return null;
    const edit = insertBox(diagram, place, { ...call, callee }, now);
    return edit && (known ? edit : { ...edit, declares: [{ name: callee, type }] });
  };
  return { text: made.text, place: [index], naming: { value: suggested, offers: "none", taken } };
}

/** A variable that takes what the cursor is at: a line of its own, or an output that the block has beside those that are connected. */
function assign(diagram: Diagram, place: Place, { boxes }: Around): Made {
  const found = at(diagram, place);
  const { text } = diagram;
  if (found?.item.kind === "box" && !found.input) {
    const { item, index } = found;
    const output = found.output ?? item.outputs[0];
    const free = boxNamed(item.callee, boxes)?.outputs.find(
      (pin) => !item.outputs.some((each) => each.name.toUpperCase() === pin.toUpperCase()),
    );
    if (free && !found.output) {
      const made = withArgument(text, item, `${free} => ${NOTHING}`);
      const pins = item.inputs.length + item.outputs.length;
      return outputNamed(made, [index, pins]);
    }
    if (!output) {
      const begin = headOf(item).at;
      return outputNamed(changed(text, [{ at: begin, end: begin, text: `${NOTHING} := ` }]), [
        index,
        item.inputs.length,
      ]);
    }
    const made = changed(text, [lineAfter(diagram, index, `${NOTHING} := ${output.target}`)]);
    return outputNamed(made, [index + 1, 1]);
  }
  const index = found?.index ?? diagram.items.length - 1;
  const value = found?.input?.text ?? found?.output?.target ?? found?.item.outputs[0]?.target ?? NOTHING;
  return outputNamed(changed(text, [lineAfter(diagram, index, `${NOTHING} := ${value}`)]), [index + 1, 1]);
}

function outputNamed(text: string, place: Place): Made {
  const read = diagramOf(text);
  const span = read && at(read, place)?.output?.span;
  return span ? sliceNamed(text, span, place, "value") : null;
}

/** One more input: the next that the box has and that is not there, or the next of those that are counted. */
function addInput(diagram: Diagram, place: Place, { boxes }: Around): Made {
  const found = at(diagram, place);
  if (!found) return null;
  const { item, index } = found;
  if (item.kind === "leave" && item.inputs.length === 0) {
    const made = changed(diagram.text, [{ at: item.span.end, end: item.span.end, text: ` IF ${NOTHING}` }]);
    return inputNamed(made, [index, 0]);
  }
  if (item.kind !== "box") return { refused: "graphic.refused.input" };
  const known = boxNamed(item.callee, boxes);
  const last = item.inputs.at(-1)?.name ?? "";
  const [, stem = "", number = ""] = /^(\D+)(\d+)$/.exec(last) ?? [];
  const missing = known?.inputs.find(
    (pin) => !item.inputs.some(({ name }) => name.toUpperCase() === pin.toUpperCase()),
  );
  const counted = known === undefined || known.more || item.inputs.length < known.inputs.length;
  const named = item.inputs.some(({ name }) => name !== "");
  const argument =
    !named && (known === undefined || known.by_position)
      ? counted && NOTHING
      : missing && !known?.by_position
        ? `${missing} := ${NOTHING}`
        : number !== "" && counted && `${stem}${Number(number) + 1} := ${NOTHING}`;
  if (!argument) return { refused: "graphic.refused.input" };
  return inputNamed(withArgument(diagram.text, item, argument), [index, item.inputs.length]);
}

function inputNamed(text: string, place: Place): Made {
  const read = diagramOf(text);
  const span = read && at(read, place)?.input?.span;
  return span ? sliceNamed(text, span, place, "value") : null;
}

function leave(diagram: Diagram, place: Place, line: string): Made {
  const index = place[0] ?? diagram.items.length - 1;
  const text = changed(diagram.text, [lineAfter(diagram, index, line)]);
  const read = diagramOf(text);
  const label = read?.items[index + 1]?.named;
  return label ? sliceNamed(text, label, [index + 1], "none") : inputNamed(text, [index + 1, 0]);
}

/** An input that is connected is disconnected, one that is not goes; so does an output that has a name, and an item. */
function remove(diagram: Diagram, place: Place): Made {
  const found = at(diagram, place);
  if (!found) return null;
  const { text } = diagram;
  const { item, input, output, index } = found;
  if (input && input.text !== NOTHING)
    return done(withPin(text, input, { text: NOTHING, negated: false, edge: "" }), place);
  const pin = input ?? output;
  const without = pin && item.kind !== "value" ? withoutArgument(text, item, pin) : null;
  if (without !== null) return done(without, [index]);
  if (output && item.kind === "box") return { refused: "graphic.refused.output" };
  const left = diagram.items.length - 1;
  return done(withoutItem(text, item), left === 0 ? [] : [Math.min(index, left - 1)]);
}

function move({ text, items }: Diagram, [index]: Place, by: number): Made {
  const [first, second] =
    index === undefined ? [] : [items[Math.min(index, index + by)], items[Math.max(index, index + by)]];
  return first && second && index !== undefined ? done(swapped(text, first, second), [index + by]) : null;
}

/** A wire from an output to an input: its line reads then what the other has. */
export function connected(text: string, from: Place, to: Place, around: Around): Made {
  const diagram = diagramOf(text);
  if (!diagram) return UNREAD;
  const [source, target] = [at(diagram, from), at(diagram, to)];
  const pin = target?.input ?? (target?.item.kind === "value" ? target.item.inputs[0] : undefined);
  if (!source || !pin) return null;
  const output = source.output ?? source.item.outputs[0];
  const take = (wire: string) => ({ ...pin.span, text: `${pin.negated ? "NOT " : ""}${wire}` });
  if (output) return done(changed(text, [take(output.target)]), to);
  const { item } = source;
  const [free] = boxNamed(item.callee, around.boxes)?.outputs ?? [];
  const wire = newName("#w", around.names);
  if (item.kind !== "box" || !item.args) return null;
  const end = item.args.end;
  const change = free
    ? { at: end, end, text: `${item.inputs.length > 0 ? ", " : ""}${free} => ${wire}` }
    : { at: item.span.at, end: item.span.at, text: `${wire} = ` };
  return done(changed(text, [change, take(wire)]), to);
}
