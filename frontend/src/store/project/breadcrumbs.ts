/** The key that opens the menu of the last part of the line above the text: the editors of all files listen, the active one acts. */

const listeners = new Set<() => void>();

export function onBreadcrumbs(open: () => void): () => void {
  listeners.add(open);
  return () => listeners.delete(open);
}

export function openBreadcrumbs(): void {
  for (const open of listeners) open();
}
