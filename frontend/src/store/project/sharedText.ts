/** The text of a file that several people edit at once (a CRDT, Yjs, as in the server): changes merge in whatever order they come. */
import diff from "fast-diff";
import * as Y from "yjs";

/** As `Y.Text` tells a change: from the beginning on, so much is skipped, deleted, or new. */
export type Delta = readonly { retain?: number; delete?: number; insert?: unknown }[];

/** A stretch of the text before the change, and what is there instead. */
export interface Replacement {
  rangeOffset: number;
  rangeLength: number;
  text: string;
}

interface Listener {
  /** The text changed, but not by `typed`. */
  onDelta(delta: Delta): void;
  /** A change that was made here, for the server. */
  onOwn(update: Uint8Array): void;
  /** The text is different now. */
  onText(): void;
}

/** The server knows the text by this name. */
const TEXT = "text";
const SERVER = "server";
const EDITOR = "editor";
const PAGE = "page";

export class SharedText {
  private readonly doc = new Y.Doc();
  private readonly text = this.doc.getText(TEXT);
  private readonly own = new Y.UndoManager(this.text, {
    trackedOrigins: new Set([EDITOR, PAGE]),
    captureTimeout: Number.POSITIVE_INFINITY, // the editor says where one ends that is taken back at once
  });

  constructor(
    /** Which draft of the server it is. */
    readonly draft: string,
    listener: Listener,
  ) {
    this.text.observe((event, { origin }) => {
      if (origin !== EDITOR) listener.onDelta(event.delta);
      listener.onText();
    });
    this.doc.on("update", (update: Uint8Array, origin: unknown) => {
      if (origin !== SERVER) listener.onOwn(update);
    });
  }

  get value(): string {
    return this.text.toString();
  }

  get length(): number {
    return this.text.length;
  }

  /** What is here, for the server to send the rest. */
  get vector(): Uint8Array {
    return Y.encodeStateVector(this.doc);
  }

  /** What is here and not there; null when that is nothing. */
  lackedBy(vector: Uint8Array): Uint8Array | null {
    const update = Y.encodeStateAsUpdate(this.doc, vector);
    return isNothing(update) ? null : update;
  }

  /** Changes from the server. */
  take(update: Uint8Array): void {
    Y.applyUpdate(this.doc, update, SERVER);
  }

  /** Changes that were made here before the page was loaded, and that the server may not have. */
  takeKept(update: Uint8Array): void {
    Y.applyUpdate(this.doc, update, "kept");
  }

  /** What the editor did to its own text. */
  typed(changes: readonly Replacement[]): void {
    const fromTheEnd = [...changes].sort((a, b) => b.rangeOffset - a.rangeOffset);
    this.doc.transact(() => {
      for (const { rangeOffset, rangeLength, text } of fromTheEnd) {
        if (rangeLength > 0) this.text.delete(rangeOffset, rangeLength);
        if (text !== "") this.text.insert(rangeOffset, text);
      }
    }, EDITOR);
  }

  /** Becomes a different text; what is the same in both stays as it is, for the sake of those who edit it now. */
  replace(text: string): void {
    this.own.stopCapturing();
    change(this.doc, text, PAGE);
    this.own.stopCapturing();
  }

  undo(): boolean {
    return this.own.undo() !== null;
  }

  redo(): boolean {
    return this.own.redo() !== null;
  }

  /** What follows is taken back by itself. */
  endStep(): void {
    this.own.stopCapturing();
  }

  /** A place that stays where it is when others type before it. */
  mark(offset: number): string {
    return encode(Y.encodeRelativePosition(Y.createRelativePositionFromTypeIndex(this.text, offset)));
  }

  /** Where a mark is now; null when it is not of this text, or of text that has not come yet. */
  offsetOf(mark: string): number | null {
    try {
      const place = Y.decodeRelativePosition(decode(mark));
      return Y.createAbsolutePositionFromRelativePosition(place, this.doc)?.index ?? null;
    } catch {
      return null;
    }
  }

  close(): void {
    this.doc.destroy();
  }
}

/** Both changes of a text, that to `one` and that to `other`. */
export function merged(base: string, one: string, other: string): string {
  if (one === other || other === base) return one;
  if (one === base) return other;
  const docs = [new Y.Doc(), new Y.Doc()] as const;
  change(docs[0], base, PAGE);
  Y.applyUpdate(docs[1], Y.encodeStateAsUpdate(docs[0]));
  change(docs[0], one, PAGE);
  change(docs[1], other, PAGE);
  Y.applyUpdate(docs[0], Y.encodeStateAsUpdate(docs[1]));
  return docs[0].getText(TEXT).toString();
}

export const joined = (updates: readonly Uint8Array[]): Uint8Array => Y.mergeUpdates([...updates]);

function change(doc: Y.Doc, after: string, origin: string): void {
  const text = doc.getText(TEXT);
  const before = text.toString();
  if (before === after) return;
  doc.transact(() => {
    let at = 0;
    for (const [kind, part] of diff(before, after)) {
      if (kind === diff.DELETE) text.delete(at, part.length);
      else if (kind === diff.INSERT) text.insert(at, part);
      if (kind !== diff.DELETE) at += part.length;
    }
  }, origin);
}

/** An update without a change and without a deletion is two zeros. */
const isNothing = (update: Uint8Array) => update.every((byte) => byte === 0);

export function encode(bytes: Uint8Array): string {
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text);
}

export const decode = (text: string) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
