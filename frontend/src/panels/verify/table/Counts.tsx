import { useState } from "react";
import { grouped, percent } from "../../../logic/format/numbers";
import { ranIn, stretchLines } from "../../../logic/verify/verify";
import { unitsOf } from "../../../logic/verify/verifyColumns";
import { usePlc } from "../../../store/plc/plc";
import {
  exportVerification,
  keepVerification,
  type ShownVerification,
  verifyStretch,
} from "../../../store/verify/verify";
import { openVerifyRecords } from "../../../store/verify/verifyRecords";
import { goToDifference, showOnlyDiffering, useVerifyRows } from "../../../store/verify/verifyRows";
import { t } from "../../../text";
import { AskName } from "../../../ui/AskName";
import { Icon, type IconName } from "../../../ui/Icon";
import { MenuButton, type MenuItem } from "../../../ui/Menu";
import { StateWord } from "../../../ui/StateWord";
import type { VerificationInfo } from "../../../wire/types";
import { ColumnsDialog } from "./ColumnsDialog";
import { Coverage } from "./Coverage";
import { spanOf } from "./Head";

const STATES: Record<VerificationInfo["state"], [tone: string, icon: IconName]> = {
  starting: ["info", "wait"],
  verifying: ["running", "running"],
  waiting: ["halted", "wait"],
  stopped: ["stopped", "stopped"],
  done: ["running", "check"],
  failed: ["fatal", "error"],
};
const NO_DIFFERENCE = {
  differs: "verify.differences.none", // none is left in the rows that are shown
  same: "verify.differences.none",
  "same in what was compared": "verify.differences.partly",
  "nothing compared": "verify.differences.nothing",
} as const satisfies Record<VerificationInfo["verdict"], string>;
const NOTHING: (typeof STATES)["done"] = ["halted", "warning"];

/** The progress, the result, and the buttons for the next and the previous difference. */
export function Counts({ shown }: { shown: ShownVerification }) {
  const { info } = shown;
  const [asked, ask] = useState<"keep" | "columns" | "coverage" | null>(null);
  const [kept, sayKept] = useState<string | null>(null);
  const onlyDiffering = useVerifyRows((rows) => rows.onlyDiffering);
  const none = useVerifyRows((rows) => rows.differing.length === 0);
  const same = t(NO_DIFFERENCE[info.verdict]);
  return (
    <div className="sub tall vfcounts">
      <Stat value={ranIn(info)} word={t("verify.compared")} id="compared" />
      {info.not_run > 0 && (
        <Stat value={info.not_run} word={t("verify.idle")} id="notrun" about={t("verify.idle.about")} />
      )}
      {info.not_reached > 0 && (
        <Stat
          value={info.not_reached}
          word={t("verify.notreached")}
          id="notreached"
          about={t("verify.notreached.about")}
        />
      )}
      {(info.skipped > 0 || info.not_run === 0) && <Skipped info={info} />}
      <Stat value={info.differing} word={t("verify.differ")} id="differ" bad={info.differing > 0} />
      <State info={info} />
      <RecordUse info={info} />
      {kept !== null && (
        <button type="button" className="btn quiet sm vfkept" onClick={openVerifyRecords}>
          <Icon name="check" small />
          <span className="cut" role="status">
            {t("verify.kept", { name: kept })}
          </span>
        </button>
      )}
      {info.coverage && (
        <button type="button" className="btn quiet sm" title={t("verify.coverage")} onClick={() => ask("coverage")}>
          <Icon name="info" small />
          <span className="long">{t("verify.coverage")}</span>
        </button>
      )}
      <span className="grow" />
      <button
        type="button"
        className={`btn quiet sm${onlyDiffering ? " on" : ""}`}
        aria-pressed={onlyDiffering}
        aria-label={t("verify.only")}
        title={t("verify.only.about")}
        onClick={() => showOnlyDiffering(!onlyDiffering)}
      >
        <Icon name="filter" small />
        <span className="long">{t("verify.only")}</span>
      </button>
      <button type="button" className="btn quiet sm" title={t("verify.columns")} onClick={() => ask("columns")}>
        <Icon name="list" small />
        <span className="long">{t("verify.columns")}</span>
      </button>
      <Export shown={shown} onKeep={() => ask("keep")} />
      <span className="vr" />
      <Jumps none={none ? same : undefined} />
      {asked === "columns" && <ColumnsOf shown={shown} onClose={() => ask(null)} />}
      {asked === "coverage" && info.coverage && (
        <Coverage coverage={info.coverage} trace={info.trace} onClose={() => ask(null)} />
      )}
      {asked === "keep" && (
        <AskName
          title={t("verify.keep.title")}
          about={t("verify.keep.about")}
          label={t("verify.keep.label")}
          action={t("verify.keep.do")}
          initial={info.title}
          onName={async (name) => {
            await keepVerification(name);
            sayKept(name);
          }}
          onClose={() => ask(null)}
        />
      )}
    </div>
  );
}

