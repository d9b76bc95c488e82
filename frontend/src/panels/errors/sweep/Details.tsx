import { useEffect, useState } from "react";
import { inNames, isFinding } from "../../../logic/errors/catalogue";
import { errorOf, isOpen, NOW } from "../../../logic/errors/sweep";
import { messageOf } from "../../../logic/format/messageOf";
import { grouped } from "../../../logic/format/numbers";
import { useCatalogueOf } from "../../../store/errors/catalogue";
import { openCell, reactionOf, withdrawFinding } from "../../../store/errors/sweeps";
import { openFile } from "../../../store/page/navigate";
import { useBench } from "../../../store/plc/bench";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { StateWord } from "../../../ui/StateWord";
import { VERDICT_ICONS } from "../../../ui/statuses";
import type { CellRef, Reaction, Sweep, SweepCell, SweepError, Verdict } from "../../../wire/types";
import { Evidence } from "../Evidence";
import { Required } from "../Required";
import { Accept } from "./Accept";
import { Facts, Found } from "./Found";

/** The selection must stay this long before its details are fetched: moving along a row with the arrow keys fetches nothing. */
const PAUSE = 120;

interface Props {
  sweep: Sweep;
  error: SweepError;
  state: string;
  /** Null while there is no result. */
  cell: SweepCell | null;
}

/** The details of a cell: a sentence, numbers, lines of the program; and the actions for it. */
export function Details({ sweep, error, state, cell }: Props) {
  return (
    <>
      <div>
        <span className="hint">
          {state === NOW ? t("sweep.asitwas", { error: error.name }) : t("sweep.while", { error: error.name, state })}
        </span>
        <h2>
          {cell?.verdict ? (
            <StateWord tone={cell.verdict} icon={VERDICT_ICONS[cell.verdict]} word={t(`verdict.${cell.verdict}`)} />
          ) : (
            <StateWord tone="never" icon={cell ? "never" : "wait"} word={t(cell ? "sweep.none" : "sweep.noresult")} />
          )}
        </h2>
      </div>
      {cell ? <Result sweep={sweep} error={error} cell={cell} /> : <p className="muted">{t("sweep.noresult.about")}</p>}
    </>
  );
}

function Result({ sweep, error, cell }: { sweep: Sweep; error: SweepError; cell: SweepCell }) {
  const [reaction, refused] = useReaction(sweep.id, cell);
  const codeWord = useBench((bench) => bench.model?.code_word ?? "");
  const { byId, errors } = useCatalogueOf(sweep.model);
  const flag = byId.get(errorOf(error.id))?.flag ?? "";
  if (cell.verdict === null)
    return (
      <>
        <p className="muted">{inNames(errors, cell.note) || t("sweep.none.about")}</p>
        <Required required={cell.untried ?? []} />
      </>
    );
  return (
    <>
      <p className="muted">{sentence(cell, cell.verdict, sweep.window)}</p>
      {cell.note && <p className="muted">{inNames(errors, cell.note)}</p>}
      {/* Above what is fetched: a button that moves while it is pressed would not act. */}
      <Deeds sweep={sweep} error={error} cell={cell} />
      {isOpen(cell) && isFinding(cell.verdict) && (
        <p className="hint">
          {t(`sweep.next.${cell.verdict}`, {
            flag: flag || t("errors.flag"),
          })}
        </p>
      )}
      {reaction && <Required {...reaction} />}
      {reaction && <Evidence reaction={reaction} onOpen={openFile} />}
      {reaction ? (
        <Facts reaction={reaction} raised={cell.raised_scan} flag={flag} codeWord={codeWord} code={error.code} />
      ) : (
        <p className="hint">{refused ?? t("sweep.loading")}</p>
      )}
      {reaction && <Found reaction={reaction} />}
    </>
  );
}

/** What the program did, in one sentence. */
function sentence({ first_read: read, first_effect: scans }: SweepCell, verdict: Verdict, window: number): string {
  const acted = verdict === "acted" || verdict === "reacted";
  if (acted && scans === 1) return t("sweep.says.reacted.one");
  if (acted && read === null) return t("sweep.says.reacted.unread", { scans });
  return t(`sweep.says.${acted ? "reacted" : verdict}`, { read, scans, window: grouped(window) });
}

function Deeds({ sweep, error, cell }: { sweep: Sweep; error: SweepError; cell: SweepCell }) {
  const [accepting, setAccepting] = useState(false);
  const [opening, setOpening] = useState(false);
  const { accepted } = cell;
  return (
    <>
      {accepted && (
        <p className="swaccepted">
          <Icon name="check" small />
          <span>
            {t("sweep.acceptedby", accepted)}{" "}
            <button type="button" className="link" onClick={() => void withdrawFinding(sweep.id, cell)}>
              {t("sweep.withdraw")}
            </button>
          </span>
        </p>
      )}
      <div className="row">
        <button
          type="button"
          className="btn primary sm"
          disabled={opening}
          title={t("sweep.open.hint", { scan: grouped(cell.raised_scan) })}
          onClick={() => {
            setOpening(true);
            void openCell(sweep.id, cell).finally(() => setOpening(false));
          }}
        >
          {t("sweep.open")}
        </button>
        {isFinding(cell.verdict) && !accepted && (
          <button type="button" className="btn sm" onClick={() => setAccepting(true)}>
            {t("sweep.accept")}
          </button>
        )}
      </div>
      {accepting && <Accept sweep={sweep.id} cell={cell} name={error.name} onClose={() => setAccepting(false)} />}
    </>
  );
}

/** Fetches the reaction of the selected cell; the second value says why there is none. */
function useReaction(sweep: number, { error, state, verdict }: SweepCell): [Reaction | null, string | null] {
  const [reaction, setReaction] = useState<Reaction | null>(null);
  const [refused, setRefused] = useState<string | null>(null);
  useEffect(() => {
    let over = false;
    setReaction(null);
    setRefused(null);
    if (verdict === null) return;
    const cell: CellRef = { error, state };
    const ask = () =>
      reactionOf(sweep, cell).then(
        (found) => over || setReaction(found),
        (why: unknown) => over || setRefused(messageOf(why)),
      );
    const timer = setTimeout(() => void ask(), PAUSE);
    return () => {
      over = true;
      clearTimeout(timer);
    };
  }, [sweep, error, state, verdict]);
  return [reaction, refused];
}
