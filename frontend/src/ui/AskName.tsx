import { type ReactNode, useState } from "react";
import { t } from "../text";
import { Field } from "./Field";
import { FormDialog } from "./FormDialog";

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
  label,
  action,
  initial = "",
  missing = t("name.missing"),
  onName,
  children,
  ...frame
}: Props) {
  const [typed, setTyped] = useState<string | null>(null);
  const name = typed ?? initial;

  async function submit(): Promise<void> {
    if (name.trim() === "") throw new Error(missing);
    await onName(name.trim());
  }

  return (
    <FormDialog {...frame} submit={action} onSubmit={submit}>
      {({ refused }) => (
        <>
          {children}
          <Field label={label} value={name} onChange={setTyped} refused={refused} />
        </>
      )}
    </FormDialog>
  );
}
