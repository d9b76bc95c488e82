/** The rows of the instance list: which are shown, and in which order. */
import type { Instance } from "../../wire/types";

export const COLUMNS = [
  "name",
  "project",
  "model",
  "state",
  "scan",
  "interval",
  "cpu",
  "memory",
  "late",
  "run",
] as const;
export type Column = (typeof COLUMNS)[number];

export interface Order {
  by: Column;
  down: boolean;
}

const VALUES: Record<Column, (instance: Instance) => string | number> = {
  name: ({ name }) => name,
  project: ({ project }) => project.name,
  model: ({ model }) => model,
  state: ({ state }) => `${state.state} ${state.mode}`,
  scan: ({ state }) => state.scan,
  interval: ({ state }) => state.interval_ns,
  cpu: ({ load }) => load.cpu_percent,
  memory: ({ load }) => load.memory_bytes,
  late: ({ state }) => state.late_percent,
  run: ({ load }) => load.run_bytes,
};

const words = new Intl.Collator(undefined, { numeric: true, sensitivity: "base" });

/** Every word of the filter must be found in name, project, model, state or mode. */
export function shownInstances(all: readonly Instance[], filter: string, order: Order): Instance[] {
  const wanted = filter.toLowerCase().split(/\s+/).filter(Boolean);
  const found = all.filter((instance) => {
    const { name, project, model, state } = instance;
    const text = `${name} ${project.name} ${model} ${state.state} ${state.mode}`.toLowerCase();
    return wanted.every((word) => text.includes(word));
  });
  const value = VALUES[order.by];
  const sign = order.down ? -1 : 1;
  return found.sort((a, b) => sign * compare(value(a), value(b)) || words.compare(a.name, b.name) || a.id - b.id);
}

function compare(a: string | number, b: string | number): number {
  return typeof a === "number" && typeof b === "number" ? a - b : words.compare(String(a), String(b));
}

/** The load of all instances together. */
export function sumOf(all: readonly Instance[]): { running: number; cpu: number; memory: number } {
  return {
    running: all.filter(({ state }) => state.state === "running").length,
    cpu: all.reduce((sum, { load }) => sum + load.cpu_percent, 0),
    memory: all.reduce((sum, { load }) => sum + load.memory_bytes, 0),
  };
}

/** The first of NAME-2, NAME-3, ... that is not taken. */
export function copyName(name: string, taken: readonly string[]): string {
  const stem = name.replace(/-\d+$/, "");
  let number = 2;
  while (taken.includes(`${stem}-${number}`)) number += 1;
  return `${stem}-${number}`;
}
