/** The form for replaying a run with one error changed, and the request to the server. */

import type { TextKey } from "../../text";
import type { NewRerun } from "../../wire/types";
import { ungrouped } from "../format/numbers";

export interface RerunForm {
  name: string;
  how: "same" | "instead" | "out";
  /** Id of the error to raise instead. */
  instead: string;
  way: "same" | "earlier" | "later";
  /** How many scans, as typed. */
  by: string;
  /** How many scans the replay continues after the end, as typed. */
  scansAfter: string;
}

type Read = { wanted: NewRerun } | { trouble: TextKey };

/** The request, or what is missing. `first`: the first scan of the run. */
export function readRerun(form: RerunForm, of: { scan: number; error: string }, first: number): Read {
  const name = form.name.trim();
  if (name === "") return { trouble: "name.missing" };
  const scansAfter = count(form.scansAfter);
  const by = form.way === "same" || form.how === "out" ? 0 : count(form.by);
  if (by === null || scansAfter === null) return { trouble: "rerun.number" };
  const shift = form.way === "earlier" ? -by : by;
  if (form.how === "instead" && form.instead === "") return { trouble: "rerun.noerror" };
  if (form.how === "same" && shift === 0) return { trouble: "rerun.nochange" };
  if (of.scan + shift < first) return { trouble: "rerun.toosoon" };
  return {
    wanted: {
      scan: of.scan,
      error: of.error,
      name,
      by: shift === 0 ? 0 : shift,
      instead: form.how === "instead" ? form.instead : "",
      leave_out: form.how === "out",
      scans_after: scansAfter,
    },
  };
}

const MOST = 1_000_000;

function count(text: string): number | null {
  const digits = ungrouped(text);
  return /^\d{1,7}$/.test(digits) && Number(digits) <= MOST ? Number(digits) : null;
}
