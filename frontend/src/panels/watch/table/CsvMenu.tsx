import { type ChangeEvent, useRef, useState } from "react";
import { fromCsv, toCsv } from "../../../logic/watch/watchcsv";
import { saveFile } from "../../../store/page/download";
import { addAll } from "../../../store/watch/watchlist";
import { told, undoEdit, useWatchLists } from "../../../store/watch/watchlists";
import { t } from "../../../text";
import { Dialog } from "../../../ui/Dialog";
import { Icon } from "../../../ui/Icon";
import { MenuButton } from "../../../ui/Menu";

const TOLD = 50;

/** Exports and imports the list as a CSV file; unreadable lines are listed, the others are imported. */
export function CsvMenu({ onNewGroup }: { onNewGroup: () => void }) {
  const { entries, name } = useWatchLists((lists) => lists.content);
  const file = useRef<HTMLInputElement>(null);
  const [bad, setBad] = useState<{ added: number; lines: readonly string[] } | null>(null);

  async function onFile({ currentTarget }: ChangeEvent<HTMLInputElement>): Promise<void> {
    const [chosen] = currentTarget.files ?? [];
    if (!chosen) return;
    const read = fromCsv(await chosen.text());
    currentTarget.value = ""; // choosing the same file again counts as a change, too
    const before = useWatchLists.getState().content.entries.length;
    if (read.entries.length > 0) addAll(read.entries);
    const added = useWatchLists.getState().content.entries.length - before;
    if (read.bad.length > 0) setBad({ added, lines: read.bad });
    else told(t("watch.csv.added", { count: added }), undoEdit);
  }

  return (
    <>
      <MenuButton
        label={t("watch.csv")}
        className="ib sm"
        items={() => [
          {
            label: t("watch.csv.export"),
            icon: "export",
            disabled: entries.length === 0,
            onSelect: () => saveFile(new Blob(["\uFEFF", toCsv(entries)], { type: "text/csv" }), `${name}.csv`),
          },
          { label: t("watch.csv.import"), icon: "import", onSelect: () => file.current?.click() },
          { label: t("watch.group.new"), separated: true, onSelect: onNewGroup },
        ]}
      >
        <Icon name="more" />
      </MenuButton>
      <input
        ref={file}
        type="file"
        accept=".csv,.txt,text/csv"
        hidden
        aria-label={t("watch.csv.import")}
        data-testid="watch-csv"
        onChange={(event) => void onFile(event)}
      />
      {bad && (
        <Dialog
          title={t("watch.csv.bad", { count: bad.lines.length })}
          about={t("watch.csv.added", { count: bad.added })}
          onClose={() => setBad(null)}
          onSubmit={() => setBad(null)}
          footer={
            <>
              <span className="grow" />
              <button type="submit" className="btn primary">
                {t("close")}
              </button>
            </>
          }
        >
          <ul className="badlines">
            {bad.lines.slice(0, TOLD).map((line) => (
              <li key={line}>{line}</li>
            ))}
          </ul>
        </Dialog>
      )}
    </>
  );
}
