/** What the program did about an error, and what to do about that, in words. */
import { t } from "../../logic/text";
import type { SweepCell } from "../../wire/types";

const inScans = (count: number) => (count === 1 ? t("sweep.scan") : t("sweep.scans", { count }));

export function sentence({ verdict, first_read: read, first_effect: effect }: SweepCell, window: number): string {
  switch (verdict) {
    case "reacted":
      return read === null
        ? t("sweep.says.effect", { effect: inScans(effect ?? 1) })
        : t("sweep.says.reacted", { effect: inScans(effect ?? 1), read });
    case "no_effect":
      return t("sweep.says.no_effect", { read: read ?? 1, window });
    case "never_read":
      return t("sweep.says.never_read", { window });
    case "stopped":
      return t("sweep.says.stopped");
    default:
      return "";
  }
}

export function nextHint({ verdict }: SweepCell, flag: string): string {
  return verdict === "never_read" ? t("sweep.next.never_read", { flag: flag || t("errors.flag") }) : t("sweep.next.no_effect");
}
