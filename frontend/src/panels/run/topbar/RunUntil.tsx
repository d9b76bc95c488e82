import { useState } from "react";
import { withName } from "../../../logic/plc/expression";
import { runUntil, useRun } from "../../../store/debug/run";
import { t } from "../../../text";
import { Dialog } from "../../../ui/Dialog";
import { Field } from "../../../ui/Field";

interface Refused {
  message: string;
  near: readonly string[];
}

/** Asks for the condition at which a run ends; a name that is not known gets the names that come near. */
export function RunUntil({ onClose }: { onClose: () => void }) {
  const conditions = useRun((run) => run.conditions);
  const [condition, setCondition] = useState(conditions[0] ?? "");
  const [refused, setRefused] = useState<Refused | null>(null);

  function change(text: string): void {
    setCondition(text);
    setRefused(null);
  }

  async function run(): Promise<void> {
    const text = condition.trim();
    if (text === "") {
      setRefused({ message: t("run.noexpression"), near: [] });
      return;
    }
    const answer = await runUntil(text);
    if (answer.ok) onClose();
    else setRefused({ message: answer.message || t("notsent"), near: answer.near ?? [] });
  }

  return (
    <Dialog
      title={t("run.until.title")}
      about={t("run.until.about")}
      width={520}
      onClose={onClose}
      onSubmit={() => void run()}
      footer={
        <>
          <span className="grow" />
          <button type="button" className="btn quiet" onClick={onClose}>
            {t("cancel")}
          </button>
          <button type="submit" className="btn primary">
            {t("run.scans.do")}
          </button>
        </>
      }
    >
      <Field
        label={t("run.until.condition")}
        value={condition}
        onChange={change}
        refused={refused?.message ?? null}
        mono
        placeholder="Main.count > 3"
      />
      {refused && refused.near.length > 0 && (
        <Offers
          label={t("run.near")}
          texts={refused.near}
          onChoose={(name) => change(withName(condition, refused.message, name))}
        />
      )}
      {conditions.length > 0 && <Offers label={t("run.last")} texts={conditions} onChoose={change} />}
    </Dialog>
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
