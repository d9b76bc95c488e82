import type { ReactNode } from "react";
import { FormDialog } from "./FormDialog";

interface Props {
  title: string;
  about: string;
  hint: ReactNode;
  /** What the button says that does it. */
  verb: string;
  /** Rejects with the reason when it cannot be done. */
  onDo: () => Promise<unknown>;
  onClose: () => void;
}

/** Asks before something that cannot be undone; a refusal stays in the dialog. */
export function Confirm({ title, about, hint, verb, onDo, onClose }: Props) {
  return (
    <FormDialog title={title} about={about} submit={verb} danger onSubmit={onDo} onClose={onClose}>
      <p className="desc">{hint}</p>
    </FormDialog>
  );
}
