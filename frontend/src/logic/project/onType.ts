/** Which lines are to be formatted while somebody types, and whether what was answered about them still fits. */

interface Change {
  range: { startLineNumber: number; startColumn: number; endLineNumber: number; endColumn: number };
  text: string;
}

interface Edit {
  range: { endLineNumber: number };
}

/** What a key finished. The place is the one after the key. */
export interface Finished {
  ch: string;
  line: number;
  column: number;
}

/** What was finished by this change, if it is one key: a line by Enter, a statement by `;`, a block by its END_. `textOf` has the lines after it. */
export function finishedBy(changes: readonly Change[], textOf: (line: number) => string): Finished | null {
  const [change, ...others] = changes;
  if (!change || others.length > 0) return null;
  const { startLineNumber: line, startColumn } = change.range;
  if (/^\r?\n$/.test(change.text)) return { ch: "\n", line: line + 1, column: 1 };
  if (!/^[;\p{L}]$/u.test(change.text)) return null;
  const column = startColumn + 1;
  const [before, after] = [textOf(line).slice(0, column - 1), textOf(line).slice(column - 1)];
  if (after.trim() !== "" || (change.text !== ";" && !/^\s*END_\w+$/i.test(before))) return null;
  return { ch: change.text, line, column };
}

/** The lines that Enter finished, one question after the other: what is typed below them meanwhile does not matter. */
export class FinishedLines {
  private readonly waiting: number[] = [];
  /** The first line that changed since the question. */
  private changed = Number.POSITIVE_INFINITY;
  private byUs = false;

  /** `finished`: the line that this change finished. */
  note(changes: readonly Change[], finished: number | null): void {
    const first = Math.min(...changes.map(({ range }) => range.startLineNumber));
    this.changed = Math.min(this.changed, finished === first ? first + 1 : first);
    // Somebody went back to these: they are not finished, or are not where they were.
    for (let at = this.waiting.length - 1; at >= 0; at -= 1) {
      if ((this.waiting[at] ?? 0) >= first) this.waiting.splice(at, 1);
    }
    if (finished !== null) this.waiting.push(finished);
  }

  /** What was answered before was put into the text, within its lines. */
  own(changes: readonly Change[]): void {
    this.changed = Math.min(this.changed, ...changes.map(({ range }) => range.startLineNumber));
    this.byUs = true;
  }

  /** An answer that does not fit: asks again where only our own edits are the reason. */
  again(line: number): boolean {
    if (!this.byUs) return false;
    this.waiting.unshift(line);
    return true;
  }

  /** The next line to ask about. */
  next(): number | undefined {
    this.changed = Number.POSITIVE_INFINITY;
    this.byUs = false;
    return this.waiting.shift();
  }

  /** Whether what was answered is about lines that are as they were. */
  fits(edits: readonly Edit[]): boolean {
    return edits.every(({ range }) => range.endLineNumber < this.changed);
  }
}
