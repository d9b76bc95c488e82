/** What raising errors would write: asked for a moment after the last change of a detail. */
import { useEffect, useState } from "react";
import { rest } from "../wire/rest";
import type { GenerateOne, PreviewedErrors } from "../wire/types";
import { useBench } from "./bench";
import { messageOf } from "./documents";
import { usePlc } from "./plc";

const DELAY = 150;

export interface Previewed {
  /** The last answer; stays while a newer one is on its way. */
  preview: PreviewedErrors | null;
  refused: string | null;
}

const nothing: Previewed = { preview: null, refused: null };

/** Follows what is wanted; null asks nothing. Errors that are raised or recovered meanwhile change the answer, too. */
export function usePreview(errors: readonly GenerateOne[] | null, again: boolean): Previewed {
  const [seen, setSeen] = useState(nothing);
  const instance = useBench((bench) => bench.instance?.id);
  const present = usePlc((plc) => plc.errors);
  const key = errors && JSON.stringify([errors, again]);
  // biome-ignore lint/correctness/useExhaustiveDependencies: what is present is a reason to ask again
  useEffect(() => {
    if (key === null || instance === undefined) {
      setSeen(nothing);
      return;
    }
    let gone = false;
    const [wanted, withAgain] = JSON.parse(key) as [GenerateOne[], boolean];
    const timer = setTimeout(() => {
      rest.previewErrors(instance, wanted, withAgain).then(
        (preview) => !gone && setSeen({ preview, refused: preview.ok ? null : preview.message }),
        (error: unknown) => !gone && setSeen({ preview: null, refused: messageOf(error) }),
      );
    }, DELAY);
    return () => {
      gone = true;
      clearTimeout(timer);
    };
  }, [key, instance, present]);
  return seen;
}
