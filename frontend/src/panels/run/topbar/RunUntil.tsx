import { useState } from "react";
import { withName } from "../../../logic/plc/expression";
import { runUntil, useRun } from "../../../store/debug/run";
import { t } from "../../../text";
import { Field } from "../../../ui/Field";
import { FormDialog } from "../../../ui/FormDialog";

/** Asks for the condition at which a run ends; for an unknown name it offers similar names. */
export function RunUntil({ onClose }: { onClose: () => void }) {
  const conditions = useRun((run) => run.conditions);
  const [condition, setCondition] = useState(conditions[0] ?? "");
  const [near, setNear] = useState<readonly string[]>([]);
  async function run(): Promise<void> {
    const text = condition.trim();
    setNear([]);
    if (text === "") throw new Error(t("run.noexpression"));
    const answer = await runUntil(text);
    if (answer.ok) return;
    setNear(answer.near ?? []);
    throw new Error(answer.message || t("notsent"));
  }

  return (
    <FormDialog
      title={t("run.until.title")}
      about={t("run.until.about")}
      width={520}
      submit={t("run.scans.do")}
      onSubmit={run}
      onClose={onClose}
    >
      {({ refused, forget }) => {
        const change = (text: string) => {
          setCondition(text);
          forget();
        };
        return (
          <>
            <Field
              label={t("run.until.condition")}
              value={condition}
              onChange={setCondition}
              refused={refused}
              mono
              placeholder="Main.count > 3"
            />
            {refused !== null && near.length > 0 && (
              <Offers
                label={t("run.near")}
                texts={near}
                onChoose={(name) => change(withName(condition, refused, name))}
              />
            )}
            {conditions.length > 0 && <Offers label={t("run.last")} texts={conditions} onChoose={change} />}
          </>
        );
      }}
    </FormDialog>
  );
}

interface OffersProps {
  label: string;
  texts: readonly string[];
  onChoose: (text: string) => void;
}

function Offers({ label, texts, onChoose }: OffersProps) {
  return (
    <div className="offerlist" role="group" aria-label={label}>
      <span className="hint">{label}</span>
      {texts.map((text) => (
        <button key={text} type="button" className="link mono cut" title={text} onClick={() => onChoose(text)}>
          {text}
        </button>
      ))}
    </div>
  );
}
