import type { VerifyDifference, VerifyRow } from "../../../wire/types";

/** The selection that the details below the table are about: a row, and one of its differences. */
export interface Looked {
  row: VerifyRow | null;
  difference: VerifyDifference | null;
}
