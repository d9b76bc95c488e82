/** The projects and instances of this server, and the project, instance and model that this browser shows. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { readLink } from "../../logic/plc/links";
import { Refused, rest } from "../../wire/rest";
import { link } from "../../wire/socket";
import type { AppInfo, Instance, ModelInfo, Project } from "../../wire/types";
import { keep, recall } from "../page/localStorage";
import { keptLooks } from "./looks";
import { resetPlc, usePlc } from "./plc";
import { instanceChanged } from "./reset";

interface Bench {
  phase: "loading" | "ready" | "locked" | "failed";
  problem: string;
  app: AppInfo | null;
  project: Project | null;
  instance: Instance | null;
  model: ModelInfo | null;
}

export const useBench = create<Bench>(() => ({
  phase: "loading",
  problem: "",
  app: null,
  project: null,
  instance: null,
  model: null,
}));

const get = useBench.getState;
const set = useBench.setState;

/** At the start: loads the server's projects, then selects the instance of the address, else that of the last visit, else the first. In the
 * place of a look at the past that has ended, it is the PLC that it was of. */
export async function start(): Promise<void> {
  try {
    const app = await rest.app();
    set({ app, phase: "ready" });
    const looks = keptLooks();
    const there = (id: number | null | undefined) => app.instances.find((instance) => instance.id === id);
    const known = (id: number | null) => there(id) ?? there(looks[id ?? ""]?.of);
    const linked = readLink(location)?.instance ?? null;
    const instance = known(linked) ?? known(recall<number | null>("instance", null)) ?? app.instances[0];
    if (instance) await chooseInstance(instance);
    else if (app.projects[0]) await chooseProject(app.projects[0]);
  } catch (error) {
    set({ phase: isLocked(error) ? "locked" : "failed", problem: messageOf(error) });
  }
}

const isLocked = (error: unknown) => error instanceof Refused && error.status === 401;

/** The server may have a new token, or this browser has lost its token: then no reconnection can succeed, and the page asks for the token. */
async function checkKey(): Promise<void> {
  try {
    await rest.app(AbortSignal.timeout(KEY_PATIENCE));
  } catch (error) {
    if (!isLocked(error)) return;
    link.connect(null);
    set({ phase: "locked", problem: messageOf(error) });
  }
}

/** A busy server may take long for it, in ms; meanwhile further attempts go on. */
const KEY_PATIENCE = 10_000;

usePlc.subscribe(({ link: now }, { link: before }) => {
  if (now.state === "lost" && now.attempt !== before.attempt) void checkKey();
});

export async function chooseInstance(instance: Instance): Promise<void> {
  keep("instance", instance.id);
  await look(instance.project, instance);
}

/** A project without an instance can be edited and built, not run. */
export async function chooseProject(project: Project): Promise<void> {
  await look(project, null);
}

async function look(project: Project, instance: Instance | null): Promise<void> {
  const otherProject = get().project?.id !== project.id;
  set({ project, instance, model: null });
  link.connect(null);
  resetPlc();
  const ready = instanceChanged({ project, instance, otherProject });
  link.connect(instance?.id ?? null);
  await Promise.all([ready, loadModel()]);
}

/** The model as the PLC has it, with the errors that its program's project added; a project without a PLC has the plain model. */
async function loadModel(): Promise<void> {
  const { project, instance } = get();
  if (!project) return;
  const model = await (instance ? rest.instanceModel(instance.id) : rest.model(project.model).catch(noSuchModel));
  const now = get();
  if (now.project?.id === project.id && now.instance?.id === instance?.id) set({ model });
}

/** The model file of a project may be missing; the project can still be shown and deleted. */
function noSuchModel(error: unknown): null {
  if (error instanceof Refused && error.status === 422) return null;
  throw error;
}

// A different program of the project may define different errors.
usePlc.subscribe(({ state: now }, { state: before }) => {
  if (now && before && now.program_version !== before.program_version) loadModel().catch(() => undefined);
});

export async function createInstance(project: Project, name: string): Promise<void> {
  const instance = await rest.createInstance(project.id, name);
  await refreshApp();
  await chooseInstance(instance);
}

export async function refreshApp(): Promise<void> {
  set({ app: await rest.app() });
}

/** A build was accepted: updates the version in the top bar. */
export function onProject(project: Project): void {
  if (get().project?.id === project.id) set({ project });
}
