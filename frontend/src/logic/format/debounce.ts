/** Debounce: a call runs a moment after the first request, once for all requests that came until then. */

interface Spaced {
  (): void;
  cancel: () => void;
}

/** Continuous requests do not postpone the call: it then runs every `delay` milliseconds. */
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
