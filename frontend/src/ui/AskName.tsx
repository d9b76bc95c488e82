import { type ReactNode, useState } from "react";
import { t } from "../text";
import { Dialog } from "./Dialog";
import { Field } from "./Field";

interface Props {
  title: string;
  about?: string;
  label: string;
  /** What the button that does it says. */
  action: string;
  /** What it is called unless somebody types; may change with what else is filled in. */
  initial?: string;
  /** What is said when nothing was entered. */
  missing?: string;
  /** Throws what was wrong; it is shown below the field. */
  onName: (name: string) => Promise<void>;
  onClose: () => void;
  /** More to fill in, above the name. */
  children?: ReactNode;
}

/** A dialog that asks for one name. */
export function AskName({
  title,
  about,
  label,
  action,
  initial = "",
  missing = t("name.missing"),
  onName,
  onClose,
  children,
}: Props) {
  const [typed, setTyped] = useState<string | null>(null);
  const name = typed ?? initial;
  const [refused, setRefused] = useState<string | null>(null);
  const [busy, setBusy] = useState(false);

  async function submit(): Promise<void> {
    if (name.trim() === "") {
      setRefused(missing);
      return;
    }
    setBusy(true);
    try {
      await onName(name.trim());
      onClose();
    } catch (error) {
      setRefused(error instanceof Error ? error.message : String(error));
      setBusy(false);
    }
  }

  return (
    <Dialog
      title={title}
      about={about}
      onClose={onClose}
      onSubmit={() => void submit()}
      footer={
        <>
          <span className="grow" />
          <button type="button" className="btn quiet" onClick={onClose}>
            {t("cancel")}
          </button>
          <button type="submit" className="btn primary" disabled={busy}>
            {action}
          </button>
        </>
      }
    >
      {children}
      <Field label={label} value={name} onChange={setTyped} refused={refused} />
    </Dialog>
  );
}
