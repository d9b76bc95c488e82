import { useState } from "react";
import { baseName } from "../logic/format/paths";
import { discard, isEdited, saveUserErrors, useUserErrors } from "../store/errors/userErrors";
import { discardEdits, isDirty, isKept, save, useDocuments } from "../store/project/documents";
import { sharedText } from "../store/project/drafts";
import { othersOf, usePeople } from "../store/project/people";
import { t } from "../text";
import { Dialog } from "../ui/Dialog";
import { Icon } from "../ui/Icon";
import { useClosing } from "./closing";
import { fileOf } from "./layout";

interface Held {
  name: string;
  /** The text is also kept in this browser, so closing the tab loses nothing. */
  kept: boolean;
  /** It is a draft that everybody shares, so nobody loses it, and who discards it discards it for all. */
  shared: boolean;
  /** Who else is in it now. To discard would take from them what they typed. */
  others: readonly string[];
  /** Why saving failed; null when it did not. */
  save: () => Promise<string | null>;
  discard: () => Promise<void> | void;
}

/** Asks what to do with the unsaved text when somebody closes its tab. */
export function CloseUnsaved({ onClosed }: { onClosed: (panel: string) => void }) {
  const panel = useClosing((closing) => closing.panel);
  const people = usePeople();
  if (panel === null) return null;
  const path = fileOf(panel);
  return (
    <Question
      key={panel}
      held={path === undefined ? errors : file(path, othersAt(path, people))}
      onDone={() => onClosed(panel)}
    />
  );
}

function Question({ held, onDone }: { held: Held; onDone: () => void }) {
  const [refused, setRefused] = useState<string | null>(null);
  const stay = () => useClosing.setState({ panel: null });
  const close = () => {
    stay();
    onDone();
  };
  const saveAndClose = async () => {
    const why = await held.save();
    if (why === null) close();
    else setRefused(why);
  };
  return (
    <Dialog
      title={t("close.title", { name: held.name })}
      about={t(held.shared ? "close.about.shared" : held.kept ? "close.about" : "close.unkept")}
      width={520}
      onClose={stay}
      onSubmit={() => void saveAndClose()}
      footer={
        <>
          {held.others.length === 0 && (
            <button
              type="button"
              className="btn danger"
              onClick={() => void Promise.resolve(held.discard()).then(close)}
            >
              {t("close.discard")}
            </button>
          )}
          <span className="grow" />
          <button type="button" className="btn quiet" onClick={stay}>
            {t("cancel")}
          </button>
          {held.kept && (
            <button type="button" className="btn" onClick={close}>
              {t(held.shared ? "close.keep.shared" : "close.keep")}
            </button>
          )}
          <button type="submit" className="btn primary">
            {t("save")}
          </button>
        </>
      }
    >
      {refused === null ? (
        <p className="desc">{hint(held)}</p>
      ) : (
        <p className="hint bad" role="alert">
          <Icon name="error" small />
          {refused}
        </p>
      )}
    </Dialog>
  );
}

function hint({ shared, others }: Held): string {
  if (others.length > 0) return t("close.hint.others", { names: others.join(", ") });
  return t(shared ? "close.hint.shared" : "close.hint");
}

const othersAt = (path: string, people: Parameters<typeof othersOf>[0]) =>
  sharedText(path) ? othersOf(people).flatMap(({ file, name }) => (file === path ? name : [])) : [];

const file = (path: string, others: readonly string[]): Held => ({
  name: baseName(path),
  kept: isKept(path),
  shared: sharedText(path) !== undefined,
  others,
  save: async () => {
    if (await save(path)) return null;
    const { open, trouble } = useDocuments.getState();
    if (open[path]?.conflict) return t("close.conflict");
    return isDirty(open[path]) ? (trouble ?? t("unsaved")) : null;
  },
  discard: () => discardEdits(path),
});

const errors: Held = {
  name: t("usererrors.title"),
  kept: true,
  shared: false,
  others: [],
  save: async () => {
    await saveUserErrors();
    const now = useUserErrors.getState();
    if (now.conflict) return t("close.conflict");
    return isEdited(now) ? (now.trouble ?? now.problems[0]?.message ?? t("unsaved")) : null;
  },
  discard,
};
