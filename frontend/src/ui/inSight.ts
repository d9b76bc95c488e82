/** Whether the panel that something is part of can be seen: it is the tab in front, and no page has the whole window. */
import { createContext, useContext, useEffect, useRef } from "react";

export const InSight = createContext(true);

/** Says, whenever it is asked, whether somebody can look at this part of the page. */
export function useLookedAt(): () => boolean {
  const inSight = useContext(InSight);
  const now = useRef(inSight);
  useEffect(() => {
    now.current = inSight;
  }, [inSight]);
  return useRef(() => now.current && document.visibilityState === "visible").current;
}
