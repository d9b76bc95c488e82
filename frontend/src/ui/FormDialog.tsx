import { type ReactNode, useState } from "react";
import { messageOf } from "../logic/format/messageOf";
import { t } from "../text";
import { Dialog } from "./Dialog";
import { Icon } from "./Icon";

/** The result of the last attempt. */
interface Sent {
  refused: string | null;
  /** Removes the refusal, as any edit does: call this when a value was changed without typing. */
  forget: () => void;
}

type Part = ReactNode | ((sent: Sent) => ReactNode);

interface Props {
  title: string;
  about?: string;
  width?: number;
  /** The label of the submit button. */
  submit: string;
  /** The action cannot be undone. */
  danger?: boolean;
  disabled?: boolean;
  /** Throws the refusal, and the dialog stays open with it; `false` keeps it open without a message. */
  onSubmit: () => Promise<unknown>;
  onClose: () => void;
  /** Left of the buttons. Without it the reason of a refusal is shown there, unless the content is a function, which then shows the reason itself. */
  aside?: Part;
  children: Part;
}

/** A dialog for one action: it closes once the action is done, and stays open with the reason of a refusal. */
export function FormDialog({ submit, danger = false, disabled = false, onSubmit, aside, children, ...frame }: Props) {
  const [refused, setRefused] = useState<string | null>(null);
  const [busy, setBusy] = useState(false);
  const sent: Sent = { refused, forget: () => setRefused(null) };

  async function act(): Promise<void> {
    if (busy || disabled) return;
    setBusy(true);
    try {
      if ((await onSubmit()) !== false) frame.onClose();
    } catch (error) {
      setRefused(messageOf(error));
    }
    setBusy(false);
  }

  const left = aside ?? (typeof children === "function" ? <span className="grow" /> : shown);
  return (
    <Dialog
      {...frame}
      onSubmit={() => void act()}
      onEdit={sent.forget}
      footer={
        <>
          {typeof left === "function" ? left(sent) : left}
          <button type="button" className="btn quiet" onClick={frame.onClose}>
            {t("cancel")}
          </button>
          <button
            type="submit"
            className={`btn ${danger ? "danger" : "primary"}`}
            disabled={disabled}
            aria-disabled={busy || disabled}
          >
            {submit}
          </button>
        </>
      }
    >
      {typeof children === "function" ? children(sent) : children}
    </Dialog>
  );
}

const shown = ({ refused }: Sent) => (
  <span className="hint bad grow" role="alert">
    {refused && (
      <>
        <Icon name="error" small />
        {refused}
      </>
    )}
  </span>
);
