/** Queries about the past of a run: the routes of `web/routes/past.py`. */
import { json, request } from "./rest";
import type { Comparison, LastWriter, NewRerun, Rerun, RunChanges } from "./types";

export const past = {
  /** Before `scan` began; null is the shown state. */
  lastWriter: (instance: number, path: string, scan: number | null) => {
    const query = new URLSearchParams({ path });
    if (scan !== null) query.set("scan", String(scan));
    return json<LastWriter>("GET", `/instances/${instance}/last-write?${query}`);
  },
  changes: (instance: number, first: number, last: number) =>
    json<RunChanges>("GET", `/instances/${instance}/changes?first=${first}&last=${last}`),

  comparisons: (instance: number) => json<Comparison[]>("GET", `/instances/${instance}/comparisons`),
  compare: (instance: number, other: number) =>
    json<Comparison>("POST", `/instances/${instance}/comparisons`, { other }),
  /** Cancels a running one, deletes a finished one. */
  forget: async (comparison: number): Promise<void> => {
    await request("DELETE", `/comparisons/${comparison}`);
  },

  rerun: (instance: number, wanted: NewRerun) => json<Rerun>("POST", `/instances/${instance}/reruns`, wanted),
  cancelRerun: async (rerun: number): Promise<void> => {
    await request("DELETE", `/reruns/${rerun}`);
  },
};
