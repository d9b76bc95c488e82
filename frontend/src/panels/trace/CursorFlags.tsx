import type { KeyboardEvent, PointerEvent } from "react";
import { grouped } from "../../logic/format/numbers";
import { within } from "../../logic/trace/plots";
import { nearestRow, type Samples } from "../../logic/trace/samples";
import { type Cursor, look, type Shown, setCursor, useTraces, viewOf, wholeOf } from "../../store/trace/traces";
import { t } from "../../text";
import { LEFT, type Scale, scanOf, xOf } from "./draw";

interface Props {
  shown: Shown;
  samples: Samples | null;
  scale: Scale;
}

/** The two cursors: lines over all plots, each with a flag that can be dragged, or moved by the arrow keys. */
export function CursorFlags({ shown, samples, scale }: Props) {
  const a = useTraces((traces) => traces.a);
  const b = useTraces((traces) => traces.b);
  const inside = (scan: number | null): scan is number =>
    scan !== null && scan >= scale.view.from && scan <= scale.view.to;
  return (
    <>
      {inside(a) && inside(b) && (
        <span
          className="trbetween"
          style={{ left: xOf(Math.min(a, b), scale), width: Math.abs(xOf(b, scale) - xOf(a, scale)) }}
        />
      )}
      {a !== null && <Flag cursor="a" scan={a} visible={inside(a)} {...{ shown, samples, scale }} />}
      {b !== null && <Flag cursor="b" scan={b} visible={inside(b)} {...{ shown, samples, scale }} />}
    </>
  );
}

interface FlagProps extends Props {
  cursor: Cursor;
  scan: number;
  visible: boolean;
}

function Flag({ cursor, scan, visible, shown, samples, scale }: FlagProps) {
  const name = cursor.toUpperCase();

  function put(next: number): void {
    const { from, to } = wholeOf(shown);
    const at = Math.max(from, Math.min(to, Math.round(next)));
    const row =
      samples && at >= (samples.scans[0] ?? at) && at <= (samples.scans.at(-1) ?? at) ? nearestRow(samples, at) : -1;
    const found = row >= 0 && !samples?.decimated ? (samples?.scans[row] ?? at) : at;
    setCursor(cursor, found);
    const view = viewOf(useTraces.getState(), shown);
    if (found >= view.from && found <= view.to) return;
    const half = (view.to - view.from) / 2;
    look(within({ from: found - half, to: found + half }, { from, to }));
  }

  function onKeyDown(event: KeyboardEvent): void {
    const step = (event.shiftKey ? 10 : 1) * shown.every;
    const { from, to } = wholeOf(shown);
    const target = {
      ArrowLeft: scan - step,
      ArrowRight: scan + step,
      PageDown: scan - 100 * shown.every,
      PageUp: scan + 100 * shown.every,
      Home: from,
      End: to,
    }[event.key];
    if (event.key === "Delete" || event.key === "Escape") setCursor(cursor, null);
    else if (target !== undefined) put(target);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  function onPointerDown(event: PointerEvent<HTMLButtonElement>): void {
    event.stopPropagation();
    const stack = event.currentTarget.closest(".trstack");
    if (!stack) return;
    const { left } = stack.getBoundingClientRect();
    const onMove = (move: globalThis.PointerEvent) => put(scanOf(move.clientX - left, scale));
    const onUp = () => {
      removeEventListener("pointermove", onMove);
      removeEventListener("pointerup", onUp);
    };
    addEventListener("pointermove", onMove);
    addEventListener("pointerup", onUp);
  }

  const x = visible ? xOf(scan, scale) : scan < scale.view.from ? LEFT : LEFT + scale.width;
  const { from, to } = wholeOf(shown);
  return (
    <>
      {visible && <span className="trcursor" style={{ left: x }} />}
      <button
        type="button"
        role="slider"
        className={`trflag ${cursor}${visible ? "" : " out"}`}
        style={{ left: x }}
        aria-label={t("trace.cursor", { name })}
        aria-valuemin={from}
        aria-valuemax={to}
        aria-valuenow={scan}
        aria-valuetext={t("trace.cursor.at", { scan: grouped(scan) })}
        title={t("trace.cursor.hint")}
        onKeyDown={onKeyDown}
        onPointerDown={onPointerDown}
      >
        {name}
      </button>
    </>
  );
}
