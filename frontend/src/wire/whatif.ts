/** What if: the route of `web/routes/past.py`. */
import { json } from "./rest";
import type { NewWhatIf, WhatIf } from "./types";

export const whatIf = (instance: number, wanted: NewWhatIf, signal: AbortSignal) =>
  json<WhatIf>("POST", `/instances/${instance}/what-if`, wanted, signal);
