import { type RefObject, useEffect } from "react";

/**
 * A panel behind another tab loses its place: the browser sets a hidden scroller to 0, and tells nobody. Where it stood
 * is put back when it is shown again.
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
      // The rows are placed by the scroller's last word, which was before.
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
