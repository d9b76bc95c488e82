/** What the project does with values outside of subranges: it is in `language.json`, beside the dialect. */
import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { rest } from "../../wire/rest";
import type { ProjectSubranges } from "../../wire/types";
import { useDocuments } from "./documents";

export type Policies = ProjectSubranges["policies"];
export type Policy = Policies[string];
export const POLICIES: readonly Policy[] = ["limit", "hold", "trap", "report", "off"];
/** The name of the entry for all that no other entry is about. */
export const WHOLE_PROJECT = "*";

interface State {
  /** Null until the server answered. */
  policies: Policies | null;
  trouble: string | null;
}

export const useSubranges = create<State>(() => ({ policies: null, trouble: null }));

/** Asks the server; an answer for a project that is not shown any more is dropped. */
export async function loadSubranges(project: number): Promise<void> {
  try {
    const { policies } = await rest.subranges(project);
    if (useDocuments.getState().project === project) useSubranges.setState({ policies, trouble: null });
  } catch (error) {
    useSubranges.setState({ trouble: messageOf(error) });
  }
}

/** Saves all entries; true if they are saved. What was there is shown again after a refusal. */
export async function changeSubranges(project: number, policies: Policies): Promise<boolean> {
  try {
    useSubranges.setState({ policies: (await rest.changeSubranges(project, policies)).policies, trouble: null });
    return true;
  } catch (error) {
    useSubranges.setState({ trouble: messageOf(error) });
    return false;
  }
}
