/** What a browser stores: small JSON entries in localStorage, which may be missing, full, or broken. */

export const PREFIX = "scanbench.";

/** What was kept, if it is of the same kind as the fallback: another version, or somebody's hand, may have kept a different one. */
export function recall<T>(key: string, fallback: T): T {
  try {
    const text = localStorage.getItem(PREFIX + key);
    const kept: unknown = text === null ? fallback : JSON.parse(text);
    return isLike(fallback, kept) ? kept : fallback;
  } catch {
    return fallback;
  }
}

/** Null says nothing about what may be kept. */
function isLike<T>(fallback: T, kept: unknown): kept is T {
  if (fallback === null) return true;
  return kept !== null && typeof kept === typeof fallback && Array.isArray(kept) === Array.isArray(fallback);
}

/** False when the browser has no room or no storage; the caller decides whether that matters. */
export function keep(key: string, value: unknown): boolean {
  return keepText(key, JSON.stringify(value));
}

/** As `keep`, of a value that is JSON already. */
export function keepText(key: string, text: string): boolean {
  try {
    localStorage.setItem(PREFIX + key, text);
    return true;
  } catch {
    return false;
  }
}

export function forget(key: string): void {
  try {
    localStorage.removeItem(PREFIX + key);
  } catch {
    // Nothing could be stored, so there is nothing to remove.
  }
}

/** Forgets it unless it is different by now: a different page of this browser may have written it. */
export function forgetSame(key: string, text: string): void {
  try {
    if (localStorage.getItem(PREFIX + key) === text) localStorage.removeItem(PREFIX + key);
  } catch {
    // As above.
  }
}

/** The keys that begin so. */
export function keysOf(beginning: string): string[] {
  try {
    const keys = Object.keys(localStorage).filter((key) => key.startsWith(PREFIX + beginning));
    return keys.map((key) => key.slice(PREFIX.length)).sort();
  } catch {
    return [];
  }
}
