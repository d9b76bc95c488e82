import type { KeyboardEvent, PointerEvent } from "react";
import { t } from "../text";
import { contentWidth } from "./contentWidth";

interface Props {
  /** The name of the column, as its head says it. */
  column: string;
  /** The chosen width. */
  width: number | undefined;
  /** Null restores the width of the style sheet. */
  onWidth: (width: number | null) => void;
}

const STEP = 16;
const LEAST = 40;
const MOST = 1200;

const clamp = (width: number) => Math.round(Math.min(MOST, Math.max(LEAST, width)));
const widthOf = (grip: HTMLElement) => grip.parentElement?.getBoundingClientRect().width ?? LEAST;

/** The right edge of a column head: drag it, or move it with the arrow keys; a double click or Enter fits the content, Delete restores the usual width. */
export function Grip({ column, width, onWidth }: Props) {
  function onPointerDown(event: PointerEvent<HTMLElement>): void {
    event.preventDefault();
    event.stopPropagation();
    const grip = event.currentTarget;
    const left = event.clientX - widthOf(grip);
    grip.setPointerCapture?.(event.pointerId);
    grip.onpointermove = (move) => onWidth(clamp(move.clientX - left));
    grip.onpointerup = grip.onpointercancel = () => {
      grip.onpointermove = null;
    };
  }

  const fitContent = (grip: HTMLElement) => onWidth(clamp(contentWidth(grip.parentElement as HTMLElement)));

  function onKeyDown(event: KeyboardEvent<HTMLElement>): void {
    const grip = event.currentTarget;
    const by = { ArrowLeft: -STEP, ArrowRight: STEP }[event.key];
    if (by !== undefined) onWidth(clamp(widthOf(grip) + by));
    else if (event.key === "Enter") fitContent(grip);
    else if (event.key === "Delete" || event.key === "Backspace") onWidth(null);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  return (
    <div
      role="separator"
      className="grip"
      tabIndex={0}
      aria-orientation="vertical"
      aria-label={t("column.width", { column })}
      aria-valuenow={width ?? 0}
      aria-valuetext={width === undefined ? t("column.width.usual") : `${width} px`}
      title={t("column.width.about", { column })}
      draggable={false}
      onPointerDown={onPointerDown}
      onKeyDown={onKeyDown}
      onClick={(event) => event.stopPropagation()}
      onDoubleClick={(event) => {
        event.stopPropagation();
        fitContent(event.currentTarget);
      }}
    />
  );
}
