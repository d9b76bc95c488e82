/** What somebody typed into a field of a drawing and what is still being taken over into its text. */

let last: Promise<boolean> = Promise.resolve(true);

/** A field is taken; `taken` tells whether it was, and never rejects. */
export function entering(taken: Promise<boolean>): void {
  last = taken;
}

/** Waits for the field that was left last; false: its text was refused. */
export async function entered(): Promise<boolean> {
  const taken = await last;
  last = Promise.resolve(true);
  return taken;
}
