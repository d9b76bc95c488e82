import { useEffect, useMemo } from "react";
import { useShallow } from "zustand/react/shallow";
import { useBench } from "../../../store/plc/bench";
import { putAwayTrouble, refreshVerifications, shownOf, useVerify } from "../../../store/verify/verify";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { Counts } from "./Counts";
import { Detail } from "./Detail";
import { EmptyVerify } from "./EmptyVerify";
import { Head, type Whole } from "./Head";
import { NewVerification } from "./NewVerification";
import { Table } from "./Table";
import "./verify.css";
import "./detail.css";

/** The properties that the dock gives a panel. */
interface Props {
  api?: { isMaximized: () => boolean; maximize: () => void; exitMaximized: () => void };
}

/** The program executed twice on the same inputs: A beside A', scan by scan. */
export function VerifyPanel({ api }: Props) {
  const instance = useBench((bench) => bench.instance?.id ?? null);
  const { verifications, id, record } = useVerify(
    useShallow(({ verifications, id, record }) => ({ verifications, id, record })),
  );
  const shown = useMemo(() => shownOf({ verifications, id, record }), [verifications, id, record]);
  const asking = useVerify((state) => state.asking);
  // biome-ignore lint/correctness/useExhaustiveDependencies: a different PLC has different verifications
  useEffect(() => void refreshVerifications(), [instance]);
  const whole: Whole | null = api
    ? { is: () => api.isMaximized(), toggle: () => (api.isMaximized() ? api.exitMaximized() : api.maximize()) }
    : null;
  return (
    <div className="pane flexcol verify" data-pane="verify" data-live>
      <Head shown={shown} whole={whole} />
      <Trouble />
      {shown ? (
        <>
          <Counts shown={shown} />
          {shown.info.state === "failed" && shown.info.message && (
            <p className="trouble st fatal" role="alert">
              <Icon name="error" small />
              <span>{shown.info.message}</span>
            </p>
          )}
          {shown.info.state !== "failed" && shown.info.message && (
            <p className="vfnote faint" role="note">
              <Icon name="info" small />
              <span className="cut" title={shown.info.message}>
                {shown.info.message}
              </span>
            </p>
          )}
          <div className="vfbody">
            <Table shown={shown} key={`${shown.source.kind} ${shown.source.id}`} />
            <Detail shown={shown} />
          </div>
        </>
      ) : (
        <EmptyVerify />
      )}
      {asking && <NewVerification wish={asking} />}
    </div>
  );
}

function Trouble() {
  const trouble = useVerify((state) => state.trouble);
  if (!trouble) return null;
  return (
    <p className="trouble st fatal" role="alert">
      <Icon name="error" small />
      <span>
        {trouble.message}
        {trouble.near.length > 0 && ` ${t("verify.near", { near: trouble.near.join(", ") })}`}
      </span>
      <span className="grow" />
      <button type="button" className="ib sm" aria-label={t("close")} title={t("close")} onClick={putAwayTrouble}>
        <Icon name="x" />
      </button>
    </p>
  );
}
