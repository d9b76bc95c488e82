import type { KeyboardEvent } from "react";
import type { ValueRow } from "../../../logic/watch/watchrows";
import { useForbidden, useOnline } from "../../../store/plc/plc";
import { force, releaseForce, select, setDraft, shownText, useWatchList, write } from "../../../store/watch/watchlist";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { PlcSymbol } from "../../../wire/types";

/** A field for a new value. Enter writes it, F7 forces it; a refused entry stays, with the reason below. For a read-only variable the PLC says why. */
export function ChangeCell({ row, symbol, forced }: { row: ValueRow; symbol: PlcSymbol | null; forced: boolean }) {
  const draft = useWatchList((list) => list.drafts.get(row.path)) ?? "";
  const online = useOnline();
  const forbidden = useForbidden("write");
  const bad = useWatchList((list) => list.notes.get(row.path)?.kind === "refused");

  // Without a connection the entry is kept, with a note that it was not sent: no entry must be lost.
  const locked = online ? forbidden : null;
  if (!symbol || symbol.expandable) return <span className="edit" role="gridcell" />;

  function onKeyDown(event: KeyboardEvent<HTMLInputElement>): void {
    if (event.key === "Enter" && draft !== "" && locked === null) void write(row.path, row.root, draft);
    else if (event.key === "F7" && event.shiftKey) void releaseForce(row.path);
    else if (event.key === "F7") void force(row.path, row.root, draft || shownText(row));
    else if (event.key === "Escape") {
      setDraft(row.path, "");
      event.currentTarget.closest<HTMLElement>("[role=treegrid]")?.focus();
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }

  return (
    <span className={`edit${bad ? " bad" : ""}`} role="gridcell" title={locked ?? undefined}>
      {bad && <Icon name="error" />}
      {forced && draft === "" && (
        <span className="st forced over">
          <Icon name="forced" />
          {t("forced")}
        </span>
      )}
      <input
        aria-label={t("watch.change.of", { path: row.path })}
        aria-invalid={bad}
        readOnly={locked !== null}
        aria-description={locked ?? undefined}
        placeholder={locked !== null ? t("watch.locked") : symbol.writable ? undefined : t("watch.readonly")}
        value={draft}
        spellCheck={false}
        autoComplete="off"
        tabIndex={-1}
        onFocus={() => select(row.path)}
        onChange={(event) => setDraft(row.path, event.target.value)}
        onKeyDown={onKeyDown}
      />
    </span>
  );
}
