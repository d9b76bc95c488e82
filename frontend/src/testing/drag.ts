/** Dragging without a mouse: the events that a browser makes of it, with what is carried. */
import { fireEvent } from "@testing-library/react";

function load(data: Record<string, string> = {}) {
  const carried = new Map(Object.entries(data));
  return {
    dropEffect: "none",
    get types() {
      return [...carried.keys()];
    },
    setData: (type: string, text: string) => void carried.set(type, text),
    getData: (type: string) => carried.get(type) ?? "",
    setDragImage: () => undefined,
  };
}

/** From one element of the page to another one. */
export function drag(from: Element, to: Element): void {
  const dataTransfer = load();
  fireEvent.dragStart(from, { dataTransfer });
  fireEvent.dragOver(to, { dataTransfer });
  fireEvent.drop(to, { dataTransfer });
  fireEvent.dragEnd(from, { dataTransfer });
}

/** A text from elsewhere: a name of the explorer, a selection of the editor. */
export function dropText(text: string, to: Element): void {
  const dataTransfer = load({ "text/plain": text });
  fireEvent.dragOver(to, { dataTransfer });
  fireEvent.drop(to, { dataTransfer });
}
