import { type FormEvent, useEffect, useState } from "react";
import { grouped } from "../../../logic/format/numbers";
import { ordered } from "../../../logic/past/past";
import { readScan } from "../../../logic/plc/timeline";
import { closeChanges, showChanges, useChanges } from "../../../store/past/changes";
import { liveScan, travel, useTimeline } from "../../../store/plc/timeline";
import { t } from "../../../text";
import { Dialog } from "../../../ui/Dialog";
import { Icon } from "../../../ui/Icon";
import { ChangesTable } from "./ChangesTable";
import { Entries } from "./Entries";

/** What changed between two scans: which variables, and which commands were entered in between. */
export function ChangesDialog() {
  const { asked, found, refused } = useChanges();
  if (!asked) return null;
  const { first, last } = asked;
  const fits = found !== null && found.first === first && found.last === last;
  const go = (scan: number) => {
    closeChanges();
    void travel(scan);
  };
  return (
    <Dialog
      title={t("changes.title", { first: grouped(first), last: grouped(last) })}
      about={t("changes.about")}
      width={920}
      onClose={closeChanges}
      footer={
        <>
          <GoTo scan={first} onGo={go} />
          <GoTo scan={last} onGo={go} />
          <span className="grow" />
          <button type="button" className="btn" onClick={closeChanges}>
            {t("close")}
          </button>
        </>
      }
    >
      <div className="whatchanged" aria-busy={!fits && refused === null}>
        <Scans first={first} last={last} />
        {refused !== null ? (
          <p className="trouble st fatal" role="alert">
            <Icon name="error" small />
            <span>{refused}</span>
          </p>
        ) : !found ? (
          <p className="lonely faint" role="status">
            {t("changes.loading")}
          </p>
        ) : (
          <>
            {found.note && (
              <p className="st warning note">
                <Icon name="warning" small />
                <span>{found.note}</span>
              </p>
            )}
            {found.count === 0 && !found.at_least ? (
              <p className="lonely faint">
                {t("changes.none", { first: grouped(found.first), last: grouped(found.last) })}
              </p>
            ) : (
              <ChangesTable
                changes={found}
                label={t("changes.list")}
                heads={[
                  t("changes.value", { scan: grouped(found.first) }),
                  t("changes.value", { scan: grouped(found.last) }),
                ]}
                writerBefore={found.last}
              />
            )}
            <Entries title={t("changes.entered")} entries={found.entries} none={t("changes.noentries")} onGo={go} />
          </>
        )}
      </div>
    </Dialog>
  );
}

function GoTo({ scan, onGo }: { scan: number; onGo: (scan: number) => void }) {
  return (
    <button type="button" className="btn quiet" onClick={() => onGo(scan)}>
      <Icon name="moved" small />
      {t("changes.goto", { scan: grouped(scan) })}
    </button>
  );
}

/** The two scans, to be changed. */
function Scans({ first, last }: { first: number; last: number }) {
  const [from, setFrom] = useState(String(first));
  const [to, setTo] = useState(String(last));
  const [bad, setBad] = useState<string | null>(null);
  useEffect(() => {
    setFrom(String(first));
    setTo(String(last));
    setBad(null);
  }, [first, last]);

  function ask(event?: FormEvent): void {
    event?.preventDefault();
    const least = useTimeline.getState().info?.first_scan ?? 0;
    const stretch = ordered(readScan(from), readScan(to));
    if (stretch && stretch.from >= least && stretch.to <= liveScan()) showChanges(stretch.from, stretch.to);
    else setBad(t("changes.bad", { first: grouped(least), live: grouped(liveScan()) }));
  }

  const field = (label: string, value: string, set: (text: string) => void) => (
    <label className="row">
      <span className="muted">{label}</span>
      <input
        className={`inp sm mono scanbox${bad ? " bad" : ""}`}
        inputMode="numeric"
        value={value}
        aria-invalid={bad !== null}
        onChange={(event) => set(event.target.value)}
        onKeyDown={(event) => {
          if (event.key !== "Enter") return;
          event.preventDefault();
          ask();
        }}
      />
    </label>
  );
  return (
    <div className="row">
      {field(t("changes.first"), from, setFrom)}
      {field(t("changes.last"), to, setTo)}
      <button type="button" className="btn sm" onClick={() => ask()}>
        {t("changes.ask")}
      </button>
      {bad && (
        <span className="hint bad" role="alert">
          {bad}
        </span>
      )}
    </div>
  );
}
