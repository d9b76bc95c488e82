/** The preferences of this browser: theme and language. `public/theme.js` reads the same entry before the first paint. */
import { create } from "zustand";
import { type Language, languages, setLanguage } from "../../text";
import { keep, PREFIX, recall } from "./localStorage";

export const themes = ["dark", "light", "contrast"] as const;
type Theme = (typeof themes)[number];

interface Prefs {
  theme: Theme;
  language: Language;
  /** Show in the editor where the compiler embedded subrange checks. */
  checks: boolean;
  /** Show live values at the ends of the lines in the editor. */
  inline: boolean;
  /** Show above declarations how many instances and references they have. */
  lenses: boolean;
  /** Put finished lines into their layout while somebody types. */
  formatOnType: boolean;
}

function systemLanguage(): Language {
  const first = navigator.language.slice(0, 2);
  return languages.find((language) => language === first) ?? "en";
}

function initial(): Prefs {
  const kept = recall<Partial<Prefs>>("prefs", {});
  const painted = document.documentElement.dataset.theme as Theme | undefined;
  const chosen = themes.find((theme) => theme === kept.theme);
  return {
    theme: chosen ?? painted ?? "dark",
    language: languages.find((language) => language === kept.language) ?? systemLanguage(),
    checks: kept.checks ?? false,
    inline: kept.inline ?? true,
    lenses: kept.lenses ?? false,
    formatOnType: kept.formatOnType ?? false,
  };
}

export const usePrefs = create<Prefs>(initial);

/** Tells the server, which says everything in this language from the next request and the next connection on. */
const LANGUAGE_COOKIE = "scanbench_language";
const YEAR_S = 31_536_000;

function apply({ theme, language }: Prefs): void {
  const root = document.documentElement;
  // Colours change without a transition: a value that fades from the old theme would look as if it had just changed.
  root.classList.add("switching");
  root.dataset.theme = theme;
  root.lang = language;
  void root.offsetHeight;
  root.classList.remove("switching");
  setLanguage(language);
  // biome-ignore lint/suspicious/noDocumentCookie: the Cookie Store API is not in every browser, and has no answer before the next request.
  document.cookie = `${LANGUAGE_COOKIE}=${language}; path=/; max-age=${YEAR_S}; samesite=lax`;
}

apply(usePrefs.getState());
usePrefs.subscribe((prefs) => {
  apply(prefs);
  keep("prefs", prefs);
});

/** Another window of this browser chose: all of them look the same. The event comes to the other windows only. */
addEventListener("storage", ({ key }) => {
  if (key === `${PREFIX}prefs`) usePrefs.setState(initial());
});

export function chooseTheme(theme: Theme): void {
  usePrefs.setState({ theme });
}

export function toggleChecks(): void {
  usePrefs.setState(({ checks }) => ({ checks: !checks }));
}

export function toggleInline(): void {
  usePrefs.setState(({ inline }) => ({ inline: !inline }));
}

export function toggleLenses(): void {
  usePrefs.setState(({ lenses }) => ({ lenses: !lenses }));
}

export function toggleFormatOnType(): void {
  usePrefs.setState(({ formatOnType }) => ({ formatOnType: !formatOnType }));
}

export function chooseLanguage(language: Language): void {
  usePrefs.setState({ language });
}
