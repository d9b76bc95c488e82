import { type Format, formatsFor } from "../../../logic/format/formats";
import { inOrder, type Unit } from "../../../logic/verify/verifyColumns";
import { shapeOf } from "../../../logic/verify/verifyValues";
import {
  moveColumn,
  resetColumns,
  setColumnFormat,
  toggleHidden,
  togglePinned,
  useArrangement,
} from "../../../store/verify/verifyColumns";
import { t } from "../../../text";
import { Dialog } from "../../../ui/Dialog";
import { IconButton } from "../../../ui/IconButton";

interface Props {
  range: string;
  units: readonly Unit[];
  onClose: () => void;
}

/** All columns: which are shown, which are pinned, in which order and format. This browser stores the choice for each range. */
export function ColumnsDialog({ range, units, onClose }: Props) {
  const arrangement = useArrangement(range);
  const all = inOrder(units, arrangement);
  return (
    <Dialog
      title={t("verify.columns")}
      about={t("verify.columns.about")}
      width={560}
      onClose={onClose}
      onSubmit={onClose}
      footer={
        <>
          <button type="button" className="btn quiet" onClick={() => resetColumns(range)}>
            {t("verify.columns.reset")}
          </button>
          <span className="grow" />
          <button type="submit" className="btn primary">
            {t("close")}
          </button>
        </>
      }
    >
      {all.length === 0 && <p className="desc">{t("verify.columns.none")}</p>}
      <ul className="vfcolumns" aria-label={t("verify.columns")}>
        {all.map((unit, at) => (
          <Line
            key={unit.key}
            range={range}
            units={units}
            unit={unit}
            shown={!arrangement.hidden.includes(unit.key)}
            pinned={arrangement.pinned.includes(unit.key)}
            format={arrangement.formats[unit.column.name] ?? "default"}
            first={at === 0}
            last={at === all.length - 1}
          />
        ))}
      </ul>
    </Dialog>
  );
}

interface LineProps {
  range: string;
  units: readonly Unit[];
  unit: Unit;
  shown: boolean;
  pinned: boolean;
  format: Format;
  first: boolean;
  last: boolean;
}

function Line({ range, units, unit, shown, pinned, format, first, last }: LineProps) {
  const { key, side, column } = unit;
  const formats = formatsFor(shapeOf(column));
  return (
    <li>
      <label className="row cut">
        <input type="checkbox" className="box" checked={shown} onChange={() => toggleHidden(range, key)} />
        <span className="mono cut" title={`${column.name} : ${column.type}`}>
          {column.name}
        </span>
        <span className="faint">{t(side === "output" ? "verify.output" : "verify.input")}</span>
      </label>
      {formats.length > 0 && (
        <select
          className="inp sm"
          aria-label={t("verify.columns.format", { name: column.name })}
          value={format}
          onChange={(event) => setColumnFormat(range, column.name, event.target.value as Format)}
        >
          {formats.map((each) => (
            <option key={each} value={each}>
              {t(`format.${each}`)}
            </option>
          ))}
        </select>
      )}
      <button
        type="button"
        className={`btn quiet sm${pinned ? " on" : ""}`}
        aria-pressed={pinned}
        onClick={() => togglePinned(range, key)}
      >
        {t("verify.pin")}
      </button>
      <IconButton
        icon="chev-u"
        small
        label={t("verify.columns.earlier", { name: column.name })}
        disabled={first}
        onClick={() => moveColumn(range, units, key, -1)}
      />
      <IconButton
        icon="chev-d"
        small
        label={t("verify.columns.later", { name: column.name })}
        disabled={last}
        onClick={() => moveColumn(range, units, key, 1)}
      />
    </li>
  );
}
