import { useEffect, useState } from "react";
import { isSplit, lineOf, REQUIREMENTS, requiredOf, withRequired } from "../../../logic/errors/required";
import { messageOf } from "../../../logic/format/messageOf";
import { openFile } from "../../../store/page/navigate";
import { createFile, edit, isDirty, openDocument, useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

/** The lines of `required.reactions` that are about one error, to be edited where the error is. */
export function RequiredLines({ error }: { error: string }) {
  const exists = useDocuments(({ files }) => files.some(({ path }) => path === REQUIREMENTS));
  const text = useDocuments(({ open }) => open[REQUIREMENTS]?.text);
  const unsaved = useDocuments(({ open }) => isDirty(open[REQUIREMENTS]));
  const [open, setOpen] = useState(false);
  const [typed, setTyped] = useState("");
  const [refused, setRefused] = useState("");
  const told = text === undefined ? "" : requiredOf(text, error);
  const split = isSplit(text ?? "", error);
  useEffect(() => {
    if (open && exists) openDocument(REQUIREMENTS).catch((why: unknown) => setRefused(messageOf(why)));
  }, [open, exists]);
  // Others edit the same file: what they typed is shown; what only ends in a space here is the same.
  useEffect(
    () => setTyped((before) => (requiredOf(withRequired("", error, before), error) === told ? before : told)),
    [told, error],
  );

  async function change(next: string): Promise<void> {
    setTyped(next);
    try {
      if (!exists) await createFile(REQUIREMENTS, "");
      await openDocument(REQUIREMENTS);
      const now = useDocuments.getState().open[REQUIREMENTS]?.text ?? "";
      edit(REQUIREMENTS, withRequired(now, error, next));
      setRefused("");
    } catch (why) {
      setRefused(messageOf(why));
    }
  }

  return (
    <details className="reqedit" open={open} onToggle={(event) => setOpen(event.currentTarget.open)}>
      <summary>{t("required.edit")}</summary>
      <textarea
        className="field"
        aria-label={t("required.edit.label")}
        placeholder={t("required.edit.example")}
        spellCheck={false}
        rows={3}
        value={typed}
        readOnly={split}
        onChange={(event) => void change(event.target.value)}
      />
      <Mistakes error={error} text={text ?? ""} />
      {refused && <p className="hint bad">{refused}</p>}
      <p className="hint">
        {t(split ? "required.edit.split" : unsaved ? "required.edit.unsaved" : "required.edit.about")}{" "}
        {exists && (
          <button type="button" className="link" onClick={() => openFile(REQUIREMENTS, lineOf(text ?? "", error) ?? 1)}>
            {t("required.edit.file")}
          </button>
        )}
      </p>
    </details>
  );
}

/** What the checks say of these lines. */
function Mistakes({ error, text }: { error: string; text: string }) {
  const problems = useDocuments((documents) => documents.problems);
  const from = lineOf(text, error);
  if (from === null) return null;
  const to = from + requiredOf(text, error).split("\n").length;
  const ours = problems.filter(({ file, line }) => file === REQUIREMENTS && line >= from && line <= to);
  if (ours.length === 0) return null;
  return (
    <ul role="alert">
      {ours.map(({ line, column, message }) => (
        <li key={`${line}:${column}`} className="hint bad">
          <Icon name="warning" small />
          <span>{message}</span>
        </li>
      ))}
    </ul>
  );
}
