import { Icon } from "./Icon";

/** Why a page cannot show what was asked for; nothing where there is no trouble. */
export function Trouble({ text }: { text: string | null }) {
  if (text === null) return null;
  return (
    <p className="trouble st fatal" role="alert">
      <Icon name="error" small />
      <span>{text}</span>
    </p>
  );
}
