import { grouped } from "../../../logic/format/numbers";
import { shareOf } from "../../../logic/past/past";
import { cancelRerun, compareRerun, openRerun, putAwayRerun, useReruns } from "../../../store/past/reruns";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { Rerun } from "../../../wire/types";

/** Replays of this run: their progress, then the instance that each produced. */
export function RerunBanners() {
  const { list, trouble } = useReruns();
  return (
    <>
      {list.map((rerun) => (
        <One key={rerun.id} rerun={rerun} trouble={trouble} />
      ))}
    </>
  );
}

function One({ rerun, trouble }: { rerun: Rerun; trouble: string | null }) {
  if (rerun.message !== "") return <Failed rerun={rerun} />;
  if (rerun.instance === null) return <Underway rerun={rerun} trouble={trouble} />;
  return <Done rerun={rerun} />;
}

function Underway({ rerun, trouble }: { rerun: Rerun; trouble: string | null }) {
  const { id, name, done, of } = rerun;
  const word = t("compare.progress", { done: grouped(done), of: grouped(of) });
  return (
    <section className="banner info" aria-label={t("rerun.started", { name })}>
      <Icon name="branch" />
      <span>
        <b>{t("rerun.started", { name })}</b>
      </span>
      <span
        className="progress"
        role="progressbar"
        aria-label={t("rerun.started", { name })}
        aria-valuemin={0}
        aria-valuemax={of}
        aria-valuenow={done}
        aria-valuetext={word}
      >
        <i style={{ width: `${shareOf(rerun) * 100}%` }} />
      </span>
      <span className="muted grow">{trouble ?? word}</span>
      <button type="button" className="btn sm" onClick={() => void cancelRerun(id)}>
        {t("rerun.cancel")}
      </button>
    </section>
  );
}

function Done({ rerun }: { rerun: Rerun }) {
  const { id, name, refused } = rerun;
  return (
    <section className="banner info" aria-label={t("rerun.done", { name })}>
      <Icon name="check" />
      <span className="grow">
        <b>{t("rerun.done", { name })}</b> {t("rerun.done.about")}{" "}
        {refused.length > 0 && (
          <span className="muted" title={refused.join("\n")}>
            {t("rerun.refused", { count: refused.length, first: refused[0] })}
          </span>
        )}
      </span>
      <button type="button" className="btn sm" onClick={() => void compareRerun(rerun)}>
        {t("rerun.compare")}
      </button>
      <button type="button" className="btn sm" onClick={() => void openRerun(rerun)}>
        {t("rerun.open", { name })}
      </button>
      <button type="button" className="ib" aria-label={t("close")} title={t("close")} onClick={() => putAwayRerun(id)}>
        <Icon name="x" />
      </button>
    </section>
  );
}

function Failed({ rerun }: { rerun: Rerun }) {
  const { id, name, message } = rerun;
  return (
    <div className="banner stale" role="alert">
      <Icon name="warning" />
      <span className="grow">
        <b>{t("rerun.failed", { name })}</b> {message}
      </span>
      <button type="button" className="btn sm" onClick={() => putAwayRerun(id)}>
        {t("link.read")}
      </button>
    </div>
  );
}
