import { type KeyboardEvent, useEffect, useRef, useState } from "react";
import { grouped } from "../../../logic/format/numbers";
import { baseName } from "../../../logic/format/paths";
import { pathBefore, withPath } from "../../../logic/plc/expression";
import { type ConsoleLine, clearConsole, completeHere, evaluate, useConsole } from "../../../store/debug/console";
import { openFile } from "../../../store/page/navigate";
import { useOnline } from "../../../store/plc/plc";
import { t } from "../../../text";
import { ComboBox } from "../../../ui/ComboBox";
import { Icon, type IconName } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { type Offer, useOffers } from "../../../ui/useOffers";
import "./console.css";

const LOOK: Record<ConsoleLine["kind"], { icon: IconName; tone: string }> = {
  input: { icon: "chev-r", tone: "muted" },
  value: { icon: "equal", tone: "" },
  error: { icon: "error", tone: "bad" },
  log: { icon: "bp-log", tone: "log" },
};

/** Expressions with their values, and the messages of logpoints. */
export function ConsolePanel() {
  const lines = useConsole((state) => state.lines);
  const list = useRef<HTMLDivElement>(null);
  const atEnd = useRef(true);
  // biome-ignore lint/correctness/useExhaustiveDependencies: runs when a line is added
  useEffect(() => {
    if (list.current && atEnd.current) list.current.scrollTop = list.current.scrollHeight;
  }, [lines]);
  return (
    <div className="pane flexcol" data-pane="console">
      <div className="sub">
        <Entry />
        <IconButton
          icon="trash"
          label={t("console.clear")}
          small
          disabled={lines.length === 0}
          onClick={clearConsole}
        />
      </div>
      {lines.length === 0 ? (
        <p className="lonely faint">{t("console.none")}</p>
      ) : (
        <div
          ref={list}
          className="scroll consolelines"
          role="log"
          aria-label={t("panel.console")}
          // biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard
          tabIndex={0}
          onScroll={(event) => {
            const { scrollTop, scrollHeight, clientHeight } = event.currentTarget;
            atEnd.current = scrollTop + clientHeight > scrollHeight - 30;
          }}
        >
          {lines.map((line) => (
            <Line key={line.id} line={line} />
          ))}
        </div>
      )}
    </div>
  );
}

function Line({ line }: { line: ConsoleLine }) {
  const { icon, tone } = LOOK[line.kind];
  const { place, scan, type } = line;
  return (
    <div className={`cl ${tone}`}>
      <Icon name={icon} small />
      <span className="mono says">{line.text}</span>
      {type && <span className="faint mono">{type}</span>}
      {scan !== undefined && <span className="faint">{t("debug.scan", { scan: grouped(scan) })}</span>}
      {place && (
        <button type="button" className="link mono" onClick={() => openFile(place.file, place.line)}>
          {`${baseName(place.file)}:${place.line}`}
        </button>
      )}
    </div>
  );
}

/** At most so many are offered at once. */
const MOST = 12;

/** Enter evaluates, the arrow keys go through earlier entries, or through what is offered for the word at the caret. */
function Entry() {
  const online = useOnline();
  const history = useConsole((state) => state.history);
  const input = useRef<HTMLInputElement>(null);
  const [text, setText] = useState("");
  const [back, setBack] = useState(-1);
  const offering = useOffers<Offer>(completeHere, MOST);

  function onKey({ key }: KeyboardEvent): boolean {
    if (key === "Enter") {
      void evaluate(text);
      offering.close();
      setText("");
      setBack(-1);
      return true;
    }
    const by = { ArrowUp: 1, ArrowDown: -1 }[key];
    if (by === undefined) return false;
    const to = Math.max(-1, Math.min(history.length - 1, back + by));
    setBack(to);
    setText(history[to] ?? "");
    return true;
  }

  function take(path: string): void {
    const next = withPath(text, input.current?.selectionStart ?? text.length, path);
    setText(next.text);
    offering.close();
    requestAnimationFrame(() => input.current?.setSelectionRange(next.caret, next.caret));
  }

  return (
    <span className="inp sm grow" title={t("console.effects")}>
      <Icon name="cmd" small />
      <ComboBox
        input={input}
        className="mono"
        label={t("console.entry")}
        placeholder={t("console.hint")}
        value={text}
        disabled={!online}
        offering={offering}
        onType={(typed, caret) => {
          setText(typed);
          offering.ask(pathBefore(typed, caret));
        }}
        onTake={({ path }) => take(path)}
        onKey={onKey}
        listed={t("console.offers")}
      />
    </span>
  );
}
