/** Runs before the tests of panels: what jsdom lacks of a browser, as far as the page uses it. Nothing is laid out: each row is 24 pixels high, all else has room for many. */
import { cleanup } from "@testing-library/react";
import { afterEach, vi } from "vitest";
import { FakeSocket } from "./socket";

const ROW = 24;
const ROOM = 960;

function heightOf(this: HTMLElement): number {
  return this.matches("[role=row], [role=treeitem], [role=option]") ? ROW : ROOM;
}

/** Tells the size of what it observes once: nothing changes its size here. */
class SizeObserver {
  constructor(private readonly tell: (entries: object[]) => void) {}

  observe(target: Element): void {
    const size = { width: ROOM, height: ROOM };
    queueMicrotask(() => target.isConnected && this.tell([{ target, contentRect: size }]));
  }

  unobserve(): void {}
  disconnect(): void {}
}

function showModal(this: HTMLDialogElement): void {
  this.setAttribute("open", "");
}

function close(this: HTMLDialogElement): void {
  this.removeAttribute("open");
}

/** No style sheet is loaded, so all elements look the same; computing it each time takes jsdom longer than anything else. */
const plain = document.createElement("div").style;
Object.assign(plain, { display: "block", visibility: "visible", pointerEvents: "auto" });
window.getComputedStyle = () => plain;

vi.stubGlobal("WebSocket", FakeSocket);
vi.stubGlobal("matchMedia", () => ({
  matches: false,
  addEventListener: () => undefined,
  removeEventListener: () => undefined,
}));
vi.stubGlobal("ResizeObserver", SizeObserver);
for (const name of ["offsetHeight", "clientHeight"])
  Object.defineProperty(HTMLElement.prototype, name, { configurable: true, get: heightOf });
for (const name of ["offsetWidth", "clientWidth"])
  Object.defineProperty(HTMLElement.prototype, name, { configurable: true, get: () => ROOM });
Object.assign(Element.prototype, { scrollTo: () => undefined, scrollIntoView: () => undefined });
Object.assign(HTMLDialogElement.prototype, { showModal, close });
vi.stubGlobal("CSS", { escape: (text: string) => text.replace(/[^\w-]/g, "\\$&") });
Object.assign(URL, { createObjectURL: () => "blob:test", revokeObjectURL: () => undefined });

// The files share one page: what a test has left there, the first test of the next file would find.
afterEach(cleanup);
