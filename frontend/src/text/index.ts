/** All texts of the page, by key. A new text goes into both catalogues; a missing key is a compile error. */
import { english, type TextKey } from "./en";
import { japanese } from "./ja";

export type { TextKey };

export const languages = ["en", "ja"] as const;
export type Language = (typeof languages)[number];
export const languageNames: Record<Language, string> = { en: "English", ja: "日本語" };

const catalogues: Record<Language, Record<TextKey, string>> = { en: english, ja: japanese };
let current: Language = "en";

export function setLanguage(language: Language): void {
  current = language;
}

/** The language of the page. */
export const language = (): Language => current;

/** The text of a key, with each `{name}` replaced by its value. Where `count` is 1, that of the key with `.one`, if there is one. */
export function t(key: TextKey, values: object = {}): string {
  const known = values as Record<string, unknown>;
  const texts: Partial<Record<string, string>> = catalogues[current];
  const text = (String(known.count) === "1" ? texts[`${key}.one`] : undefined) ?? catalogues[current][key];
  return text.replace(/\{(\w+)\}/g, (whole, name: string) => (name in known ? String(known[name]) : whole));
}
