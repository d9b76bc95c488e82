/** What is told about a reaction: a sentence, the places in the program, and what to do next. */

import { t } from "../../text";
import type { Reaction, Verdict } from "../../wire/types";

/** One line of the program that had to do with an error. */
interface Place {
  file: string;
  line: number;
  what: "read" | "handler";
  /** What it did, in words. */
  says: string;
}

/** The statements that read the error, each line once, with what it read first. */
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

/** Stretches of lines that were reached with the error only. */
interface Stretch {
  file: string;
  from: number;
  to: number;
}

/** Handler lines that follow each other, taken together. */
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
  if (verdict === "reacted") return t(scans === 1 ? "reaction.says.reacted.one" : "reaction.says.reacted", values);
  return t(`reaction.says.${verdict}`, values);
}

/** What to do about a finding; empty when nothing is missing. */
export function nextStep(verdict: Verdict, flag: string): string {
  if (verdict === "reacted" || verdict === "stopped") return "";
  return t(`reaction.next.${verdict}`, { flag });
}
