import { useCallback, useEffect, useState } from "react";
import { messageOf } from "../../../logic/format/messageOf";
import { useBench } from "../../../store/plc/bench";
import { listModels } from "../../../store/plc/models";
import { createProject, listTemplates } from "../../../store/project/newProject";
import { t } from "../../../text";
import { Field } from "../../../ui/Field";
import { FormDialog } from "../../../ui/FormDialog";
import type { ModelSummary, ProjectTemplate } from "../../../wire/types";
import { ArchiveField, type Chosen } from "./ArchiveField";
import { ModelFacts } from "./ModelFacts";
import { TemplateField } from "./TemplateField";

interface Props {
  /** A zip file that was dropped on the page. */
  dropped?: File | null;
  onClose: () => void;
}

/** Asks for the name, the PLC model and the first instance of a new project. */
/** Characters that a name has at most, as the server wants it. */
const LONGEST = 100;

export function NewProject({ dropped = null, onClose }: Props) {
  const [models, setModels] = useState<readonly ModelSummary[]>([]);
  const [name, setName] = useState("");
  /** Empty until somebody chooses: then it is the model of the archive, or a usual one. */
  const [picked, setPicked] = useState("");
  const taken = useBench(({ app }) => app?.instances);
  const [instance, setInstance] = useState(() => freeName((taken ?? []).map((known) => known.name)));
  const [unreachable, setUnreachable] = useState<string | null>(null);
  const [wrongInstance, setWrongInstance] = useState(false);
  const [archive, setArchive] = useState<Chosen>("none");
  const [templates, setTemplates] = useState<readonly ProjectTemplate[]>([]);
  const [template, setTemplate] = useState("");

  const isKnown = (wanted: string) => models.some((known) => known.name === wanted);
  const written =
    typeof archive === "object" ? archive.found.model : (templates.find(({ id }) => id === template)?.model ?? "");
  const model = picked || (isKnown(written) ? written : usual(models));

  const isTaken = (wanted: string) => taken?.some((known) => known.name === wanted) === true;

  const loadModels = useCallback(() => {
    setUnreachable(null);
    Promise.all([listModels(), listTemplates()])
      .then(([found, begun]) => {
        setModels(found);
        setTemplates(begun);
      })
      .catch((error: unknown) => setUnreachable(messageOf(error)));
  }, []);
  useEffect(loadModels, [loadModels]);

  async function create(): Promise<boolean> {
    // Without a model no project can be created: this only asks for the models again.
    if (model === "") {
      loadModels();
      return false;
    }
    const [project, first] = [name.trim(), instance.trim()];
    const wrong = (name: string) => name === "" || name.length > LONGEST;
    setWrongInstance(!wrong(project) && (wrong(first) || isTaken(first)));
    if (project === "" || first === "") throw new Error(t("name.missing"));
    const { length = 0 } = [project, first].find((each) => each.length > LONGEST) ?? {};
    if (length > 0) throw new Error(t("name.long", { longest: LONGEST, length }));
    // Checked before anything is created: otherwise a project without an instance would remain after a failure.
    if (isTaken(first)) throw new Error(t("newproject.taken", { name: first }));
    await createProject(project, model, first, typeof archive === "object" ? archive.file : template);
    return true;
  }

  return (
    <FormDialog
      title={t("newproject.title")}
      about={t("newproject.about")}
      width={520}
      submit={model === "" && unreachable !== null ? t("lost.now") : t("create")}
      disabled={(model === "" && unreachable === null) || archive === "not yet"}
      onSubmit={create}
      onClose={onClose}
    >
      {({ refused }) => (
        <>
          <Field
            label={t("newproject.name")}
            value={name}
            onChange={setName}
            refused={unreachable ?? (wrongInstance ? null : refused)}
          />
          <label className="field">
            <span>{t("newproject.model")}</span>
            <select
              className="inp"
              value={model}
              disabled={models.length === 0}
              onChange={(event) => setPicked(event.target.value)}
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
          <TemplateField templates={templates} value={template} disabled={archive !== "none"} onChoose={setTemplate} />
          <ArchiveField
            dropped={dropped}
            onChoose={(chosen) => {
              setArchive(chosen);
              if (typeof chosen !== "object") return;
              const { file, found } = chosen;
              setName((typed) => typed || found.name || file.name.replace(/\.(zip|xml)$/i, ""));
              if (isKnown(found.model)) setPicked("");
            }}
          />
          {written !== "" && written !== model && (
            <p className="hint">
              {t(typeof archive === "object" ? "newproject.archive.model" : "newproject.template.model", {
                model: written,
              })}
            </p>
          )}
          <Field
            label={t("newproject.instance")}
            value={instance}
            onChange={setInstance}
            refused={wrongInstance ? refused : null}
          />
        </>
      )}
    </FormDialog>
  );
}

const usual = (models: readonly ModelSummary[]) =>
  (models.find((known) => known.name === "GENERIC-IEC") ?? models[0])?.name ?? "";

/** The first of plc-1, plc-2, ... that is free. */
function freeName(taken: readonly string[]): string {
  let number = 1;
  while (taken.includes(`plc-${number}`)) number += 1;
  return `plc-${number}`;
}
