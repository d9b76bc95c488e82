/** What raising errors would write: requested a moment after the last change of a detail. */

import { useEffect, useState } from "react";
import { spaced } from "../../logic/format/debounce";
import { messageOf } from "../../logic/format/messageOf";
import { rest } from "../../wire/rest";
import type { GenerateOne, PreviewedErrors } from "../../wire/types";
import { useBench } from "../plc/bench";
import { usePlc } from "../plc/plc";

const DELAY = 150;

interface Previewed {
  /** The last answer; it stays until a newer one arrives. */
  preview: PreviewedErrors | null;
  refused: string | null;
}

const nothing: Previewed = { preview: null, refused: null };

/** Follows the wanted errors; null requests nothing. Errors that are raised or recovered meanwhile change the answer, too. */
export function usePreview(errors: readonly GenerateOne[] | null, again: boolean, anyway: boolean): Previewed {
  const [seen, setSeen] = useState(nothing);
  const instance = useBench((bench) => bench.instance?.id ?? null);
  const question = errors && instance !== null && JSON.stringify([instance, errors, again, anyway]);
  useEffect(() => {
    if (!question) {
      setSeen(nothing);
      return;
    }
    return follow(JSON.parse(question), setSeen);
  }, [question]);
  return seen;
}

/** Requests the preview, and again whenever the present errors change; until the returned function is called. */
function follow(
  [instance, errors, again, anyway]: [number, GenerateOne[], boolean, boolean],
  tell: (seen: Previewed) => void,
) {
  let asked = 0;
  let told = 0;
  let over = false;
  const ask = spaced(() => {
    asked += 1;
    const turn = asked;
    // A later request may be answered first.
    const answer = (seen: Previewed) => {
      if (over || turn < told) return;
      told = turn;
      tell(seen);
    };
    rest.previewErrors(instance, errors, again, anyway).then(
      (preview) => answer({ preview, refused: preview.ok ? null : preview.message }),
      (error: unknown) => answer({ preview: null, refused: messageOf(error) }),
    );
  }, DELAY);
  ask();
  const stop = usePlc.subscribe((plc, before) => {
    if (plc.errors !== before.errors && present(plc.errors) !== present(before.errors)) ask();
  });
  return () => {
    over = true;
    ask.cancel();
    stop();
  };
}

/** The errors that are present, with their details. */
function present(errors: ReturnType<typeof usePlc.getState>["errors"]): string {
  const rows = [...errors.values()].filter(({ status }) => status === "generated");
  return rows.map(({ id, details }) => `${id} ${details}`).join("\n");
}
