/** The grid of a panel: elements where they are placed, and while it is edited, how they are moved and sized. */
import { type CSSProperties, type DragEvent, type KeyboardEvent, type PointerEvent, useState } from "react";
import { pathsIn } from "../../logic/format/paths";
import {
  addElement,
  changeElement,
  extent,
  kindFor,
  newId,
  type Panel,
  type PanelElement,
  removeElement,
} from "../../logic/operator/panel";
import { editPanel } from "../../store/operator/panels";
import { useRack } from "../../store/operator/rack";
import { useMembers } from "../../store/plc/members";
import { useWatches } from "../../store/plc/watches";
import { t } from "../../text";
import { labelOf, OperatedElement } from "./OperatedElement";

/** Pixels of a cell, as in `operator.css`. */
export const CELL = 36;
const GAP = 2;

interface Props {
  path: string;
  panel: Panel;
  editing: boolean;
  selected: string | null;
  onSelect: (id: string | null) => void;
}

/** What the pointer does to an element, in cells. */
interface Dragged {
  id: string;
  size: boolean;
  from: { x: number; y: number };
  columns: number;
  rows: number;
}

export function PanelGrid({ path, panel, editing, selected, onSelect }: Props) {
  const [dragged, setDragged] = useState<Dragged | null>(null);
  const { columns, rows } = extent(panel);
  const edit = (change: (panel: Panel) => Panel) => editPanel(path, change);

  function onDrop(event: DragEvent<HTMLDivElement>): void {
    const paths = pathsIn(event.dataTransfer.getData("text/plain"));
    if (!editing || paths.length === 0) return;
    event.preventDefault();
    event.stopPropagation();
    const { left, top, width } = event.currentTarget.getBoundingClientRect();
    const at = { column: Math.floor((event.clientX - left) / CELL), row: Math.floor((event.clientY - top) / CELL) };
    const made = paths.map((each) => ({ id: newId(), kind: kindOf(each), path: each }));
    edit((now) =>
      made.reduce((next, each, index) => addElement(next, { ...each, at: index === 0 ? at : null }, width / CELL), now),
    );
    onSelect(made[0]?.id ?? null);
  }

  function onPointerMove(event: PointerEvent): void {
    if (dragged === null) return;
    const moved = (from: number, to: number) => Math.round((to - from) / CELL);
    const next = { columns: moved(dragged.from.x, event.clientX), rows: moved(dragged.from.y, event.clientY) };
    if (next.columns !== dragged.columns || next.rows !== dragged.rows) setDragged({ ...dragged, ...next });
  }

  function onPointerUp(): void {
    if (dragged !== null) edit((now) => applied(now, dragged));
    setDragged(null);
  }

  const shown = dragged === null ? panel : applied(panel, dragged);
  return (
    <div
      role={editing && panel.elements.length > 0 ? "listbox" : "group"}
      aria-label={t("operator.elements")}
      className={`opgrid${editing ? " editing" : ""}`}
      style={{ minWidth: columns * CELL, minHeight: rows * CELL }}
      onDragOver={(event) => editing && event.dataTransfer.types.includes("text/plain") && event.preventDefault()}
      onDrop={onDrop}
      tabIndex={-1}
      onPointerMove={onPointerMove}
      onPointerUp={onPointerUp}
      onPointerCancel={() => setDragged(null)}
      onPointerDown={(event) => event.target === event.currentTarget && onSelect(null)}
    >
      {shown.elements.map((element) =>
        editing ? (
          <EditedElement
            key={element.id}
            element={element}
            selected={element.id === selected}
            onSelect={() => onSelect(element.id)}
            onChange={(change) => edit((now) => changeElement(now, element.id, change))}
            onRemove={(grid) => {
              grid?.focus(); // what had the focus is gone
              edit((now) => removeElement(now, element.id));
              onSelect(null);
            }}
            onDrag={(size, { clientX: x, clientY: y }) =>
              setDragged({ id: element.id, size, from: { x, y }, columns: 0, rows: 0 })
            }
          />
        ) : (
          <div
            key={element.id}
            role="group"
            aria-label={labelOf(element)}
            className={classOf(element)}
            style={placed(element)}
          >
            <OperatedElement element={element} />
          </div>
        ),
      )}
    </div>
  );
}

const classOf = ({ kind }: PanelElement) => `opelement op-${kind}`;

const placed = ({ column, row, width, height }: PanelElement): CSSProperties => ({
  left: column * CELL + GAP,
  top: row * CELL + GAP,
  width: width * CELL - 2 * GAP,
  height: height * CELL - 2 * GAP,
});

function applied(panel: Panel, { id, size, columns, rows }: Dragged): Panel {
  const element = panel.elements.find((each) => each.id === id);
  if (!element) return panel;
  const { column, row, width, height } = element;
  return changeElement(
    panel,
    id,
    size ? { width: width + columns, height: height + rows } : { column: column + columns, row: row + rows },
  );
}

/** The kind that suits a variable that was dropped, as far as its type is known here. */
function kindOf(path: string) {
  const members = [...useMembers.getState().of.values()].flat();
  const symbol = useWatches.getState().symbols.get(path) ?? members.find((member) => member.path === path);
  const inputs = useRack.getState().channels?.filter(({ side }) => side === "input") ?? [];
  const isInput = inputs.some(({ terminals }) => terminals.some((terminal) => terminal.path === path));
  return kindFor(symbol?.type ?? "", !isInput && symbol?.section !== "VAR_INPUT");
}

interface EditedProps {
  element: PanelElement;
  selected: boolean;
  onSelect: () => void;
  onChange: (change: Partial<PanelElement>) => void;
  onRemove: (grid: HTMLElement | null) => void;
  onDrag: (size: boolean, event: PointerEvent) => void;
}

function EditedElement({ element, selected, onSelect, onChange, onRemove, onDrag }: EditedProps) {
  const { column, row, width, height, kind } = element;

  /** Arrows move it, with Shift they size it. */
  function onKeyDown(event: KeyboardEvent<HTMLElement>): void {
    const step = STEPS[event.key];
    if (step && event.shiftKey) onChange({ width: width + step[0], height: height + step[1] });
    else if (step) onChange({ column: column + step[0], row: row + step[1] });
    else if (event.key === "Delete" || event.key === "Backspace") onRemove(event.currentTarget.parentElement);
    else return;
    event.preventDefault();
  }

  function onPointerDown(event: PointerEvent): void {
    if (event.button !== 0) return;
    onSelect();
    event.currentTarget.setPointerCapture(event.pointerId);
    onDrag((event.target as HTMLElement).classList.contains("opsize"), event);
  }

  const name = t("operator.element", {
    kind: t(`operator.kind.${kind}`),
    label: labelOf(element),
    column: column + 1,
    row: row + 1,
    width,
    height,
  });
  return (
    <div
      role="option"
      aria-selected={selected}
      aria-label={name}
      tabIndex={0}
      className={`${classOf(element)}${selected ? " selected" : ""}`}
      style={placed(element)}
      onFocus={onSelect}
      onKeyDown={onKeyDown}
      onPointerDown={onPointerDown}
    >
      <div className="opstill" inert>
        <OperatedElement element={element} still />
      </div>
      <span className="opsize" title={t("operator.size")} />
    </div>
  );
}

const STEPS: Record<string, readonly [columns: number, rows: number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};
