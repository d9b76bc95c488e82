/** What the form of a what-if question asks for. */
import type { NewWhatIf, WhatIfTry } from "../../wire/types";

/** `set`: the values as given; `vary`: each of several values of one variable; `search`: the smallest change. */
type Mode = "set" | "vary" | "search";
export const MODES: readonly Mode[] = ["set", "vary", "search"];

export interface WhatIfForm {
  mode: Mode;
  scan: string;
  window: string;
  /** `start = TRUE; level = 40` */
  values: string;
  vary: string;
  /** `1, 2, 5`, `0..100/5` */
  tried: string;
  /** Paths, separated by semicolons. */
  candidates: string;
  condition: string;
  watch: string;
  hold: boolean;
}

export const FORM: WhatIfForm = {
  mode: "set",
  scan: "",
  window: "100",
  values: "",
  vary: "",
  tried: "",
  candidates: "",
  condition: "",
  watch: "",
  hold: true,
};

/** The request; else the field that is missing or wrong. */
export function wantedOf(form: WhatIfForm): NewWhatIf | keyof WhatIfForm {
  const scan = whole(form.scan);
  const window = whole(form.window);
  const values = valuesOf(form.values);
  if (scan === undefined) return "scan";
  if (window === undefined) return "window";
  if (values === null || (form.mode === "set" && values.length === 0)) return "values";
  const vary = form.mode === "vary" ? form.vary.trim() : "";
  const tried = form.mode === "vary" ? listed(form.tried, ",") : [];
  const candidates = form.mode === "search" ? listed(form.candidates, ";") : [];
  if (form.mode === "vary" && vary === "") return "vary";
  if (form.mode === "vary" && tried.length === 0) return "tried";
  if (form.mode === "search" && candidates.length === 0) return "candidates";
  const condition = form.condition.trim();
  if (form.mode === "search" && condition === "") return "condition";
  return {
    scan,
    window,
    values,
    vary,
    tried,
    search: form.mode === "search",
    candidates,
    condition,
    watch: listed(form.watch, ";"),
    hold: form.hold,
  };
}

/** `start = TRUE; level := 40`; null where a part has no value. */
function valuesOf(text: string): { path: string; value: string }[] | null {
  const found = listed(text, ";").map((part) => /^([^=]*?)\s*:?=\s*(.+)$/.exec(part));
  if (found.some((part) => !part?.[1])) return null;
  return found.map((part) => ({ path: part?.[1] ?? "", value: part?.[2] ?? "" }));
}

/** Parts of a text; a separator within quotes is none: `name = 'a;b'` is one part. */
function listed(text: string, by: string): string[] {
  const parts = [""];
  let quote = "";
  for (const [at, letter] of [...text].entries()) {
    if (quote === "" && letter === by) {
      parts.push("");
      continue;
    }
    if (quote === "" && (letter === "'" || letter === '"')) quote = letter;
    else if (letter === quote && [...text][at - 1] !== "$") quote = "";
    parts[parts.length - 1] += letter;
  }
  return parts.map((each) => each.trim()).filter(Boolean);
}

const whole = (text: string): number | undefined => {
  const digits = text.replace(/[\s\u2009,]/g, "");
  return /^\d{1,15}$/.test(digits) ? Number(digits) : undefined;
};

/** Only the change: what every try has too is in the form. */
export const changeOf = ({ values }: WhatIfTry) => values.map(({ path, value }) => `${path} = ${value}`).join(", ");
