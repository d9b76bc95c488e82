import { useState } from "react";
import type { ShownVerification } from "../../../store/verify/verify";
import { useVerifyRows } from "../../../store/verify/verifyRows";
import { t } from "../../../text";
import { Facts } from "./Facts";
import { Source } from "./Source";

/** Below the table: the program at the place of the difference, and the details of the row. */
export function Detail({ shown }: { shown: ShownVerification }) {
  const row = useVerifyRows(({ selected, byIndex }) => (selected === null ? null : (byIndex.get(selected) ?? null)));
  const [chosen, choose] = useState<{ row: number; at: number }>({ row: -1, at: 0 });
  const at = row && chosen.row === row.index ? chosen.at : 0;
  const difference = row?.differences[at] ?? null;
  return (
    <section className={`vfdetail${row ? "" : " idle"}`} aria-label={t("verify.details")}>
      <Source info={shown.info} row={row} difference={difference} />
      <Facts
        shown={shown}
        row={row}
        difference={difference}
        at={at}
        onChoose={(next) => row && choose({ row: row.index, at: next })}
      />
    </section>
  );
}
