import type { KeyboardEvent, PointerEvent } from "react";

interface Props {
  label: string;
  onWidth: (width: number | null) => void;
}

const STEP = 16;
const LEAST = 48;
const MOST = 640;

/** The left edge of a column head: drag it, or move it with the arrow keys; a double click restores the default width. */
export function Grip({ label, onWidth }: Props) {
  const clamp = (width: number) => Math.round(Math.min(MOST, Math.max(LEAST, width)));
  const widthOf = (grip: HTMLElement) => grip.parentElement?.getBoundingClientRect().width ?? LEAST;

  function onPointerDown(event: PointerEvent<HTMLElement>): void {
    event.preventDefault();
    const grip = event.currentTarget;
    const right = event.clientX + widthOf(grip);
    grip.setPointerCapture(event.pointerId);
    grip.onpointermove = (move) => onWidth(clamp(right - move.clientX));
    grip.onpointerup = () => {
      grip.onpointermove = null;
    };
  }

  function onKeyDown(event: KeyboardEvent<HTMLElement>): void {
    const by = { ArrowLeft: STEP, ArrowRight: -STEP }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    onWidth(clamp(widthOf(event.currentTarget) + by));
  }

  return (
    <button
      type="button"
      className="grip"
      aria-label={label}
      title={label}
      onPointerDown={onPointerDown}
      onKeyDown={onKeyDown}
      onDoubleClick={() => onWidth(null)}
    />
  );
}
