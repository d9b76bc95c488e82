import type { LeafRow } from "../logic/errors/catalogue";
import { t } from "../text";
import { StateWord } from "./StateWord";
import { VERDICT_ICONS } from "./statuses";

interface Props {
  reaction: NonNullable<LeafRow["reaction"]>;
  /** A longer text: the server's message, unless given. */
  title?: string;
}

/** The verdict in short, or that the reaction is still being computed. What is not as required comes before the verdict. */
export function ReactionWord({ reaction: { state, verdict, unmet, message }, title = message }: Props) {
  if (state === "recording")
    return (
      <StateWord
        tone="recording"
        icon="record"
        word={t("reaction.recording")}
        title={title || t("reaction.recording.about")}
      />
    );
  const known = state === "failed" ? null : verdict;
  if (known && unmet > 0) {
    const word = t("sweep.unmet", { count: unmet });
    const about = `${t(`verdict.${known}`)}: ${word}`;
    return <StateWord tone="unmet" icon="error" word={word} title={[about, title].filter(Boolean).join(" · ")} />;
  }
  return (
    <StateWord
      tone={known ?? "stale"}
      icon={known ? VERDICT_ICONS[known] : "info"}
      word={t(known ? `verdict.${known}` : "reaction.failed")}
      title={title || undefined}
    />
  );
}
