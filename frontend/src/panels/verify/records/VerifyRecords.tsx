import { type KeyboardEvent, useState } from "react";
import { dayTime, grouped } from "../../../logic/format/numbers";
import { ranIn, titleOf } from "../../../logic/verify/verify";
import { useWidths } from "../../../store/page/columns";
import { useBench } from "../../../store/plc/bench";
import {
  closeVerifyRecords,
  deleteRecord,
  exportRecord,
  openRecord,
  useVerifyRecords,
} from "../../../store/verify/verifyRecords";
import { t } from "../../../text";
import { Confirm } from "../../../ui/Confirm";
import { Dialog } from "../../../ui/Dialog";
import { Empty } from "../../../ui/Empty";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { MenuButton, type MenuItem } from "../../../ui/Menu";
import { useColumns } from "../../../ui/useColumns";
import type { VerificationRecord } from "../../../wire/types";
import "./verifyrecords.css";

const FORMATS = ["html", "csv", "json", "junit"] as const;
const WIDTH = 960;
/** From this number on, the list has a filter. */
const MANY = 8;

/** The kept verifications of this project: open, export, delete. */
export function VerifyRecords() {
  const open = useVerifyRecords((records) => records.open);
  return open ? <RecordsDialog /> : null;
}

function RecordsDialog() {
  const { list, trouble } = useVerifyRecords();
  const project = useBench((bench) => bench.project?.name ?? "");
  const [deleting, setDeleting] = useState<VerificationRecord | null>(null);
  return (
    <>
      <Dialog
        title={t("verify.records.title")}
        about={t("verify.records.about", { project })}
        width={WIDTH}
        onClose={closeVerifyRecords}
        footer={
          <>
            <span className="hint bad grow" role="alert">
              {trouble && (
                <>
                  <Icon name="error" small />
                  {trouble}
                </>
              )}
            </span>
            <button type="button" className="btn" onClick={closeVerifyRecords}>
              {t("close")}
            </button>
          </>
        }
      >
        {list === null && <p className="faint">{t("verify.records.loading")}</p>}
        {list?.length === 0 && trouble === null && <NoRecords />}
        {list && list.length > 0 && <Records list={list} onDelete={setDeleting} />}
      </Dialog>
      {deleting && (
        <Confirm
          title={t("verify.records.delete.title")}
          about={t("verify.records.delete.about", { name: deleting.name })}
          hint={t("verify.records.delete.hint")}
          verb={t("verify.records.delete.do")}
          onDo={() => deleteRecord(deleting)}
          onClose={() => setDeleting(null)}
        />
      )}
    </>
  );
}

function NoRecords() {
  return (
    <Empty
      title={t("verify.records.none")}
      about={t("verify.records.none.about")}
      ways={[{ icon: "record", strong: t("verify.records.none.keep"), rest: t("verify.records.none.keep.rest") }]}
    />
  );
}

interface RecordsProps {
  list: readonly VerificationRecord[];
  onDelete: (record: VerificationRecord) => void;
}

function Records({ list, onDelete }: RecordsProps) {
  const [filter, setFilter] = useState("");
  const { th } = useColumns(useWidths("verify.records"));
  const wanted = filter.trim().toLowerCase();
  const shown = list.filter(({ name, by, instance, info }) =>
    [name, by, instance, info.title].some((text) => text.toLowerCase().includes(wanted)),
  );
  return (
    <>
      {list.length >= MANY && (
        <span className="inp sm">
          <Icon name="search" small />
          <input
            type="search"
            aria-label={t("verify.records.filter")}
            placeholder={t("verify.records.filter")}
            value={filter}
            spellCheck={false}
            onChange={(event) => setFilter(event.target.value)}
          />
        </span>
      )}
      <div className="vrscroll scroll">
        <table className="vrtable" aria-label={t("verify.records.title")}>
          <thead>
            <tr>
              {(["name", "range", "program", "scans", "differences", "by", "at"] as const).map((column) =>
                th(column, t(`verify.records.${column}`), ["scans", "differences"].includes(column) ? "num" : ""),
              )}
              <th aria-label={t("verify.records.open.do")} />
            </tr>
          </thead>
          <tbody>
            {shown.map((record) => (
              <RecordLine key={record.id} record={record} onDelete={() => onDelete(record)} />
            ))}
          </tbody>
        </table>
        {shown.length === 0 && <p className="lonely faint">{t("verify.records.nomatch")}</p>}
      </div>
    </>
  );
}

function RecordLine({ record, onDelete }: { record: VerificationRecord; onDelete: () => void }) {
  const { name, instance, by, at, program_version, info } = record;
  const scans = info.scan === null ? "" : `${grouped(info.first)} – ${grouped(info.scan)}`;
  const items = (): MenuItem[] =>
    FORMATS.map((format) => ({
      label: t(`verify.records.export.${format}`),
      onSelect: () => void exportRecord(record, format),
    }));

  function onKeyDown(event: KeyboardEvent): void {
    if (event.key !== "Delete") return;
    event.preventDefault();
    onDelete();
  }

  return (
    <tr data-record={record.id} onKeyDown={onKeyDown} onDoubleClick={() => openRecord(record)}>
      <th scope="row" className="cut" title={name}>
        <button
          type="button"
          className="link cut"
          aria-label={t("verify.records.open", { name })}
          onClick={() => openRecord(record)}
        >
          {name}
        </button>
      </th>
      <td className="cut" title={titleOf(info)}>
        {titleOf(info)}
      </td>
      <td className="cut" title={`${info.source === "trace" ? info.trace : instance}, ${versionOf(program_version)}`}>
        {info.source === "trace" ? info.trace : instance}, {versionOf(program_version)}
      </td>
      <td className="num" title={scans}>
        {grouped(ranIn(info))}
      </td>
      <td className="num">
        {info.differing === 0 ? (
          <span className="muted">{t(ranIn(info) === 0 ? "verify.state.nothing" : "verify.records.same")}</span>
        ) : (
          <span className="st fatal">
            <Icon name="differs" small />
            {grouped(info.differing)}
          </span>
        )}
      </td>
      <td className="cut" title={by}>
        {by}
      </td>
      <td>{dayTime(at)}</td>
      <td className="acts">
        <MenuButton label={t("verify.records.export", { name })} className="ib sm" items={items}>
          <Icon name="export" />
        </MenuButton>
        <IconButton icon="trash" small label={t("verify.records.delete", { name })} onClick={onDelete} />
      </td>
    </tr>
  );
}

const versionOf = (version: number) => t("verify.records.version", { version });
