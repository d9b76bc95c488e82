import type { LeafRow } from "../logic/errors/catalogue";
import { t } from "../text";
import { StateWord } from "./StateWord";
import { VERDICT_ICONS } from "./statuses";

interface Props {
  reaction: NonNullable<LeafRow["reaction"]>;
  /** A longer text: the server's message, unless given. */
  title?: string;
}

/** The verdict in short, or that the reaction is still being computed. Findings are told with it. */
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
    const word = t("reaction.unmet", { grade: t(`verdict.${known}`), unmet: t("sweep.unmet", { count: unmet }) });
    return <StateWord tone="unmet" icon="error" word={word} title={[word, title].filter(Boolean).join(" · ")} />;
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
