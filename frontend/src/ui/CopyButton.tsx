import { useEffect, useState } from "react";
import { copyText } from "./clipboard";
import { Icon, type IconName } from "./Icon";

const SAID_FOR = 2000;

interface Props {
  label: string;
  /** The label after copying. */
  done: string;
  title?: string;
  className?: string;
  icon?: IconName;
  text: () => string;
  disabled?: boolean;
}

/** A button that copies a text, and then says so. */
export function CopyButton({ label, done, title, className = "btn sm", icon = "link", text, disabled }: Props) {
  const [copied, setCopied] = useState(false);
  useEffect(() => {
    if (!copied) return;
    const timer = setTimeout(() => setCopied(false), SAID_FOR);
    return () => clearTimeout(timer);
  }, [copied]);
  return (
    <button
      type="button"
      className={className}
      title={title}
      disabled={disabled}
      onClick={() => void copyText(text()).then(setCopied)}
    >
      <Icon name={copied ? "check" : icon} small />
      <span aria-live="polite">{copied ? done : label}</span>
    </button>
  );
}
