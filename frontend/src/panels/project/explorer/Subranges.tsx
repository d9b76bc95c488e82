import { useEffect, useState } from "react";
import { useDialectVersion } from "../../../store/project/dialect";
import {
  changeSubranges,
  loadSubranges,
  POLICIES,
  type Policies,
  type Policy,
  useSubranges,
  WHOLE_PROJECT,
} from "../../../store/project/subranges";
import { t } from "../../../text";
import { Dialog } from "../../../ui/Dialog";
import { IconButton } from "../../../ui/IconButton";

/** What becomes of values outside of subranges: for the whole project, and by variables, types and POUs. Each change is saved at once. */
export function Subranges({ project, onClose }: { project: number; onClose: () => void }) {
  const { policies, trouble } = useSubranges();
  const version = useDialectVersion();
  // biome-ignore lint/correctness/useExhaustiveDependencies: a new version of the file may say something else
  useEffect(() => void loadSubranges(project), [project, version]);
  const said = policies ?? {};
  const entries = Object.entries(said).filter(([name]) => name !== WHOLE_PROJECT);
  const save = (next: Policies) => changeSubranges(project, next);
  const without = (name: string) => Object.fromEntries(Object.entries(said).filter(([each]) => each !== name));
  return (
    <Dialog
      title={t("subranges")}
      about={t("subranges.about")}
      trouble={trouble}
      width={640}
      onClose={onClose}
      footer={
        <>
          <span className="grow" />
          <button type="button" className="btn" onClick={onClose}>
            {t("close")}
          </button>
        </>
      }
    >
      {policies !== null && (
        <>
          <div className="policy">
            <b className="grow">{t("subranges.all")}</b>
            <PolicyChoice
              label={t("subranges.all")}
              value={said[WHOLE_PROJECT] ?? "limit"}
              onChoose={(policy) => void save({ ...said, [WHOLE_PROJECT]: policy })}
            />
          </div>
          <ul className="libraries" aria-label={t("subranges.entries")}>
            {entries.map(([name, policy]) => (
              <li key={name}>
                <span className="mono grow cut" title={name}>
                  {name}
                </span>
                <PolicyChoice
                  label={t("subranges.of", { name })}
                  value={policy}
                  onChoose={(next) => void save({ ...said, [name]: next })}
                />
                <IconButton
                  icon="trash"
                  label={t("subranges.remove", { name })}
                  onClick={() => void save(without(name))}
                />
              </li>
            ))}
          </ul>
          <NewEntry onAdd={(name, policy) => save({ ...said, [name]: policy })} />
        </>
      )}
    </Dialog>
  );
}

/** Keeps what was typed until it is saved. */
function NewEntry({ onAdd }: { onAdd: (name: string, policy: Policy) => Promise<boolean> }) {
  const [name, setName] = useState("");
  const [policy, setPolicy] = useState<Policy>("trap");
  const typed = name.trim();
  const add = async () => {
    if (typed !== "" && (await onAdd(typed, policy))) setName("");
  };
  return (
    <div className="policy">
      <input
        className="inp mono grow"
        aria-label={t("subranges.name")}
        placeholder={t("subranges.name.hint")}
        value={name}
        maxLength={200}
        onChange={(event) => setName(event.target.value)}
        onKeyDown={(event) => {
          if (event.key !== "Enter") return;
          event.preventDefault();
          void add();
        }}
      />
      <PolicyChoice label={t("subranges.new")} value={policy} onChoose={setPolicy} />
      <button type="button" className="btn" disabled={typed === ""} onClick={() => void add()}>
        {t("subranges.add")}
      </button>
    </div>
  );
}

interface ChoiceProps {
  label: string;
  value: Policy;
  onChoose: (policy: Policy) => void;
}

function PolicyChoice({ label, value, onChoose }: ChoiceProps) {
  return (
    <select
      className="inp sm"
      aria-label={label}
      value={value}
      title={t(`subranges.${value}.about`)}
      onChange={(event) => onChoose(event.target.value as Policy)}
    >
      {POLICIES.map((each) => (
        <option key={each} value={each}>
          {t(`subranges.${each}`)}
        </option>
      ))}
    </select>
  );
}
