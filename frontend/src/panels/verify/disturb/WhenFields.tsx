import { type DisturbForm, isSeeded, type readDisturbance, WHENS } from "../../../logic/verify/disturb";
import { setDisturbance } from "../../../store/verify/disturb";
import { t } from "../../../text";
import { FieldLine } from "./FieldLine";
import { NumberField } from "./NumberField";

interface Props {
  form: DisturbForm;
  troubles: ReturnType<typeof readDisturbance>["troubles"];
}

/** Once, or at random; the seed where it has an effect. */
export function WhenFields({ form, troubles }: Props) {
  return (
    <>
      <FieldLine label={t("disturb.when")}>
        {(id) => (
          <>
            <select
              id={id}
              className="inp sm"
              value={form.when}
              onChange={(event) => setDisturbance({ when: event.target.value as DisturbForm["when"] })}
            >
              {WHENS.map((when) => (
                <option key={when} value={when}>
                  {t(`disturb.when.${when}`)}
                </option>
              ))}
            </select>
            {form.when === "scan" && (
              <NumberField
                label={t("shape.scan")}
                value={form.scan}
                bad={troubles.scan !== undefined}
                onChange={(scan) => setDisturbance({ scan })}
              />
            )}
          </>
        )}
      </FieldLine>
      {form.when === "chance" && <Chance form={form} troubles={troubles} />}
      {isSeeded(form) && (
        <FieldLine label={t("disturb.seed")}>
          {(id) => (
            <NumberField
              id={id}
              value={form.seed}
              title={t("disturb.seed.about")}
              bad={troubles.seed !== undefined}
              onChange={(seed) => setDisturbance({ seed })}
            />
          )}
        </FieldLine>
      )}
    </>
  );
}

function Chance({ form, troubles }: Props) {
  return (
    <>
      <FieldLine label={t("disturb.chance")}>
        {(id) => (
          <NumberField
            id={id}
            value={form.chance}
            placeholder="0.1 %"
            bad={troubles.chance !== undefined}
            onChange={(chance) => setDisturbance({ chance })}
          />
        )}
      </FieldLine>
      <FieldLine label={t("disturb.first")}>
        {(id) => (
          <NumberField
            id={id}
            value={form.scan}
            placeholder={t("disturb.first.any")}
            bad={troubles.scan !== undefined}
            onChange={(scan) => setDisturbance({ scan })}
          />
        )}
      </FieldLine>
      <FieldLine label={t("disturb.times")}>
        {(id) => (
          <>
            <NumberField
              id={id}
              value={form.times}
              placeholder={t("disturb.times.endless")}
              bad={troubles.times !== undefined}
              onChange={(times) => setDisturbance({ times })}
            />
            <span className="faint">{t("disturb.times.unit")}</span>
          </>
        )}
      </FieldLine>
    </>
  );
}
