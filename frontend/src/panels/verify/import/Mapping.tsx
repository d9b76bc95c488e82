import {
  byColumn,
  changeColumn,
  countRoles,
  firstValues,
  hasTolerance,
  isProposed,
  ROLES,
} from "../../../logic/verify/traceImport";
import { useWidths } from "../../../store/page/columns";
import { complete } from "../../../store/plc/completion";
import { editMapping, forgetMapping, loadMapping, useTraceImport } from "../../../store/verify/traceImport";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { MenuButton, type MenuItem } from "../../../ui/Menu";
import { PathField } from "../../../ui/PathField";
import { useColumns } from "../../../ui/useColumns";
import type { TraceColumnMap, TraceMapping, TraceProblem, UploadedTrace } from "../../../wire/types";
import { placeOf } from "./Problems";
import { toleranceText } from "./Tolerance";

interface Props {
  trace: UploadedTrace;
  mapping: TraceMapping;
  onSave: () => void;
  /** The tolerance of a column is to be changed. */
  onTolerance: (column: string) => void;
}

/** The columns: the first values of each, its role, and the variable that it belongs to. */
export function Mapping({ trace, mapping, onSave, onTolerance }: Props) {
  const problems = useTraceImport((state) => state.checked?.problems);
  const { style, head } = useColumns(useWidths("mapping"));
  const wrong = byColumn(problems ?? []);
  return (
    <section className="timap" aria-label={t("import.trace.mapping")}>
      <div className="row">
        <b>{t("import.trace.mapping")}</b>
        <span className="faint grow">{t("import.trace.inputs", countRoles(mapping))}</span>
        <MenuButton label={t("import.trace.load")} className="btn quiet sm" items={savedItems}>
          {t("import.trace.load")}
          <Icon name="chev-d" small />
        </MenuButton>
        <button type="button" className="btn quiet sm" onClick={onSave}>
          {t("import.trace.save")}
        </button>
      </div>
      <div className="titable scroll" role="table" aria-label={t("import.trace.columns")} style={style}>
        <div className="gr h" role="row">
          {(["column", "values", "role", "variable"] as const).map((column) =>
            head(column, t(`import.trace.${column}`)),
          )}
          <span role="columnheader">{t("import.trace.tolerance")}</span>
          <span role="columnheader" aria-label={t("import.trace.proposed")} />
        </div>
        {mapping.axis !== "" && <AxisRow trace={trace} axis={mapping.axis} wrong={wrong.get(mapping.axis)} />}
        {mapping.columns.map((row) => (
          <ColumnRow
            key={row.column}
            row={row}
            trace={trace}
            wrong={wrong.get(row.column)}
            onChange={(change) => editMapping(changeColumn(mapping, row.column, change))}
            onTolerance={onTolerance}
          />
        ))}
      </div>
    </section>
  );
}

function savedItems(): MenuItem[] {
  const { saved } = useTraceImport.getState();
  if (saved.length === 0) return [{ label: t("import.trace.load.none"), disabled: true, onSelect: () => undefined }];
  return [
    ...saved.map((each) => ({ label: shownName(each.name), hint: each.by, onSelect: () => loadMapping(each) })),
    ...saved.map((each, index) => ({
      label: t("import.trace.load.forget", { name: shownName(each.name) }),
      icon: "trash" as const,
      separated: index === 0,
      onSelect: () => void forgetMapping(each),
    })),
  ];
}

/** The server saves the mapping of the last verification under this name. */
const shownName = (name: string) => (name === "Last import" ? t("import.trace.last") : name);

interface AxisRowProps {
  trace: UploadedTrace;
  axis: string;
  wrong: readonly TraceProblem[] | undefined;
}

function AxisRow({ trace, axis, wrong }: AxisRowProps) {
  return (
    <div className="gr" role="row" data-column={axis}>
      <Name column={axis} wrong={wrong} />
      <Values trace={trace} column={axis} />
      <span role="cell" className="faint">
        {t("import.trace.axis")}
      </span>
      <span role="cell" />
      <span role="cell" />
      <span role="cell" />
    </div>
  );
}

