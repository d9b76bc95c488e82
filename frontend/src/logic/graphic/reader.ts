/** Reads through the text of one network: blanks and comments, words, and slices up to a closing bracket. */

import type { Unread } from "./tree";

const WORD = /[\p{L}_][\p{L}\p{N}_]*/uy;
/** A variable as it is written: members, indexes are read by `reference`. */
const BLANK = /\s+/y;
const OPENS: Readonly<Record<string, string>> = { "(": ")", "[": "]" };

/** Thrown where the text is not what the grammar wants; the caller shows the text then. */
export class NotRead extends Error {
  constructor(
    readonly at: number,
    readonly expected: Unread["expected"],
  ) {
    super(expected);
  }
}

export class Reader {
  at = 0;
  /** Whether a comment was skipped inside of the network. */
  comments = false;

  constructor(
    readonly text: string,
    at = 0,
    readonly end = text.length,
  ) {
    this.at = at;
  }

  /** Skips blanks and comments. */
  skip(): void {
    for (;;) {
      BLANK.lastIndex = this.at;
      if (BLANK.test(this.text)) this.at = Math.min(this.end, BLANK.lastIndex);
      const end = commentEnd(this.text, this.at, this.end);
      if (end === this.at) return;
      this.comments = true;
      this.at = end;
    }
  }

  /** Whether this comes next, after blanks. */
  sees(mark: string): boolean {
    this.skip();
    return this.at + mark.length <= this.end && this.text.startsWith(mark, this.at);
  }

  takes(mark: string): boolean {
    if (!this.sees(mark)) return false;
    this.at += mark.length;
    return true;
  }

  expect(mark: string, expected: Unread["expected"]): void {
    if (!this.takes(mark)) throw new NotRead(this.at, expected);
  }

  /** The word that comes next, without taking it; empty when there is none. */
  word(): string {
    this.skip();
    WORD.lastIndex = this.at;
    const found = this.at < this.end ? WORD.exec(this.text)?.[0] : undefined;
    return found ?? "";
  }

  done(): boolean {
    this.skip();
    return this.at >= this.end;
  }

  /**
   * The text up to one of the marks that is in no bracket, string or comment; the mark is not taken. Blanks around it are left out.
   */
  upTo(marks: readonly string[], expected: Unread["expected"]): string {
    const from = this.at;
    const closing: string[] = [];
    while (this.at < this.end) {
      const comment = commentEnd(this.text, this.at, this.end);
      if (comment !== this.at) {
        this.at = comment;
        continue;
      }
      const here = this.text[this.at] ?? "";
      if (closing.length === 0 && marks.some((mark) => this.text.startsWith(mark, this.at)))
        return this.text.slice(from, this.at).trim();
      if (here === "'" || here === '"') this.at = stringEnd(this.text, this.at, this.end);
      else {
        const opens = OPENS[here];
        if (opens !== undefined) closing.push(opens);
        else if (here === closing.at(-1)) closing.pop();
        else if (here === ")" || here === "]") throw new NotRead(this.at, expected);
        this.at += 1;
      }
    }
    throw new NotRead(from, expected);
  }
}

/** What may begin a word, a string or a comment: everything else is passed over at once. */
const BEGINS = /[A-Za-z_'"/(\u0080-\uffff]/g;
const DIGIT = /\p{N}/u;

/** The words of a text in capitals, without those in comments and strings. */
export function* wordsIn(text: string, from = 0, end = text.length): Generator<{ word: string; at: number }> {
  let at = from;
  for (;;) {
    BEGINS.lastIndex = at;
    const found = BEGINS.exec(text);
    if (!found || found.index >= end) return;
    at = found.index;
    const here = found[0];
    const comment = commentEnd(text, at, end);
    WORD.lastIndex = at;
    if (comment !== at) at = comment;
    else if (here === "'" || here === '"') at = stringEnd(text, at, end);
    else if (WORD.test(text)) {
      const next = WORD.lastIndex;
      if (at === 0 || !DIGIT.test(text[at - 1] ?? "")) yield { word: text.slice(at, next).toUpperCase(), at };
      at = next;
    } else at += 1;
  }
}

/** The end of the comment that begins here; the same place when none does. */
export function commentEnd(text: string, at: number, end = text.length): number {
  const two = text.slice(at, at + 2);
  if (two === "//") {
    const line = text.indexOf("\n", at);
    return line < 0 || line > end ? end : line;
  }
  const close = two === "(*" ? "*)" : two === "/*" ? "*/" : null;
  if (close === null) return at;
  const found = text.indexOf(close, at + 2);
  return found < 0 || found + 2 > end ? end : found + 2;
}

/** The end of the string that begins here; `$` takes the next character with it. */
export function stringEnd(text: string, at: number, end = text.length): number {
  const quote = text[at];
  let here = at + 1;
  while (here < end && text[here] !== quote && text[here] !== "\n") here += text[here] === "$" ? 2 : 1;
  return Math.min(end, here + 1);
}
