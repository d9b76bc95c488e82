import { useEffect, useRef } from "react";
import { bindCell } from "../../../store/plc/values";

/** The value at the end of each scan: value frames write it directly. */
export function NowCell({ path }: { path: string }) {
  const cell = useRef<HTMLSpanElement>(null);
  useEffect(
    () =>
      bindCell(path, "default", ({ text }) => {
        if (cell.current) cell.current.textContent = text;
      }),
    [path],
  );
  return (
    <span className="num" role="gridcell">
      <span ref={cell} data-testid={`now:${path}`} />
    </span>
  );
}
