/** The catalogue in one language. The other names stay in `wordings`, so that a search finds both. */
import type { ErrorDetail, ErrorGroup, ErrorInfo } from "../../wire/types";

type Wording = NonNullable<ErrorInfo["wordings"]>[number];

interface Worded {
  name?: string;
  description?: string;
  wordings?: Wording[];
}

/** Groups, errors, details and choices with the names and descriptions of a language; those without a wording stay as they are. */
export function inLanguage(groups: readonly ErrorGroup[], language: string): ErrorGroup[] {
  return groups.map((group) => ({
    ...worded(group, language),
    groups: inLanguage(group.groups, language),
    errors: group.errors.map((error) => ({
      ...worded(error, language),
      details: error.details.map((detail) => detailIn(detail, language)),
    })),
  }));
}

function detailIn(detail: ErrorDetail, language: string): ErrorDetail {
  return {
    ...detail,
    description: wordingOf(detail, language)?.description || detail.description,
    choices: (detail.choices ?? []).map((choice) => ({
      ...choice,
      description: wordingOf(choice, language)?.description || choice.description,
    })),
  };
}

function worded<T extends Worded>(thing: T, language: string): T {
  const wording = wordingOf(thing, language);
  if (!wording) return thing;
  const before = { language: "", name: thing.name ?? "", description: thing.description ?? "" };
  return {
    ...thing,
    name: wording.name || thing.name,
    ...(thing.description === undefined ? {} : { description: wording.description || thing.description }),
    wordings: [...(thing.wordings ?? []), before],
  };
}

function wordingOf(thing: Worded, language: string): Wording | undefined {
  return thing.wordings?.find((wording) => wording.language === language);
}
