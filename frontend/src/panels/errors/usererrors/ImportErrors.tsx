import { useState } from "react";
import { importUserErrors, isEdited, useUserErrors } from "../../../store/errors/userErrors";
import { t } from "../../../text";
import { FormDialog } from "../../../ui/FormDialog";
import { Icon } from "../../../ui/Icon";

/** Asks for a file, and whether it replaces the existing errors. The dialog stays open while the file is wrong. */
export function ImportErrors({ onClose }: { onClose: () => void }) {
  const state = useUserErrors();
  const count = state.errors.length;
  const [file, setFile] = useState<File | null>(null);
  const [how, setHow] = useState<"replace" | "add">(count > 0 ? "add" : "replace");

  async function take(): Promise<void> {
    const why = file ? await importUserErrors(file, how) : t("usererrors.import.missing");
    if (why !== null) throw new Error(why);
  }

  return (
    <FormDialog
      title={t("usererrors.import.title")}
      about={t("usererrors.import.about")}
      submit={t("usererrors.import.do")}
      onSubmit={take}
      onClose={onClose}
      aside={<span className="grow hint bad">{isEdited(state) && t("usererrors.import.edited")}</span>}
    >
      {({ refused }) => (
        <>
          <label className="field">
            <span>{t("usererrors.import.file")}</span>
            <input
              type="file"
              accept=".xml,application/xml,text/xml"
              className="inp file"
              onChange={(event) => setFile(event.target.files?.[0] ?? null)}
            />
          </label>
          {count > 0 && (
            <fieldset className="uehow">
              <legend>{t("usererrors.import.how")}</legend>
              {(["add", "replace"] as const).map((each) => (
                <label key={each} className="row">
                  <input type="radio" name="how" checked={how === each} onChange={() => setHow(each)} />
                  {t(`usererrors.import.${each}`, { count })}
                </label>
              ))}
            </fieldset>
          )}
          <p className="uerefused" role="alert">
            {refused && (
              <>
                <Icon name="error" small />
                <span>{refused}</span>
              </>
            )}
          </p>
        </>
      )}
    </FormDialog>
  );
}
