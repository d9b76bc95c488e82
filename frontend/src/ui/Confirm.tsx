import { type ReactNode, useState } from "react";
import { t } from "../text";
import { Dialog } from "./Dialog";
import { Icon } from "./Icon";

interface ConfirmProps {
  title: string;
  about: string;
  hint: ReactNode;
  /** What the button says that does it. */
  verb: string;
  /** Rejects with the reason when it cannot be done. */
  onDo: () => Promise<unknown>;
  reasonOf: (error: unknown) => string;
  onClose: () => void;
}

/** Asks before something that cannot be undone; a refusal stays in the dialog. */
export function Confirm({ title, about, hint, verb, onDo, reasonOf, onClose }: ConfirmProps) {
  const [refused, setRefused] = useState<string | null>(null);

  function act(): void {
    onDo().then(onClose, (error: unknown) => setRefused(reasonOf(error)));
  }

  return (
    <Dialog
      title={title}
      about={about}
      onClose={onClose}
      onSubmit={act}
      footer={
        <>
          <span className="hint bad grow" role="alert">
            {refused && (
              <>
                <Icon name="error" small />
                {refused}
              </>
            )}
          </span>
          <button type="button" className="btn quiet" onClick={onClose}>
            {t("cancel")}
          </button>
          <button type="submit" className="btn danger">
            {verb}
          </button>
        </>
      }
    >
      <p className="desc">{hint}</p>
    </Dialog>
  );
}
