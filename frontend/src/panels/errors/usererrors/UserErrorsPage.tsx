import { type KeyboardEvent, useEffect, useState } from "react";
import { generalProblems } from "../../../logic/errors/userErrors";
import {
  addError,
  complaints,
  discard,
  exportUserErrors,
  isEdited,
  loadUserErrors,
  saveUserErrors,
  useUserErrors,
} from "../../../store/errors/userErrors";
import { useBench } from "../../../store/plc/bench";
import { build } from "../../../store/project/documents";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { Conflict } from "./Conflict";
import { ErrorForm } from "./ErrorForm";
import { ErrorList } from "./ErrorList";
import { ImportErrors } from "./ImportErrors";
import { NoErrors } from "./NoErrors";
import { Unreadable } from "./Unreadable";
import "./usererrors.css";

/** The page of the errors that the project defines itself: the list on the left, the form of the selected error on the right. */
export function UserErrorsPage() {
  const project = useBench((bench) => bench.project?.id ?? null);
  useEffect(() => void loadUserErrors(project), [project]);
  const [importing, setImporting] = useState(false);
  const state = useUserErrors();
  const { errors, stored, readable, problems, selected, conflict } = state;
  const shown = selected === null ? undefined : errors[selected];

  function onKeyDown(event: KeyboardEvent): void {
    if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "s") return;
    event.preventDefault();
    event.stopPropagation();
    if (isEdited(state)) void saveUserErrors();
  }

  return (
    <div className="pane flexcol" data-pane="usererrors" onKeyDown={onKeyDown}>
      <Toolbar onImport={() => setImporting(true)} />
      <Notes />
      {conflict && <Conflict theirs={conflict} />}
      {project === null ? (
        <p className="lonely faint">{t("usererrors.noproject")}</p>
      ) : stored === null ? (
        <p className="lonely faint">{t("usererrors.loading")}</p>
      ) : !readable && errors.length === 0 ? (
        <Unreadable problems={problems} />
      ) : errors.length === 0 ? (
        <NoErrors />
      ) : (
        <div className="uesplit">
          <ErrorList errors={errors} problems={complaints(state)} selected={selected} />
          {shown && selected !== null ? (
            <ErrorForm key={selected} index={selected} error={shown} problems={complaints(state)} />
          ) : (
            <p className="lonely faint">{t("usererrors.select")}</p>
          )}
        </div>
      )}
      {importing && <ImportErrors onClose={() => setImporting(false)} />}
    </div>
  );
}

function Toolbar({ onImport }: { onImport: () => void }) {
  const state = useUserErrors();
  const edited = isEdited(state);
  const ready = state.stored !== null;
  return (
    <div className="sub tall uebar">
      <button type="button" className="btn sm" disabled={!ready} onClick={addError}>
        <Icon name="plus" small />
        {t("usererrors.add")}
      </button>
      <button type="button" className="btn sm" disabled={!ready} onClick={onImport}>
        <Icon name="import" small />
        {t("usererrors.import")}
      </button>
      <button
        type="button"
        className="btn sm"
        disabled={state.version === 0}
        title={t("usererrors.export.hint")}
        onClick={() => void exportUserErrors()}
      >
        <Icon name="export" small />
        {t("usererrors.export")}
      </button>
      <span className="grow" />
      {edited && (
        <span className="st muted" role="status">
          <span className="dirty" />
          {t("unsaved")}
        </span>
      )}
      {edited && (
        <button type="button" className="btn quiet sm" onClick={() => void discard()}>
          {t("usererrors.discard")}
        </button>
      )}
      <button
        type="button"
        className="btn primary sm"
        disabled={!edited}
        title={t("save.hint")}
        onClick={() => void saveUserErrors()}
      >
        {t("save")}
      </button>
    </div>
  );
}

/** The result of the last request: refused, or stored and waiting for a build. */
function Notes() {
  const state = useUserErrors();
  if (state.trouble !== null)
    return (
      <p className="banner uenote" role="alert">
        <span className="st fatal">
          <Icon name="error" small />
        </span>
        <span className="grow">{state.trouble}</span>
      </p>
    );
  const [general] = state.readable ? generalProblems(state.problems) : [];
  if (general)
    return (
      <p className="banner uenote" role="alert">
        <span className="st fatal">
          <Icon name="error" small />
        </span>
        <span className="grow">{general.message}</span>
      </p>
    );
  if (!state.unbuilt || isEdited(state)) return null;
  return (
    <div className="banner uenote" role="status">
      <Icon name="info" small />
      <span className="grow">{t("usererrors.about.saved", state)}</span>
      <button type="button" className="btn sm" onClick={() => void build()}>
        {t("build")}
      </button>
    </div>
  );
}
