/** Controller logs, and the mapping of their columns: the routes of `web/routes/verify.py`. */
import { json, request } from "./rest";
import type {
  CheckTraceMapping,
  NewController,
  NewTraceVerification,
  SavedMapping,
  TraceMapping,
  TraceMappingChecked,
  UploadedTrace,
  VerificationInfo,
} from "./types";

const mappings = (project: number) => `/projects/${project}/trace-mappings`;

export const traceImport = {
  upload: (project: number, file: File) =>
    json<UploadedTrace>("POST", `/projects/${project}/traces?name=${encodeURIComponent(file.name)}`, file),
  connect: (project: number, wanted: NewController) =>
    json<UploadedTrace>("POST", `/projects/${project}/controllers`, wanted),
  check: (instance: number, wanted: CheckTraceMapping) =>
    json<TraceMappingChecked>("POST", `/instances/${instance}/trace-check`, wanted),
  begin: (instance: number, wanted: NewTraceVerification) =>
    json<VerificationInfo>("POST", `/instances/${instance}/trace-verifications`, wanted),
  saved: (project: number) => json<SavedMapping[]>("GET", mappings(project)),
  save: (project: number, name: string, mapping: TraceMapping) =>
    json<SavedMapping>("POST", mappings(project), { name, mapping }),
  forget: async (mapping: number): Promise<void> => {
    await request("DELETE", `/trace-mappings/${mapping}`);
  },
};
