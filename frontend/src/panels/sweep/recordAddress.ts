import { usePrefs } from "../../store/prefs";

/** Where the printable test record of a PLC stands. */
export function recordAddress(instance: number): string {
  return `/api/instances/${instance}/record?format=html&lang=${usePrefs.getState().language}`;
}
