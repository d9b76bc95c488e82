/** A new project that runs at once. */
import { skeleton } from "../../logic/project/explorer";
import { rest } from "../../wire/rest";
import { chooseProject, createInstance, refreshApp } from "../plc/bench";

/** Makes a project with a first program and an instance that runs it. Throws the server's refusal. */
export async function createProject(name: string, model: string, instanceName: string): Promise<void> {
  const project = await rest.createProject(name, model);
  if ((await rest.files(project.id)).length === 0) await rest.save(project.id, "Main.st", skeleton("Main.st"), 0);
  const built = await rest.build(project.id, true);
  if (built.ok) await createInstance(built.project, instanceName);
  else {
    await refreshApp();
    await chooseProject(project);
  }
}
