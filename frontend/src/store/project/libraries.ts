/** The libraries of vendors for the project's dialect. */
import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { rest } from "../../wire/rest";
import type { ProjectLibrary } from "../../wire/types";
import { useDocuments } from "./documents";

interface State {
  /** Null until the server answered. */
  libraries: readonly ProjectLibrary[] | null;
  trouble: string | null;
}

export const useLibraries = create<State>(() => ({ libraries: null, trouble: null }));

/** Asks the server; an answer for a project that is not shown any more is dropped. */
export async function loadLibraries(project: number): Promise<void> {
  try {
    const libraries = await rest.libraries(project);
    if (useDocuments.getState().project === project) useLibraries.setState({ libraries, trouble: null });
  } catch (error) {
    useLibraries.setState({ trouble: messageOf(error) });
  }
}

/** Saves the text of a library as a file of the project. */
export async function addLibrary(project: number, name: string): Promise<void> {
  try {
    await rest.addLibrary(project, name);
    await loadLibraries(project);
  } catch (error) {
    useLibraries.setState({ trouble: messageOf(error) });
  }
}

/** The page that tells how much of the project runs. */
export const reportAddress = (project: number) => `/api/projects/${project}/report`;
