import { codeText } from "../../../logic/errors/codeText";
import { type Entries, type Entry, troubles } from "../../../logic/errors/details";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { ErrorInfo } from "../../../wire/types";
import { RoomyControl } from "./controls";

interface Props {
  error: ErrorInfo;
  entries: Entries;
  /** Other errors of the dialog that ask for the same kind of detail. */
  alike: readonly ErrorInfo[];
  same: boolean;
  onEntry: (name: string, entry: Entry) => void;
  onSame: () => void;
}

/** One error in the dialog: its description, and its details. */
export function DetailsPage({ error, entries, alike, same, onEntry, onSame }: Props) {
  const fatal = error.severity === "fatal";
  const refused = troubles(error, entries);
  return (
    <>
      <div>
        <h3 className="row">
          {error.name}
          <span className={`chip ${fatal ? "fatal" : "halted"}`}>
            <Icon name={fatal ? "fatal" : "warning"} />
            {t(fatal ? "errors.fatal" : "errors.nonfatal")}
          </span>
        </h3>
        <span className="kv">
          <span>
            {t("errors.code")}
            <b>{codeText(error.code)}</b>
          </span>
          <span>
            {t("errors.flag")}
            <b>{error.flag}</b>
          </span>
        </span>
      </div>
      {error.description && <p className="desc">{error.description}</p>}
      {error.details.length === 0 && <p className="faint">{t("dialog.nodetails")}</p>}
      <div className="roomies">
        {error.details.map((detail) => (
          <RoomyControl
            key={detail.name}
            detail={detail}
            entry={entries[detail.name] ?? { text: "", format: "decimal" }}
            trouble={refused.get(detail.name) ?? null}
            onEntry={(entry) => onEntry(detail.name, entry)}
          />
        ))}
      </div>
      {alike.length > 0 && (
        <span className="row">
          <input id="same-kind" type="checkbox" className="box" checked={same} onChange={onSame} />
          <label htmlFor="same-kind">{t("dialog.same")}</label>
          <span className="muted cut">
            {t("dialog.alike", { count: alike.length, names: alike.map((other) => other.name).join(", ") })}
          </span>
        </span>
      )}
    </>
  );
}
