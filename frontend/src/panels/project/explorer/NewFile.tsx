import { useState } from "react";
import { declares, newFilePath } from "../../../logic/project/explorer";
import {
  hasBody,
  isPouName,
  KINDS,
  kindOf,
  languagesOf,
  type NewKind,
  type NewLanguage,
  nameOf,
  skeleton,
} from "../../../logic/project/skeleton";
import { openFile } from "../../../store/page/navigate";
import { useBench } from "../../../store/plc/bench";
import { createFile, useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import { Field } from "../../../ui/Field";
import { FormDialog } from "../../../ui/FormDialog";
import { Segments } from "../../../ui/Segments";

/** Asks for a name, for what is declared and in which language, and creates the file with a first text. */
export function NewFile({ onClose }: { onClose: () => void }) {
  const files = useDocuments((documents) => documents.files);
  const input = useBench((bench) => bench.model?.areas[0]?.first);
  const [name, setName] = useState("");
  const [chosen, setChosen] = useState<NewKind | null>(null);
  const [wanted, setWanted] = useState<NewLanguage>("ST");
  const kind = chosen ?? kindOf(name);
  const language = languagesOf(kind).includes(wanted) ? wanted : "ST";
  const free = declares(name.trim());

  async function create(): Promise<void> {
    const path = newFilePath(name, files);
    if (path === null) throw new Error(t("file.badname"));
    if (declares(path) && kind !== "global" && !isPouName(nameOf(path)))
      throw new Error(t("file.badpou", { name: nameOf(path) }));
    await createFile(path, skeleton(path, { kind, language, ...(input === undefined ? {} : { input }) }));
    openFile(path, 1);
  }

  return (
    <FormDialog
      title={t("file.new")}
      about={t("file.new.about")}
      submit={t("create")}
      onSubmit={create}
      onClose={onClose}
    >
      {({ refused }) => (
        <>
          <Field label={t("file.name")} value={name} onChange={setName} refused={refused} />
          {free ? (
            <>
              <Kind value={kind} onChoose={setChosen} />
              {hasBody(kind) && <Language kind={kind} value={language} onChoose={setWanted} />}
            </>
          ) : (
            <p className="faint">{t("file.new.named")}</p>
          )}
        </>
      )}
    </FormDialog>
  );
}

function Kind({ value, onChoose }: { value: NewKind; onChoose: (kind: NewKind) => void }) {
  return (
    <label className="field">
      <span>{t("file.kind")}</span>
      <select className="inp" value={value} onChange={({ target }) => onChoose(target.value as NewKind)}>
        {KINDS.map((kind) => (
          <option key={kind} value={kind}>
            {t(`file.kind.${kind}`)}
          </option>
        ))}
      </select>
    </label>
  );
}

interface LanguageProps {
  kind: NewKind;
  value: NewLanguage;
  onChoose: (language: NewLanguage) => void;
}

function Language({ kind, value, onChoose }: LanguageProps) {
  const words = languagesOf(kind).map((language) => ({ value: language, word: t(`file.language.${language}`) }));
  return (
    <div className="field">
      <span>{t("file.language")}</span>
      <Segments label={t("file.language")} value={value} options={words} onChoose={onChoose} />
    </div>
  );
}
