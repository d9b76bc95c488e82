/** An element of a panel as people operate it: what it shows, and what it writes. */
import { type KeyboardEvent, useEffect, useRef, useState } from "react";
import { splitPath } from "../../logic/format/paths";
import { type PanelElement, WRITES } from "../../logic/operator/panel";
import { forgetRefusal, operate, press, release, useRefused } from "../../store/operator/operate";
import { useBench } from "../../store/plc/bench";
import { useForbidden, usePlc } from "../../store/plc/plc";
import { useForcedAt } from "../../store/watch/forces";
import { t } from "../../text";
import { Icon } from "../../ui/Icon";
import { Bar, Lamp, Trend } from "./Shown";
import { type Reading, useReading } from "./useReading";

export const labelOf = ({ label, path, kind }: PanelElement) =>
  label || splitPath(path).name || t(`operator.kind.${kind}`);

/** `still`: it is being edited, so nothing in it can be operated. */
export function OperatedElement({ element, still = false }: { element: PanelElement; still?: boolean }) {
  const { id, kind, path } = element;
  const reading = useReading(path);
  const forced = useForcedAt(path);
  const refused = useRefused(({ of }) => of.get(id));
  const label = labelOf(element);
  const shows = kind !== "text" || path !== "";
  const missing = path === "" ? (shows ? t("operator.nopath") : null) : reading.refused;
  return (
    <>
      <span className="oplabel" title={path || label}>
        {(kind !== "button" || missing !== null) && <span className="cut">{label}</span>}
        {forced && (
          <span
            className="st forced"
            role="img"
            aria-label={t("forced")}
            title={t("force.to", { value: forced.value })}
          >
            <Icon name="forced" small />
          </span>
        )}
      </span>
      {missing !== null ? (
        <span className="opmissing" title={missing}>
          <Icon name="warning" small />
          <span className="cut">{path === "" ? missing : t("operator.notfound", { path })}</span>
        </span>
      ) : (
        shows && <Content element={element} label={label} reading={reading} still={still} />
      )}
      {refused !== undefined && !still && (
        <button type="button" className="oprefused" title={refused} onClick={() => forgetRefusal(id)}>
          <Icon name="error" small />
          <span role="alert">{refused}</span>
        </button>
      )}
    </>
  );
}

interface ContentProps {
  element: PanelElement;
  label: string;
  reading: Reading;
  still: boolean;
}

function Content({ element, label, reading, still }: ContentProps) {
  const forbidden = useForbidden("write");
  // A curve is that of one variable of one PLC, live or in the past.
  const instance = useBench((bench) => bench.instance?.id);
  const past = usePlc((plc) => plc.state?.past != null);
  const seen = `${element.path} ${instance} ${past}`;
  const locked = still ? t("operator.editing") : reading.symbol?.writable === false ? t("watch.readonly") : forbidden;
  const props = { element, label, reading, locked: WRITES.includes(element.kind) ? locked : null };
  switch (element.kind) {
    case "switch":
      return <SwitchControl {...props} />;
    case "button":
      return <PushButton {...props} />;
    case "number":
      return <NumberField {...props} />;
    case "slider":
      return <Slider {...props} />;
    case "lamp":
      return <Lamp element={element} label={label} reading={reading} />;
    case "bar":
      return <Bar element={element} label={label} reading={reading} />;
    case "trend":
      return <Trend key={seen} element={element} label={label} reading={reading} />;
    case "text":
      return <output className="opvalue mono">{reading.text}</output>;
  }
}

interface ControlProps<Element = PanelElement> {
  element: Element;
  label: string;
  reading: Reading;
  /** Why it cannot be operated now. */
  locked: string | null;
}

function SwitchControl({ element: { id, path }, label, reading, locked }: ControlProps) {
  if (reading.symbol && reading.on === null) return <NoBool />;
  return (
    <button
      type="button"
      role="switch"
      className={`opswitch${reading.on ? " on" : ""}`}
      aria-label={label}
      aria-checked={reading.on === true}
      disabled={locked !== null || reading.on === null}
      title={locked ?? path}
      onClick={() => void operate(id, path, reading.on ? "FALSE" : "TRUE")}
    >
      <span className="optrack">
        <span className="opthumb" />
      </span>
      <span className="opword mono">{reading.text}</span>
    </button>
  );
}