interface ColumnRowProps {
  row: TraceColumnMap;
  trace: UploadedTrace;
  wrong: readonly TraceProblem[] | undefined;
  onChange: (change: Partial<TraceColumnMap>) => void;
  onTolerance: (column: string) => void;
}

function ColumnRow({ row, trace, wrong, onChange, onTolerance }: ColumnRowProps) {
  const { column, path, role } = row;
  return (
    <div className={`gr${role === "ignore" ? " unused" : ""}`} role="row" data-column={column}>
      <Name column={column} wrong={wrong} />
      <Values trace={trace} column={column} />
      <span role="cell">
        <select
          className="inp sm"
          aria-label={t("import.trace.role.of", { column })}
          value={role}
          onChange={(event) => onChange({ role: event.target.value as TraceColumnMap["role"] })}
        >
          {ROLES.map((each) => (
            <option key={each} value={each}>
              {t(`import.trace.role.${each}`)}
            </option>
          ))}
        </select>
      </span>
      <span role="cell" className="row">
        <PathField
          label={t("import.trace.variable.of", { column })}
          value={path}
          complete={complete}
          bad={role !== "ignore" && (wrong?.some(isOfColumn) ?? false)}
          onChange={(next) => onChange({ path: next })}
        />
      </span>
      <span role="cell">{role === "output" && <Within row={row} onTolerance={onTolerance} />}</span>
      <span role="cell">{isProposed(row, trace.mapping) && <Proposed trace={trace} column={column} />}</span>
    </div>
  );
}

/** How much the output may differ; the button changes that. */
function Within({ row, onTolerance }: { row: TraceColumnMap; onTolerance: (column: string) => void }) {
  const label = t("import.trace.tolerance.of", { column: row.column });
  return (
    <button type="button" className="btn quiet sm" aria-label={label} onClick={() => onTolerance(row.column)}>
      {hasTolerance(row) ? toleranceText(row) : <span className="faint">{t("import.trace.tolerance.none")}</span>}
    </button>
  );
}

/** The variable is the proposed one; how sure that is, where it is not certain. */
function Proposed({ trace, column }: { trace: UploadedTrace; column: string }) {
  const guess = trace.guesses.find((each) => each.column === column);
  const unsure = guess !== undefined && guess.score < 1;
  const others = guess?.near.slice(1) ?? [];
  const about = [
    t("import.trace.proposed.about"),
    others.length > 0 ? t("import.trace.proposed.near", { names: others.join(", ") }) : "",
  ];
  return (
    <span className="chip" title={about.filter(Boolean).join(" ")}>
      {t("import.trace.proposed")}
      {unsure && ` ${Math.round(guess.score * 100)} %`}
    </span>
  );
}

/** A problem of the column itself, not of one of its cells: the server reports it for the head of the file. */
const isOfColumn = ({ row, warning }: TraceProblem) => !warning && (row === null || row <= 1);

/** The name of the column in the file; marked when it has a problem. */
function Name({ column, wrong }: { column: string; wrong: readonly TraceProblem[] | undefined }) {
  const refusing = wrong?.some(({ warning }) => !warning) ?? false;
  const why = wrong?.map((problem) => [placeOf(problem), problem.message].filter(Boolean).join(": ")).join("\n");
  return (
    <span role="rowheader" className="mono" title={[column, why].filter(Boolean).join("\n")}>
      {wrong && (
        <span className={`st ${refusing ? "fatal" : "warning"}`}>
          <Icon name={refusing ? "error" : "warning"} small />
          <span className="sr">{wrong[0]?.message}</span>
        </span>
      )}
      <span className="cut">{column}</span>
    </span>
  );
}

function Values({ trace, column }: { trace: UploadedTrace; column: string }) {
  const text = firstValues(trace.sample, trace.columns.indexOf(column));
  return (
    <span role="cell" className="mono muted cut" title={text}>
      {text}
    </span>
  );
}
