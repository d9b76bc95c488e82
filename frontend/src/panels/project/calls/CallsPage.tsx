/** The call tree: whom a POU or method calls, or who calls it, level by level. */
import { useEffect, useState } from "react";
import { openFile } from "../../../store/page/navigate";
import {
  type Called,
  type Direction,
  followCalls,
  type Party,
  turnAround,
  unfold,
  useCalls,
} from "../../../store/project/calls";
import { t } from "../../../text";
import type { IconName } from "../../../ui/Icon";
import { PageHead } from "../../../ui/PageHead";
import { Segments } from "../../../ui/Segments";
import { Tree, type TreeRow } from "../../../ui/Tree";
import { Trouble } from "../../../ui/Trouble";
import { PastNote } from "../PastNote";

/** By the kinds of symbols of LSP: class, method, function; a program is a module. */
const ICONS: Record<number, IconName> = { 2: "program", 5: "fb", 6: "fn", 12: "fn" };

const DIRECTIONS: readonly Direction[] = ["calls", "callers"];

export function CallsPage() {
  useEffect(followCalls, []);
  const { direction, root, state, trouble } = useCalls();
  const rows = useRows(root);
  return (
    <section className="pane flexcol" aria-label={t("calls.title")} data-pane="calls">
      <PageHead title={root?.name ?? t("calls.title")} name={root !== null}>
        <span className="grow" />
        <Segments
          label={t("calls.direction")}
          value={direction}
          options={DIRECTIONS.map((value) => ({ value, word: t(`calls.${value}`) }))}
          onChoose={turnAround}
        />
      </PageHead>
      <PastNote of="cross" />
      <Trouble text={trouble} />
      {state === "asking" && trouble === null && <p className="lonely faint">{t("calls.asking")}</p>}
      {state === "nothing" && <p className="lonely faint">{t("calls.nothing")}</p>}
      {root && rows.length === 1 && trouble === null && (
        <p className="lonely faint">{t(`calls.none.${direction}`, { name: root.name })}</p>
      )}
      {root && <Tree label={t("calls.title")} rows={rows} />}
    </section>
  );
}

/** The rows in sight; which are unfolded is a matter of this page. */
function useRows(root: Party | null): TreeRow[] {
  const below = useCalls((calls) => calls.below);
  const [open, setOpen] = useState<ReadonlySet<string>>(new Set());
  if (!root) return [];
  const rows: TreeRow[] = [{ ...rowOf(root, "", 0), onActivate: () => openFile(root.file, root.line) }];

  function toggle(key: string, party: Party): void {
    const next = new Set(open);
    if (!next.delete(key)) {
      next.add(key);
      void unfold(party);
    }
    setOpen(next);
  }

  function add(parent: Party, key: string, around: readonly string[]): void {
    for (const each of below[parent.id] ?? []) {
      const own = `${key}/${each.id}`;
      // Calls that come back to a POU above would have no end.
      const again = around.includes(each.id);
      const known = below[each.id];
      const foldable = !again && known?.length !== 0;
      const unfolded = foldable && open.has(own);
      rows.push({
        ...rowOf(each, own, around.length),
        open: foldable ? unfolded : undefined,
        meta: <Places of={each} again={again} />,
        onToggle: foldable ? () => toggle(own, each) : undefined,
        onActivate: () => openPlace(each),
      });
      if (unfolded) add(each, own, [...around, each.id]);
    }
  }
  add(root, "", [root.id]);
  return rows;
}

const rowOf = (party: Party, key: string, level: number): TreeRow => ({
  ...{ key: key || party.id, level, icon: ICONS[party.kind] ?? "fn", label: party.name, name: party.name },
});

function openPlace({ places: [first] }: Called): void {
  if (first) openFile(first.file, first.line, first.column);
}

/** The lines of the calls: the first one is opened with the row. */
function Places({ of: { places }, again }: { of: Called; again: boolean }) {
  const lines = [...new Set(places.map(({ line }) => line))].join(", ");
  return (
    <span className="mono">
      {again && `${t("calls.again")} `}
      {places[0] && `${places[0].file}:${lines}`}
    </span>
  );
}
