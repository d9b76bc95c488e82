import type { Fate } from "../../../logic/project/change";
import { useWidths } from "../../../store/page/columns";
import { t } from "../../../text";
import { useColumns } from "../../../ui/useColumns";
import { useGrid } from "../../../ui/useGrid";
import type { LostVariable } from "../../../wire/types";

interface Props {
  plc: string;
  fate: Fate;
  variables: readonly LostVariable[];
}

/** The variables with the same change; reinitialized ones with the reason. Only the visible rows are in the page. */
export function Variables({ plc, fate, variables }: Props) {
  const grid = useGrid({ count: variables.length });
  const { style, head } = useColumns(useWidths("fates"));
  const reasons = fate === "reinitialized";
  return (
    <div
      ref={grid.scroll}
      className={`grid scroll lost${reasons ? "" : " bare"}`}
      role="table"
      aria-label={`${plc}: ${t(`change.fate.${fate}`)}`}
      aria-rowcount={variables.length + 1}
      style={style}
      // biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard
      tabIndex={0}
    >
      <div className="gr h" role="row">
        {reasons ? (
          head("variable", t(`change.fate.${fate}`))
        ) : (
          <span role="columnheader">{t(`change.fate.${fate}`)}</span>
        )}
        {reasons && <span role="columnheader">{t("change.why")}</span>}
      </div>
      <div {...grid.body}>
        {grid.items.map((item) => {
          const variable = variables[item.index];
          return (
            variable && (
              <div
                key={variable.path}
                className="gr"
                role="row"
                aria-rowindex={item.index + 2}
                style={{ transform: `translateY(${grid.topOf(item)}px)` }}
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
