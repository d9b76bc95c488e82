import { inNames } from "../../../logic/errors/catalogue";
import { secondsLeft, timeLeft } from "../../../logic/errors/sweep";
import { clockTime, dayTime, percent } from "../../../logic/format/numbers";
import { useCatalogue } from "../../../store/errors/catalogue";
import { recordAddress } from "../../../store/errors/records";
import { cancelSweep, compareSweeps, resumeSweep, showSweeps, useSweeps } from "../../../store/errors/sweeps";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { MenuButton } from "../../../ui/Menu";
import { StateWord } from "../../../ui/StateWord";
import type { Sweep } from "../../../wire/types";
import { STATUS } from "./statusWords";

/** How many runs are done, how long the rest takes, what runs now; and the actions for the whole sweep. */
export function Progress({ sweep }: { sweep: Sweep }) {
  const { id, done, total, status, instance_id: plc } = sweep;
  const share = total === 0 ? 1 : done / total;
  const running = status === "running";
  return (
    <div className="swtop">
      <IconButton icon="list" label={t("sweep.all")} small onClick={showSweeps} />
      <div className="swp">
        <div className="row">
          <b>{t("sweep.runs", { done, total })}</b>
          {running ? (
            <Left sweep={sweep} share={share} />
          ) : (
            <StateWord {...STATUS[status]} word={t(`sweep.status.${status}`)} />
          )}
          <span className="faint cut">
            {t("sweep.of", {
              by: sweep.by,
              at: clockTime(sweep.at),
              instance: sweep.instance,
              model: sweep.model,
              version: sweep.program_version,
            })}
          </span>
          <span className="grow" />
          {running && <Now id={id} />}
        </div>
        <span
          className={`progress ${status}`}
          role="progressbar"
          aria-label={t("sweep.progress")}
          aria-valuemin={0}
          aria-valuemax={total}
          aria-valuenow={done}
          aria-valuetext={t("sweep.runs", { done, total })}
        >
          <i style={{ width: `${share * 100}%` }} />
        </span>
      </div>
      {running && (
        <button type="button" className="btn sm" onClick={() => void cancelSweep(id)}>
          {t("cancel")}
        </button>
      )}
      {!running && done < total && (
        <button
          type="button"
          className="btn sm"
          title={t("sweep.resume.hint", { left: total - done })}
          onClick={() => void resumeSweep(id)}
        >
          <Icon name="play" small />
          {t("sweep.resume")}
        </button>
      )}
      <CompareWith id={id} />
      <a
        className="btn quiet sm"
        href={plc === null ? undefined : recordAddress(plc, "html", sweep.program_version)}
        aria-disabled={plc === null}
        title={t(plc === null ? "sweep.record.gone" : "sweep.record.hint")}
        target="_blank"
        rel="noreferrer"
      >
        <Icon name="export" small />
        <span className="wide">{t("sweep.record")}</span>
      </a>
    </div>
  );
}

function Left({ sweep, share }: { sweep: Sweep; share: number }) {
  const left = secondsLeft(sweep);
  const done = percent(Math.floor(share * 100));
  return <span className="faint">{left === null ? done : t("sweep.left", { share: done, time: timeLeft(left) })}</span>;
}

function Now({ id }: { id: number }) {
  const now = useSweeps((sweeps) => sweeps.now[id]);
  const { errors } = useCatalogue();
  if (!now) return null;
  return <span className="faint cut">{t("sweep.now", { what: inNames(errors, now) })}</span>;
}

/** The other sweeps of the project: choosing one shows both side by side. */
function CompareWith({ id }: { id: number }) {
  const list = useSweeps((sweeps) => sweeps.list);
  const others = (list ?? []).filter((other) => other.id !== id && other.done > 0);
  return (
    <MenuButton
      label={t("sweep.compare")}
      title={others.length === 0 ? t("sweep.compare.none") : t("sweep.compare.hint")}
      disabled={others.length === 0}
      items={() =>
        others.map((other) => ({
          label: t("sweep.compare.menu", { at: dayTime(other.at), version: other.program_version }),
          hint: `${other.instance}, ${other.by}`,
          onSelect: () => compareSweeps(id, other.id),
        }))
      }
    >
      <Icon name="swap" small />
      <span className="wide">{t("sweep.compare")}</span>
    </MenuButton>
  );
}
