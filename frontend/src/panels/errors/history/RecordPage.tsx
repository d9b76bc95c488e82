import { useEffect, useMemo, useState } from "react";
import { everything, type HistoryView, recordLines } from "../../../logic/errors/history";
import { UNGRADED, VERDICTS } from "../../../logic/errors/sweep";
import { dayTime } from "../../../logic/format/numbers";
import { useCatalogueOf } from "../../../store/errors/catalogue";
import { deleteRecord, importedAddress, loadRecord, showRecord, useRecords } from "../../../store/errors/records";
import { useBench } from "../../../store/plc/bench";
import { t } from "../../../text";
import { Confirm } from "../../../ui/Confirm";
import { Icon } from "../../../ui/Icon";
import { MenuButton } from "../../../ui/Menu";
import { StateWord } from "../../../ui/StateWord";
import { VERDICT_ICONS } from "../../../ui/statuses";
import type { ImportedRecord, TestRecord } from "../../../wire/types";
import { Filters } from "./Filters";
import { HistoryTable } from "./HistoryTable";
import "./history.css";
import { openAddress } from "./RecordMenu";

/** An imported test record: what a different PLC was tested against. Nothing on this page can be changed. */
export function RecordPage() {
  const project = useBench((bench) => bench.project?.id ?? null);
  // biome-ignore lint/correctness/useExhaustiveDependencies: runs again for a different project, which has its own records
  useEffect(() => void loadRecord(), [project]);
  const { record, list, trouble } = useRecords();
  return (
    <div className="pane flexcol" data-pane="record">
      {trouble && (
        <p className="trouble st fatal" role="alert">
          <Icon name="error" small />
          <span>{trouble}</span>
        </p>
      )}
      {record ? (
        <Whole key={record.info.id} imported={record} />
      ) : (
        <p className="lonely faint">{t(list.length === 0 ? "record.none" : "record.loading")}</p>
      )}
    </div>
  );
}

function Whole({ imported }: { imported: ImportedRecord }) {
  const { info, record } = imported;
  const [view, setView] = useState<HistoryView>(everything);
  const [doomed, setDoomed] = useState(false);
  const { byId } = useCatalogueOf(record.model);
  const lines = useMemo(
    () => recordLines(record).map((line) => ({ ...line, name: byId.get(line.id)?.name ?? line.name })),
    [record, byId],
  );
  return (
    <>
      <div className="sub tall">
        <Picker imported={imported} />
        <span className="grow" />
        <button type="button" className="btn sm" onClick={() => openAddress(importedAddress(info, "html"), true)}>
          {t("record.print")}
        </button>
        <button type="button" className="btn quiet sm" onClick={() => openAddress(importedAddress(info, "xml"), false)}>
          {t("record.xml")}
        </button>
        <button type="button" className="btn quiet sm" onClick={() => setDoomed(true)}>
          {t("record.delete")}
        </button>
      </div>
      <p className="oldnote st past" role="status">
        <Icon name="import" small />
        <span>{t("record.imported", { by: info.by, at: dayTime(info.at) })}</span>
      </p>
      <Facts record={record} />
      <Counts record={record} />
      <div className="sub hbar" role="toolbar" aria-label={t("record.table")}>
        <Filters view={view} onView={(change) => setView({ ...view, ...change })} />
      </div>
      <HistoryTable
        lines={lines}
        view={view}
        onView={(change) => setView({ ...view, ...change })}
        label={t("record.table")}
        dated
      />
      {doomed && (
        <Confirm
          title={t("record.delete.title")}
          about={info.title}
          hint={t("record.delete.hint")}
          verb={t("record.delete")}
          onDo={() => deleteRecord(info)}
          onClose={() => setDoomed(false)}
        />
      )}
    </>
  );
}

function Picker({ imported }: { imported: ImportedRecord }) {
  const list = useRecords((records) => records.list);
  const { id, title } = imported.info;
  return (
    <MenuButton
      label={t("record.choose", { title })}
      className="btn quiet sm rectitle"
      items={() =>
        list.map((other) => ({ label: other.title, checked: other.id === id, onSelect: () => showRecord(other.id) }))
      }
    >
      <b className="cut">{title}</b>
      <Icon name="chev-d" small />
    </MenuButton>
  );
}

function Facts({ record }: { record: TestRecord }) {
  const facts = [
    [t("record.project"), record.project],
    [t("record.instance"), record.instance],
    [t("record.model"), record.model],
    [t("record.version"), String(record.program_version)],
    [t("record.written"), `${dayTime(record.exported_at)}, ${record.exported_by}`],
    [t("record.tool"), record.tool],
  ] as const;
  return (
    <dl className="recfacts">
      {facts.map(([name, value]) => (
        <div key={name}>
          <dt>{name}</dt>
          <dd className="cut" title={value}>
            {value}
          </dd>
        </div>
      ))}
      <div className="wide">
        <dt>{t("record.hash")}</dt>
        <dd className="mono cut" title={record.program_hash}>
          {record.program_hash || "–"}
        </dd>
      </div>
    </dl>
  );
}

function Counts({ record }: { record: TestRecord }) {
  const { summary, sweeps, log } = record;
  return (
    <p className="reccounts">
      <span>{t("record.tested", { tested: summary.tested, errors: summary.errors })}</span>
      {[...VERDICTS, ...UNGRADED]
        .filter((verdict) => summary.verdicts[verdict])
        .map((verdict) => (
          <span key={verdict}>
            <StateWord tone={verdict} icon={VERDICT_ICONS[verdict]} word={t(`verdict.${verdict}`)} />{" "}
            <b>{summary.verdicts[verdict] ?? 0}</b>
          </span>
        ))}
      {summary.accepted > 0 && <span>{t("record.accepted", { count: summary.accepted })}</span>}
      {sweeps.length + log.length > 0 && (
        <span className="faint">{t("record.more", { sweeps: sweeps.length, lines: log.length })}</span>
      )}
    </p>
  );
}
