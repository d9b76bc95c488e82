import { usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { End } from "./End";
import { Facts } from "./Facts";
import "./timeline.css";
import { Track } from "./Track";
import { useRun } from "./useRun";

/** Every scan of the run along the bottom edge, and the controls for going back to it. */
export function Timeline() {
  const run = useRun();
  const interval = usePlc((plc) => plc.state?.interval_ns ?? 0);
  return (
    <section className="timeline" aria-label={t("timeline.label")} data-pane="timeline" data-live>
      <Facts run={run} interval={interval} />
      {run ? <Track run={run} interval={interval} /> : <p className="tl-none faint">{t("timeline.none")}</p>}
      <End run={run} />
    </section>
  );
}
