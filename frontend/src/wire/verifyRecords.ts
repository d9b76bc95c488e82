/** Verifications that are kept in a project: the routes of `web/routes/verify.py`. */
import { json, request } from "./rest";
import type { VerificationRecord } from "./types";

export const verifyRecords = {
  all: (project: number) => json<VerificationRecord[]>("GET", `/projects/${project}/verification-records`),
  delete: async (record: number): Promise<void> => {
    await request("DELETE", `/verification-records/${record}`);
  },
};
