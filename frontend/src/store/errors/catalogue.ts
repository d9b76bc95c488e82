/** The errors that the virtual PLC knows, with those of the project, in the language of the page. */
import { useMemo } from "react";
import { allErrors } from "../../logic/errors/catalogue";
import { inLanguage } from "../../logic/errors/wordings";
import type { ErrorGroup, ErrorInfo, ModelInfo } from "../../wire/types";
import { usePrefs } from "../page/prefs";
import { useBench } from "../plc/bench";

interface Catalogue {
  groups: readonly ErrorGroup[];
  errors: readonly ErrorInfo[];
  byId: ReadonlyMap<string, ErrorInfo>;
}

const none: Catalogue = { groups: [], errors: [], byId: new Map() };
const made = new WeakMap<ModelInfo, Map<string, Catalogue>>();

// Many panels need it: it is computed once for a model and a language.
function catalogueOf(model: ModelInfo | null, language: string): Catalogue {
  if (!model) return none;
  const known = made.get(model) ?? new Map<string, Catalogue>();
  made.set(model, known);
  let found = known.get(language);
  if (!found) {
    const groups = inLanguage(model.catalogue, language);
    const errors = allErrors(groups);
    found = { groups, errors, byId: new Map(errors.map((error) => [error.id, error])) };
    known.set(language, found);
  }
  return found;
}

export function useCatalogue(): Catalogue {
  const model = useBench((bench) => bench.model);
  const language = usePrefs((prefs) => prefs.language);
  return useMemo(() => catalogueOf(model, language), [model, language]);
}

/** The catalogue if it is that of the given model, else null: a sweep or a record may belong to a different model. */
export function useCatalogueOf(model: string): Catalogue {
  const catalogue = useCatalogue();
  return useBench((bench) => bench.model?.name === model) ? catalogue : none;
}

/** The same outside React. */
export function catalogueNow(): Catalogue {
  return catalogueOf(useBench.getState().model, usePrefs.getState().language);
}
