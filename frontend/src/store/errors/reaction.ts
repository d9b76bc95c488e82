/** The reaction of the program to the selected error: requested once its window is over. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { keyOf } from "../../logic/plc/errorInstances";
import { rest } from "../../wire/rest";
import type { Reaction } from "../../wire/types";
import { useBench } from "../plc/bench";
import { usePlc } from "../plc/plc";
import { useSimulator } from "./simulator";

interface Seen {
  /** The error, or the instance, of the reaction; null when there is nothing to show. */
  id: string | null;
  reaction: Reaction | null;
  /** Why the reaction is not available. */
  refused: string | null;
}

const nothing: Seen = { id: null, reaction: null, refused: null };

export const useReaction = create<Seen>(() => nothing);

let shown = "";

/** The reaction is requested again when this changes: the error, when it was raised, the PLC or the program. */
function wanted(): { key: string; instance: number; id: string } | null {
  const { selected } = useSimulator.getState();
  const { errors, instances, state } = usePlc.getState();
  const instance = useBench.getState().instance?.id;
  const row = selected === null ? undefined : (instances.get(selected) ?? errors.get(selected));
  if (!row || instance === undefined || row.reaction?.state !== "done") return null;
  const id = keyOf(row);
  const key = [instance, id, row.count, row.generated_scan, state?.program_version, row.reaction.verdict].join(" ");
  return { key, instance, id };
}

function follow(): void {
  const next = wanted();
  const key = next?.key ?? "";
  if (key === shown) return;
  shown = key;
  if (!next) {
    useReaction.setState(nothing);
    return;
  }
  // The old reaction to the same error stays until the new one arrives, so that the layout does not jump.
  if (useReaction.getState().id !== next.id) useReaction.setState({ ...nothing, id: next.id });
  rest.reaction(next.instance, next.id).then(
    (reaction) => shown === key && useReaction.setState({ id: next.id, reaction, refused: null }),
    (error: unknown) =>
      shown === key && useReaction.setState({ id: next.id, reaction: null, refused: messageOf(error) }),
  );
}

useSimulator.subscribe((now, before) => {
  if (now.selected !== before.selected) follow();
});
usePlc.subscribe((now, before) => {
  if (now.errors !== before.errors || now.state?.program_version !== before.state?.program_version) follow();
});
