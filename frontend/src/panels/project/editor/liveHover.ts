/** The value in the hover goes on as the program does: value frames write it, for as long as the hover is open. */
import { follow } from "../../../store/plc/follow";

/** Monaco draws the hover a moment after it was told what belongs there. */
const DRAWN_WITHIN = 2_000;
const LOOK = 250;

let stop: () => void = () => undefined;

/** Keeps the line `head := value` of the hover up to date, by the value of a path, until the returned function is called; one hover is open at a time. */
export function liveHover(head: string, path: string): () => void {
  stop();
  const begun = Date.now();
  let text: string | null = null;
  const show = () => {
    const line = lineOf(head);
    if (line && text !== null) valueIn(line, head).textContent = text;
    return line !== null;
  };
  const unfollow = follow(path, "default", (reading) => {
    if (reading.text === "") return; // not known yet
    text = reading.text;
    show();
  });
  const timer = setInterval(() => {
    if (!show() && Date.now() - begun > DRAWN_WITHIN) stop();
  }, LOOK);
  stop = () => {
    stop = () => undefined;
    clearInterval(timer);
    unfollow();
  };
  return stop;
}

const lineOf = (head: string) =>
  [...document.querySelectorAll<HTMLElement>(".monaco-hover .monaco-tokenized-source")].find(
    (line) => line.offsetParent !== null && plain(line).startsWith(`${head} :=`),
  ) ?? null;

/** Monaco writes some blanks as ones that do not break. */
const plain = ({ textContent }: HTMLElement) => (textContent ?? "").replaceAll("\u00a0", " ");

/** The element of the value; Monaco's own, in the colours of the language, gives way the first time. */
function valueIn(line: HTMLElement, head: string): HTMLElement {
  const known = line.querySelector<HTMLElement>(".livevalue");
  if (known) return known;
  const value = document.createElement("span");
  value.className = "livevalue";
  line.replaceChildren(`${head} := `, value);
  return value;
}
