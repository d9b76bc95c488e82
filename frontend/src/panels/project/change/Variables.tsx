import { useVirtualizer } from "@tanstack/react-virtual";
import { useRef } from "react";
import type { Fate } from "../../../logic/project/change";
import { t } from "../../../text";
import type { LostVariable } from "../../../wire/types";

const ROW = 24;

interface Props {
  plc: string;
  fate: Fate;
  variables: readonly LostVariable[];
}

/** The variables that share a fate; for those that begin anew it says why. Only the rows in sight exist in the page. */
export function Variables({ plc, fate, variables }: Props) {
  const scroll = useRef<HTMLDivElement>(null);
  const virtual = useVirtualizer({
    count: variables.length,
    getScrollElement: () => scroll.current,
    estimateSize: () => ROW,
    overscan: 8,
    scrollMargin: ROW,
    scrollPaddingStart: ROW,
  });
  const reasons = fate === "anew";
  return (
    <div
      ref={scroll}
      className={`grid scroll lost${reasons ? "" : " bare"}`}
      role="table"
      aria-label={`${plc}: ${t(`change.fate.${fate}`)}`}
      aria-rowcount={variables.length + 1}
      // biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard
      tabIndex={0}
    >
      <div className="gr h" role="row">
        <span role="columnheader">{t(`change.fate.${fate}`)}</span>
        {reasons && <span role="columnheader">{t("change.why")}</span>}
      </div>
      <div className="virtual" role="rowgroup" style={{ height: virtual.getTotalSize() }}>
        {virtual.getVirtualItems().map((item) => {
          const variable = variables[item.index];
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
                {reasons && (
                  <span role="cell" className="muted cut" title={variable.reason}>
                    {variable.reason}
                  </span>
                )}
              </div>
            )
          );
        })}
      </div>
    </div>
  );
}
