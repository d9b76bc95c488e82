/** Verifications of an instance, their rows, and kept ones: the routes of `web/routes/verify.py`. */
import { blob, json, request } from "./rest";
import type {
  DriveVerification,
  NewVerification,
  SetCell,
  VerificationInfo,
  VerificationRecord,
  VerifyFlows,
  VerifyRows,
  VerifyUse,
} from "./types";

/** The source of rows. */
export type VerifySource = { kind: "verification" | "record"; id: number };
export type ExportFormat = "csv" | "json" | "html" | "junit";
/** How the name of such a file ends. */
export const endingOf = (format: ExportFormat): string => (format === "junit" ? "xml" : format);

const base = ({ kind, id }: VerifySource) =>
  kind === "verification" ? `/verifications/${id}` : `/verification-records/${id}`;

export const verify = {
  all: (instance: number) => json<VerificationInfo[]>("GET", `/instances/${instance}/verifications`),
  begin: (instance: number, wanted: NewVerification) =>
    json<VerificationInfo>("POST", `/instances/${instance}/verifications`, wanted),
  drive: (verification: number, how: DriveVerification) =>
    json<VerificationInfo>("PATCH", `/verifications/${verification}`, how),
  delete: async (verification: number): Promise<void> => {
    await request("DELETE", `/verifications/${verification}`);
  },
  /** Rows from index `first` on; `differing`: only rows that differ are counted. */
  rows: (of: VerifySource, first: number, count: number, differing: boolean) =>
    json<VerifyRows>("GET", `${base(of)}/rows?first=${first}&count=${count}&differing=${differing}`),
  setCells: (verification: number, cells: readonly SetCell[]) =>
    json<VerificationInfo>("POST", `/verifications/${verification}/cells`, { cells }),
  uses: (verification: number, scan: number, call: number) =>
    json<VerifyUse[]>("GET", `/verifications/${verification}/uses?scan=${scan}&call=${call}`),
  flow: (verification: number, scan: number, call: number, pou: string, path: string) =>
    json<VerifyFlows>(
      "GET",
      `/verifications/${verification}/flow?${new URLSearchParams({ scan: String(scan), call: String(call), pou, path })}`,
    ),
  export: async (of: VerifySource, format: ExportFormat): Promise<Blob> => blob(`${base(of)}/export?format=${format}`),
  keep: (verification: number, name: string) =>
    json<VerificationRecord>("POST", `/verifications/${verification}/keep`, { name }),
};
