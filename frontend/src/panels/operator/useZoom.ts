import { type RefObject, useEffect, useState } from "react";
import { extent, type Panel } from "../../logic/operator/panel";
import { CELL } from "./PanelGrid";

const LARGEST = 3;

/** How much larger a panel can be drawn so that it fills the element that shows it; never smaller than 1. */
export function useZoom(element: RefObject<HTMLElement | null>, panel: Panel, wanted: boolean): number {
  const [zoom, setZoom] = useState(1);
  const { columns, rows } = extent(panel);
  useEffect(() => {
    const box = element.current;
    if (!wanted || !box || columns === 0) return;
    const fit = () => {
      const { paddingLeft, paddingTop } = getComputedStyle(box);
      const wide = box.clientWidth - 2 * Number.parseFloat(paddingLeft);
      const high = box.clientHeight - 2 * Number.parseFloat(paddingTop);
      setZoom(Math.max(1, Math.min(LARGEST, wide / (columns * CELL), high / (rows * CELL))));
    };
    const observer = new ResizeObserver(fit);
    observer.observe(box);
    return () => observer.disconnect();
  }, [element, columns, rows, wanted]);
  return wanted ? zoom : 1;
}
