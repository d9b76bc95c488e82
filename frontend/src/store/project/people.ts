/** Who else is at the project and where, where you are for them, and whom you follow. */
import { create } from "zustand";
import { link } from "../../wire/socket";
import type { Here, People, Person } from "../../wire/types";
import { openFile } from "../page/navigate";
import { chooseInstance, refreshApp, useBench } from "../plc/bench";
import { usePlc } from "../plc/plc";
import { onInstanceChange } from "../plc/reset";
import { useDocuments } from "./documentState";

interface Known {
  /** Your own number among the people. */
  you: number;
  people: readonly Person[];
  /** The number of the person whom you follow. */
  following: number | null;
}

export const usePeople = create<Known>(() => ({ you: 0, people: [], following: null }));

const get = usePeople.getState;
const set = usePeople.setState;

/** More often nobody sees it. */
const PAUSE = 80;
const NOWHERE = { file: null, line: null, anchor: null, head: null };
let here: Omit<Here, "type"> = NOWHERE;
let told = "";
let later: ReturnType<typeof setTimeout> | undefined;

export function onPeople({ you, people }: People): void {
  set({ you, people });
  if (followed()) void goAlong();
  else endFollowing();
}

export const othersOf = ({ you, people }: Known) => people.filter(({ id }) => id !== you);

/** Everybody else is told, a moment later, where you are. */
export function tellHere(place: Omit<Here, "type">): void {
  here = place;
  later ??= setTimeout(tell, PAUSE);
}

function tell(): void {
  clearTimeout(later);
  later = undefined;
  const text = JSON.stringify(here);
  if (text !== told && link.post({ type: "here", ...here })) told = text;
}

useDocuments.subscribe(({ active }, before) => {
  if (active === null && before.active !== null) tellHere(NOWHERE);
});

onInstanceChange(({ otherProject }) => {
  if (otherProject) set({ you: 0, people: [], following: null });
});

// A new connection is of somebody of whom the server knows nothing yet.
usePlc.subscribe(({ link: now }, { link: before }) => {
  if (now.state === before.state) return;
  if (now.state === "open") tell();
  else told = "";
});

const followed = () => get().people.find(({ id }) => id === get().following);

export function follow(id: number): void {
  went = "";
  set({ following: id });
  void goAlong();
}

export function endFollowing(): void {
  if (get().following !== null) set({ following: null });
}

/** Where they were last: in the same place one may look around. */
let went = "";

async function goAlong(): Promise<void> {
  const person = followed();
  if (!person) return;
  const { id, instance, file } = person;
  const now = `${instance} ${file}`;
  if (now === went) return;
  went = now;
  if (useBench.getState().instance?.id !== instance) await goToInstance(instance);
  if (file !== null && get().following === id) openFile(file);
}

async function goToInstance(id: number): Promise<void> {
  const known = () => useBench.getState().app?.instances.find((each) => each.id === id);
  if (!known()) await refreshApp().catch(() => undefined);
  const instance = known();
  if (instance) await chooseInstance(instance);
}

/** Goes to where somebody is now. */
export async function goTo({ instance, file, line }: Person): Promise<void> {
  endFollowing();
  if (useBench.getState().instance?.id !== instance) await goToInstance(instance);
  if (file !== null) openFile(file, line ?? 1);
}
