/** What jsdom lacks of a browser, as far as the page uses it. Nothing is laid out: each row is 24 pixels high, all else has room for many. */
import { vi } from "vitest";
import { FakeSocket } from "./socket";

const ROW = 24;
const ROOM = 960;

function heightOf(this: HTMLElement): number {
  return this.matches("[role=row], [role=treeitem], [role=option]") ? ROW : ROOM;
}

/** Observers that never see a change: nothing changes its size here. */
class NoObserver {
  observe(): void {}
  unobserve(): void {}
  disconnect(): void {}
}

export function fillGaps(): void {
  vi.stubGlobal("WebSocket", FakeSocket);
  vi.stubGlobal("ResizeObserver", NoObserver);
  for (const name of ["offsetHeight", "clientHeight"])
    Object.defineProperty(HTMLElement.prototype, name, { configurable: true, get: heightOf });
  for (const name of ["offsetWidth", "clientWidth"])
    Object.defineProperty(HTMLElement.prototype, name, { configurable: true, get: () => ROOM });
  Object.assign(Element.prototype, { scrollTo: () => undefined, scrollIntoView: () => undefined });
  Object.assign(HTMLDialogElement.prototype, { showModal, close });
  Object.assign(URL, { createObjectURL: () => "blob:test", revokeObjectURL: () => undefined });
}

function showModal(this: HTMLDialogElement): void {
  this.setAttribute("open", "");
}

function close(this: HTMLDialogElement): void {
  this.removeAttribute("open");
}
