import { usePlc } from "../../store/plc";
import { usePrefs } from "../../store/prefs";
import type { Instance, SweepSummary } from "../../wire/types";

/** Where the printable test record stands: of the version that was swept, where this is the PLC that was. */
export function recordAddress(instance: Instance, sweep: SweepSummary): string {
  const query = new URLSearchParams({ format: "html", lang: usePrefs.getState().language });
  const running = usePlc.getState().state?.program_version;
  if (instance.name === sweep.instance && sweep.program_version !== running)
    query.set("version", String(sweep.program_version));
  return `/api/instances/${instance.id}/record?${query}`;
}
