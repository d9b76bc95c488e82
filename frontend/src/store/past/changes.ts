/** What changed between two scans: a query about the run, shown in a dialog. */
import { past } from "../../wire/past";
import { query } from "../plc/query";

const changes = query(
  (instance, { first, last }: { first: number; last: number }) => past.changes(instance, first, last),
  { keeps: true },
);

/** `asked` is null while the dialog is closed. */
export const useChanges = changes.use;
export const closeChanges = changes.close;

/** Opens the dialog: which values differ between the beginnings of the two scans. */
export function showChanges(first: number, last: number): void {
  void changes.ask({ first: Math.min(first, last), last: Math.max(first, last) });
}
