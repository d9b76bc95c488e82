/** The state of the PLC along its run, derived from the marks: the ribbon of the timeline. */
import type { ErrorInfo, Mark } from "../../wire/types";
import { type Axis, placeOf } from "./timeline";

type RunTone = "running" | "stopped" | "fatal";

/** From this scan on, up to the next stretch. */
interface Stretch {
  from: number;
  tone: RunTone;
}

/** A stretch on the axis, in pixels. */
interface Piece {
  left: number;
  width: number;
  tone: RunTone;
}

/** The state after the marks so far: the fatal errors that are present, a run-time error, mode PROGRAM. */
interface Course {
  fatal: ReadonlySet<string>;
  trapped: boolean;
  program: boolean;
}

/** Before the first mark that says otherwise, the program runs. */
const RUNNING: Course = { fatal: new Set(), trapped: false, program: false };
const WORDS = /[\w-]+/g;

/** The stretches of a run; neighbours differ in tone. `errors` is the catalogue: it knows which errors are fatal. */
export function stretches(marks: readonly Mark[], errors: readonly ErrorInfo[]): Stretch[] {
  const fatal = new Set(errors.filter((error) => error.severity === "fatal").map((error) => error.id));
  const found: Stretch[] = [{ from: 0, tone: "running" }];
  let course = RUNNING;
  for (const mark of marks) {
    course = after(course, mark, fatal);
    const tone = toneOf(course);
    if (found.at(-1)?.tone !== tone) found.push({ from: mark.scan, tone });
  }
  return found;
}

function toneOf({ fatal, trapped, program }: Course): RunTone {
  if (fatal.size > 0 || trapped) return "fatal";
  return program ? "stopped" : "running";
}

/** The texts are those of the commands' plans on the server (`runtime/modes.py`, `restart.py`, `trap.py`, `faults/inject.py`). */
function after(course: Course, { kind, text }: Mark, fatal: ReadonlySet<string>): Course {
  switch (kind) {
    case "mode":
      return modeSet(course, text);
    case "run":
      return /^(cold|warm) start|^power off and on/.test(text) ? RUNNING : course;
    case "system":
      return /^[^\s:]+:\d+:\d+: /.test(text) ? { ...course, trapped: true } : course;
    case "build":
      // Where the old program had stopped with an error, the corrected one starts without the errors of before.
      return /^program version \d+: warm start/.test(text) ? RUNNING : course;
    case "error":
      // An armed error is not raised yet, and a missed one was never raised.
      if (/^(armed|fault) \d+\b/.test(text)) return course;
      // A second CPU Unit goes on with the program.
      if (text.includes("; the standby takes over")) return course;
      return { ...course, fatal: new Set([...course.fatal, ...named(text, fatal)]) };
    case "recover":
      return recovered(course, text, named(text, fatal));
    default:
      return course;
  }
}

function modeSet(course: Course, text: string): Course {
  const mode = /\b(PROGRAM|MONITOR|RUN)\b/.exec(text)?.[1];
  if (mode === undefined) return course;
  return mode === "PROGRAM" ? { ...course, trapped: false, program: true } : RUNNING;
}

function recovered(course: Course, text: string, ids: readonly string[]): Course {
  const left = new Set(course.fatal);
  for (const id of ids) left.delete(id);
  const over = course.fatal.size > 0 && left.size === 0;
  if (over || text.includes("the program stays stopped")) return { fatal: left, trapped: false, program: true };
  return { ...course, fatal: left };
}

function named(text: string, ids: ReadonlySet<string>): string[] {
  return (text.match(WORDS) ?? []).filter((word) => ids.has(word));
}

/** A stopped PLC counts no scans, so most stops have no length: they are drawn with a minimum width. */
const LEAST = 3;
const SERIOUS: readonly RunTone[] = ["running", "stopped", "fatal"];

/** The stretches as they are drawn on a part of the run, `width` pixels wide: no more pieces than pixels. */
export function pieces(run: readonly Stretch[], axis: Axis, width: number): Piece[] {
  const found: Piece[] = [];
  for (const [index, { from, tone }] of run.entries()) {
    const end = run[index + 1]?.from ?? axis.to;
    if (end < axis.from || from > axis.to) continue;
    const right = placeOf(Math.min(end, axis.to), axis) * width;
    let left = placeOf(Math.max(from, axis.from), axis) * width;
    const last = found.at(-1);
    if (last && left - last.left < LEAST) {
      // Where several stretches share these pixels, the most severe one is drawn.
      last.tone = worse(last.tone, tone);
      left = last.left + LEAST;
      last.width = Math.min(right, left) - last.left;
      if (right <= left || last.tone === tone) {
        last.width = Math.max(last.width, right - last.left);
        continue;
      }
    }
    found.push({ left, width: right - left, tone });
  }
  return found.map((piece) => (piece.tone === "running" ? piece : { ...piece, width: Math.max(LEAST, piece.width) }));
}

function worse(one: RunTone, other: RunTone): RunTone {
  return SERIOUS.indexOf(one) > SERIOUS.indexOf(other) ? one : other;
}
