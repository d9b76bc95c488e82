import { t } from "../../../text";
import type { InstanceLimits } from "../../../wire/types";

/** The limits of an instance in a few words. */
export function limitsIn({ memory_mib: memory, cpu_percent: cpu, run_mib: run }: InstanceLimits): string {
  const parts = [
    cpu === null ? "" : `CPU ${cpu} %`,
    memory === null ? "" : `${memory} MiB`,
    run === null ? "" : `${t("instances.column.run")} ${run} MiB`,
  ].filter(Boolean);
  return parts.join(", ") || t("instances.limit.none");
}
