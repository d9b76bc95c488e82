/** Elements that only show a value. */
import { useEffect, useRef } from "react";
import type { PanelElement } from "../../logic/operator/panel";
import { useOnline } from "../../store/plc/plc";
import { t } from "../../text";
import type { Reading } from "./useReading";

interface Props {
  element: PanelElement;
  label: string;
  reading: Reading;
}

export function Lamp({ element: { tone = "normal" }, label, reading: { on, text } }: Props) {
  return (
    <span className={`oplamp tone-${tone}${on ? " on" : ""}`} role="img" aria-label={`${label}: ${text}`}>
      <span className="opbulb" />
      <span className="opword mono">{text}</span>
    </span>
  );
}

/** How far a value is on a scale, 0 to 1. */
const share = (value: number, low: number, high: number) =>
  high === low ? 0 : Math.max(0, Math.min(1, (value - low) / (high - low)));

export function Bar({ element: { low, high, width, height }, label, reading: { number, text } }: Props) {
  const upright = height > width;
  const filled = number === null ? 0 : share(number, low, high);
  const outside = number !== null && (number < Math.min(low, high) || number > Math.max(low, high));
  return (
    <span className={`opbar${upright ? " upright" : ""}${outside ? " outside" : ""}`}>
      <span
        className="opscale"
        role="meter"
        aria-label={label}
        aria-valuemin={low}
        aria-valuemax={high}
        aria-valuenow={number ?? low}
        aria-valuetext={text}
        title={outside ? t("operator.outside", { low, high }) : t("operator.scale", { low, high })}
      >
        <i style={upright ? { height: `${filled * 100}%` } : { width: `${filled * 100}%` }} />
      </span>
      <output className="opword mono">{text}</output>
    </span>
  );
}

const SPAN_MS = 30_000;
const DRAWN_MS = 100;
const WIDE = 300;
const HIGH = 100;

type Point = readonly [at: number, value: number | null];

/** The values that arrived in this browser in the last half minute; nothing where it was without a connection or not drawn. */
export function Trend({ element: { low, high }, label, reading: { number, on, text } }: Props) {
  const line = useRef<SVGPathElement>(null);
  const points = useRef<Point[]>([]);
  const online = useOnline();
  const value = online ? (number ?? (on === null ? null : Number(on))) : null;
  const [bottom, top] = on === null ? [low, high] : [0, 1];

  useEffect(() => {
    points.current.push([performance.now(), value]);
  }, [value]);

  useEffect(() => {
    const changed = () => points.current.push([performance.now(), document.hidden ? null : value]);
    document.addEventListener("visibilitychange", changed);
    return () => document.removeEventListener("visibilitychange", changed);
  }, [value]);

  useEffect(() => {
    const draw = () => {
      const now = performance.now();
      const known = points.current;
      // The value before the shown stretch is where the line begins.
      while ((known[1]?.[0] ?? now) < now - SPAN_MS) known.shift();
      line.current?.setAttribute("d", steps(known, now, bottom, top));
    };
    const drawing = setInterval(draw, DRAWN_MS);
    return () => clearInterval(drawing);
  }, [bottom, top]);

  return (
    <span className="optrend" title={t("operator.trend.about", { low: bottom, high: top })}>
      <svg viewBox={`0 0 ${WIDE} ${HIGH}`} preserveAspectRatio="none" role="img" aria-label={`${label}: ${text}`}>
        <path ref={line} />
      </svg>
      <span className="opend mono">{top}</span>
      <span className="opend low mono">{bottom}</span>
      <output className="opword mono">{text}</output>
    </span>
  );
}

/** A value holds until the next one; null is a gap. */
function steps(points: readonly Point[], now: number, low: number, high: number): string {
  let path = "";
  let drawn = false;
  for (const [at, value] of points) {
    const x = Math.max(0, WIDE * (1 - (now - at) / SPAN_MS)).toFixed(1);
    if (drawn) path += `H${x}`;
    if (value !== null) {
      const y = (HIGH * (1 - share(value, low, high))).toFixed(1);
      path += drawn ? `V${y}` : `M${x} ${y}`;
    }
    drawn = value !== null;
  }
  return drawn ? `${path}H${WIDE}` : path;
}
