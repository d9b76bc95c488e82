/** The description of a reaction: a sentence, the places in the program, and what to do next. */

import { t } from "../../text";
import type { Reaction, Verdict } from "../../wire/types";
import { isFinding } from "./catalogue";

/** A line of the program that took part in the reaction. */
interface Place {
  file: string;
  line: number;
  what: "read" | "handler";
  /** What the line did, in words. */
  says: string;
}

/** The lines that read the error, each once, with what it read first. */
export function readersOf({ readers }: Reaction): Place[] {
  const found = new Map<string, { file: string; line: number; what: Set<string>; scan: number }>();
  for (const { file, line, what, scan } of readers) {
    const key = `${file}:${line}`;
    const known = found.get(key);
    if (known) {
      known.what.add(what);
      known.scan = Math.min(known.scan, scan);
    } else found.set(key, { file, line, what: new Set([what]), scan });
  }
  return [...found.values()].map(({ file, line, what, scan }) => ({
    file,
    line,
    what: "read",
    says: t("reaction.reads", { what: [...what].map((one) => t(`reaction.what.${one as "flag"}`)).join(", "), scan }),
  }));
}

/** Ranges of lines that were executed only because of the error. */
interface Stretch {
  file: string;
  from: number;
  to: number;
}

/** Consecutive handler lines, combined to ranges. */
export function stretchesOf({ lines }: Reaction): Stretch[] {
  const inOrder = [...lines].sort((a, b) => a.file.localeCompare(b.file) || a.line - b.line);
  const found: Stretch[] = [];
  for (const { file, line } of inOrder) {
    const last = found.at(-1);
    if (last && last.file === file && line <= last.to + 1) last.to = line;
    else found.push({ file, from: line, to: line });
  }
  return found;
}

/** What the program did, in one sentence. */
export function sentenceOf(reaction: Reaction, flag: string): string {
  const { verdict, window, first_read, first_effect } = reaction;
  const scans = first_effect ?? 0;
  const values = { flag, window, scans, read: first_read ?? 0 };
  if (verdict === "acted" || verdict === "reacted")
    return t(scans === 1 ? "reaction.says.reacted.one" : "reaction.says.reacted", values);
  return t(`reaction.says.${verdict}`, values);
}

/** What to do about a finding; empty when the program missed nothing. */
export function nextStep(verdict: Verdict, flag: string): string {
  if (!isFinding(verdict)) return "";
  return t(`reaction.next.${verdict}`, { flag });
}
