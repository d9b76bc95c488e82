import { useVirtualizer } from "@tanstack/react-virtual";
import { useRef } from "react";
import { grouped } from "../../logic/numbers";
import { t } from "../../logic/text";
import { build, useDocuments } from "../../store/documents";
import { Dialog } from "../../ui/Dialog";
import { Icon } from "../../ui/Icon";
import type { BuildResult, OnlineChange as Change } from "../../wire/types";
import "./change.css";

/** A build waits for a yes: what the swap of the program would do to the variables of every running PLC. */
export function OnlineChange() {
  const asking = useDocuments((documents) => documents.asking);
  return asking && <Agreement result={asking} />;
}

function Agreement({ result }: { result: BuildResult }) {
  const close = () => useDocuments.setState({ asking: null });
  const { project, changes } = result;
  return (
    <Dialog
      title={t("change.title", { project: project.name, from: project.version, to: project.version + 1 })}
      about={t("change.about")}
      width={720}
      onClose={close}
      onSubmit={() => void build(true)}
      footer={
        <>
          <span className="hint grow cut" title={result.message}>
            {result.message}
          </span>
          <button type="button" className="btn quiet" onClick={close}>
            {t("cancel")}
          </button>
          <button type="submit" className="btn primary">
            {t("change.again")}
          </button>
        </>
      }
    >
      <div className="changes">
        {changes.map((change) => (
          <OnePlc key={change.instance} change={change} />
        ))}
      </div>
    </Dialog>
  );
}

/** One PLC: what is kept, and each variable that begins anew, with the reason. */
function OnePlc({ change }: { change: Change }) {
  const lost = change.lost_count;
  return (
    <section aria-label={change.name}>
      <div className="row">
        <Icon name="plc" />
        <b className="cut">{change.name}</b>
        <span className="grow" />
        {lost > 0 && change.refusal === "" && (
          <span className="st warning">
            <Icon name="init" small />
            {lost === 1 ? t("change.lost.one") : t("change.lost", { count: grouped(lost) })}
          </span>
        )}
        {change.refusal === "" && (
          <span className="st cleared">
            <Icon name="check" small />
            {t("change.kept", { count: grouped(change.kept) })}
          </span>
        )}
      </div>
      {change.refusal !== "" ? (
        <p className="st fatal why">
          <Icon name="error" small />
          <span>{t("change.refused", { why: change.refusal })}</span>
        </p>
      ) : lost === 0 ? (
        <p className="hint">{t("change.none")}</p>
      ) : (
        <Lost change={change} />
      )}
    </section>
  );
}

const ROW = 24;

function Lost({ change }: { change: Change }) {
  const scroll = useRef<HTMLDivElement>(null);
  const virtual = useVirtualizer({
    count: change.lost.length,
    getScrollElement: () => scroll.current,
    estimateSize: () => ROW,
    overscan: 8,
    scrollMargin: ROW,
    scrollPaddingStart: ROW,
  });
  const more = change.lost_count - change.lost.length;
  return (
    <>
      <div
        ref={scroll}
        className="grid scroll lost"
        role="table"
        aria-label={`${change.name}: ${t("change.why")}`}
        aria-rowcount={change.lost.length + 1}
        // biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard
        tabIndex={0}
      >
        <div className="gr h" role="row">
          <span role="columnheader">{t("change.variable")}</span>
          <span role="columnheader">{t("change.why")}</span>
        </div>
        <div className="virtual" role="rowgroup" style={{ height: virtual.getTotalSize() }}>
          {virtual.getVirtualItems().map((item) => {
            const variable = change.lost[item.index];
            return (
              variable && (
                <div
                  key={variable.path}
                  className="gr"
                  role="row"
                  aria-rowindex={item.index + 2}
                  style={{ transform: `translateY(${item.start - ROW}px)` }}
                >
                  <span role="cell" className="mono cut" title={variable.path}>
                    {variable.path}
                  </span>
                  <span role="cell" className="muted cut" title={variable.reason}>
                    {variable.reason}
                  </span>
                </div>
              )
            );
          })}
        </div>
      </div>
      {more > 0 && <p className="hint">{t("change.more", { count: grouped(more) })}</p>}
    </>
  );
}
