/** The dialect of the project: it is in one of its files, so it changes with that file, whoever saves it. */
import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { rest } from "../../wire/rest";
import type { ProjectDialect } from "../../wire/types";
import { useDocuments } from "./documents";

export type Dialect = ProjectDialect["dialect"];
export const DIALECTS: readonly Dialect[] = ["iec", "codesys", "twincat", "siemens", "rockwell", "omron"];
export const LANGUAGE_FILE = "language.json";

interface State {
  /** Null until the server answered. */
  dialect: Dialect | null;
  /** Why the last change was refused. */
  trouble: string | null;
}

export const useDialect = create<State>(() => ({ dialect: null, trouble: null }));

/** The saved version of the file that says it; 0 where there is none. */
export const useDialectVersion = () =>
  useDocuments(({ files }) => files.find(({ path }) => path === LANGUAGE_FILE)?.version ?? 0);

/** Asks the server; an answer for a project that is not shown any more is dropped. */
export async function loadDialect(project: number): Promise<void> {
  try {
    const { dialect } = await rest.dialect(project);
    if (useDocuments.getState().project === project) useDialect.setState({ dialect });
  } catch {
    // Without a connection the page says so; the next one asks again.
  }
}

/** Saves the file; everybody at the project hears of it as of every file. */
export async function changeDialect(project: number, dialect: Dialect): Promise<void> {
  const before = useDialect.getState().dialect;
  useDialect.setState({ dialect, trouble: null });
  try {
    await rest.changeDialect(project, dialect);
  } catch (error) {
    useDialect.setState({ dialect: before, trouble: messageOf(error) });
  }
}
