/** The looks at the past that this browser began: each is at a branch that the server ends when nobody is there. */
import { keep, recall } from "../page/localStorage";

interface Look {
  /** The PLC that one came from. */
  of: number;
  scan: number;
}

/** By the branch that was made for it. */
export type Looks = Readonly<Record<string, Look>>;

const KEY = "looks";

export const keptLooks = (): Looks => recall(KEY, {});

export const keepLooks = (looks: Looks) => keep(KEY, looks);
