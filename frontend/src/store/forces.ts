/** Which rows are forced and who wrote last, as far as this browser was told. */
import { create } from "zustand";

export interface WrittenBy {
  author: string;
  scan: number;
}

interface Forces {
  paths: ReadonlySet<string>;
  written: ReadonlyMap<string, WrittenBy>;
}

export const useForces = create<Forces>(() => ({ paths: new Set(), written: new Map() }));

export function onWritten(path: string, author: string, scan: number, forced: boolean): void {
  useForces.setState((state) => ({
    paths: forced ? new Set(state.paths).add(path) : state.paths,
    written: new Map(state.written).set(path, { author, scan }),
  }));
}

export function onReleased(path: string | null): void {
  useForces.setState(({ paths }) => {
    const next = new Set(path === null ? [] : paths);
    if (path !== null) next.delete(path);
    return { paths: next };
  });
}

/** The PLC counts its forces; at none, no row is forced, whoever released them. */
export function onForceCount(count: number): void {
  if (count === 0 && useForces.getState().paths.size > 0) useForces.setState({ paths: new Set() });
}

export function resetForces(): void {
  useForces.setState({ paths: new Set(), written: new Map() });
}
