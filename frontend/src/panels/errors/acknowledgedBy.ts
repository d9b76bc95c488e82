import { grouped, wallTime } from "../../logic/format/numbers";
import { t } from "../../text";
import type { ErrorHistoryRow } from "../../wire/types";

/** Who acknowledged an error, when, and what they said. */
export function acknowledgedBy({ by, at, scan, remark }: NonNullable<ErrorHistoryRow["acknowledged"]>): string {
  const said = t("errors.acknowledged.by", { by, at: wallTime(at), scan: grouped(scan) });
  return remark ? `${said} ${t("errors.acknowledged.remark", { remark })}` : said;
}
