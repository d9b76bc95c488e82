import { useBench } from "../../../store/plc/bench";
import { useWhatIf } from "../../../store/verify/whatif";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { Results } from "./Results";
import { WhatIfForm } from "./WhatIfForm";
import "./whatif.css";

/** Inputs of the recorded run with other values: as given, several of one, or the smallest change with which a condition holds. */
export function WhatIfPage() {
  const instance = useBench((bench) => bench.instance);
  const { found, busy, trouble } = useWhatIf();
  return (
    <div className="pane flexcol" data-pane="whatif">
      {instance && <WhatIfForm />}
      {trouble && (
        <p className="trouble st fatal" role="alert">
          <Icon name="error" small />
          <span>{trouble}</span>
        </p>
      )}
      {busy && (
        <p className="lonely faint" role="status">
          {t("whatif.busy")}
        </p>
      )}
      {found && <Results found={found} />}
      {!found && !busy && !trouble && <p className="lonely faint">{t(instance ? "whatif.none" : "sweep.noplc")}</p>}
    </div>
  );
}
