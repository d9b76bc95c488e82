import { memo, type ReactNode, useEffect, useRef } from "react";
import { shallow } from "zustand/shallow";
import type { GroupRow, LeafRow } from "../../../logic/errors/catalogue";
import { detailsInWords, inNames } from "../../../logic/errors/catalogue";
import { codeText } from "../../../logic/errors/codeText";
import { useCatalogue } from "../../../store/errors/catalogue";
import { selectError, toggleChecked, toggleGroup, useSimulator } from "../../../store/errors/simulator";
import { t } from "../../../text";
import { Checkbox } from "../../../ui/Checkbox";
import { Icon } from "../../../ui/Icon";
import { ReactionWord } from "../../../ui/ReactionWord";
import { StateWord } from "../../../ui/StateWord";
import { StatusWord } from "../../../ui/StatusWord";
import type { ErrorInfo, ReactionState } from "../../../wire/types";
import { WayOn } from "./WayOn";

export function Group({ row, index, selected }: { row: GroupRow; index: number; selected: boolean }) {
  return (
    <div
      id={`error-${index}`}
      className={`gr grp${selected ? " on" : ""}`}
      role="row"
      style={{ "--lv": row.level }}
      aria-level={row.level + 1}
      aria-expanded={row.open}
      aria-selected={selected}
      data-key={row.key}
      onClick={() => toggleGroup(row.key)}
    >
      <span className="name" role="gridcell">
        <Icon name={row.open ? "chev-d" : "chev-r"} className="tw" />
        <Checkbox label={row.name} check={row.check} onToggle={() => toggleChecked(row.ids)} />
        <span className="cut">{row.name}</span>
      </span>
      <span className="tested" role="gridcell">
        {t("errors.tested", { tested: row.tested, total: row.ids.length })}
      </span>
    </div>
  );
}

interface LeafProps {
  row: LeafRow;
  index: number;
  selected: boolean;
  /** The lines below the row. */
  children: ReactNode;
}

/** An error. All rows are computed again when one of them changes; unchanged ones are not drawn again. */
export const Leaf = memo(function Leaf({ row, index, selected, children }: LeafProps) {
  const { error } = row;
  const fatal = error.severity === "fatal";
  return (
    <>
      <div
        id={`error-${index}`}
        className={`gr${selected ? " on" : ""}${row.fitted ? "" : " absent"}`}
        role="row"
        style={{ "--lv": row.level + 1 }}
        aria-level={row.level + 1}
        aria-selected={selected}
        data-key={row.key}
        title={[
          [error.name, row.instance, `${codeText(row.code)} · ${error.flag}`, error.description],
          row.fitted ? [] : [t("errors.absent.about"), t("errors.absent.where")],
        ]
          .flat()
          .filter(Boolean)
          .join("\n")}
        onClick={() => selectError(row.key)}
      >
        <span className="name" role="gridcell">
          <Checkbox
            label={row.instance ? `${error.name}, ${row.instance}` : error.name}
            check={row.check}
            disabled={row.keys.length === 0}
            onToggle={() => {
              toggleChecked(row.keys);
              selectError(row.key);
            }}
          />
          <span className="cut">{row.instance || error.name}</span>
        </span>
        <span className="mono muted c-code" role="gridcell">
          {codeText(row.code)}
        </span>
        <span className="mono muted c-flag" role="gridcell">
          {error.flag}
        </span>
        <span role="gridcell" className="c-severity">
          <StateWord
            tone={fatal ? "fatal" : "warning"}
            icon={fatal ? "fatal" : "warning"}
            word={t(fatal ? "errors.fatal" : "errors.nonfatal")}
          />
        </span>
        <span role="gridcell" className="c-state">
          {!row.fitted && row.status === "never" ? (
            <StateWord tone="stale" icon="minus" word={t("errors.absent")} title={t("errors.absent.about")} />
          ) : row.armed && row.status !== "generated" ? (
            <StateWord tone="recording" icon="clock" word={t("errors.armed")} title={t("errors.armed.about")} />
          ) : (
            <StatusWord status={row.status} swept={row.swept && row.status === "never"} />
          )}
        </span>
        <span role="gridcell" className="c-reaction">
          {row.reaction && <Reacted reaction={row.reaction} swept={row.swept} />}
        </span>
      </div>
      {children}
    </>
  );
}, sameLeaf);

function sameLeaf({ row: before, ...rest }: LeafProps, { row: after, ...others }: LeafProps): boolean {
  const told = (row: LeafRow) => ({ ...row, keys: row.keys.join() });
  return shallow(told(before), told(after)) && shallow(rest, others);
}

/** The reaction, and how many scans it took. */
function Reacted({ reaction, swept }: { reaction: ReactionState; swept: boolean }) {
  const { verdict, scans, message } = reaction;
  const title = swept ? [message, t("history.swept")].filter(Boolean).join(" · ") : message;
  return (
    <>
      <ReactionWord reaction={reaction} title={title} />
      {swept && <Icon name="refresh" small className="faint" />}
      {(verdict === "acted" || verdict === "reacted") && scans !== null && (
        <span className="scans num" title={t("reaction.scans", { scans })}>
          {scans}
        </span>
      )}
    </>
  );
}

/** The reason without the name, which is in the row above, and with the details in words. */
function refusalOf(error: ErrorInfo, message: string): string {
  const plain = message.startsWith(`${error.id}: `) ? message.slice(error.id.length + 2) : message;
  const worded = plain.replace(/\(([^()]*=[^()]*)\)/, (_, details: string) => `(${detailsInWords(error, details)})`);
  return worded === "" || /[.!?]$/.test(worded) ? worded : `${worded}.`;
}

/** Why this error was not generated, and what to do. */
export function RefusalRow({ error }: { error: ErrorInfo }) {
  const outcome = useSimulator((state) => state.outcome);
  const { errors } = useCatalogue();
  const place = useRef<HTMLDivElement>(null);
  // The tree may be short: the refusal must not be below its visible part.
  // biome-ignore lint/correctness/useExhaustiveDependencies: runs for each new refusal
  useEffect(() => void place.current?.scrollIntoView({ block: "nearest" }), [outcome]);
  if (!outcome) return null;
  const why = refusalOf(error, outcome.message);
  return (
    <div className="refusalrow" role="row" ref={place}>
      <span role="gridcell">
        <span role="alert">
          <Icon name="error" small />
          <span>
            <b>{t("errors.notgenerated")}</b> {inNames(errors, why) || t("notsent.about")} <WayOn outcome={outcome} />
          </span>
        </span>
      </span>
    </div>
  );
}
