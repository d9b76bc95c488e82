/** Another instance is looked at, or another project: who holds something of the one before forgets it. */
import type { Instance, Project } from "../../wire/types";

interface Chosen {
  project: Project;
  /** Null for a project without an instance, or while none is looked at. */
  instance: Instance | null;
  /** The project is another one, too. */
  otherProject: boolean;
}

type Callback = (chosen: Chosen) => unknown;

const callbacks: Callback[] = [];

/**
 * Runs with each choice, before the socket connects; a promise that it returns is waited for. What a store builds on is imported by it,
 * and so runs before it.
 */
export function onInstanceChange(callback: Callback): void {
  callbacks.push(callback);
}

export async function instanceChanged(chosen: Chosen): Promise<void> {
  await Promise.all(callbacks.map((callback) => callback(chosen)));
}
