/** The page shows a different instance or project: stores that hold data of the old one reset themselves here. */
import type { Instance, Project } from "../../wire/types";

interface Chosen {
  project: Project;
  /** Null for a project without an instance, or while no instance is shown. */
  instance: Instance | null;
  /** The project changes, too. */
  otherProject: boolean;
}

type Callback = (chosen: Chosen) => unknown;

const callbacks: Callback[] = [];

/**
 * Runs at each change, before the socket connects; a returned promise is awaited. A store imports the stores that it builds on,
 * so those run first.
 */
export function onInstanceChange(callback: Callback): void {
  callbacks.push(callback);
}

export async function instanceChanged(chosen: Chosen): Promise<void> {
  await Promise.all(callbacks.map((callback) => callback(chosen)));
}
