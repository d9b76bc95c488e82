/** A deed that many reasons call for: done a moment after the first of them, and once for all that came until then. */

interface Spaced {
  (): void;
  cancel: () => void;
}

/** Reasons that keep coming never put it off: it is done every `delay` milliseconds then. */
export function spaced(deed: () => void, delay: number): Spaced {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const call = () => {
    timer ??= setTimeout(() => {
      timer = undefined;
      deed();
    }, delay);
  };
  return Object.assign(call, { cancel: () => clearTimeout(timer) });
}
