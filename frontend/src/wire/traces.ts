/** Traces of an instance, their samples, and records of them: the routes of `web/routes/traces.py`. */
import { blob, bytes, json, request } from "./rest";
import type { ChangeTrace, DefineTrace, Retrospective, TraceInfo, TraceRecordInfo } from "./types";

/** The source of samples. */
export type Source = { kind: "trace" | "record"; id: number };

const at = (instance: number, trace: number) => `/instances/${instance}/traces/${trace}`;
const base = (instance: number, { kind, id }: Source) => (kind === "trace" ? at(instance, id) : `/trace-records/${id}`);

export const traces = {
  all: (instance: number) => json<TraceInfo[]>("GET", `/instances/${instance}/traces`),
  make: (instance: number, wanted: DefineTrace) => json<TraceInfo>("POST", `/instances/${instance}/traces`, wanted),
  change: (instance: number, trace: number, by: ChangeTrace) => json<TraceInfo>("PATCH", at(instance, trace), by),
  drive: (instance: number, trace: number, action: "start" | "stop") =>
    json<TraceInfo>("POST", `${at(instance, trace)}/${action}`),
  delete: async (instance: number, trace: number): Promise<void> => {
    await request("DELETE", at(instance, trace));
  },
  /** Scans `first` to `last` (null: all); if they have more rows than `points`, the least and greatest value of stretches. */
  samples: async (instance: number, source: Source, first: number, last: number | null, points: number | null) => {
    const query = new URLSearchParams({ first: String(first) });
    if (last !== null) query.set("last", String(last));
    if (points !== null) query.set("points", String(points));
    return bytes(`${base(instance, source)}/samples?${query}`);
  },
  csv: (instance: number, source: Source) => blob(`${base(instance, source)}/csv`),
  keep: (instance: number, trace: number, name: string) =>
    json<TraceRecordInfo>("POST", `${at(instance, trace)}/keep`, { name }),
  records: (project: number) => json<TraceRecordInfo[]>("GET", `/projects/${project}/trace-records`),
  deleteRecord: async (record: number): Promise<void> => {
    await request("DELETE", `/trace-records/${record}`);
  },
  recordEarlier: (instance: number, signals: readonly string[], scans: number, every: number) =>
    json<Retrospective>("POST", `/instances/${instance}/retrospectives`, { signals, scans, every }),
  cancelRetrospective: async (retrospective: number): Promise<void> => {
    await request("DELETE", `/retrospectives/${retrospective}`);
  },
};