function ColumnsOf({ shown, onClose }: { shown: ShownVerification; onClose: () => void }) {
  const columns = useVerifyRows((rows) => rows.columns);
  return <ColumnsDialog range={shown.info.title} units={unitsOf(columns)} onClose={onClose} />;
}

interface StatProps {
  value: number;
  word: string;
  id: string;
  bad?: boolean;
  about?: string;
}

function Stat({ value, word, id, bad = false, about }: StatProps) {
  return (
    <span className={`stat${bad ? " st-bad" : ""}`} title={about} data-testid={`verify:${id}`}>
      <b>
        {bad && <Icon name="differs" small />}
        {grouped(value)}
      </b>
      <span>{word}</span>
    </span>
  );
}

/** The scans that were not compared; those of a run can be verified afterwards. */
function Skipped({ info }: { info: VerificationInfo }) {
  if (info.skipped === 0) return <Stat value={0} word={t("verify.skipped")} id="skipped" />;
  const items = (): MenuItem[] =>
    stretchLines(info.stretches).map((label, at) => {
      const [first, last] = info.stretches[at] ?? [0, 0];
      if (info.source === "trace") return { label, disabled: true, onSelect: () => {} }; // the log has no values that could be verified
      return { label, hint: t("verify.skipped.verify"), onSelect: () => verifyStretch(first, last) };
    });
  return (
    <MenuButton label={t("verify.skipped.which")} className="btn quiet vfskip" items={items}>
      <Stat value={info.skipped} word={t("verify.skipped")} id="skipped" />
      <Icon name="chev-d" small />
    </MenuButton>
  );
}

function State({ info }: { info: VerificationInfo }) {
  const runs = usePlc(({ state }) => state?.state === "running");
  // A verification that keeps up with a running PLC waits for each next scan: that is its normal state.
  const keepsUp = info.state === "waiting" && info.source === "live" && info.pace === "free" && runs;
  const state = keepsUp ? "verifying" : info.state;
  const nothing = state === "done" && info.verdict === "nothing compared";
  const [tone, icon] = nothing ? NOTHING : STATES[state];
  const about = info.scan === null ? spanOf(info) : t("verify.upto", { scan: grouped(info.scan) });
  return (
    <span className="vfstate" role="status" data-state={info.state}>
      <StateWord
        tone={tone}
        icon={icon}
        word={t(nothing ? "verify.state.nothing" : `verify.state.${state}`)}
        title={info.message}
      />
      <span className="cut faint" title={about}>
        {about}
      </span>
    </span>
  );
}

/** How full the record of used variables became. */
function RecordUse({ info: { used, limit } }: { info: VerificationInfo }) {
  const share = Math.min(100, (100 * used) / limit);
  const text = t("verify.record.use", { share: percent(share), limit: grouped(limit) });
  return (
    <span className="vfuse" title={t("verify.record.use.about", { used: grouped(used), limit: grouped(limit) })}>
      <span className={`progress${share >= 100 ? " interrupted" : ""}`}>
        <i style={{ width: `${share}%` }} />
      </span>
      <span className={`hint${used > limit ? " st halted" : ""}`}>{used > limit ? t("verify.record.full") : text}</span>
    </span>
  );
}

function Export({ shown, onKeep }: { shown: ShownVerification; onKeep: () => void }) {
  return (
    <MenuButton
      label={t("verify.export")}
      items={() => [
        ...(["csv", "json", "html", "junit"] as const).map((format) => ({
          label: t(`verify.export.${format}`),
          icon: "export" as const,
          onSelect: () => void exportVerification(format),
        })),
        ...(shown.record
          ? []
          : [{ label: t("verify.keep"), icon: "record" as const, separated: true, onSelect: onKeep }]),
      ]}
    >
      <Icon name="export" small />
      <span className="long">{t("verify.export")}</span>
    </MenuButton>
  );
}

/** `none`: why there is nowhere to go. */
function Jumps({ none: why }: { none: string | undefined }) {
  const none = why !== undefined;
  return (
    <>
      <button
        type="button"
        className="btn sm"
        disabled={none}
        title={why ?? t("verify.first")}
        aria-label={t("verify.first")}
        onClick={() => goToDifference("first")}
      >
        <Icon name="differs" small />
        <span className="long">{t("verify.first")}</span>
      </button>
      <button
        type="button"
        className="btn sm"
        disabled={none}
        title={why ?? t("verify.previous")}
        aria-label={t("verify.previous")}
        onClick={() => goToDifference("previous")}
      >
        <Icon name="chev-u" small />
        <span className="long">{t("verify.previous.short")}</span>
      </button>
      <button
        type="button"
        className="btn sm"
        disabled={none}
        title={why ?? t("verify.next")}
        aria-label={t("verify.next")}
        onClick={() => goToDifference("next")}
      >
        <Icon name="chev-d" small />
        <span className="long">{t("verify.next.short")}</span>
      </button>
    </>
  );
}
