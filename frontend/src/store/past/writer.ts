/** Who last wrote a variable: a query about the run. The answer is a statement, a command, or the PLC itself. */
import { past } from "../../wire/past";
import type { LastWriter } from "../../wire/types";
import { openFile } from "../page/navigate";
import { query } from "../plc/query";
import { travel } from "../plc/timeline";

const writer = query((instance, { path, scan }: { path: string; scan: number | null }) =>
  past.lastWriter(instance, path, scan),
);

export const useWriter = writer.use;
export const closeWriter = writer.close;

/** Opens the dialog. `scan`: who wrote it before that scan began; null: before what is shown now. */
export function showWriter(path: string, scan: number | null = null): void {
  void writer.ask({ path, scan });
}

/** There is no variable to ask about: the dialog says why. */
export const refuseWriter = (why: string) => writer.refuse({ path: "…", scan: null }, why);

/** Goes to the moment before the write, and shows its statement. */
export function goToWriter({ scan, count, place }: LastWriter): void {
  closeWriter();
  if (place) openFile(place.file, place.line);
  void travel(scan, count);
}
