import type { VerifyDifference, VerifyRow } from "../../../wire/types";

/** What is looked at below the table: a row, and one of its differences. */
export interface Looked {
  row: VerifyRow | null;
  difference: VerifyDifference | null;
}
