import { useState } from "react";
import { grouped } from "../../../logic/format/numbers";
import { changeColumn } from "../../../logic/verify/traceImport";
import { useBench } from "../../../store/plc/bench";
import {
  beginTrace,
  closeTraceImport,
  editMapping,
  saveMapping,
  useTraceImport,
} from "../../../store/verify/traceImport";
import { t } from "../../../text";
import { AskName } from "../../../ui/AskName";
import { Dialog } from "../../../ui/Dialog";
import { Icon } from "../../../ui/Icon";
import { Axis } from "./Axis";
import { ChooseController } from "./ChooseController";
import { ChooseFile } from "./ChooseFile";
import { Mapping } from "./Mapping";
import { Problems } from "./Problems";
import { Tolerance } from "./Tolerance";
import "./traceimport.css";

const WIDTH = 940;

/** Imports a controller log and verifies it. If the dialog is closed before the start, everything stays as it is. */
export function TraceImport() {
  const open = useTraceImport((state) => state.open);
  return open ? <ImportDialog /> : null;
}

function ImportDialog() {
  const { trace, mapping, refused, checked, busy, trouble } = useTraceImport();
  const instance = useBench((bench) => bench.instance);
  const [naming, setNaming] = useState(false);
  const [column, setColumn] = useState<string | null>(null);
  const row = mapping?.columns.find((each) => each.column === column);
  // Problems of reading the file, and of the mapping.
  const told = [...(trace?.problems ?? []), ...(checked?.problems ?? [])];
  return (
    <>
      <Dialog
        title={t("import.trace.title")}
        about={t("import.trace.about")}
        width={WIDTH}
        onClose={closeTraceImport}
        footer={
          <>
            <Verdict />
            <button type="button" className="btn quiet" onClick={closeTraceImport}>
              {t("cancel")}
            </button>
            {/* Enter in a field does not submit: it continues in the next line. */}
            <button
              type="button"
              className="btn primary"
              disabled={instance === null || trouble !== null || !checked?.ok || busy}
              onClick={() => void beginTrace()}
            >
              {t("import.trace.start")}
            </button>
          </>
        }
      >
        <div className="traceimport">
          {instance === null && (
            <p className="hint bad" role="alert">
              <Icon name="error" small />
              {t("import.trace.noinstance")}
            </p>
          )}
          <ChooseFile />
          <ChooseController />
          {refused && <Refused />}
          {trace && mapping && (
            <>
              <Axis trace={trace} mapping={mapping} />
              <Mapping trace={trace} mapping={mapping} onSave={() => setNaming(true)} onTolerance={setColumn} />
              {told.length > 0 && (
                <Problems
                  problems={told}
                  onTake={(column, path) => editMapping(changeColumn(mapping, column, { path }))}
                />
              )}
            </>
          )}
        </div>
      </Dialog>
      {/* beside the dialog: a form inside of its form would not be one */}
      {mapping && row && (
        <Tolerance
          row={row}
          onChange={(within) => editMapping(changeColumn(mapping, row.column, within))}
          onClose={() => setColumn(null)}
        />
      )}
      {naming && <SaveMapping onClose={() => setNaming(false)} />}
    </>
  );
}

function SaveMapping({ onClose }: { onClose: () => void }) {
  return (
    <AskName
      title={t("import.trace.save")}
      label={t("import.trace.save.name")}
      action={t("import.trace.save.do")}
      onName={saveMapping}
      onClose={onClose}
    />
  );
}

/** The file could not be read: nothing was imported. */
function Refused() {
  const refused = useTraceImport((state) => state.refused);
  if (!refused) return null;
  return (
    <div className="tirefused" role="alert">
      <p className="st fatal">
        <Icon name="error" small />
        <span>
          <b>{t("import.trace.refused", { name: refused.name })}</b> {refused.message}
        </span>
      </p>
      {refused.problems.length > 0 && <Problems problems={refused.problems} />}
    </div>
  );
}

/** Says whether the log can be verified with the current mapping. */
function Verdict() {
  const { trace, checked, trouble, told, busy } = useTraceImport();
  if (busy) {
    return (
      <span className="tiverdict grow" role="status">
        {t("import.trace.starting")}
      </span>
    );
  }
  if (trouble !== null) {
    return (
      <span className="hint bad grow" role="alert">
        <Icon name="error" small />
        {trouble}
      </span>
    );
  }
  const wrong = checked?.problems.filter(({ warning }) => !warning).length ?? 0;
  return (
    <span className="tiverdict grow" role="status">
      {trace && !checked && <span className="faint">{t("import.trace.check.busy")}</span>}
      {checked && !checked.ok && (
        <span className="st fatal">
          <Icon name="error" small />
          {t("import.trace.check.bad", {
            count: wrong,
          })}
        </span>
      )}
      {checked?.ok && (
        <span className="st running">
          <Icon name="check" small />
          {t("import.trace.check.ok", { first: grouped(checked.first ?? 0), last: grouped(checked.last ?? 0) })}
        </span>
      )}
      {checked && checked.missing > 0 && (
        <span className="muted">
          {t("import.trace.check.missing", {
            count: grouped(checked.missing),
          })}
        </span>
      )}
      {told && <span className="muted">{told}</span>}
    </span>
  );
}
