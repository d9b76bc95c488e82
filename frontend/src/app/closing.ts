/** Closing a tab by hand: asks first if its text is not saved. */
import type { DockviewApi } from "dockview-react";
import { create } from "zustand";
import { isEdited, useUserErrors } from "../store/errors/userErrors";
import { isDirty, useDocuments } from "../store/project/documents";
import { closeTab, fileOf } from "./layout";

interface Closing {
  /** The panel that is about to be closed, while the question is open. */
  panel: string | null;
}

export const useClosing = create<Closing>(() => ({ panel: null }));

export function closeByHand(dock: DockviewApi, panel: string): void {
  if (holdsEdits(panel)) useClosing.setState({ panel });
  else closeTab(dock, panel);
}

function holdsEdits(panel: string): boolean {
  const path = fileOf(panel);
  if (path !== undefined) return isDirty(useDocuments.getState().open[path]);
  return panel === "usererrors" && isEdited(useUserErrors.getState());
}
