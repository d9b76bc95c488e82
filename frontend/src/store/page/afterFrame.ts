/** Work that may come after the frame of what caused it: a key is drawn first. */

/** At the latest then, in ms, where the browser draws no frame. */
const LATEST = 100;

/** In ms after the frame: what else comes with it, as the answers to a key, is first. */
const SOON = 10;

const waiting = new Set<() => void>();
let timer: ReturnType<typeof setTimeout> | undefined;

/** Calls it once, however often it is asked for before; at once while the page is not shown, and before it goes. */
export function afterFrame(work: () => void): void {
  if (isHidden()) {
    work();
    return;
  }
  waiting.add(work);
  if (timer !== undefined) return;
  timer = setTimeout(doWaiting, LATEST);
  requestAnimationFrame(() => setTimeout(doWaiting, SOON));
}

/** What waits is done now: something else depends on it. */
export function doWaiting(): void {
  clearTimeout(timer);
  timer = undefined;
  const works = [...waiting];
  waiting.clear();
  for (const work of works) work();
}

/** Where there is no page at all nothing is drawn either. */
const isHidden = () => typeof document === "undefined" || document.visibilityState === "hidden";

if (typeof document !== "undefined") {
  addEventListener("pagehide", doWaiting);
  document.addEventListener("visibilitychange", () => isHidden() && doWaiting());
}
