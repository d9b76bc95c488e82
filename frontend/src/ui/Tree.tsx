import { type DragEvent, type KeyboardEvent, type MouseEvent, type ReactNode, useRef, useState } from "react";
import { Icon, type IconName } from "./Icon";

export interface TreeRow {
  key: string;
  level: number;
  icon?: IconName;
  /** A class for the icon's colour. */
  tone?: string;
  label: ReactNode;
  /** The accessible name if the label is more than text. */
  name: string;
  meta?: ReactNode;
  /** Undefined: it cannot be unfolded. */
  open?: boolean;
  selected?: boolean;
  title?: string;
  /** The drag data of the row. */
  drag?: string;
  onToggle?: () => void;
  onActivate?: () => void;
  onMenu?: (at: { x: number; y: number }) => void;
  actions?: ReactNode;
}

interface Props {
  label: string;
  rows: readonly TreeRow[];
}

/** A tree of flat rows. Up, Down, Home, End move; Right and Left unfold and fold; Enter opens; the menu key opens the menu. */
export function Tree({ label, rows }: Props) {
  const [focusKey, setFocusKey] = useState<string | null>(null);
  const tree = useRef<HTMLDivElement>(null);
  const focused = Math.max(
    0,
    rows.findIndex((row) => row.key === focusKey),
  );

  function focus(index: number): void {
    const row = rows[Math.max(0, Math.min(rows.length - 1, index))];
    if (!row) return;
    setFocusKey(row.key);
    tree.current?.querySelectorAll<HTMLElement>("[role=treeitem]")[rows.indexOf(row)]?.focus();
  }

  function onKeyDown(event: KeyboardEvent): void {
    const row = rows[focused];
    if (!row) return;
    switch (event.key) {
      case "ArrowDown":
        focus(focused + 1);
        break;
      case "ArrowUp":
        focus(focused - 1);
        break;
      case "Home":
        focus(0);
        break;
      case "End":
        focus(rows.length - 1);
        break;
      case "ArrowRight":
        if (row.open === false) row.onToggle?.();
        else if (row.open) focus(focused + 1);
        break;
      case "ArrowLeft":
        if (row.open) row.onToggle?.();
        else focus(parentOf(rows, focused));
        break;
      case "Enter":
      case " ":
        (row.onActivate ?? row.onToggle)?.();
        break;
      case "ContextMenu":
        openMenu(row, event.currentTarget);
        break;
      default:
        return;
    }
    event.preventDefault();
  }

  return (
    <div ref={tree} role="tree" aria-label={label} className="scroll tree" onKeyDown={onKeyDown}>
      {rows.map((row, index) => (
        <Row key={row.key} row={row} tabbable={index === focused} onFocus={() => setFocusKey(row.key)} />
      ))}
    </div>
  );
}

function Row({ row, tabbable, onFocus }: { row: TreeRow; tabbable: boolean; onFocus: () => void }) {
  const foldable = row.open !== undefined;
  return (
    <div
      role="treeitem"
      className={`tr${row.selected ? " on" : ""}`}
      style={{ "--lv": row.level }}
      aria-level={row.level + 1}
      aria-label={row.name}
      aria-expanded={row.open}
      aria-selected={row.selected ?? false}
      tabIndex={tabbable ? 0 : -1}
      title={row.title}
      draggable={row.drag !== undefined}
      onDragStart={(event: DragEvent) => event.dataTransfer.setData("text/plain", row.drag ?? "")}
      onFocus={onFocus}
      onClick={() => (row.onActivate ?? row.onToggle)?.()}
      onContextMenu={(event: MouseEvent) => {
        if (!row.onMenu) return;
        event.preventDefault();
        row.onMenu({ x: event.clientX, y: event.clientY });
      }}
    >
      {foldable ? (
        <button
          type="button"
          className="twist"
          tabIndex={-1}
          aria-hidden="true"
          onClick={(event) => {
            event.stopPropagation();
            row.onToggle?.();
          }}
        >
          <Icon name={row.open ? "chev-d" : "chev-r"} className="tw" />
        </button>
      ) : (
        <span className="tw" />
      )}
      {row.icon && <Icon name={row.icon} className={row.tone} />}
      <span className="cut">{row.label}</span>
      {row.meta !== undefined && <span className="meta">{row.meta}</span>}
      {row.actions}
    </div>
  );
}

function parentOf(rows: readonly TreeRow[], index: number): number {
  const level = rows[index]?.level ?? 0;
  for (let i = index - 1; i >= 0; i -= 1) if ((rows[i]?.level ?? 0) < level) return i;
  return index;
}

function openMenu(row: TreeRow, tree: Element): void {
  const element = tree.querySelector(`[role=treeitem][tabindex="0"]`);
  const { left, bottom } = (element ?? tree).getBoundingClientRect();
  row.onMenu?.({ x: left + 24, y: bottom });
}
