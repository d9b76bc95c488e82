import { useCallback, useEffect, useState } from "react";
import { messageOf } from "../../../logic/format/messageOf";
import { useBench } from "../../../store/plc/bench";
import { listModels } from "../../../store/plc/models";
import { createProject } from "../../../store/project/newProject";
import { t } from "../../../text";
import { Dialog } from "../../../ui/Dialog";
import { Field } from "../../../ui/Field";
import type { ModelSummary } from "../../../wire/types";
import { ModelFacts } from "./ModelFacts";

/** Asks for the name, the PLC model and the first instance of a new project. */
export function NewProject({ onClose }: { onClose: () => void }) {
  const [models, setModels] = useState<readonly ModelSummary[]>([]);
  const [name, setName] = useState("");
  const [model, setModel] = useState("");
  const taken = useBench(({ app }) => app?.instances);
  const [instance, setInstance] = useState(() => freeName((taken ?? []).map((known) => known.name)));
  const [refused, setRefused] = useState<{ instance: boolean; why: string } | null>(null);

  const [creating, setCreating] = useState(false);

  const loadModels = useCallback(() => {
    setRefused(null);
    listModels()
      .then((all) => {
        setModels(all);
        setModel((chosen) => chosen || (all.find((known) => known.name === "GENERIC-IEC") ?? all[0])?.name || "");
      })
      .catch((error: unknown) => setRefused({ instance: false, why: messageOf(error) }));
  }, []);
  useEffect(loadModels, [loadModels]);

  async function create(): Promise<void> {
    if (creating) return;
    // Without a model there is nothing to make; the one that is asked for again may come now.
    if (model === "") {
      loadModels();
      return;
    }
    if (name.trim() === "" || instance.trim() === "") {
      setRefused({ instance: name.trim() !== "", why: t("name.missing") });
      return;
    }
    // Asked before anything is made: a project without its instance would be left behind.
    if (taken?.some((known) => known.name === instance.trim())) {
      setRefused({ instance: true, why: t("newproject.taken", { name: instance.trim() }) });
      return;
    }
    setCreating(true);
    try {
      await createProject(name.trim(), model, instance.trim());
      onClose();
    } catch (error) {
      setRefused({ instance: false, why: messageOf(error) });
    } finally {
      setCreating(false);
    }
  }

  return (
    <Dialog
      title={t("newproject.title")}
      about={t("newproject.about")}
      width={520}
      onClose={onClose}
      onSubmit={() => void create()}
      footer={
        <>
          <span className="grow" />
          <button type="button" className="btn quiet" onClick={onClose}>
            {t("cancel")}
          </button>
          <button type="submit" className="btn primary" disabled={creating || (model === "" && refused === null)}>
            {model === "" && refused !== null ? t("lost.now") : t("create")}
          </button>
        </>
      }
    >
      <Field
        label={t("newproject.name")}
        value={name}
        onChange={setName}
        refused={refused && !refused.instance ? refused.why : null}
      />
      <label className="field">
        <span>{t("newproject.model")}</span>
        <select
          className="inp"
          value={model}
          disabled={models.length === 0}
          onChange={(event) => setModel(event.target.value)}
        >
          {models.length === 0 && <option value="">{t("newproject.loading")}</option>}
          {models.map((known) => (
            <option key={known.name} value={known.name}>
              {known.vendor ? `${known.vendor} ${known.name}` : known.name}
            </option>
          ))}
        </select>
      </label>
      <ModelFacts model={models.find((known) => known.name === model)} />
      <Field
        label={t("newproject.instance")}
        value={instance}
        onChange={setInstance}
        refused={refused?.instance ? refused.why : null}
      />
    </Dialog>
  );
}

/** The first of plc-1, plc-2, ... that is not taken. */
function freeName(taken: readonly string[]): string {
  let number = 1;
  while (taken.includes(`plc-${number}`)) number += 1;
  return `plc-${number}`;
}
