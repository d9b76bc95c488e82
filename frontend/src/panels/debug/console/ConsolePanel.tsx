import { type KeyboardEvent, useEffect, useRef, useState } from "react";
import { grouped } from "../../../logic/format/numbers";
import { baseName } from "../../../logic/format/paths";
import { type ConsoleLine, clearConsole, evaluate, useConsole } from "../../../store/debug/console";
import { openFile } from "../../../store/page/navigate";
import { useOnline } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon, type IconName } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
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

/** Enter evaluates, the arrow keys go through earlier entries. */
function Entry() {
  const online = useOnline();
  const history = useConsole((state) => state.history);
  const [text, setText] = useState("");
  const [back, setBack] = useState(-1);

  function onKeyDown(event: KeyboardEvent): void {
    if (event.key === "Enter") {
      void evaluate(text);
      setText("");
      setBack(-1);
      return;
    }
    const by = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    const to = Math.max(-1, Math.min(history.length - 1, back + by));
    setBack(to);
    setText(history[to] ?? "");
  }

  return (
    <label className="inp sm grow">
      <Icon name="cmd" small />
      <input
        className="mono"
        aria-label={t("console.entry")}
        placeholder={t("console.hint")}
        title={t("console.effects")}
        value={text}
        disabled={!online}
        spellCheck={false}
        autoComplete="off"
        onChange={(event) => setText(event.target.value)}
        onKeyDown={onKeyDown}
      />
    </label>
  );
}
