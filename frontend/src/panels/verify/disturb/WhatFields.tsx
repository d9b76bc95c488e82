import { type DisturbForm, type readDisturbance, turnsBits } from "../../../logic/verify/disturb";
import { complete } from "../../../store/plc/completion";
import { useDocuments } from "../../../store/project/documents";
import { setDisturbance } from "../../../store/verify/disturb";
import { t } from "../../../text";
import { PathField } from "../../../ui/PathField";
import { FieldLine } from "./FieldLine";
import { NumberField } from "./NumberField";

interface Props {
  form: DisturbForm;
  troubles: ReturnType<typeof readDisturbance>["troubles"];
}

/** What is disturbed, and for how long. */
export function WhatFields({ form, troubles }: Props) {
  const { kind } = form;
  return (
    <>
      {kind === "result" ? (
        <Site form={form} bad={troubles.site !== undefined} />
      ) : (
        <FieldLine label={t("disturb.path")}>
          {(id) => (
            <PathField
              id={id}
              label={t("disturb.path")}
              value={form.path}
              placeholder={kind === "flip" ? "Main.count" : t("disturb.path.all")}
              complete={complete}
              bad={troubles.path !== undefined}
              onChange={(path) => setDisturbance({ path })}
            />
          )}
        </FieldLine>
      )}
      {turnsBits(kind) ? (
        <FieldLine label={t("disturb.bit")}>
          {(id) => (
            <NumberField
              id={id}
              value={form.bit}
              placeholder={t("disturb.bit.any")}
              bad={troubles.bit !== undefined}
              onChange={(bit) => setDisturbance({ bit })}
            />
          )}
        </FieldLine>
      ) : (
        <Length form={form} bad={troubles.scans !== undefined} />
      )}
    </>
  );
}

/** A statement: typed, or taken from the caret of the editor. */
function Site({ form, bad }: { form: DisturbForm; bad: boolean }) {
  const cursor = useDocuments((documents) => documents.cursor);
  const active = useDocuments((documents) => documents.active);
  const place = active && cursor ? `${active}:${cursor.line}` : null;
  return (
    <FieldLine label={t("disturb.site")}>
      {(id) => (
        <>
          <input
            id={id}
            className={`inp sm mono site${bad ? " bad" : ""}`}
            aria-invalid={bad}
            placeholder="Main.st:12"
            value={form.site}
            spellCheck={false}
            autoComplete="off"
            onChange={(event) => setDisturbance({ site: event.target.value })}
          />
          {place && place !== form.site && (
            <button type="button" className="link" onClick={() => setDisturbance({ site: place })}>
              {t("disturb.site.here", { place })}
            </button>
          )}
        </>
      )}
    </FieldLine>
  );
}

function Length({ form, bad }: { form: DisturbForm; bad: boolean }) {
  const endless = form.kind === "stuck" && form.endless;
  return (
    <FieldLine label={t("disturb.scans")}>
      {(id) => (
        <>
          <NumberField
            id={id}
            value={endless ? "" : form.scans}
            bad={bad}
            disabled={endless}
            onChange={(scans) => setDisturbance({ scans })}
          />
          <span className="faint">{t("shape.scans")}</span>
          {form.kind === "stuck" && (
            <label className="row tightish">
              <input
                type="checkbox"
                className="box"
                checked={form.endless}
                onChange={() => setDisturbance({ endless: !form.endless })}
              />
              {t("disturb.scans.endless")}
            </label>
          )}
        </>
      )}
    </FieldLine>
  );
}
