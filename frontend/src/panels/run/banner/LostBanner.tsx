import { useEffect, useState } from "react";
import { grouped } from "../../../logic/format/numbers";
import { useBench } from "../../../store/plc/bench";
import { readClock } from "../../../store/plc/clock";
import type { LinkStatus } from "../../../store/plc/plc";
import { reconnectNow } from "../../../store/plc/reconnect";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

/** No connection: since when, what is still shown, when the page tries again. */
export function LostBanner({ link }: { link: LinkStatus }) {
  const name = useBench((bench) => bench.instance?.name ?? "");
  const [now, setNow] = useState(Date.now());
  useEffect(() => {
    const timer = setInterval(() => setNow(Date.now()), 500);
    return () => clearInterval(timer);
  }, []);
  const seconds = Math.max(0, Math.ceil(((link.nextTryAt ?? now) - now) / 1000));
  const since = new Date(link.lostAt ?? now).toLocaleTimeString("en-GB");
  return (
    <div className="banner stale" role="alert">
      <Icon name="lost" />
      <span className="grow">
        <b>{t("lost.title", { name, since })}</b>{" "}
        <span className="muted">
          {t("lost.about", { scan: grouped(readClock().scan), attempt: link.attempt, seconds })}
        </span>
      </span>
      <button type="button" className="btn sm" onClick={reconnectNow}>
        <Icon name="refresh" small />
        {t("lost.now")}
      </button>
    </div>
  );
}
