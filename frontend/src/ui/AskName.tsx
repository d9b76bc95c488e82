import { type ReactNode, useState } from "react";
import { t } from "../text";
import { Field } from "./Field";
import { FormDialog } from "./FormDialog";

interface Props {
  title: string;
  about?: string;
  label: string;
  /** The label of the submit button. */
  action: string;
  /** The default name until somebody types; may change with other fields. */
  initial?: string;
  /** The message for an empty name. */
  missing?: string;
  /** Characters at most. */
  longest?: number;
  /** Throws the refusal, which is shown below the field. */
  onName: (name: string) => Promise<void>;
  onClose: () => void;
  /** More fields, above the name. */
  children?: ReactNode;
}

/** A dialog that asks for one name. */
export function AskName({
  label,
  action,
  initial = "",
  missing = t("name.missing"),
  longest = Number.POSITIVE_INFINITY,
  onName,
  children,
  ...frame
}: Props) {
  const [typed, setTyped] = useState<string | null>(null);
  const name = typed ?? initial;

  async function submit(): Promise<void> {
    if (name.trim() === "") throw new Error(missing);
    if (name.trim().length > longest) throw new Error(t("name.long", { longest, length: name.trim().length }));
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
