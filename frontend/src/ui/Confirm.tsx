import type { ReactNode } from "react";
import { FormDialog } from "./FormDialog";

interface Props {
  title: string;
  about: string;
  hint: ReactNode;
  /** The label of the submit button. */
  verb: string;
  /** Rejects with the reason of a refusal. */
  onDo: () => Promise<unknown>;
  onClose: () => void;
}

/** Asks before an action that cannot be undone; a refusal is shown in the dialog. */
export function Confirm({ title, about, hint, verb, onDo, onClose }: Props) {
  return (
    <FormDialog title={title} about={about} submit={verb} danger onSubmit={onDo} onClose={onClose}>
      <p className="desc">{hint}</p>
    </FormDialog>
  );
}
