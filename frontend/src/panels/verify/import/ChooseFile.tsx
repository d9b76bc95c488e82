import { type DragEvent, useRef, useState } from "react";
import { grouped } from "../../../logic/format/numbers";
import { readTrace, useTraceImport } from "../../../store/verify/traceImport";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

/** The file: dropped here, or chosen. After that, one line describes it. */
export function ChooseFile() {
  const { trace, reading } = useTraceImport();
  const chooser = useRef<HTMLInputElement>(null);
  const [over, setOver] = useState(false);

  function onDrag(event: DragEvent): void {
    if (!event.dataTransfer.types.includes("Files")) return;
    event.preventDefault();
    setOver(true);
  }

  function onDrop(event: DragEvent): void {
    setOver(false);
    const [file] = event.dataTransfer.files;
    if (!file) return;
    event.preventDefault();
    void readTrace(file);
  }

  const choose = (key: "import.trace.again" | "import.trace.choose") => (
    <button type="button" className="btn sm" disabled={reading !== null} onClick={() => chooser.current?.click()}>
      {t(key)}
    </button>
  );
  return (
    <div
      className={`${trace ? "tifile" : "tidrop"}${over ? " over" : ""}`}
      onDragOver={onDrag}
      onDragLeave={() => setOver(false)}
      onDrop={onDrop}
    >
      <Icon name="import" small={trace !== null} />
      {reading !== null && (
        <span className="grow" role="status">
          {t("import.trace.reading", { name: reading })}
        </span>
      )}
      {reading === null && trace && (
        <span className="grow cut">
          <b>{trace.name}</b>{" "}
          <span className="muted">
            {t("import.trace.rows", { rows: grouped(trace.rows), columns: trace.columns.length })}
          </span>{" "}
          {trace.layout !== "" && <span className="chip">{trace.layout}</span>}{" "}
          {trace.left_out.length > 0 && (
            <span className="muted" title={trace.left_out.join("\n")}>
              {t("import.trace.leftout", { count: trace.left_out.length })}
            </span>
          )}
        </span>
      )}
      {reading === null && !trace && (
        <p>
          {t("import.trace.drop")}
          <small className="faint">{t("import.trace.drop.about")}</small>
        </p>
      )}
      {choose(trace ? "import.trace.again" : "import.trace.choose")}
      <input
        ref={chooser}
        type="file"
        hidden
        aria-label={t("import.trace.file")}
        accept=".csv,.json,.txt,.tsv,.trace,.xml,text/csv,application/json"
        onChange={(event) => {
          const file = event.target.files?.[0];
          event.target.value = ""; // choosing the same file again, corrected, counts as a change, too
          if (file) void readTrace(file);
        }}
      />
    </div>
  );
}
