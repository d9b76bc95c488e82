import { type FormEvent, type ReactNode, useEffect, useId, useRef } from "react";
import { t } from "../text";
import { Icon } from "./Icon";

interface Props {
  title: string;
  /** The consequence, in one sentence. */
  about?: string;
  /** What could not be done or read. */
  trouble?: string | null;
  width?: number;
  children: ReactNode;
  footer: ReactNode;
  onClose: () => void;
  /** Enter in a field, or the primary button. */
  onSubmit?: () => void;
  /** Called when something was typed or chosen. */
  onEdit?: () => void;
}

/** A modal dialog: the browser traps the focus, Escape closes. */
export function Dialog({ title, about, trouble, width = 460, children, footer, onClose, onSubmit, onEdit }: Props) {
  const dialog = useRef<HTMLDialogElement>(null);
  const id = useId();
  useEffect(() => {
    dialog.current?.showModal();
    // showModal focuses the first control, which is the close button
    dialog.current?.querySelector<HTMLElement>(".page input, .page select, .page textarea")?.focus();
  }, []);
  const submit = (event: FormEvent) => {
    event.preventDefault();
    onSubmit?.();
  };
  return (
    <dialog
      ref={dialog}
      className="dialog"
      style={{ width }}
      aria-labelledby={id}
      onCancel={(event) => {
        event.preventDefault();
        onClose();
      }}
    >
      <form onSubmit={submit} onChange={onEdit} method="dialog">
        <header>
          <div className="grow">
            <h2 id={id}>{title}</h2>
            {about && <p>{about}</p>}
          </div>
          <button type="button" className="ib" aria-label={t("close")} title={t("close")} onClick={onClose}>
            <Icon name="x" />
          </button>
        </header>
        <div className="page">
          {trouble && (
            <p className="trouble st fatal" role="alert">
              <Icon name="error" small />
              <span>{trouble}</span>
            </p>
          )}
          {children}
        </div>
        <footer>{footer}</footer>
      </form>
    </dialog>
  );
}
