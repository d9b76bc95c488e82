import { type ReactNode, useState } from "react";
import { messageOf } from "../logic/format/messageOf";
import { t } from "../text";
import { Dialog } from "./Dialog";
import { Icon } from "./Icon";

/** What became of the last try. */
interface Sent {
  refused: string | null;
  /** What was refused is another now without having been typed: the reason goes, as with every edit. */
  forget: () => void;
}

type Part = ReactNode | ((sent: Sent) => ReactNode);

interface Props {
  title: string;
  about?: string;
  width?: number;
  /** What the button says that does it. */
  submit: string;
  /** What it does cannot be undone. */
  danger?: boolean;
  disabled?: boolean;
  /** Throws what was wrong, and the dialog stays with it; `false` leaves it open without a word. */
  onSubmit: () => Promise<unknown>;
  onClose: () => void;
  /** Left of the buttons. Without it a reason stands there, unless the content is a function, which then shows it where it belongs. */
  aside?: Part;
  children: Part;
}

/** A dialog that does one thing: it closes once that is done, and stays with the reason when it is refused. */
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
