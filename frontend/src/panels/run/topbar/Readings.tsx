import { useEffect, useRef } from "react";
import { grouped, microseconds, plcTime } from "../../../logic/format/numbers";
import { bindClock } from "../../../store/plc/clock";
import { usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";

/** Value frames write scan number and PLC time directly, without React; the cycle time comes with the state. */
export function Readings() {
  const scan = useRef<HTMLSpanElement>(null);
  const time = useRef<HTMLSpanElement>(null);
  const fraction = useRef<HTMLSpanElement>(null);
  // How long a scan took is measured while it runs: of a scan in the past nobody knows it.
  const cycle = usePlc(({ state }) => (state === null || state.past ? null : state.cycle_us));
  const known = usePlc((plc) => plc.state !== null);
  useEffect(
    () =>
      bindClock((now) => {
        if (!known) {
          for (const each of [scan, time]) if (each.current) each.current.textContent = "–";
          if (fraction.current) fraction.current.textContent = "";
          return;
        }
        if (scan.current) scan.current.textContent = grouped(now.scan);
        const [whole = "", part = ""] = plcTime(now.timeNs).split(".");
        if (time.current) time.current.textContent = whole;
        if (fraction.current) {
          fraction.current.textContent = `.${part}`;
          fraction.current.classList.toggle("spare", whole.includes("d"));
        }
      }),
    [known],
  );
  return (
    <div className="reads">
      <div className="read r-scan">
        <span>{t("read.scan")}</span>
        <span ref={scan} data-testid="scan" />
      </div>
      <div className="read r-time">
        <span>{t("read.time")}</span>
        <span data-testid="plc-time">
          <span ref={time} />
          <span ref={fraction} />
        </span>
      </div>
      <div className="read r-cycle" title={t("read.cycle.about")}>
        <span>{t("read.cycle")}</span>
        <span data-testid="cycle">{cycle === null ? "–" : microseconds(cycle)}</span>
      </div>
    </div>
  );
}
