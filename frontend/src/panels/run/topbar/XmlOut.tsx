import { useEffect, useState } from "react";
import { messageOf } from "../../../logic/format/messageOf";
import { saveExchangeFile, writeProject } from "../../../store/project/newProject";
import { t } from "../../../text";
import { FileLists } from "../../../ui/FileLists";
import { FormDialog } from "../../../ui/FormDialog";
import { Segments } from "../../../ui/Segments";
import { Trouble } from "../../../ui/Trouble";
import type { ExchangeFile, ExchangeForm, Project } from "../../../wire/types";

const FORMS = ["tc6", "iec61131-10"] as const satisfies readonly ExchangeForm[];

interface Props {
  project: Project;
  onClose: () => void;
}

/** Says what a file for other tools has no place for, and saves it. */
export function XmlOut({ project, onClose }: Props) {
  const [form, setForm] = useState<ExchangeForm>("tc6");
  const [made, setMade] = useState<ExchangeFile | null>(null);
  const [trouble, setTrouble] = useState<string | null>(null);

  useEffect(() => {
    let over = false;
    setMade(null);
    setTrouble(null);
    writeProject(project, form).then(
      (file) => over || setMade(file),
      (error: unknown) => over || setTrouble(messageOf(error)),
    );
    return () => {
      over = true;
    };
  }, [project, form]);

  return (
    <FormDialog
      title={t("xmlout.title", { name: project.name })}
      about={t("xmlout.about")}
      width={520}
      submit={t("xmlout.save")}
      disabled={made === null}
      onSubmit={async () => made && saveExchangeFile(made)}
      onClose={onClose}
    >
      <div>
        <Segments
          label={t("xmlout.form")}
          options={FORMS.map((value) => ({ value, word: t(`xmlout.form.${value}`) }))}
          value={form}
          onChoose={setForm}
        />
      </div>
      <Trouble text={trouble} />
      {!made && !trouble && <p role="status">{t("xmlout.writing")}</p>}
      {made && made.left_out.length === 0 && <p role="status">{t("xmlout.all")}</p>}
      {made && made.left_out.length > 0 && (
        <FileLists>
          <h3>{t("xmlout.left", { count: made.left_out.length })}</h3>
          <ul aria-label={t("xmlout.left", { count: made.left_out.length })}>
            {made.left_out.map((each) => (
              <li key={each}>{each}</li>
            ))}
          </ul>
        </FileLists>
      )}
    </FormDialog>
  );
}
