/** From a row of a verification to who last wrote one of its variables. */
import { memberOf, writtenBefore } from "../../logic/verify/verify";
import type { VerifyDifference, VerifyRow } from "../../wire/types";
import { loadMembers } from "../plc/members";
import { showWriter } from "./writer";

/** Columns have the names inside the block; the query takes the path of the variable. */
export async function showWriterOf(row: VerifyRow, difference: VerifyDifference | null, column: string): Promise<void> {
  const inside = row.instance === "" ? [] : await loadMembers(row.instance);
  showWriter(memberOf(row.instance, inside, column), writtenBefore(row, difference));
}
