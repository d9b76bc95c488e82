import { bindCell } from "../../store/plc/values";

interface Shown {
  cell: HTMLElement;
  text: HTMLElement;
  lamp?: HTMLElement;
  /** How the text is written in this cell, where that differs. */
  written?: (text: string) => string;
}

const FADE_AFTER = 120;
const MARK_FOR = 1000;

/** Writes the live value of a path into a cell, which flashes when it changes, until the returned function is called. */
export function showLive(
  path: string,
  format: Parameters<typeof bindCell>[1],
  { cell, text, lamp, written = (shown) => shown }: Shown,
): () => void {
  let fade: ReturnType<typeof setTimeout> | undefined;
  let unmark: ReturnType<typeof setTimeout> | undefined;
  const unbind = bindCell(path, format, (reading) => {
    text.textContent = written(reading.text);
    lamp?.classList.toggle("on", reading.lamp === true);
    lamp?.toggleAttribute("hidden", reading.lamp === null);
    text.classList.toggle("bw", reading.lamp !== null);
    if (!reading.changed) return;
    cell.classList.add("flash", "changed");
    clearTimeout(fade);
    clearTimeout(unmark);
    fade = setTimeout(() => cell.classList.remove("flash"), FADE_AFTER);
    unmark = setTimeout(() => cell.classList.remove("changed"), MARK_FOR);
  });
  return () => {
    unbind();
    clearTimeout(fade);
    clearTimeout(unmark);
  };
}