/** TRUE while it is held. */
function PushButton({ element: { id, path, tone = "normal" }, label, reading, locked }: ControlProps) {
  // Whatever happens to this element meanwhile, the variable that was pressed is the one that is let go.
  const held = useRef<string | null>(null);
  const letGo = useRef(() => {
    if (held.current !== null) release(held.current);
    held.current = null;
  }).current;
  useEffect(() => letGo, [letGo]);
  useEffect(() => {
    if (locked !== null) letGo();
  }, [locked, letGo]);
  if (reading.symbol && reading.on === null) return <NoBool />;

  function push(): void {
    if (held.current !== null || locked !== null) return;
    held.current = path;
    void press(id, path);
  }
  const isPress = ({ key }: KeyboardEvent) => key === " " || key === "Enter";
  return (
    <button
      type="button"
      className={`oppush tone-${tone}${reading.on ? " on" : ""}`}
      aria-label={label}
      aria-pressed={reading.on === true}
      disabled={locked !== null || reading.on === null}
      title={locked ?? t("operator.hold", { path })}
      onPointerDown={(event) => {
        if (event.button !== 0) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        push();
      }}
      onPointerUp={letGo}
      onPointerCancel={letGo}
      onBlur={letGo}
      onKeyDown={(event) => {
        if (!isPress(event)) return;
        event.preventDefault();
        if (!event.repeat) push();
      }}
      onKeyUp={(event) => isPress(event) && letGo()}
    >
      <span className={`lamp${reading.on ? " on" : ""}`} />
      <span className="cut">{label}</span>
    </button>
  );
}

const NoBool = () => (
  <span className="opmissing">
    <Icon name="warning" small />
    <span className="cut">{t("operator.nobool")}</span>
  </span>
);

/** Shows the value; with the focus it is empty for a new one, and shows the value faintly. Enter writes, Escape takes the entry back. */
export function NumberField({
  element: { id, path },
  label,
  reading,
  locked,
}: ControlProps<Pick<PanelElement, "id" | "path">>) {
  const [draft, setDraft] = useState<string | null>(null);
  return (
    <input
      className={`inp opnumber mono${draft ? " edited" : ""}`}
      aria-label={label}
      value={draft ?? reading.text}
      placeholder={reading.text}
      readOnly={locked !== null}
      title={locked ?? t("operator.enter", { path })}
      spellCheck={false}
      autoComplete="off"
      onFocus={() => locked === null && setDraft("")}
      onBlur={() => setDraft(null)}
      onChange={({ target }) => setDraft(target.value)}
      onKeyDown={({ key }) => {
        if (key === "Enter" && draft) void operate(id, path, draft);
        if (key === "Enter" || key === "Escape") setDraft("");
      }}
    />
  );
}

function Slider({ element: { id, path, ...scale }, label, reading, locked }: ControlProps) {
  const [dragged, setDragged] = useState<number | null>(null);
  const pulled = useRef(false);
  const letGo = () => {
    pulled.current = false;
    setDragged(null);
  };
  useEffect(() => {
    if (locked !== null) setDragged(null);
  }, [locked]);
  const whole = reading.symbol?.kind !== "real";
  if (reading.symbol && reading.number === null && reading.text !== "")
    return (
      <span className="opmissing">
        <Icon name="warning" small />
        <span className="cut">{t("operator.nonumber")}</span>
      </span>
    );
  const ends = [Math.min(scale.low, scale.high), Math.max(scale.low, scale.high)] as const;
  const [low, high] = whole ? [Math.ceil(ends[0]), Math.floor(ends[1])] : ends;
  const now = dragged ?? reading.number ?? low;
  const outside = reading.number !== null && (reading.number < low || reading.number > high);
  return (
    <span className={`opslider${outside ? " outside" : ""}`}>
      <input
        type="range"
        aria-label={label}
        aria-valuetext={reading.text}
        min={low}
        max={high}
        step={whole ? 1 : (high - low) / 200 || 1}
        value={Math.max(low, Math.min(high, now))}
        disabled={locked !== null || reading.number === null}
        title={locked ?? (outside ? t("operator.outside", { low, high }) : path)}
        onChange={({ target }) => {
          setDragged(Number(target.value));
          void operate(id, path, target.value).then(() => pulled.current || setDragged(null));
        }}
        onPointerDown={() => {
          pulled.current = true;
        }}
        onPointerUp={letGo}
        onPointerCancel={letGo}
        onBlur={letGo}
      />
      <output className="opword mono">{reading.text}</output>
    </span>
  );
}
