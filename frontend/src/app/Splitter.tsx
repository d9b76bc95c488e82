import { type KeyboardEvent, type PointerEvent, useEffect, useState } from "react";
import { keep, recall } from "../store/page/localStorage";
import { t } from "../text";

const LEAST = 160;
const MOST = 480;
const USUAL = 232;

/** The border between explorer and dock: drag it, or move it with the arrow keys; a double click restores the default width. */
export function Splitter() {
  const [width, setWidth] = useState(() => recall("left", USUAL));
  useEffect(() => {
    document.documentElement.style.setProperty("--w-left-now", `${width}px`);
    keep("left", width);
  }, [width]);

  const clamp = (value: number) => Math.min(MOST, Math.max(LEAST, Math.round(value)));

  function onPointerDown(event: PointerEvent<HTMLElement>): void {
    const target = event.currentTarget;
    target.setPointerCapture(event.pointerId);
    target.onpointermove = (move) => setWidth(clamp(move.clientX));
    target.onpointerup = () => {
      target.onpointermove = null;
    };
  }

  function onKeyDown(event: KeyboardEvent): void {
    const step = { ArrowLeft: -16, ArrowRight: 16 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    setWidth(clamp(width + step));
  }

  return (
    <div
      className="splitter"
      role="separator"
      aria-orientation="vertical"
      aria-label={t("splitter")}
      aria-valuenow={width}
      aria-valuemin={LEAST}
      aria-valuemax={MOST}
      tabIndex={0}
      onPointerDown={onPointerDown}
      onKeyDown={onKeyDown}
      onDoubleClick={() => setWidth(USUAL)}
    />
  );
}
