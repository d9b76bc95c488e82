/** A new project that runs at once, and projects as files. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { skeleton } from "../../logic/project/skeleton";
import { t } from "../../text";
import { rest } from "../../wire/rest";
import type { ExchangeFile, ExchangeForm, Project, ProjectArchive, ProjectTemplate } from "../../wire/types";
import { saveFile } from "../page/download";
import { showPanel } from "../page/navigate";
import { chooseProject, createInstance, refreshApp } from "../plc/bench";
import { useDocuments } from "./documents";

/** A zip file that was dropped on the page: the dialog for a new project shows what it has. */
export const useDropped = create<{ archive: File | null }>(() => ({ archive: null }));

export const dropArchive = (archive: File | null): void => useDropped.setState({ archive });

/** Makes a project, with the files of an archive or template or with a first program, and an instance that runs it. Throws the server's refusal. */
export async function createProject(
  name: string,
  model: string,
  instanceName: string,
  from: File | string,
): Promise<void> {
  const project = await (typeof from === "string"
    ? rest.createProject(name, model, from)
    : rest.unpackProject(name, model, from));
  if ((await rest.files(project.id)).length === 0) await rest.save(project.id, "Main.st", skeleton("Main.st"), 0);
  const built = await rest.build(project.id, true);
  if (built.ok) await createInstance(built.project, instanceName);
  else {
    await refreshApp();
    await chooseProject(project);
    useDocuments.setState({ trouble: t("newproject.noplc", { name: instanceName }) });
    showPanel("problems");
  }
}

export const listTemplates = (): Promise<ProjectTemplate[]> => rest.templates();

export const lookAtArchive = (file: File): Promise<ProjectArchive> => rest.lookAtArchive(file);

/** The program of a project as a file for other tools, with what that form has no place for. Throws the server's refusal. */
export const writeProject = (project: Project, form: ExchangeForm): Promise<ExchangeFile> =>
  rest.writeProject(project.id, form);

export const saveExchangeFile = ({ name, text }: ExchangeFile): void =>
  saveFile(new Blob([text], { type: "application/xml" }), name);

/** Saves a project as a zip file, as it is on the server. */
export async function exportProject({ id, name }: Project): Promise<void> {
  try {
    saveFile(await rest.packProject(id), `${name}.zip`);
  } catch (error) {
    useDocuments.setState({ trouble: messageOf(error) });
    showPanel("problems");
  }
}
