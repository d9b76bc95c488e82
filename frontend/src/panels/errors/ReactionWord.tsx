import { t } from "../../logic/text";
import { StateWord } from "../../ui/StateWord";
import { VERDICT_ICONS } from "../../ui/statuses";
import type { ReactionState } from "../../wire/types";

/** The reaction in short: icon, word, and how many scans it took. */
export function ReactionWord({ reaction }: { reaction: ReactionState }) {
  const { state, verdict, scans, message } = reaction;
  if (state === "recording")
    return (
      <StateWord
        tone="recording"
        icon="record"
        word={t("reaction.recording")}
        title={message || t("reaction.recording.about")}
      />
    );
  if (state === "failed" || verdict === null)
    return <StateWord tone="stale" icon="info" word={t("reaction.failed")} title={message || undefined} />;
  return (
    <>
      <StateWord
        tone={verdict}
        icon={VERDICT_ICONS[verdict]}
        word={t(`verdict.${verdict}`)}
        title={message || undefined}
      />
      {verdict === "reacted" && scans !== null && (
        <span className="scans num" title={t("reaction.scans", { scans })}>
          {scans}
        </span>
      )}
    </>
  );
}
