import { useEffect, useRef } from "react";
import { follow } from "../../../store/plc/follow";
import { t } from "../../../text";

/** What the variable has now, or had in the scan that is shown; value frames write it without React. */
export function LiveValue({ path }: { path: string }) {
  const text = useRef<HTMLSpanElement>(null);
  useEffect(
    () =>
      follow(path, "default", (reading) => {
        if (text.current) text.current.textContent = reading.text;
      }),
    [path],
  );
  return (
    <span className="crossvalue" data-live>
      <span className="muted">{t("cross.now")}</span> <span ref={text} className="mono" data-testid={`value:${path}`} />
    </span>
  );
}
