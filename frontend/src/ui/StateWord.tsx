import { Icon, type IconName } from "./Icon";

interface Props {
  /** A class of the design's state words: running, halted, fatal, forced, never, generated ... */
  tone: string;
  icon: IconName;
  word: string;
  title?: string;
}

/** A state: always icon, word and colour together. */
export function StateWord({ tone, icon, word, title }: Props) {
  return (
    <span className={`st ${tone}`} title={title}>
      <Icon name={icon} small />
      <span className="cut">{word}</span>
    </span>
  );
}
