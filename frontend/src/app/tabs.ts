/** The active tab of each strip is in sight, however many tabs there are and however narrow the window becomes. */

/** Turns the strips of the dock so far that their active tabs are whole; only the strips: nothing around them moves. */
function reveal(dock: HTMLElement): void {
  for (const tab of dock.querySelectorAll<HTMLElement>(".dv-tab.dv-active-tab")) {
    const strip = tab.closest(".dv-tabs-container");
    if (!strip) continue;
    const [shown, wanted] = [strip.getBoundingClientRect(), tab.getBoundingClientRect()];
    if (wanted.right > shown.right) strip.scrollLeft += wanted.right - shown.right;
    // A tab wider than its strip begins at the left.
    if (wanted.left < shown.left || wanted.width > shown.width) strip.scrollLeft += wanted.left - shown.left;
  }
}

/** Returns what makes the tabs visible once the dock has been drawn, and a function that ends it. */
export function keepTabsInSight(dock: HTMLElement): { soon: () => void; stop: () => void } {
  let asked = 0;
  const soon = () => {
    cancelAnimationFrame(asked);
    asked = requestAnimationFrame(() => reveal(dock));
  };
  const resized = new ResizeObserver(soon);
  resized.observe(dock);
  return {
    soon,
    stop: () => {
      cancelAnimationFrame(asked);
      resized.disconnect();
    },
  };
}
