import { useEffect, useMemo } from "react";
import type { HistoryLine } from "../../../logic/errors/history";
import { dayTime } from "../../../logic/format/numbers";
import { keyOf } from "../../../logic/plc/errorInstances";
import { useCatalogue } from "../../../store/errors/catalogue";
import { refreshRecords, setHistoryView, showVersion, useRecords } from "../../../store/errors/records";
import { useBench } from "../../../store/plc/bench";
import { usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { MenuButton, type MenuItem } from "../../../ui/Menu";
import type { ErrorHistoryRow } from "../../../wire/types";
import { Filters } from "./Filters";
import { HistoryTable } from "./HistoryTable";
import "./history.css";
import { RecordMenu } from "./RecordMenu";

/** One row for each error of the catalogue: was the program tested against it, and did the program react? */
export function HistoryPanel() {
  const instance = useBench((bench) => bench.instance?.id ?? null);
  const project = useBench((bench) => bench.project?.id ?? null);
  const running = usePlc((plc) => plc.state?.program_version ?? null);
  // biome-ignore lint/correctness/useExhaustiveDependencies: runs again for a different PLC, a different program and a restored connection
  useEffect(() => void refreshRecords(), [instance, project, running]);
  const { old, view, trouble } = useRecords();
  const lines = useLines();
  return (
    <div className="pane flexcol" data-pane="history" data-live>
      <div className="sub hbar" role="toolbar" aria-label={t("history.label")}>
        <Filters view={view} onView={setHistoryView} />
        <span className="grow" />
        <VersionMenu running={running} />
        <RecordMenu />
      </div>
      {trouble && (
        <p className="trouble st fatal" role="alert">
          <Icon name="error" small />
          <span>{trouble}</span>
        </p>
      )}
      {old && (
        <p className="oldnote st past" role="status">
          <Icon name="past" small />
          <span>
            {t("history.old", { version: old.version, running: running ?? "–" })}{" "}
            <button type="button" className="link" onClick={() => void showVersion(null)}>
              {t("history.old.back")}
            </button>
          </span>
        </p>
      )}
      {lines.length === 0 ? (
        <p className="lonely faint">{t("history.none")}</p>
      ) : (
        <HistoryTable
          lines={lines}
          view={view}
          onView={setHistoryView}
          label={t("history.table")}
          dated={old !== null}
        />
      )}
    </div>
  );
}

/** The rows of the shown version, in the order of the catalogue and with its names. */
function useLines(): readonly HistoryLine[] {
  const live = usePlc((plc) => plc.instances);
  const old = useRecords((records) => records.old);
  const { errors } = useCatalogue();
  return useMemo(() => {
    const rows = new Map<string, ErrorHistoryRow[]>();
    for (const row of old ? old.rows : live.values()) rows.set(row.id, [...(rows.get(row.id) ?? []), row]);
    const names = new Map(errors.map(({ id, name }) => [id, name]));
    // Errors that are not in the catalogue of the running program come last: they belong to a different version.
    const others = old ? old.rows.filter(({ id }) => !names.has(id)) : [];
    const known = errors.flatMap(({ id }) => (rows.get(id) ?? []).sort(byNumber));
    return [...known, ...others].map((row) => ({ ...row, name: names.get(row.id) ?? row.name }));
  }, [live, old, errors]);
}

const byNumber = (a: ErrorHistoryRow, b: ErrorHistoryRow) => keyOf(a).localeCompare(keyOf(b), "en", { numeric: true });

function VersionMenu({ running }: { running: number | null }) {
  const { versions, old } = useRecords();
  const shown = old?.version ?? running;
  if (shown === null) return null;

  function items(): MenuItem[] {
    return versions.map(({ version, raised, at }) => ({
      label: t(version === running ? "history.version.running" : "history.version", { version }),
      hint: [t("history.raised", { raised }), at ? dayTime(at) : ""].filter(Boolean).join(" · "),
      checked: version === shown,
      onSelect: () => void showVersion(version),
    }));
  }

  const word = t(old ? "history.version" : "history.version.running", { version: shown });
  return (
    <MenuButton label={t("history.version.of", { version: word })} items={items} disabled={versions.length === 0}>
      <span className="cut">{word}</span>
      <Icon name="chev-d" small />
    </MenuButton>
  );
}
