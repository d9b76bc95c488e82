import { useEffect, useRef, useState } from "react";
import { useNavigation } from "../store/page/navigate";
import { useDocuments } from "../store/project/documents";

type Side = "explorer" | "debug" | null;

/** The left side of a narrow window, which covers the editor: it closes with Escape, by a click elsewhere, and once somebody went to a file or page. */
export function useFlyout() {
  const [side, setSide] = useState<Side>(null);
  const active = useDocuments((documents) => documents.active);
  const went = useNavigation((navigation) => navigation.went);
  const before = useRef({ active, went });
  useEffect(() => {
    // The first file opens by itself, perhaps while somebody reads the explorer.
    const byHand = before.current.active !== null || went !== before.current.went;
    before.current = { active, went };
    if (byHand) setSide(null);
  }, [active, went]);
  useEffect(() => {
    if (side === null) return;
    const onPointerDown = ({ target }: PointerEvent) => {
      if (target instanceof Element && !target.closest(".leftside, .strip, [role=menu], dialog")) setSide(null);
    };
    const onKeyDown = ({ key, target, defaultPrevented }: KeyboardEvent) => {
      if (key !== "Escape" || defaultPrevented || !(target instanceof Element)) return;
      if (!target.closest(".leftside, .strip")) return;
      document.querySelector<HTMLElement>(".strip .is-on")?.focus();
      setSide(null);
    };
    addEventListener("pointerdown", onPointerDown);
    addEventListener("keydown", onKeyDown);
    return () => {
      removeEventListener("pointerdown", onPointerDown);
      removeEventListener("keydown", onKeyDown);
    };
  }, [side]);
  return { side, toggle: (wanted: Exclude<Side, null>) => setSide((now) => (now === wanted ? null : wanted)) };
}
