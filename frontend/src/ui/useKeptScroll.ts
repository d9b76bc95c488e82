import { type RefObject, useEffect } from "react";

/**
 * A panel in a hidden tab loses its scroll position: the browser sets it to 0 without an event. This hook restores the position
 * when the panel is shown again.
 */
export function useKeptScroll(scroller: RefObject<HTMLElement | null>): void {
  useEffect(() => {
    const element = scroller.current;
    if (!element) return;
    let top = element.scrollTop;
    let hidden = element.clientHeight === 0;
    const note = () => {
      if (element.clientHeight > 0 && !hidden) top = element.scrollTop;
    };
    const seen = new ResizeObserver(() => {
      const was = hidden;
      hidden = element.clientHeight === 0;
      if (!was || hidden) return;
      element.scrollTop = top;
      // The rows are placed by the last scroll event, which told the position before.
      element.dispatchEvent(new Event("scroll"));
    });
    element.addEventListener("scroll", note, { passive: true });
    seen.observe(element);
    return () => {
      element.removeEventListener("scroll", note);
      seen.disconnect();
    };
  }, [scroller]);
}
