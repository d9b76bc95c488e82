/** How the program reacted to the error that is selected: asked for once its window is over. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { rest } from "../../wire/rest";
import type { Reaction } from "../../wire/types";
import { useBench } from "../plc/bench";
import { usePlc } from "../plc/plc";
import { useSimulator } from "./simulator";

interface Seen {
  /** The error that it is about; null when there is nothing to show. */
  id: string | null;
  reaction: Reaction | null;
  /** Why it could not be told. */
  refused: string | null;
}

const nothing: Seen = { id: null, reaction: null, refused: null };

export const useReaction = create<Seen>(() => nothing);

let shown = "";

/** What decides whether it has to be asked anew: another error, raised again, another PLC or program. */
function wanted(): { key: string; instance: number; id: string } | null {
  const { selected } = useSimulator.getState();
  const { errors, state } = usePlc.getState();
  const instance = useBench.getState().instance?.id;
  const row = selected === null ? undefined : errors.get(selected);
  if (!row || instance === undefined || row.reaction?.state !== "done") return null;
  const key = [instance, row.id, row.count, row.generated_scan, state?.program_version, row.reaction.verdict].join(" ");
  return { key, instance, id: row.id };
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
  // Of the same error the last one stays until the new one is here: nothing jumps.
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
